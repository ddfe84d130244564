#pragma once
// A page inside a report, in a frame of its own.
#include <string>

namespace railstrata {

/// A frame that is made of a text obeys the policy of the page around it as well as its own: so this gives what the
/// text asks for beyond a report's own policy.
struct FramedPage {
  std::string text;            ///< a whole HTML page
  std::string script_policy;   ///< further sources of scripts, each after a space
  std::string style_policy;    ///< of styles
  std::string further_policy;  ///< whole directives, each with "; " behind it
};

}  // namespace railstrata
