#pragma once
// What changes from one solution of a contact to the next, and how its case follows.
#include <array>
#include <cstddef>
#include <optional>

#include "bem/solve_bem.hpp"
#include "options/option_slots.hpp"
#include "record/unit.hpp"

namespace railstrata {

/// What differs from the case in one solution. Load or approach, creepage or force: at most one of each.
struct State {
  std::optional<double> load, approach;                ///< N, vertical, on the rail; m, along the contact normal
  std::optional<double> lateral_shift, yaw, roll;      ///< m, to the field side; tangents
  std::optional<double> speed, friction;               ///< m/s, as reference_speed; at rest
  std::optional<double> creepage_x, creepage_y, spin;  ///< the last 1/m
  std::optional<double> force_x, force_y;              ///< N, on the wheel; lateral friction in the contact plane
  double descent = 0;        ///< m, of the wheel, where the approach was made of it; 0: it was not
  bool extrapolate = false;  ///< an approach that half-spaces do not bear has an answer (Forces::beyond)
  bool keep_cells = false;   ///< as BemOptions
  double rolling_share = 1;  ///< of a wheelset (DriveSpec); callers do not give it
};

struct StateMember {
  const char *name, *unit;
  unsigned bit;  ///< of rs_state.given
  std::optional<double> State::*at;
  Slot (*in_case)(CaseSpec&, std::size_t);  ///< as its option has it, whose range counts; null: a force
  double step;                              ///< of differences; of a force: over the load
  double (*coordinate)(const CaseSpec&);    ///< in steps of a weight similar to that of the others
};

/// A member of a state: a member of State, a row here and one of rs_state in railstrata.h. In the order in which
/// NextStart adds coordinates up. A step is small beside what tractions and geometry do on the way to a cell's coming
/// into contact, large beside round-off.
inline constexpr std::array<StateMember, 12> kState = [] {
  using namespace option_slot;
  using C = CaseSpec;
  using D = DriveSpec;
  using G = GeometrySpec;
  using S = State;
  return std::array<StateMember, 12>{{
      {"lateral_shift", "m", 4, &S::lateral_shift, at<&C::geometry, &G::lateral_shift>, 1e-8,
       [](const C& c) { return c.geometry.lateral_shift / kMilli; }},
      {"yaw", "", 8, &S::yaw, at<&C::geometry, &G::yaw>, 1e-7, [](const C& c) { return c.geometry.yaw / 1e-2; }},
      {"roll", "", 16, &S::roll, at<&C::geometry, &G::roll>, 1e-7, [](const C& c) { return c.geometry.roll / 1e-2; }},
      {"load", "N", 1, &S::load, nullptr, 1e-6, [](const C& c) { return 1e-5 * c.vehicle.load(); }},
      {"approach", "m", 2, &S::approach, at<&C::vehicle, &VehicleSpec::approach>, 1e-10,
       [](const C& c) { return c.vehicle.approach.value_or(0) / 0.1e-3; }},
      {"creepage_x", "", 128, &S::creepage_x, at<&C::drive, &D::creepage>, 1e-8,
       [](const C& c) { return c.drive.creepage.value_or(0) / 1e-3; }},
      {"creepage_y", "", 256, &S::creepage_y, at<&C::drive, &D::lateral_creepage>, 1e-8,
       [](const C& c) { return c.drive.lateral_creepage.value_or(0) / 1e-3; }},
      {"spin", "1/m", 512, &S::spin, at<&C::drive, &D::spin>, 1e-6,
       [](const C& c) { return c.drive.spin.value_or(0); }},
      {"force_x", "N", 1024, &S::force_x, nullptr, 1e-6, [](const C& c) { return c.drive.traction().value_or(0); }},
      {"force_y", "N", 2048, &S::force_y, nullptr, 1e-6,
       [](const C& c) { return c.drive.lateral_traction_coefficient.value_or(0); }},
      {"friction", "", 64, &S::friction, at<&C::drive, &D::friction_coefficient>, 1e-7,
       [](const C& c) { return c.drive.friction_coefficient; }},
      {"speed", "m/s", 32, &S::speed, at<&C::drive, &D::speed>, 1e-4, [](const C& c) { return 1e-2 * c.drive.speed; }},
  }};
}();

/// Makes `out`, a copy of `base` that may have had another state, the case in this state. Throws CaseError: a member
/// out of the range of its option, members that exclude each other.
void set_state(const State& state, const CaseSpec& base, CaseSpec& out);

/// What a member was in a solution of a state: given, or as the case or the result has it. Throws CaseError: it is a
/// result there.
double value_in_state(const StateMember& member, const State& state, const CaseSpec& spec, const BemResult& result);
/// The step of differences.
double step_of(const StateMember& member, const CaseSpec& spec);

}  // namespace railstrata
