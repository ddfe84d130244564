#pragma once
// What becomes of rail, wheel or layer under repeated rolling, in words: one rule for files, tables, pages and studies.
#include <algorithm>
#include <array>
#include <string_view>

#include "post/summary.hpp"

namespace railstrata {

/// From the best to the worst.
enum class Verdict { elastic, shakes_down, one_track, perhaps_one_track, yields, ratchets };

struct VerdictWords {
  std::string_view words, means;
  bool lasts;
};
inline constexpr std::array<VerdictWords, 6> kVerdicts{
    {{"stays elastic", "it never yields", true},
     {"shakes down", "it yields in the first passages and then no more", true},
     {"shakes down in one track",
      "only if every wheel runs in the same place; wheels that wander sideways make it yield again and again", false},
     {"may shake down in one track", "beyond the limit for wandering traffic; below the bound that no load exceeds",
      false},
     {"yields in every passage", "back and forth if the material hardens kinematically, drifting if it does not",
      false},
     {"ratchets", "every passage adds strain, until it cracks or flows away", false}}};

inline const VerdictWords& words_of(Verdict v) { return kVerdicts[static_cast<std::size_t>(v)]; }

/// The first of first_yield, wandering, single_track, upper and kinematic that is at least 1 decides, in this order. A
/// single_track that was not computed (NaN) is passed over; another that is NaN says that nothing decides it: no
/// stress, or no strength.
inline Verdict verdict_of(const ShakedownFactors& f) {
  const auto enough = [](double factor) { return !(factor < 1); };
  if (enough(f.first_yield)) return Verdict::elastic;
  if (enough(f.wandering)) return Verdict::shakes_down;
  if (f.single_track >= 1) return Verdict::one_track;
  if (enough(f.upper)) return Verdict::perhaps_one_track;
  return enough(f.kinematic) ? Verdict::yields : Verdict::ratchets;
}

/// Of the body that fares worst. There must be one.
inline Verdict verdict_of(const ShakedownSummary& s) {
  Verdict worst = Verdict::elastic;
  for (const BodyShakedown& b : s.bodies) worst = std::max(worst, verdict_of(b.factors));
  return worst;
}

}  // namespace railstrata
