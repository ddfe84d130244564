#pragma once
// Module 1, wheel on rail or roller: what was set and where the patches of the last solution lie. SI; y, roll and yaw
// have the signs of the caller, those of patches are of a right pair (marker.hpp).
#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cntc/contact_search.hpp"
#include "cntc/problem.hpp"

namespace railstrata::cntc {

/// x (or s), y, z, roll, yaw, pitch and their rates.
struct Motion {
  std::array<double, 6> at{}, rate{};
};

struct TrackPlace {
  double gauge_depth = 0;  ///< GAUGHT, > 0: the rail stands by its gauge, otherwise at y, z
  double gauge = 0, y = 0, z = 0, cant = 0;
  double roller_radius = 0, curvature = 0;
};

/// A rail without mass that gives way (F = 3), and forces on it besides those of the wheel.
struct RailSupport {
  double stiffness[2]{}, force[2]{};  ///< N/m, N; across and down
  double first_step = 1e-3;           ///< m, of the search across
  double way[2]{};                    ///< m, what was found
};

struct GivenForces {
  double load = 0;   ///< N, FZ
  double along = 0;  ///< N, FX_WS on the rail in the wheelset's x (F = 1)
  RailSupport rail;
};

/// Friction by the inclination (V = 1) or by the place along the track (V = 2).
struct FrictionSlice {
  double at = 0;
  std::vector<double> numbers;
};

struct WheelRailPatch {
  PatchPlane plane;
  Marker on_wheel, on_rail;  ///< the reference as seen from the profiles
  Overlap overlap;
  double approach = 0;
  double along = 0, across = 0;  ///< m, the reference along the track, s + x, and along the rail's profile
  /// On the rail, in the track and the wheelset: about the profiles' origins.
  Vec3 force, moment_on_rail, force_of_wheelset, moment_on_wheel;
};

/// Results.
struct FoundPlace {
  double sunk = 0;  ///< m, of the last height that was found under a load below that of the first touch
  std::vector<WheelRailPatch> patches;
  Marker wheelset_at, wheel_in_wheelset, rail_at;
};

struct ModuleOne {
  std::optional<Outline> rail, wheel;
  TrackPlace track;
  bool has_track = false, has_wheelset = false;
  std::array<double, 6> rail_shift{};  ///< dy, dz, roll and their rates
  double flange_distance = 0, flange_place = 0, wheel_radius = 0;
  std::optional<double> tape_y;
  Motion wheelset, flexibility;
  double pitch_rate_of_roller = 0;
  GivenForces forces;
  SearchSteps steps;
  double relative_step = 1;  ///< DQREL
  std::vector<FrictionSlice> slices;
  int friction_digit = 0, varies = 0;  ///< L, V
  FoundPlace found;
};

using Numbers = std::span<const double>;

/// By itype, or by the ending of the file's name.
bool profile_is_of_wheel(const std::string& file, std::span<const int> ints);
void set_profile(ModuleOne& one, const Problem& base, const std::string& file, std::span<const int> ints,
                 Numbers reals);
void set_profile(ModuleOne& one, const Problem& base, Numbers values, std::span<const int> ints, Numbers reals);
/// Z = 0 to 3; 32 and 33: a rail that gives way.
void set_track(ModuleOne& one, const Problem& base, int digit, Numbers values);
void set_wheelset(ModuleOne& one, const Problem& base, int digit, Numbers values);
void set_position(ModuleOne& one, const Problem& base, int digit, Numbers values);
void set_velocity(ModuleOne& one, const Problem& base, int digit, Numbers values);
void set_flexibility(ModuleOne& one, const Problem& base, int digit, Numbers values);
void set_vertical_force(ModuleOne& one, Problem& base, double force);
void set_force_along(ModuleOne& one, double force);
void set_search(ModuleOne& one, const Problem& base, int number, Numbers values);
/// DQREL, in place of DQ.
void set_relative_step(ModuleOne& one, double step);
/// V = 1 and 2 beside the laws of module 3.
std::string set_wheel_friction(ModuleOne& one, Problem& base, int method, Numbers values);

/// -1 for a left wheel, whose y is turned: CONFIG 0 and 4.
double side_of(const Problem& base);
bool on_roller(const Problem& base);

/// Finds and solves the patches: problem k of `patch(k)`, from 1 on. Throws Refused.
class PatchProblems {
 public:
  virtual ~PatchProblems() = default;
  virtual Problem& patch(int number) = 0;
};
void solve_wheel(ModuleOne& one, Problem& base, PatchProblems& problems, std::vector<std::string>& remarks);

/// Results in the caller's units and signs; what there is no value for is NaN.
std::vector<double> contact_location(const ModuleOne& one, const Problem& base, const Problem& patch, int number);
/// number -1: of all patches.
std::vector<double> global_forces(const ModuleOne& one, const Problem& base, int number);
std::vector<double> profile_values(const ModuleOne& one, const Problem& base, int task, std::span<const int> ints,
                                   Numbers reals);
std::vector<double> wheelset_motion(const Motion& motion, const Problem& base, bool rates);

}  // namespace railstrata::cntc
