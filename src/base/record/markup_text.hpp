#pragma once
// Text in XML, SVG and HTML.
#include <string>
#include <string_view>

namespace railstrata {

/// A text that reads as itself between tags and inside double quotes: &, < and " as entities.
std::string markup_text(std::string_view text);

}  // namespace railstrata
