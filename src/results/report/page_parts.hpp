#pragma once
// Common parts of pages: texts inside a script element, and scripts by their hashes.
#include <string>
#include <string_view>

namespace railstrata {

/// JSON inside a script element, where nothing may look like a tag: "<" stands in its texts only, where \u003c means
/// the same.
std::string json_in_page(const std::string& json);

/// 'sha256-…' as a Content-Security-Policy names a script or style.
std::string policy_hash(std::string_view text);

}  // namespace railstrata
