#include "capi/wheelset.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "capi/guarded.hpp"
#include "capi/patch_forces.hpp"
#include "core/root.hpp"
#include "halfspace/hertz.hpp"

using namespace railstrata;
using railstrata::capi::Stiffening;
using railstrata::capi::Wheel;

namespace railstrata::capi {

double Stiffening::force_at(double a) const { return a > 0 ? scale * std::pow(a, power) : 0.0; }
double Stiffening::approach_at(double q) const { return std::pow(q / scale, 1 / power); }

void Stiffening::add(double a, double q) {
  constexpr double kNear = 1e-4, kFar = 1, kLeast = 0.8, kMost = 3;
  if (!(a > 0) || !(q > 0)) return;
  const double apart = approach > 0 ? std::abs(std::log(a / approach)) : 0;
  if (apart > kNear && apart < kFar) power = std::clamp(std::log(q / force) / std::log(a / approach), kLeast, kMost);
  approach = a;
  force = q;
  scale = q / std::pow(a, power);
}

namespace {

constexpr int kMostSolutions = 60, kFreeSolutions = 5;

/// A cold call of the interface inside: its code becomes the exception that it came from.
void raise(int code, const rs_error& error) {
  if (code == RS_OK) return;
  if (code == RS_NO_ANSWER) throw NoAnswer(CaseError(error.message));
  if (code == RS_CASE) throw CaseError(error.message);
  if (code == RS_NUMERICS) throw NumericalError(error.message);
  if (code == RS_MACHINE) throw EnvironmentError(error.message);
  throw std::runtime_error(error.message);
}

WheelsetMotion motion_of(const rs_wheelset_state& s) {
  return {s.y, s.z, s.yaw, s.roll, s.speed, s.y_rate, s.z_rate, s.yaw_rate, s.roll_rate, s.pitch_rate};
}

RailMotion rail_of(const rs_wheelset_state& s, int side) {
  return {s.rail_y[side], s.rail_z[side], s.rail_roll[side], s.rail_y_rate[side], s.rail_z_rate[side]};
}

/// Looks where the wheel touches and leaves it in the contact, whose solutions then need not look again.
void place(Wheel& w, const HeldPlace& held) {
  rs_contact& c = *w.contact;
  Placement& p = c.placement;
  p.track = track_under(p.wheel, p.rail, w.at_rest, w.motion, w.rail);
  answer([&] { p.contact = place_wheel(p.wheel, p.rail, p.track, held); });
  GeometrySpec& g = c.loaded.spec.geometry;
  g.lateral_shift = p.track.lateral_shift;
  g.yaw = p.track.yaw;
  g.roll = p.track.roll;
  g.cant = p.track.cant;
}

/// hold: each wheel keeps to the place where it touches now, if another is lower by less than 5 um.
void place(rs_wheelset& set, const rs_wheelset_state& state, double roll, bool hold = false) {
  constexpr double kHeldWithin = 5e-6;  // m
  for (int side : {RS_LEFT, RS_RIGHT}) {
    Wheel& w = set.wheels[static_cast<std::size_t>(side)];
    w.motion = motion_of(state);
    w.motion.roll = roll;
    w.rail = rail_of(state, side);
    if (side == RS_RIGHT) {
      w.motion = mirrored(w.motion);
      w.rail = mirrored(w.rail);
    }
    place(w, hold ? HeldPlace{w.touching().rail_s, kHeldWithin} : HeldPlace{});
  }
  set.roll = roll;
}

/// The force and the moment about the wheelset's centre, of the tractions of all cells.
void add_up(Wheel& w) {
  w.force = {w.forces.force_x, w.forces.force_y, w.forces.force_z};
  w.moment = {};
  if (!w.contact->last) return;
  const auto add = [&](const BemPatch& patch) {
    const auto arm = [&](double x, Vec2 point) { return arm_of(w.track(), w.touching(), w.motion, x, point); };
    w.moment += wrench_of(patch, arm).moment;
  };
  add(*w.contact->last);
  for (const BemPatch& patch : w.contact->last->further) add(patch);
}

/// Solves a wheel under an approach along the normal of its first contact.
void press(Wheel& w, double approach) {
  const WheelSlip slip = slip_at(w.track(), w.touching(), w.motion, w.rail);
  rs_state state{};
  state.size = sizeof(rs_state);
  state.given = RS_APPROACH | RS_SPEED | RS_CREEPAGE_X | RS_CREEPAGE_Y | RS_SPIN;
  state.approach = approach;
  state.speed = w.motion.speed;
  state.creepage_x = slip.creepage_x;
  state.creepage_y = slip.creepage_y;
  state.spin = slip.spin;
  w.forces.size = sizeof(rs_forces);
  rs_error error{};
  raise(rs_solve(w.contact.get(), &state, &w.forces, &error), error);
  w.approach = approach;
  add_up(w);
}

void press(rs_wheelset& set, const std::array<double, 2>& approach) {
  ++set.solutions;
  for (std::size_t k : {0, 1}) {
    press(set.wheels[k], approach[k]);
    set.stiffening[k].add(approach[k], set.wheels[k].force.z);
  }
}

/// Approach of a wheel at the height z of the wheelset.
double approach_at(const Wheel& w, double z) {
  WheelsetMotion m = w.motion;
  m.z = z;
  return descent(w.track(), w.touching(), m, w.rail) * std::cos(w.touching().angle);
}

void begin_stiffening(rs_wheelset& set) {
  for (std::size_t k : {0, 1}) {
    if (set.stiffening[k].scale > 0) continue;
    const rs_contact& c = *set.wheels[k].contact;
    const double approach = hertz_estimate(c.loaded.spec, set.wheels[k].touching()).approach;
    set.stiffening[k].scale = c.loaded.spec.vehicle.load() / std::pow(approach, 1.5);
  }
}

double tolerance_of(const rs_wheelset& set) {
  return std::max(set.wheels[0].contact->options.balance, set.wheels[1].contact->options.balance);
}

/// z where the forces that are expected of the approaches bear the load.
double expected_height(const rs_wheelset& set, double load) {
  const auto borne = [&](double z) {
    return set.stiffening[0].force_at(approach_at(set.wheels[0], z)) +
           set.stiffening[1].force_at(approach_at(set.wheels[1], z));
  };
  double high = std::max(
      height_of_descent(0, set.wheels[0].track(), set.wheels[0].touching(), set.wheels[0].motion, set.wheels[0].rail),
      height_of_descent(0, set.wheels[1].track(), set.wheels[1].touching(), set.wheels[1].motion, set.wheels[1].rail));
  double step = 1e-4, low = high - step;
  while (borne(low) < load) low -= step *= 2;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (borne(middle) < load ? high : low) = middle;
  }
  return low;
}

/// The height under a load, with the roll that is given.
double sink(rs_wheelset& set, double load) {
  begin_stiffening(set);
  for (int i = 0; i < kMostSolutions; ++i) {
    const double z = expected_height(set, load);
    press(set, {approach_at(set.wheels[0], z), approach_at(set.wheels[1], z)});
    if (std::abs(set.wheels[0].force.z + set.wheels[1].force.z - load) <= tolerance_of(set) * load) return z;
  }
  throw NumericalError("the height of the wheelset under its load was not found");
}

/// The vertical forces that bear the load and the roll moment, where forces and moments keep their proportions.
std::array<double, 2> wanted_forces(const rs_wheelset& set, double load, double roll_moment) {
  double arm[2];
  for (std::size_t k : {0, 1}) {
    const Wheel& w = set.wheels[k];
    if (!(w.force.z > 0))
      throw NoAnswer(CaseError("friction bears the wheel that is pressed: no vertical force is left",
                               "lower drive.friction_coefficient, or check y and the profiles"));
    arm[k] = w.moment.x / w.force.z;
  }
  arm[1] = -arm[1];
  const double left = (-roll_moment - arm[1] * load) / (arm[0] - arm[1]);
  if (!(left > 0 && left < load))
    throw NoAnswer(
        CaseError(fmt::format("a roll moment of {:.4g} N m tips the wheelset over under {:.4g} N", roll_moment, load),
                  "give a smaller rs_wheelset_state.roll_moment, or the roll"));
  return {left, load - left};
}

/// The roll at which both wheels have their approaches, and the height; none was found: nothing.
std::optional<double> tilt(rs_wheelset& set, const rs_wheelset_state& state, const std::array<double, 2>& approach,
                           bool hold) {
  constexpr double kClose = 1e-10;  // m
  double height[2];
  const auto apart = [&](double roll) {
    place(set, state, roll, hold);
    for (std::size_t k : {0, 1}) {
      const Wheel& w = set.wheels[k];
      height[k] =
          height_of_descent(approach[k] / std::cos(w.touching().angle), w.track(), w.touching(), w.motion, w.rail);
    }
    return height[0] - height[1];
  };
  const double usual = -2 * std::max(tape_circle_distance(set.wheels[0].at_rest), 1e-3);
  double roll = set.roll, error = apart(roll), slope = usual;
  for (int i = 0; i < kMostSolutions; ++i) {
    if (std::abs(error) <= kClose) return 0.5 * (height[0] + height[1]);
    hold = hold || i == kFreeSolutions;
    const double next = roll - error / slope, after = apart(next);
    if (std::abs(next - roll) > 0 && (after - error) / (next - roll) < 0.1 * usual)
      slope = (after - error) / (next - roll);
    roll = next;
    error = after;
  }
  return {};
}

/// Height and roll by wheels whose force follows their own approach, which is soon done. Where the wheels touch changes
/// with the roll; after some solutions they keep to a place. None: a wheel on tread and flange does not follow it.
std::optional<double> lean_by_approaches(rs_wheelset& set, const rs_wheelset_state& state) {
  constexpr int kSoon = 8;
  place(set, state, set.roll);
  begin_stiffening(set);
  std::array<double, 2> wanted{0.5 * state.load, 0.5 * state.load};
  while (set.solutions < kSoon) {
    const std::array<double, 2> approach{set.stiffening[0].approach_at(wanted[0]),
                                         set.stiffening[1].approach_at(wanted[1])};
    const std::optional<double> z = tilt(set, state, approach, set.solutions > kFreeSolutions);
    if (!z) return {};
    press(set, approach);
    wanted = wanted_forces(set, state.load, state.roll_moment);
    const double missed =
        std::max(std::abs(wanted[0] - set.wheels[0].force.z), std::abs(wanted[1] - set.wheels[1].force.z));
    if (missed <= tolerance_of(set) * state.load) return z;
  }
  return {};
}

/// Height and roll: of all rolls, under each of which the wheelset sinks until it bears its load, the one whose moment
/// is that wanted. The moment falls as the roll grows, until a wheel is lifted; with the place of the first contact it
/// jumps by some 1e-4.
std::optional<double> lean_by_moment(rs_wheelset& set, const rs_wheelset_state& state, double from) {
  constexpr double kSame = 1e-10;  // rad
  double z = 0;
  bool hold = false;
  const auto excess = [&](double roll) {
    place(set, state, roll, hold);
    z = sink(set, state.load);
    return set.wheels[0].moment.x - set.wheels[1].moment.x + state.roll_moment;
  };
  const double arm = tape_circle_distance(set.wheels[0].at_rest), close = tolerance_of(set) * state.load * arm;
  double a = from, at_a = excess(a);
  if (std::abs(at_a) <= close) return z;
  double step = 1.2 * at_a / (arm * arm * (set.stiffening[0].slope() + set.stiffening[1].slope()));
  while (set.wheels[at_a > 0 ? 0 : 1].force.z > 0) {
    const double b = a + step, at_b = excess(b);
    if (std::abs(at_b) <= close) return z;
    hold = at_a * at_b < 0;
    if (hold)
      return narrow_root(a, at_a, b, at_b, close, kSame, kMostSolutions, excess) ? std::optional(z) : std::nullopt;
    a = b;
    at_a = at_b;
    step *= 2;
  }
  return {};
}

double lean(rs_wheelset& set, const rs_wheelset_state& state) {
  const double from = set.roll;
  const std::array<Stiffening, 2> stiffening = set.stiffening;
  std::exception_ptr refused;
  try {
    if (const std::optional<double> z = lean_by_approaches(set, state)) return *z;
  } catch (const NoAnswer&) {  // perhaps of forces on the way
    refused = std::current_exception();
  }
  set.stiffening = stiffening;
  if (const std::optional<double> z = lean_by_moment(set, state, from)) return *z;
  if (refused) std::rethrow_exception(refused);
  throw NumericalError("height and roll of the wheelset under its load were not found");
}

/// A member that counts and is no number would be answered as a wheel that misses its rail.
void require_numbers(const rs_wheelset_state& s) {
  using S = rs_wheelset_state;
  const auto number = [](const std::string& name, double value) {
    if (!std::isfinite(value))
      throw CaseError(fmt::format("rs_wheelset_state.{} = {:g}", name, value), "give a finite number");
  };
  if (s.given & RS_WHEELSET_Z) number("z", s.z);
  if (s.given & RS_WHEELSET_ROLL) number("roll", s.roll);
  if (s.given == RS_WHEELSET_LOAD) number("roll_moment", s.roll_moment);
  constexpr std::pair<const char*, double S::*> kNumbers[] = {{"y", &S::y},
                                                              {"yaw", &S::yaw},
                                                              {"y_rate", &S::y_rate},
                                                              {"z_rate", &S::z_rate},
                                                              {"yaw_rate", &S::yaw_rate},
                                                              {"roll_rate", &S::roll_rate},
                                                              {"pitch_rate", &S::pitch_rate}};
  for (const auto& [name, member] : kNumbers) number(name, s.*member);
  using OfRails = double(S::*)[2];
  constexpr std::pair<const char*, OfRails> kOfRails[] = {{"rail_y", &S::rail_y},
                                                          {"rail_z", &S::rail_z},
                                                          {"rail_roll", &S::rail_roll},
                                                          {"rail_y_rate", &S::rail_y_rate},
                                                          {"rail_z_rate", &S::rail_z_rate}};
  for (const auto& [name, member] : kOfRails)
    for (int side : {RS_LEFT, RS_RIGHT}) number(fmt::format("{}[{}]", name, side), (s.*member)[side]);
}

void require_state(const rs_wheelset_state& s) {
  if (s.size != sizeof(rs_wheelset_state))
    throw CaseError(fmt::format("rs_wheelset_state.size = {} is of another version of the library", s.size),
                    "set size = sizeof(rs_wheelset_state), and compile with this version's railstrata.h");
  constexpr unsigned kPressed = RS_WHEELSET_Z | RS_WHEELSET_ROLL, kSunk = RS_WHEELSET_LOAD | RS_WHEELSET_ROLL;
  if (s.given != kPressed && s.given != kSunk && s.given != RS_WHEELSET_LOAD)
    throw CaseError(fmt::format("rs_wheelset_state.given = {} does not say what is given", s.given),
                    "give RS_WHEELSET_Z | RS_WHEELSET_ROLL, RS_WHEELSET_LOAD | RS_WHEELSET_ROLL or RS_WHEELSET_LOAD");
  if (!(s.speed > 0) || !std::isfinite(s.speed))
    throw CaseError(fmt::format("rs_wheelset_state.speed = {:g}", s.speed), "give a speed above 0 m/s");
  if ((s.given & RS_WHEELSET_LOAD) && !(s.load > 0 && std::isfinite(s.load)))
    throw CaseError(fmt::format("rs_wheelset_state.load = {:g}", s.load), "give a load above 0 N");
  require_numbers(s);
}

void put(double (&out)[3], Vec3 v, bool mirror, bool axial) {
  const double across = mirror ? -1 : 1, along = mirror && axial ? -1 : 1;
  out[0] = along * v.x;
  out[1] = axial ? v.y : across * v.y;
  out[2] = along * v.z;
}

rs_wheel wheel_of(const Wheel& w, double y, bool mirror) {
  const double odd = mirror ? -1 : 1;
  const Placement& p = w.contact->placement;
  const WheelSlip slip = slip_at(w.track(), w.touching(), w.motion, w.rail);
  const Vec2 wheel = p.wheel.at(w.touching().wheel_s).position, rail = p.rail.at(w.touching().rail_s).position;
  rs_wheel out{};
  put(out.force, w.force, mirror, false);
  put(out.moment, w.moment, mirror, true);
  out.normal_force = w.forces.normal_force;
  out.lateral_force = odd * w.forces.lateral_force;
  out.spin_moment = odd * w.forces.spin_moment;
  out.creepage_x = slip.creepage_x;
  out.creepage_y = odd * slip.creepage_y;
  out.spin = odd * slip.spin;
  out.approach = w.approach;
  const Vec3 arm = arm_of(w.track(), w.touching(), w.motion, w.touching().x, w.touching().point);
  put(out.point, {arm.x, arm.y, w.touching().point.z + w.rail.z}, mirror, false);
  out.point[1] += y;
  out.on_wheel[0] = wheel.y;
  out.on_wheel[1] = wheel.z;
  out.on_rail[0] = rail.y;
  out.on_rail[1] = rail.z;
  out.contact_angle = odd * w.touching().angle;
  out.rolling_radius = w.touching().rolling_radius;
  out.p_max = w.forces.p_max;
  out.patch_area = w.forces.patch_area;
  out.dissipation = w.forces.dissipation;
  out.patches = w.forces.patches;
  out.cells = w.forces.cells;
  out.checks_hold = w.forces.checks_hold;
  return out;
}

void forget(rs_wheelset& set) {
  set.roll = 0;
  set.stiffening = {};
  for (Wheel& w : set.wheels) rs_forget(w.contact.get());
}

void solve(rs_wheelset& set, const rs_wheelset_state& state, rs_wheelset_forces& forces) {
  require_state(state);
  set.solutions = 0;
  if (state.given & RS_WHEELSET_ROLL) place(set, state, state.roll);
  forces.z = state.z;
  if (state.given & RS_WHEELSET_Z)
    press(set, {approach_at(set.wheels[0], state.z), approach_at(set.wheels[1], state.z)});
  else
    forces.z = state.given & RS_WHEELSET_ROLL ? sink(set, state.load) : lean(set, state);
  forces.roll = set.roll;
  forces.solutions = set.solutions;
  for (int side : {RS_LEFT, RS_RIGHT})
    forces.wheel[side] = wheel_of(set.wheels[static_cast<std::size_t>(side)], state.y, side == RS_RIGHT);
  for (int i : {0, 1, 2}) {
    forces.force[i] = forces.wheel[0].force[i] + forces.wheel[1].force[i];
    forces.moment[i] = forces.wheel[0].moment[i] + forces.wheel[1].moment[i];
  }
}

Wheel wheel_from(rs_contact* contact, const rs_error& error) {
  if (!contact) raise(error.code, error);
  Wheel out{{contact, rs_contact_free}, contact->placement.track, {}, {}, {}, 0, {}, {}};
  out.at_rest.lateral_shift = 0;
  const GeometrySpec& g = contact->loaded.spec.geometry;
  if (g.rail_radius || g.in_line())
    throw CaseError("a wheelset rolls on straight rails, in patches that are no lines",
                    "take out rail_radius and contact = \"line\"",
                    g.rail_radius ? "geometry.rail_radius" : "geometry.contact");
  return out;
}

/// make: a contact from a list of overrides.
template <class Make>
rs_wheelset* new_wheelset(const char* const* overrides, int count, const char* const* right, int right_count,
                          Make&& make) {
  if (count < 0 || right_count < 0 || (count > 0 && !overrides) || (right_count > 0 && !right))
    throw CaseError("a list of overrides is missing", "give a count of 0");
  std::vector<const char*> of_right(overrides, overrides + count);
  of_right.insert(of_right.end(), right, right + right_count);
  rs_error error{};
  Wheel left = wheel_from(make(overrides, count, &error), error);
  Wheel other = wheel_from(make(of_right.data(), count + right_count, &error), error);
  return new rs_wheelset(std::move(left), std::move(other));
}

}  // namespace
}  // namespace railstrata::capi

extern "C" {

rs_wheelset* rs_wheelset_new(const char* case_file, const char* const* overrides, int count, const char* const* right,
                             int right_count, rs_error* error) {
  rs_wheelset* out = nullptr;
  capi::guarded(error, [&] {
    out = capi::new_wheelset(overrides, count, right, right_count, [&](const char* const* list, int n, rs_error* e) {
      return rs_contact_new(case_file, list, n, e);
    });
  });
  return out;
}

rs_wheelset* rs_wheelset_from_text(const char* toml, const char* const* overrides, int count, const char* const* right,
                                   int right_count, rs_error* error) {
  rs_wheelset* out = nullptr;
  capi::guarded(error, [&] {
    out = capi::new_wheelset(overrides, count, right, right_count, [&](const char* const* list, int n, rs_error* e) {
      return rs_contact_from_text(toml, list, n, e);
    });
  });
  return out;
}

void rs_wheelset_free(rs_wheelset* wheelset) { delete wheelset; }

int rs_wheelset_solve(rs_wheelset* wheelset, const rs_wheelset_state* state, rs_wheelset_forces* forces,
                      rs_error* error) {
  return capi::guarded(error, [&] {
    if (!wheelset || !state || !forces)
      throw CaseError("the wheelset, the state or the forces are NULL",
                      "make one with rs_wheelset_new, give the others");
    if (forces->size != sizeof(rs_wheelset_forces))
      throw CaseError(fmt::format("rs_wheelset_forces.size = {} is of another version of the library", forces->size),
                      "set size = sizeof(rs_wheelset_forces), and compile with this version's railstrata.h");
    capi::solve(*wheelset, *state, *forces);
  });
}

void rs_wheelset_keep(rs_wheelset* wheelset) {
  if (!wheelset) return;
  wheelset->kept = {wheelset->roll, wheelset->stiffening, {}};
  for (std::size_t k : {0, 1}) wheelset->kept.contacts[k] = wheelset->wheels[k].contact->start;
}

void rs_wheelset_reset(rs_wheelset* wheelset) {
  if (!wheelset) return;
  wheelset->roll = wheelset->kept.roll;
  wheelset->stiffening = wheelset->kept.stiffening;
  for (std::size_t k : {0, 1}) wheelset->wheels[k].contact->start = wheelset->kept.contacts[k];
}

void rs_wheelset_forget(rs_wheelset* wheelset) {
  if (wheelset) capi::forget(*wheelset);
}

rs_contact* rs_wheelset_contact(rs_wheelset* wheelset, int side) {
  if (!wheelset || side < RS_LEFT || side > RS_RIGHT) return nullptr;
  return wheelset->wheels[static_cast<std::size_t>(side)].contact.get();
}

}  // extern "C"
