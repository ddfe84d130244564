#pragma once
// Loads that change: transients, load collectives, passes; in SI units.
#include <optional>
#include <string>
#include <vector>

#include "spec/crack_spec.hpp"
#include "spec/curve_spec.hpp"
#include "spec/drive_spec.hpp"

namespace railstrata {

/// A history that the half-space engine follows in time (bem/transient.hpp).
enum class TransientKind {
  none,     ///< steady rolling
  rolling,  ///< rolling from a beginning, step by step
  shift     ///< loads and displacements sideways without rolling: presliding, fretting
};

enum class TransientStart {
  rest,   ///< pressed together, then shifted by the first forces
  steady  ///< as if it had rolled so for ever
};

/// A history of loads and motions, linear between its rows: columns of one length, an empty one is not given. What
/// rolls takes from the drive what has no column; a shift stays where nothing is given.
struct TransientSpec {
  TransientKind kind = TransientKind::none;
  TransientStart start = TransientStart::rest;
  std::optional<double> distance;               ///< m, rolled altogether; not given: to the last row
  int increments = 10;                          ///< shift: from row to row
  std::string history_file;                     ///< empty once it is read into the columns
  std::vector<double> at_distance, at_time;     ///< m, s: where the rows are
  std::vector<double> wheel_load, load_factor;  ///< N; over the static load
  std::vector<double> traction_coefficient, tractive_force, creepage, displacement;
  std::vector<double> lateral_traction_coefficient, lateral_force, lateral_creepage, lateral_displacement;
  std::vector<double> spin;  ///< 1/m
};

/// The law of wear depth (damage/wear.hpp).
enum class WearLaw {
  usfd,    ///< University of Sheffield, from T-gamma over the area
  kth,     ///< Archard with Jendel's map of coefficients
  archard  ///< Archard with the rail's wear_coefficient
};

/// Tonnes over the track by an axle of two such wheels [N].
inline double gross_tonnes(double wheel_force) { return 2e-3 * wheel_force / kGravity; }

/// A row of a load collective: what it does not give is the case's (tables/load_rows.hpp).
struct LoadSpec {
  std::string name;           ///< empty: "load 1", "load 2", … by its place
  double passages = 1;        ///< of such a wheel
  std::string wheel_profile;  ///< as of the geometry; empty: the case's
  std::optional<double> wheel_radius;
  std::optional<double> wheel_load, lateral_shift, yaw, roll, curve_radius, speed;
  std::optional<double> traction_coefficient, creepage;                  ///< at most one
  std::optional<double> lateral_traction_coefficient, lateral_creepage;  ///< at most one
  std::optional<double> friction_coefficient;
  std::optional<double> axle_weight;  ///< N, for gross tonnes; not given: twice the wheel's load
  std::optional<double> guiding_force, t_gamma,
      friction_energy;  ///< N, of the vehicle code, to compare with what comes out
  /// Gross tonnes of its axle, with the load of the wheel [N].
  double tonnes(double load) const { return gross_tonnes(axle_weight ? 0.5 * *axle_weight : load); }
  bool operator==(const LoadSpec&) const = default;
};

struct CollectiveSpec {
  std::string file;  ///< empty once it is read into the rows
  CurveSpec curve;   ///< with bogies: the rows follow from it
  WearLaw wear_law = WearLaw::usfd;
  double lateral_deviation = 0;      ///< m across, of the wheels of each row about their place
  double wear_factor = 1;            ///< of wear over that of the laws
  double bin_scale = 1;              ///< of the widths of a series' bins (tables/load_rows.cpp)
  bool match_guiding_force = false;  ///< a row's shift is moved until its wheel has the row's guiding force
};

/// Grinding of the rail.
struct GrindingSpec {
  std::optional<double> every;  ///< kg of gross traffic
  double depth = 0;             ///< m, each time
};

/// What lives are computed from beside the strengths (lives/zone_life.hpp, clock/clock.hpp).
struct LifeSpec {
  double until = 0;  ///< kg of gross traffic through which rail and metal are followed; 0: they are not
  std::optional<double> first_cracks;  ///< kg, gross traffic after which a rail had its first cracks
  // What is not known of a number that holds for all wheels and all metal: coefficients of variation, of the place a
  // standard deviation [m]. A range covers two of them to both sides.
  std::optional<double> strength_scatter;  ///< not given: none, in a range of the traffic kStrengthScatter
  double ductility_scatter = 0.15, friction_scatter = 0.15, wear_scatter = 0.2, place_scatter = 0.5e-3;
  GrindingSpec grinding;
  CrackSpec crack;
};
/// Hardness of a grade's delivery: two of it reach from 260 to 300 HBW of R260. [EN13674]
inline constexpr double kStrengthScatter = 0.035;

/// Whether passes are jumped over (steady/pass_jump.hpp).
enum class PassJump { off, automatic };

/// What bears a pass of the stationary method (passes/following_contact.hpp).
enum class PassPressure { elastic, following };

/// Passes over a rail that yields (`railstrata passes`); lists begin again after their last value.
struct PassesSpec {
  std::vector<double> lateral_positions;      ///< m, of pass 1, 2, …, positive to the field side; empty: 0
  std::optional<double> lateral_deviation;    ///< m, of a normal distribution about them, cut at three of it
  int lateral_seed = 1;                       ///< of its random numbers
  std::vector<double> traction_coefficients;  ///< of pass 1, 2, …; empty: that of the drive
  PassPressure pressure = PassPressure::elastic;
  std::optional<double> ductility;  ///< net plastic strain that the material bears
  PassJump jump = PassJump::off;
  double jump_tolerance = 0.02;  ///< of the rates after a jump
  // Grid of plastic strain (steady/steady_grid.hpp): errors of residual stress are some percent at 6 cells, and fall
  // with their square.
  int patch_cells = 6;              ///< over each half-axis of the patch
  double patch_rows = 8;            ///< over its shorter half-axis
  std::optional<double> first_row;  ///< m, at the surface; below it rows grow by a quarter each; not given: as those
  std::optional<double> window;     ///< half-lengths behind the load where flow is followed; not given: by the contact
};

}  // namespace railstrata
