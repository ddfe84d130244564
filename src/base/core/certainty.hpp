#pragma once
// How sure a preset number is.
#include <array>
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
  constexpr std::array<std::string_view, 4> words{"", "standard minimum", "estimated", "published"};
  return words[static_cast<std::size_t>(certainty)];
}

}  // namespace railstrata
