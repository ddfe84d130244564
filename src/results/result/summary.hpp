#pragma once
// The numbers of a result, the same for both engines: what summary.json holds. SI units; a number that does not apply
// is NaN (null in the file). result/result_table.hpp has a row for each: its key, unit, words and where it is shown.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/engine.hpp"
#include "result/patch.hpp"

namespace railstrata {

inline constexpr double kNotApplicable = std::numeric_limits<double>::quiet_NaN();

/// Half widths of error bars: of half-spaces what the cells leave uncertain (judge/cell_errors.hpp), of finite elements
/// the change from the window before (judge/window_change.hpp); NaN: no law applies, or the case gives the number
/// itself.
struct ContactErrors {
  double p_max = kNotApplicable, q_max = kNotApplicable;  ///< Pa
  double slip_area_fraction = kNotApplicable;
  double F_x = kNotApplicable, F_y = kNotApplicable;  ///< N
  double creepage_x = kNotApplicable, creepage_y = kNotApplicable;
};

struct ContactSummary {
  PatchMeasures patch;  ///< of the field alone
  /// N, on the wheel, model frame: pressure and friction of the whole contact together
  double F_x = kNotApplicable, F_y = kNotApplicable, F_z = kNotApplicable;
  double creepage_x = kNotApplicable, creepage_y = kNotApplicable, spin_per_m = kNotApplicable;
  double approach = kNotApplicable, penetration_max = kNotApplicable, p_max_scatter = kNotApplicable;
  double contact_angle = kNotApplicable;  ///< rad, of the common tangent at the rigid contact point
  /// N, on the wheel: (F_y, F_z) along the contact plane's normal and along its lateral tangent
  double normal_force = kNotApplicable, lateral_force = kNotApplicable;
  double displacement_x = kNotApplicable,
         displacement_y = kNotApplicable;   ///< m, of the wheel over the rail: a shift's
  double friction_work = kNotApplicable;    ///< J, of a transient since its start
  double spin_moment = kNotApplicable;      ///< N m, on the wheel about the normal at the rigid contact point
  double motion_power = kNotApplicable;     ///< W, of the tractions in the cells' rigid slip; half-spaces
  double bending_stretch = kNotApplicable;  ///< of the running surface, by the bending of a rail on its track
  ContactErrors error;
};

/// One of several patches of a wheel.
struct PatchSummary {
  double y = kNotApplicable;                                 ///< m, of its rigid contact point, model frame
  double rail_y = kNotApplicable, wheel_y = kNotApplicable;  ///< m, the same in each profile's own frame
  ContactSummary contact;                                    ///< its own numbers
};

/// normal_force = F_z cos(angle) - F_y sin(angle), lateral_force = F_y cos(angle) + F_z sin(angle): of the half-space
/// engine the pressure's and the lateral friction's resultants.
inline void turn_into_contact_plane(ContactSummary& c, double angle) {
  c.contact_angle = angle;
  c.normal_force = c.F_z * std::cos(angle) - c.F_y * std::sin(angle);
  c.lateral_force = c.F_y * std::cos(angle) + c.F_z * std::sin(angle);
}

/// x from the axle in the rolling direction, y from the rigid contact point towards the field side, depth below the
/// surface along its normal.
struct StressMaximum {
  double value = kNotApplicable, x = kNotApplicable, y = kNotApplicable, depth = kNotApplicable;
  bool at_rim = false;            ///< of what was searched: a larger one may lie beyond
  double error = kNotApplicable;  ///< Pa, as ContactErrors
};
struct StressPair {
  StressMaximum von_mises, sigma1;
};
struct StressSummary {
  std::optional<StressPair> surface, subsurface, layer, interface, matrix;
};

struct EnergySummary {
  double closure = kNotApplicable, hourglass_share = kNotApplicable;
};

/// Plastic strain of bodies that yield, at the end of the rolling.
struct PlasticSummary {
  double strain = kNotApplicable;       ///< largest sqrt(2/3 Ep:Ep) of any point of an element
  double accumulated = kNotApplicable;  ///< largest accumulated plastic strain p
  double elements = kNotApplicable;     ///< with plastic strain
  double work = kNotApplicable;         ///< J, on the plastic strains
  double dissipated = kNotApplicable;   ///< J of it, less what the backstresses hold
  double x = kNotApplicable, y = kNotApplicable,
         depth = kNotApplicable;  ///< m, of the largest accumulated one: along the rail from where the wheel was put on
                                  ///< (of the wheel none), y and depth as of StressMaximum
  std::string body, zone;         ///< where it is; empty: nothing has yielded
};

/// Extremes of a wheel's way over what changes along the rail, from the end of the run-up on (passage/passage.hpp).
struct PassageSummary {
  double F_z_max = kNotApplicable, F_z_max_position = kNotApplicable;  ///< N, m: of the wheel
  double F_z_min = kNotApplicable, F_z_min_position = kNotApplicable;
  double p_max = kNotApplicable, p_max_position = kNotApplicable;
  double parts = kNotApplicable;  ///< the most that the patch had
  double von_mises = kNotApplicable, von_mises_x = kNotApplicable, von_mises_depth = kNotApplicable;  ///< of the rail
  double P1 = kNotApplicable, P2 = kNotApplicable;                                                    ///< N, over a dip
  double P1_jenkins_low = kNotApplicable, P1_jenkins_high = kNotApplicable;
  double P2_jenkins_low = kNotApplicable, P2_jenkins_high = kNotApplicable;
  double passing_frequency = kNotApplicable, F_z_passing = kNotApplicable;     ///< Hz, N: of waves of rail or wheel
  double interface_opening = kNotApplicable, interface_slip = kNotApplicable;  ///< m, of an unbonded layer
};

/// Factors by which the elastic stress of the case may be multiplied (damage/shakedown.hpp).
struct ShakedownFactors {
  double first_yield = kNotApplicable, wandering = kNotApplicable, single_track = kNotApplicable,
         upper = kNotApplicable, kinematic = kNotApplicable;
};
/// A layer or what lies below, by name.
struct ZoneShakedown {
  std::string zone;
  ShakedownFactors factors;
  double depth = kNotApplicable;  ///< m, where `wandering` is decided
};
struct BodyShakedown {
  std::string body;  ///< "rail", "wheel"
  ShakedownFactors factors;
  std::string zone;                                   ///< that decides `wandering`, and where
  double depth = kNotApplicable, y = kNotApplicable;  ///< m; y from the rigid contact point
  std::vector<ZoneShakedown> zones;
  std::vector<std::string> notes;  ///< strengths that are estimates, or not known; what the cells leave uncertain
};
/// Shakedown factors of the bodies whose strength is known.
struct ShakedownSummary {
  std::vector<BodyShakedown> bodies;
  /// The least value of a factor over the bodies; NaN without bodies, or where one of them lacks it.
  double least(double ShakedownFactors::*factor) const {
    double out = bodies.empty() ? kNotApplicable : std::numeric_limits<double>::infinity();
    for (const BodyShakedown& b : bodies)
      out = b.factors.*factor < out || std::isnan(b.factors.*factor) ? b.factors.*factor : out;
    return out;
  }
  /// The body that decides the factor for wandering traffic; null without bodies.
  const BodyShakedown* governing() const {
    const auto at = std::min_element(bodies.begin(), bodies.end(), [](const BodyShakedown& a, const BodyShakedown& b) {
      return a.factors.wandering < b.factors.wandering;
    });
    return at == bodies.end() ? nullptr : &*at;
  }
};

/// A fatigue parameter and its place.
struct FatigueValue {
  double value = kNotApplicable;
  double depth = kNotApplicable, y = kNotApplicable;  ///< m
  std::string zone;
  double x = kNotApplicable;  ///< m, along a rail that is not the same all along
};
/// Largest principal stress of a zone over the cycle, residual stress included.
struct BrittleSummary {
  std::string zone;
  double sigma1 = kNotApplicable, depth = kNotApplicable;  ///< Pa, m
  double share_of_tensile = kNotApplicable;                ///< sigma_1 over the tensile strength
  double critical_flaw = kNotApplicable;                   ///< m, depth of a surface crack that runs under sigma_1
  double thickness = kNotApplicable;                       ///< m, of a layer
};
/// The largest over an interface and the cycle.
struct InterfaceSummary {
  std::string above, below;
  double depth = kNotApplicable;                            ///< m
  double tension = kNotApplicable, shear = kNotApplicable;  ///< Pa
  double shear_range = kNotApplicable;                      ///< Pa, of tau_xz over a passage
  double sigma_xx_range_above = kNotApplicable, sigma_xx_range_below = kNotApplicable;  ///< Pa, where shear_range is
  double delamination = kNotApplicable;                                                 ///< 1: begins
};
struct BodyFatigue {
  std::string body;
  std::optional<FatigueValue> dang_van;             ///< utilisation of the fatigue limit
  std::optional<FatigueValue> smith_watson_topper;  ///< Pa
  std::optional<FatigueValue> fatemi_socie;
  std::optional<FatigueValue> jiang_sehitoglu;  ///< Pa
  std::vector<BrittleSummary> brittle;
  std::vector<InterfaceSummary> interfaces;
  std::vector<double> dang_van_used;  ///< of its limit at every point of the section, row by row; empty: no limit
};

/// Where a steel's wear is known from, the surest first.
enum class WearSource {
  given,      ///< wear_factor of the case
  grade,      ///< measured of the grade
  estimated,  ///< from the hardness
  unknown     ///< factor 1
};
/// For files and people.
constexpr std::string_view wear_source_text(WearSource source) {
  constexpr std::array<std::string_view, 4> words{"given", "measured of the grade", "estimated from hardness",
                                                  "unknown"};
  return words[static_cast<std::size_t>(source)];
}

/// Wear of a surface's steel over that of the steel of the law's tests (fatigue/steel_wear.hpp).
struct SteelWear {
  double factor = kNotApplicable;
  WearSource source = WearSource::unknown;
  std::string text;  ///< in words, with the source and how sure it is
};

/// Worn area by Jendel's map, and what of it its tests hardly reach.
struct MapShares {
  double worn = 0, seized = 0, fast = 0;  ///< of any unit
  void add(double weight, double depth, double seized_part, double fast_part) {
    if (!std::isfinite(depth)) return;
    worn += weight * depth;
    seized += weight * seized_part;
    fast += weight * fast_part;
  }
  double outside() const { return worn > 0 ? (seized + fast) / worn : kNotApplicable; }
};

/// Wear and damage of the rail's surface in one passage (fatigue/streamlines.hpp); NaN where friction or data are
/// missing.
struct DamageSummary {
  double t_gamma = kNotApplicable, t_gamma_with_spin = kNotApplicable;  ///< N
  double friction_energy = kNotApplicable;                              ///< J per m of rail, from the cells
  double motion_energy = kNotApplicable;  ///< J per m of rail, of the tractions in the cells' rigid slip; half-spaces
  double rcf_damage = kNotApplicable;     ///< per axle passage
  double brr_wear = kNotApplicable;       ///< m² per m rolled
  double usfd_depth = kNotApplicable, archard_depth = kNotApplicable,
         kth_depth = kNotApplicable;         ///< m per passage, the deepest
  MapShares kth_of_map;                      ///< of all streamlines
  SteelWear rail_steel, wheel_steel;         ///< whose factors the depths have
  double temperature_rise = kNotApplicable;  ///< K
  /// K, bounds of the rise that every order and thickness of the layers keeps (damage/flash_temperature.hpp)
  double temperature_rise_lower = kNotApplicable, temperature_rise_upper = kNotApplicable;
  double austenitisation = kNotApplicable;  ///< the rise over the rail's austenitisation_rise; from 1 on martensite
  double surface_fatigue = kNotApplicable, local_fatigue = kNotApplicable;
};

struct RunSummary {
  Engine engine = Engine::fem;
  std::string commit;
  double wall_s = kNotApplicable, preload_wall_s = kNotApplicable, output_wall_s = kNotApplicable;
  double dt_s = kNotApplicable, element_steps_per_s = kNotApplicable, peak_memory_bytes = kNotApplicable;
  double stable_step = kNotApplicable, unscaled_step = kNotApplicable;  ///< s, with and without selective mass scaling
  double added_mass = kNotApplicable;  ///< kg, by selective mass scaling of thin rows; 0: real masses
  long elements = 0, nodes = 0, steps = 0;
  int threads = 0;
};

struct Check {
  std::string name;  ///< key of a row of judge/check_limits.hpp
  bool ok = false;
  double value = kNotApplicable, limit = kNotApplicable;
};

inline Check at_most(std::string_view name, double value, double limit) {
  return {.name = std::string(name), .ok = value <= limit, .value = value, .limit = limit};
}

/// A sound result that is not plausible; exit code and checks do not depend on it.
struct Warning {
  std::string name;
  double value = kNotApplicable, limit = kNotApplicable;
  std::string text;
};

/// How long the rail lasts if every wheel were this one (lives/zone_life.hpp); where the case asks for it.
struct LifeSummary {
  double best = kNotApplicable, low = kNotApplicable, high = kNotApplicable;  ///< kg of gross traffic; infinite: never
  double groove = kNotApplicable;  ///< m, worn by wheels that are alike and run in one track; NaN: they are not
  std::string text;                ///< in words; empty: it was not asked for
};

/// A crack of the rail in one passage (fatigue/crack_summary.hpp), at its lower end; where the case gives one.
struct CrackSummary {
  double depth = kNotApplicable;                                   ///< m
  double K_I_range = kNotApplicable, K_II_range = kNotApplicable;  ///< Pa √m
  double equivalent_range = kNotApplicable;                        ///< Pa √m, of the growth law
  double growth = kNotApplicable;                                  ///< m a wheel, along the crack
  double release = kNotApplicable;                                 ///< J/m², largest energy release rate
  double phase = kNotApplicable;                                   ///< rad, atan2(K_II, K_I) there
  double life = kNotApplicable;        ///< kg of gross traffic to crack.allowable; infinite: it does not get there
  double kink_angle = kNotApplicable;  ///< rad from the surface, where a kink would open most
  double kink_range = kNotApplicable;  ///< Pa √m
  double azimuth = kNotApplicable;     ///< rad, as of crack.azimuth
  double slipping = kNotApplicable;    ///< largest share of the length
};

/// An interface of the rail that slides (bem/interface_slip.hpp): the last passage that was followed, and the first.
struct SlidingSummary {
  double passages = kNotApplicable;
  double slip = kNotApplicable, first_slip = kNotApplicable;  ///< m, largest of a passage
  double left = kNotApplicable, first_left = kNotApplicable;  ///< m, largest that it leaves behind
  double area = kNotApplicable;                               ///< m², slips at one time
  double work = kNotApplicable, first_work = kNotApplicable;  ///< J/m, of friction
  double shear = kNotApplicable;                              ///< Pa, largest
};

struct Summary {
  std::string title;
  std::string state;  ///< of a transient: which of its states this is
  double position = kNotApplicable;
  ContactSummary contact;             ///< of several patches those of the largest pressure, F_x, F_y and F_z of all
  std::vector<PatchSummary> patches;  ///< where there are several
  StressSummary rail, wheel;
  EnergySummary energy;
  PassageSummary passage;
  PlasticSummary plastic;
  ShakedownSummary shakedown;
  DamageSummary damage;
  LifeSummary life;
  CrackSummary crack;
  SlidingSummary interface_slip;
  std::vector<BodyFatigue> fatigue;  ///< of the bodies whose strength or fatigue limits are known
  RunSummary run;
  std::vector<Check> checks;
  std::vector<Warning> warnings;
};

/// The worst of all layers and of all interfaces: what cracks a brittle layer, and what shears it off.
/// Layers on rail and wheel, residual stress of the process included; NaN where there is no layer, or
/// where the case gives no strength to compare with.
struct LayerWorst {
  double sigma_1 = kNotApplicable;            ///< Pa, the largest principal stress in a layer
  double share_of_tensile = kNotApplicable;   ///< of its tensile strength; 1: it cracks
  double critical_flaw = kNotApplicable;      ///< m, the smallest flaw that the stress opens
  double interface_tension = kNotApplicable;  ///< Pa
  double interface_shear = kNotApplicable;    ///< Pa
  double shear_range = kNotApplicable;        ///< Pa, of tau_xz over a passage
  double delamination = kNotApplicable;       ///< 1: the interface gives way
};
LayerWorst layer_worst(const Summary& summary);

}  // namespace railstrata
