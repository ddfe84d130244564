#pragma once
// How long rail and wheel last under a load collective: every zone, at its surface and below, by every way in which it
// may end.
//
//   fatigue               Dang Van's stress on a sigma-N line
//   worn through          wear and grinding take a layer away
//   layer cracks, interface shears   the stresses of a load reach the strength
//
// Lives by plastic strain, low-cycle fatigue and ductility, need a rail that is followed through its traffic
// (clock/clock.hpp), which gives its rows in place of these; fatigue and ratchetting do not add, the shorter life
// counts. [Kapoor1994] Damage is summed by position across the body and by depth (damage/life.hpp), with the wear of
// the case's law on the unworn profile and with the grinding of the case; kinds of wheels add up by their numbers.
//
// Ranges. Fatigue: Miner's sum from 1/3 to 3 [Haibach2006], and below the limit the line as above it, flatter, or none.
// Worn through: the wear laws that the case has data for.
#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "damage/life.hpp"
#include "fatigue/rail_damage.hpp"
#include "fatigue/shakedown_summary.hpp"
#include "fatigue/wheel_damage.hpp"
#include "spec/case_fwd.hpp"

namespace railstrata {

/// The way of ending of a layer that wear and grinding take away; all others are damages.
inline constexpr const char* kWornThrough = "worn through";

/// m, the upper part of a body that counts as its surface.
inline constexpr double kSkin = 0.2e-3;

/// Factor on the strengths for the low (0), best (1) and high (2) life: two deviations of life.strength_scatter.
double strength_factor(const CaseSpec& spec, std::size_t variant);

/// A kind of wheels.
struct LifeLoad {
  double passages = 1;  ///< in a unit of traffic, one collective
  double force = 0;     ///< N, on this rail
  const std::vector<PatchDamage>* patches = nullptr;
  const std::vector<SectionShakedown>* sections = nullptr;
};

struct LifeRow {
  std::string body, zone, place, mechanism;
  LifeRange wheels{};             ///< that pass; of the wheel its turns
  LifeRange mgt{};                ///< million gross tonnes; NaN of the wheel
  LifeRange distance{};           ///< m that the wheel runs; NaN of the rail
  double depth = kNotApplicable;  ///< m, below the surface of that time
  double y = kNotApplicable;      ///< m, from the axis of rail or tape circle, field side positive
  std::string rests_on{};         ///< or what is missing
  /// MGT, traffic that was followed: an infinite life is one beyond it. Infinite: lives were not followed but summed.
  double followed = std::numeric_limits<double>::infinity();
  bool known() const { return wheels.known(); }
};

/// The picture behind a row: m of the place, over MGT.
struct LifeCurve {
  std::vector<double> mgt, removed;          ///< by wear and grinding
  std::vector<double> damaged_mgt, damaged;  ///< how deep everything would have failed if nothing were removed
  std::vector<double> failed_mgt, failed;    ///< points by their depth below the new surface, and when they fail
  double layer = kNotApplicable;             ///< thickness of the uppermost layer
  double y = kNotApplicable;                 ///< m, of the place, from the rail's axis
};

struct Lives {
  std::vector<LifeRow> rows;
  double tonnes = 0, wheels = 0;  ///< of a unit of traffic
  LifeCurve curve;                ///< of the rail's shortest life by damage; empty without one
};

/// rail, wheel: damage of one collective, and of the wheel per metre.
Lives zone_lives(const CaseSpec& spec, const std::vector<LifeLoad>& loads, const RailDamage& rail,
                 const WheelDamage& wheel);

/// The rail's row with the shortest life; null where none is known.
const LifeRow* shortest(const std::vector<LifeRow>& rows);
/// That of those that end by damage, not by wear through a layer.
const LifeRow* first_damage(const std::vector<LifeRow>& rows);

/// "lasts 42 MGT (25 to 70): rail, at the surface, ductility exhausted; not known: …".
std::string life_text(const std::vector<LifeRow>& rows);
/// "42 (25 to 70)", "never"; of what was followed so far "> 50" instead.
std::string range_text(const LifeRange& range, double followed = std::numeric_limits<double>::infinity());

}  // namespace railstrata
