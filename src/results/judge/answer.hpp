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

struct Answer {
  Lasts lasts = Lasts::yes;
  std::string zone;                 ///< "rail: layer"; "wheel" where no layer decides; as tables name it
  std::string decides;              ///< "layer of the rail, at the surface"
  std::string reason;               ///< all of it in words, `decides` first
  std::vector<std::string> doubts;  ///< keys of failed checks and of warnings beside which no "yes" can stand
};
/// Of a "yes" beside a doubt nothing is left: withheld. A "no" stays. None without a strength.
std::optional<Answer> answer_of(const Summary& summary);

/// "at the surface", "2.31 mm deep".
std::string depth_in_words(double depth);

}  // namespace railstrata
