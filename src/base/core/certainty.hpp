#pragma once
// How sure a preset number is.
#include <string_view>

namespace railstrata {

enum class Certainty {
  absent,            ///< nothing known: the user must give it
  standard_minimum,  ///< what the standard asks for
  estimated,         ///< usual values or a rule of thumb, no standard behind them
  published          ///< from a source that can be looked up, not measured for this use
};
/// "", "standard minimum", "estimated", "published".
constexpr std::string_view certainty_text(Certainty certainty) {
  switch (certainty) {
    case Certainty::standard_minimum:
      return "standard minimum";
    case Certainty::estimated:
      return "estimated";
    case Certainty::published:
      return "published";
    case Certainty::absent:
      break;
  }
  return "";
}

}  // namespace railstrata
