#pragma once
// A report as one HTML file.
#include <string>
#include <string_view>

#include "report/report.hpp"

namespace railstrata {

/// A page inside a report, in a frame of its own. A frame that is made of a text obeys the policy of the page around it
/// as well as its own: so this gives what the text asks for beyond a report's own policy.
struct FramedPage {
  std::string text;            ///< a whole HTML page
  std::string script_policy;   ///< further sources of scripts, each after a space
  std::string style_policy;    ///< of styles
  std::string further_policy;  ///< whole directives, each with "; " behind it
};

/// The page: one file without any reference outside it. Scripts and styles run by their hashes alone
/// (Content-Security-Policy). what_if: another page, in a frame that opens on demand ("What if?").
std::string report_page(const Report& report, const FramedPage& what_if = {});

// ---- parts of pages: texts inside a script element, scripts by their hashes, bytes as text
/// JSON inside a script element, where nothing may look like a tag: "<" stands in its texts only, where \u003c means
/// the same.
std::string json_in_page(const std::string& json);

/// Base64 with padding [RFC 4648].
std::string base64_of(std::string_view bytes);

/// 'sha256-…' as a Content-Security-Policy names a script or style.
std::string policy_hash(std::string_view text);

}  // namespace railstrata
