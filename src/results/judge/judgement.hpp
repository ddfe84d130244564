#pragma once
// Does it last? The answer of a result in one line, with the body and the zone that decide: for the screen, the files,
// the pages and the tables of studies.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "judge/verdict.hpp"
#include "result/summary.hpp"

namespace railstrata {

enum class Lasts { yes, one_track, perhaps_one_track, withheld, no };

struct LastsRow {
  std::string_view word;   ///< "does it last?" "yes"
  std::string_view title;  ///< of a page
  std::string_view tone;   ///< "good", "open", "bad": green, amber, red
};
const LastsRow& lasts_row(Lasts lasts);

struct Judgement {
  Lasts lasts = Lasts::yes;
  std::string zone;     ///< "rail: layer"; "wheel" where no layer decides; as tables name it
  std::string decides;  ///< "layer of the rail, at the surface"
  std::string reason;   ///< all of it in words, `decides` first
  /// Keys of failed checks and of warnings that rule a "yes" out; a body whose layers and fatigue were not looked at
  std::vector<std::string> doubts;
};
/// A "yes" with doubts becomes "withheld", a "no" stays. Empty without a strength.
std::optional<Judgement> judgement_of(const Summary& summary);

/// "at the surface", "2.31 mm deep".
std::string depth_in_words(double depth);

}  // namespace railstrata
