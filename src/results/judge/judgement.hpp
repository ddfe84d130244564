#pragma once
// Does it last? The answer of a result in one line, with the body and the zone that decide: for the screen, the files,
// the pages and the tables of studies.
#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "result/summary.hpp"

namespace railstrata {

// ---- the verdict on rail, wheel or layer under repeated rolling, as a text: one rule for files, tables, pages and
// studies
/// Response of the material by its load factors, from the best to the worst; then failures of layers.
enum class Verdict {
  elastic,
  shakes_down,
  one_track,
  perhaps_one_track,
  yields,
  ratchets,
  layer_cracks,
  interface_shears
};

struct VerdictRow {
  std::string_view text, means;
  bool lasts;
};
inline constexpr std::array<VerdictRow, 8> kVerdicts{
    {{"stays elastic", "it never yields", true},
     {"shakes down", "it yields in the first passages and then no more", true},
     {"shakes down in one track",
      "only if every wheel runs in the same place; wheels that wander sideways make it yield again and again", false},
     {"may shake down in one track", "beyond the limit for wandering traffic; below the bound that no load exceeds",
      false},
     {"yields in every passage", "back and forth if the material hardens kinematically, drifting if it does not",
      false},
     {"ratchets", "every passage adds strain, until it cracks or flows away", false},
     {"brittle layer cracks", "its largest principal stress reaches its tensile strength", false},
     {"interface shears", "the tractions at a layer's lower side reach the strength of the bond", false}}};

inline const VerdictRow& verdict_row(Verdict v) { return kVerdicts[static_cast<std::size_t>(v)]; }
/// "shakes down in one track".
inline std::string_view verdict_text(Verdict v) { return verdict_row(v).text; }

/// The first of first_yield, wandering, single_track, upper and kinematic that is at least 1 decides, in this order. A
/// single_track that was not computed (NaN) is passed over; another that is NaN means that nothing decides it: no
/// stress, or no strength.
inline Verdict verdict_of(const ShakedownFactors& f) {
  const auto enough = [](double factor) { return !(factor < 1); };
  if (enough(f.first_yield)) return Verdict::elastic;
  if (enough(f.wandering)) return Verdict::shakes_down;
  if (f.single_track >= 1) return Verdict::one_track;
  if (enough(f.upper)) return Verdict::perhaps_one_track;
  return enough(f.kinematic) ? Verdict::yields : Verdict::ratchets;
}

/// Verdict of the worst body. There must be one.
inline Verdict verdict_of(const ShakedownSummary& s) {
  Verdict worst = Verdict::elastic;
  for (const BodyShakedown& b : s.bodies) worst = std::max(worst, verdict_of(b.factors));
  return worst;
}

/// All that ends it, the load factors first; empty where it lasts. What is NaN is not known and ends nothing.
inline std::vector<Verdict> fails_by(Verdict by_factors, double share_of_tensile, double delamination) {
  std::vector<Verdict> out;
  if (!verdict_row(by_factors).lasts) out.push_back(by_factors);
  if (share_of_tensile >= 1) out.push_back(Verdict::layer_cracks);
  if (delamination >= 1) out.push_back(Verdict::interface_shears);
  return out;
}
inline std::vector<Verdict> fails_by(const Summary& s) {
  const LayerWorst layers = layer_worst(s);
  return fails_by(verdict_of(s.shakedown), layers.share_of_tensile, layers.delamination);
}

// ---- the answer
enum class Lasts { yes, narrowly, one_track, perhaps_one_track, withheld, no };

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
/// A load factor below it lasts narrowly: strengths of one steel differ by as much. [EN13674]
inline constexpr double kAmple = 1.1;

/// Does it last? A "no" stays; any other answer with doubts becomes "withheld". Empty without a strength.
std::optional<Judgement> judgement_of(const Summary& summary);

/// "at the surface", "2.31 mm deep".
std::string depth_in_words(double depth);

}  // namespace railstrata
