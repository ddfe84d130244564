#pragma once
// A contact problem (ire, icp): what was set, the last solution, and what was refused.
//
// Lengths as CONTACT has them: body 1 is the upper one (z > 0, the wheel), body 2 the lower one (the rail); x and y in
// the contact plane. Settings are SI, but creepages, which stand as they were given: whether they are distances shows
// when the problem is solved.
#include <array>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "bem/influence_operator.hpp"
#include "bem/rolling_contact.hpp"
#include "cntc/curved_row.hpp"
#include "cntc/units.hpp"
#include "halfspace/layered.hpp"

namespace railstrata::cntc {

/// The calls that set something. A refused setting stays refused until the same call succeeds.
enum class Setting {
  units = 1,
  solver,
  material,
  friction,
  grid,
  gap,
  normal,
  creepages,
  forces,
  slip,
  step,
  speed,
  layers,
  blocks,
  temperature,
  rail_profile,
  wheel_profile,
  track,
  wheelset,
  position,
  velocity,
  flexibility
};

/// Simplified theory in place of half-spaces under friction, M = 3 and 5: the slope reduction K0_MF, ALFAMF, BETAMF.
struct SimplifiedTheory {
  double k0 = 1, alpha = 1, beta = 1;
  bool strips = false;  ///< M = 5, FaStrip
};

/// A standard linear solid, M = 1, both bodies: FG and TC.
struct Viscosity {
  double share = 0;  ///< of the late compliance in that at once
  double time = 0;   ///< s
};

struct Materials {
  std::array<HalfSpaceMaterial, 2> body;
  std::optional<SimplifiedTheory> simplified;
  std::optional<Viscosity> viscosity;
  std::array<std::vector<HalfSpaceLayer>, 2> layers;
  ThirdBody film;
};

struct FrictionLaw {
  double at_rest = 0;
  FallingFriction falling;
  std::vector<TablePoint> by_temperature;  ///< factor of `at_rest`; empty: none
  int digit = 0;
};

struct Creepages {
  double x = 0, y = 0, spin = 0;
  double length = 1e-3;  ///< m in the unit of length they were given in
};

/// Parameters as given, SI. number: IPOTCN or IBASE, 0: none yet.
struct Parameters {
  int number = 0;
  int mx = 0, my = 0;
  std::vector<double> value;
};

struct Settings {
  std::map<int, int> flags;  ///< those that were set
  Materials materials;
  bool has_materials = false;
  std::optional<FrictionLaw> friction;
  std::optional<ContactHeat> heat;  ///< without tables
  Parameters grid, gap;
  double load = 0;      ///< N
  double approach = 0;  ///< m
  Creepages creepages;
  double relative_x = 0, relative_y = 0;  ///< forces on body 1 over fstat fn
  std::vector<double> extra_x, extra_y;   ///< in the order of the elements
  std::vector<double> row_friction;       ///< of each row of elements; empty: that of the law
  double chi = 0;                         ///< rad
  std::optional<double> step;             ///< m
  double speed = 1;                       ///< m/s
  double tolerance = 1e-5;
  int first_slip = 0;  ///< INISLP
};

struct Hertz {
  double A = 0, B = 0;  ///< 1/m
  double a = 0, b = 0;  ///< m
  double approach = 0;  ///< m
  double load = 0;      ///< N
  double scale = 0;
};

struct Discretisation {
  PatchGrid grid;
  Plane gap;
  Hertz hertz;
};

/// A solution in the frame that it was asked for, SI; tractions of `rolling` act on body 2 (the rail).
struct Solved {
  Discretisation on;
  LayeredHalfSpace upper, lower;
  std::shared_ptr<const InfluenceOperator> influence;
  RollingSolution rolling;
  FrictionLaw friction;
  ThirdBody film;
  std::array<double, 2> flexibility{0, 0};  ///< m/Pa, L / k of simplified theory along x and y; 0: half-spaces
  double reduction = 1;                     ///< k of simplified theory
  Plane local_friction;                     ///< of each element; empty: uniform
  std::array<Plane, 3> late;                ///< m, displacement by delay along the normal, x and y; empty: elastic
  Plane temperature;                        ///< of each element, °C; empty: H = 0
  double speed = 1;
  double spin = 0;     ///< 1/m, or rad of a shift
  bool shift = false;  ///< slip and creepages are distances
  int border_cells = 0;
};

struct Block {
  int kind = 0;                 ///< ISUBS
  std::vector<double> x, y, z;  ///< m, or numbers of columns and rows; z ascending
  std::array<int, 3> size{0, 0, 0};
  std::vector<double> table;  ///< 21 columns of size[0] size[1] size[2] values each, SI
};

struct Refusal {
  int code = 0;
  std::string text;
};

struct Problem {
  Units units;
  double origin_x = 0, origin_y = 0;  ///< m, the point of forces and creepages, in the coordinates of the elements
  bool of_wheel = false;              ///< settings and patches of module 1
  double side = 1;                    ///< -1: of a left wheel, which is seen in a mirror: y of results is turned
  std::vector<CurvedRow> rows;        ///< of elements on a curved surface; empty: a plane
  Settings settings;
  InfluenceCache cache;
  std::optional<Solved> solved;
  bool broken = false;  ///< the last solution failed: there is no state before
  int cases = 0;
  std::vector<Block> blocks;
  double cpu_s = 0, wall_s = 0;
  std::map<int, Refusal> refused;  ///< by Setting, or by flag
  Refusal last;
  std::mutex busy;
};

/// Flags that were not set have CONTACT's default.
int flag(const Settings& settings, int code);

}  // namespace railstrata::cntc
