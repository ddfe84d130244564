#pragma once
// Two wheels on one rigid axle and their rails, solved motion by motion: docs/vehicle.md.
#include <array>
#include <cstddef>
#include <optional>
#include <string>

#include "ask/patch_forces.hpp"
#include "geometry/wheelset.hpp"

namespace railstrata {

inline constexpr std::size_t kLeft = 0, kRight = 1;

/// Motion of a wheelset and its rails, in the track's axes. Given are z and roll (loads are results), load and roll (z
/// is found), or load (both are found, under a roll moment). Meanings are those of rs_wheelset_state (railstrata.h).
struct WheelsetState {
  double y = 0;
  std::optional<double> z;
  double yaw = 0;
  std::optional<double> roll;
  double speed = 0;
  double y_rate = 0, z_rate = 0, yaw_rate = 0, roll_rate = 0, pitch_rate = 0;
  std::optional<double> load;
  double roll_moment = 0;
  std::array<double, 2> rail_y{}, rail_z{}, rail_roll{}, rail_y_rate{}, rail_z_rate{};
  std::array<double, 2> wheel_pitch_rate{}, rail_yaw{};
  bool extrapolate = false;  ///< a height that half-spaces do not bear has an answer (Forces::beyond)
};
/// In the order of rs_wheelset_state; the optional ones in that of the bits of its `given`.
inline constexpr std::array<Named<WheelsetState, double, std::optional<double>, std::array<double, 2>>, 19>
    kWheelsetState{{{"y", "m", &WheelsetState::y},
                    {"z", "m", &WheelsetState::z},
                    {"yaw", "rad", &WheelsetState::yaw},
                    {"roll", "rad", &WheelsetState::roll},
                    {"speed", "m/s", &WheelsetState::speed},
                    {"y_rate", "m/s", &WheelsetState::y_rate},
                    {"z_rate", "m/s", &WheelsetState::z_rate},
                    {"yaw_rate", "rad/s", &WheelsetState::yaw_rate},
                    {"roll_rate", "rad/s", &WheelsetState::roll_rate},
                    {"pitch_rate", "rad/s", &WheelsetState::pitch_rate},
                    {"load", "N", &WheelsetState::load},
                    {"roll_moment", "N m", &WheelsetState::roll_moment},
                    {"rail_y", "m", &WheelsetState::rail_y},
                    {"rail_z", "m", &WheelsetState::rail_z},
                    {"rail_roll", "rad", &WheelsetState::rail_roll},
                    {"rail_y_rate", "m/s", &WheelsetState::rail_y_rate},
                    {"rail_z_rate", "m/s", &WheelsetState::rail_z_rate},
                    {"wheel_pitch_rate", "rad/s", &WheelsetState::wheel_pitch_rate},
                    {"rail_yaw", "rad", &WheelsetState::rail_yaw}}};

/// One wheel, in the track's axes; meanings are those of rs_wheel (railstrata.h).
struct WheelForces : PatchForces {
  double creepage_x = 0, creepage_y = 0, spin = 0;
  int patches = 0;
  bool checks_hold = true, beyond = false;
};
inline constexpr std::array<Named<WheelForces, double, int, bool, Vec2, Vec3>, 21> kWheelForces{
    {{"force", "N", &WheelForces::force},
     {"moment", "N m", &WheelForces::moment},
     {"normal_force", "N", &WheelForces::normal_force},
     {"lateral_force", "N", &WheelForces::lateral_force},
     {"spin_moment", "N m", &WheelForces::spin_moment},
     {"creepage_x", "", &WheelForces::creepage_x},
     {"creepage_y", "", &WheelForces::creepage_y},
     {"spin", "1/m", &WheelForces::spin},
     {"approach", "m", &WheelForces::approach},
     {"point", "m", &WheelForces::point},
     {"on_wheel", "m", &WheelForces::on_wheel},
     {"on_rail", "m", &WheelForces::on_rail},
     {"contact_angle", "rad", &WheelForces::contact_angle},
     {"rolling_radius", "m", &WheelForces::rolling_radius},
     {"p_max", "Pa", &WheelForces::p_max},
     {"patch_area", "m2", &WheelForces::patch_area},
     {"dissipation", "W", &WheelForces::dissipation},
     {"patches", "", &WheelForces::patches},
     {"cells", "", &WheelForces::cells},
     {"checks_hold", "", &WheelForces::checks_hold},
     {"beyond", "", &WheelForces::beyond}}};

/// force, moment: of both contacts on the wheelset, about its centre.
struct WheelsetForces {
  double z = 0, roll = 0;
  Vec3 force, moment;
  std::array<WheelForces, 2> wheels;
  int solutions = 0;  ///< of each contact, that the state took
  int beyond = 0;     ///< wheels that are
};
/// Without the wheels, which stand before the last two in rs_wheelset_forces.
inline constexpr std::array<Named<WheelsetForces, double, int, Vec3>, 6> kWheelsetForces{
    {{"z", "m", &WheelsetForces::z},
     {"roll", "rad", &WheelsetForces::roll},
     {"force", "N", &WheelsetForces::force},
     {"moment", "N m", &WheelsetForces::moment},
     {"solutions", "", &WheelsetForces::solutions},
     {"beyond", "", &WheelsetForces::beyond}}};

/// How the vertical force of a wheel grows with its descent, Q = scale d^power: Hertz's 1.5 to begin with.
struct Stiffening {
  double scale = 0, power = 1.5;
  double descent = 0, force = 0;  ///< that it goes through
  double force_at(double d) const;
  double descent_at(double q) const;
  double slope() const { return descent > 0 ? power * force / descent : 0; }  ///< there
  void add(double d, double q, bool several);
};

/// One wheel as the left one of its motion, which rolls on.
struct Wheel {
  explicit Wheel(const LoadedCase& loaded);
  Contact contact;
  TrackGeometry at_rest;
  WheelsetMotion motion;
  RailMotion rail;
  Forces forces;
  RigidContact reference;  ///< of the last solution: the place that its creepages are of (reference_of)
  Vec3 force, moment;      ///< N, N m about the wheelset's centre, in the track's axes
  const RigidContact& touching() const { return contact.placement().contact; }
  const TrackGeometry& track() const { return contact.placement().track; }
};

/// What a solution under a load has found, by the wheels' shifts over their rails.
struct SunkWheelset {
  std::array<double, 2> shift{};  ///< m
  std::array<Stiffening, 2> stiffening;
  double left_share = 0.5;
  bool several = false;  ///< places of a wheel
};

/// How height and roll follow what a wheelset bears too much, row by row (wheelset_lean.cpp).
using Leaning = std::array<double, 4>;

/// Where the next solution starts from.
struct WheelsetStart {
  double roll = 0;          ///< rad
  double tilting = 0;       ///< m, change of the wheels' difference in height with the roll; 0: of none
  double left_share = 0.5;  ///< of the load, on the left wheel
  std::array<Stiffening, 2> stiffening;
  std::optional<Leaning> leaning;                   ///< of a wheel on tread and flange
  std::array<std::optional<SunkWheelset>, 2> sunk;  ///< the last one and that before
  std::array<NextStart, 2> contacts;
};

/// The state of the last answer, and what it gave or found: m, rad.
struct SolvedWheelset {
  WheelsetState state;
  double z = 0, roll = 0;
};

/// Both cases are those of left wheels: the right one's is that of its mirror image. Position, motion and load of the
/// cases do not count.
struct Wheelset {
  Wheelset(const LoadedCase& left, const LoadedCase& right) : wheels{Wheel(left), Wheel(right)} {}
  std::array<Wheel, 2> wheels;
  std::array<Stiffening, 2> stiffening;
  double roll = 0;                       ///< rad, of the last solution
  double tilting = 0, left_share = 0.5;  ///< as WheelsetStart
  std::optional<Leaning> leaning;
  std::array<std::optional<SunkWheelset>, 2> sunk;
  int solutions = 0;
  WheelsetStart kept;
  std::optional<SolvedWheelset> solved;  ///< none after an error
  std::string remarks;  ///< of the last answer: checks that fail and notes, one a line, with the wheel before it
};

/// Of a load of 0 all forces are 0, and the wheels touch. Throws CaseError, NoAnswer (of a contact; the roll moment
/// tips the wheelset over), NumericalError.
WheelsetForces solve(Wheelset& set, const WheelsetState& state);
void drop_solution(Wheelset& set);
/// A patch of the last solution in the track's axes, `approach`, `on_wheel` and `on_rail` as of a contact. about: m,
/// the point that moments are about; none: the centre of the wheelset. Throws CaseError: no solution, side or patch.
PatchForces patch_forces(const Wheelset& set, int side, int index, const std::optional<Vec3>& about);
/// Solutions start from the ones before. Before trial steps `keep` remembers where the next one starts from, `reset`
/// returns there; `forget` starts anew.
void keep(Wheelset& set);
void reset(Wheelset& set);
void forget(Wheelset& set);

}  // namespace railstrata
