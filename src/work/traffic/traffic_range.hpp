#pragma once
// The range of a rail's lives by what is not known of its case.
//
// Design: the rail is followed once with the best values and twice for each uncertain input, with that one at its lower
// and its higher end: 1 + 2 n runs. The result of a run has too little to read other runs from it: of the damage by
// ductility, which alone scales with its limit, it has the largest value of all zones at the end of each stretch.
//
// Combination: with L the life at the best values, an input has at its ends the effects e = ln(L_end/L). Lives differ
// by factors, so effects add in ln L; inputs are independent, so they add as squares; the two sides are kept apart,
// since few of them are alike:
//   low = L exp(-√Σ min(e, 0)²),   high = L exp(+√Σ max(e, 0)²)
// of each input the end that goes further to that side. With e proportional to the input's deviation the range has two
// standard deviations of ln L to each side. One input alone gives its own lives at the ends. An input's share is its
// part of both sums. Interactions between inputs are left out.
//
// The rows' own ranges (Miner's sum, exponents: lives/zone_life.hpp) are one more input, "damage law", without runs.
//
// Beyond the horizon: a best life beyond it counts as the horizon for the lower side, which makes `low` too high rather
// than too low where several inputs matter, and its higher side is infinite. An end beyond the horizon has an infinite
// effect, in the shares that of a life as long as what was followed; a run that ended earlier than L (a layer worn
// through) says nothing of that row.
#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "clock/clock.hpp"
#include "core/control.hpp"

namespace railstrata {

/// The name of the input that stands for the rows' own ranges.
inline constexpr const char* kDamageLaw = "damage law";

/// A run of the design.
struct RangeRun {
  std::string input, value;  ///< empty: all best values
  ClockResult result{};
  std::string fault{};  ///< why there is no result; empty: there is one
};

/// A life that was followed so far: MGT; infinite: longer than that.
struct FollowedLife {
  double mgt = 0, followed = 0;
};

/// What an input does to a life.
struct InputEffect {
  std::string input, key;
  std::array<std::string, 2> value;  ///< at its lower and its higher end
  std::array<FollowedLife, 2> life{};
  std::array<bool, 2> known{};  ///< not where the run failed or ended before the best life
  double down = 0, up = 0;      ///< effects on ln L, down <= 0 <= up
  double share = 0;             ///< of the range, all inputs together 1; 0 where nothing has an effect
};

struct TrafficRange {
  std::vector<RangeRun> runs;        ///< the best values first
  std::vector<LifeRow> lives;        ///< those of the best values with the range of all inputs
  LifeRange first{};                 ///< MGT, until damage first ends the metal anywhere
  double followed = 0;               ///< MGT, with the best values
  std::vector<InputEffect> effects;  ///< on that; the largest share first
};

/// The range of a life by the effects of inputs; the order of these changes no bit.
LifeRange combined(const FollowedLife& best, const std::vector<InputEffect>& effects);

/// An effect by the lives at the two ends: fills `down`, `up` and `known`; of a failed run the life is NaN.
void set_effect(const FollowedLife& best, InputEffect& effect);

/// The shares; the largest first, equal ones by name.
void set_shares(const FollowedLife& best, std::vector<InputEffect>& effects);

/// The row of the same zone, place and mechanism, where its life is known; else null.
const LifeRow* same_row(const std::vector<LifeRow>& lives, const LifeRow& row);

/// Follows the rail through all runs of the design. Progress and lines of `control` give the number of the run. A run
/// at an end that cannot be followed is reported and left out, as are those after a stop. Throws CaseError and
/// Interrupted as run_clock of the best values.
TrafficRange run_range(const CaseSpec& spec, const std::filesystem::path& folder, const ClockOptions& options,
                       Control& control);

/// The lives of runs that were made: `inputs` in the order of the runs, two for each.
struct NamedInput {
  std::string name, key;
};
TrafficRange range_of(std::vector<RangeRun> runs, const std::vector<NamedInput>& inputs);

/// "friction decides: 0.245 to 0.455 gives 31 MGT to 12 MGT"; empty where nothing has an effect.
std::string deciding_text(const TrafficRange& range);

}  // namespace railstrata
