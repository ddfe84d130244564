#include "ask/wheelset.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <string>
#include <utility>

#include "ask/wheelset_forces.hpp"
#include "ask/wheelset_wheel.hpp"
#include "core/faults.hpp"
#include "core/root.hpp"
#include "halfspace/hertz.hpp"
#include "rules/clashes.hpp"

namespace railstrata {

double Stiffening::force_at(double d) const { return d > 0 ? scale * std::pow(d, power) : 0.0; }
double Stiffening::descent_at(double q) const { return std::pow(q / scale, 1 / power); }

void Stiffening::add(double d, double q, bool several) {
  constexpr double kFar = 1, kLeast = 0.8;
  // on the way of two planes into one, some 50 nm, the force grows ten times as fast
  const double near = several ? 2e-5 : 1e-4, most = several ? 30 : 3;
  if (!(d > 0) || !(q > 0)) return;
  const double apart = descent > 0 ? std::abs(std::log(d / descent)) : 0;
  if (apart > near && apart < kFar) power = std::clamp(std::log(q / force) / std::log(d / descent), kLeast, most);
  descent = d;
  force = q;
  scale = q / std::pow(d, power);
}

namespace {

constexpr int kMostSolutions = 60, kFreeSolutions = 5;

/// Looks where the wheels touch and leaves it in their contacts, whose solutions then need not look again. hold: each
/// wheel keeps to the place where it touches now, if another is lower by less than 5 um.
void place(Wheelset& set, const WheelsetState& state, double roll, bool hold = false) {
  constexpr double kHeldWithin = 5e-6;  // m
  for (std::size_t side : {kLeft, kRight}) {
    Wheel& w = set.wheels[side];
    place(w, side, state, roll, hold ? HeldPlace{w.touching().rail_s, kHeldWithin} : HeldPlace{});
  }
  set.roll = roll;
}

/// Whether its last solution has several patches or tried them apart.
bool at_several_places(const Wheel& w) { return w.forces.patches > 1 || !w.contact.start.last().smooth.empty(); }

void press(Wheelset& set, const std::array<double, 2>& descents, bool extrapolate = false) {
  ++set.solutions;
  for (std::size_t k : {0, 1}) {
    press(set.wheels[k], descents[k], extrapolate, set.solutions > 1);
    const Wheel& w = set.wheels[k];
    if (!w.forces.beyond) set.stiffening[k].add(descents[k], w.force.z, at_several_places(w));
  }
}

void begin_stiffening(Wheelset& set) {
  for (std::size_t k : {0, 1}) {
    if (set.stiffening[k].scale > 0) continue;
    const CaseSpec& spec = set.wheels[k].contact.spec();
    const RigidContact& touching = set.wheels[k].touching();
    const double descent = hertz_estimate(spec, touching).approach / std::cos(touching.angle);
    set.stiffening[k].scale = spec.vehicle.load() / std::pow(descent, 1.5);
  }
}

std::array<double, 2> shifts_of(const WheelsetState& s) { return {s.y - s.rail_y[kLeft], s.y - s.rail_y[kRight]}; }

/// Where a wheel touches at several places, whose shares change fast with the shift: descents under the same force and
/// the left share of the load go on as from the solution before to the last one.
void follow(Wheelset& set, const WheelsetState& state) {
  constexpr double kFarthest = 2;  // steps
  const auto& [last, before] = set.sunk;
  if (!last || !before || !last->several || !before->several) return;
  const std::array<double, 2> now = shifts_of(state);
  for (std::size_t k : {0, 1}) {
    const double share = (now[k] - last->shift[k]) / (last->shift[k] - before->shift[k]);
    if (!(share > 0 && share <= kFarthest && last->stiffening[k].descent > 0)) continue;
    Stiffening& s = set.stiffening[k];
    s = last->stiffening[k];
    s.scale *= std::pow(before->stiffening[k].descent_at(s.force) / s.descent, share * s.power);
    s.descent = 0;  // the power stays
    if (k == kLeft) set.left_share = last->left_share + share * (last->left_share - before->left_share);
  }
}

void remember(Wheelset& set, const WheelsetState& state) {
  const bool several = at_several_places(set.wheels[kLeft]) || at_several_places(set.wheels[kRight]);
  set.sunk[1] = std::exchange(set.sunk[0], SunkWheelset{shifts_of(state), set.stiffening, set.left_share, several});
}

double tolerance_of(const Wheelset& set) {
  return std::max(set.wheels[0].contact.load_tolerance(), set.wheels[1].contact.load_tolerance());
}

double height_touching(const Wheel& w) { return height_of_descent(0, w.track(), w.touching(), w.motion, w.rail); }

/// z where the forces that are expected of the descents bear the load.
double expected_height(const Wheelset& set, double load) {
  const auto borne = [&](double z) {
    return set.stiffening[0].force_at(descent_at(set.wheels[0], z)) +
           set.stiffening[1].force_at(descent_at(set.wheels[1], z));
  };
  double high = std::max(height_touching(set.wheels[0]), height_touching(set.wheels[1]));
  double step = 1e-4, low = high - step;
  while (borne(low) < load) low -= step *= 2;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (borne(middle) < load ? high : low) = middle;
  }
  return low;
}

/// A height and by how much more than the load is borne there, N.
struct TriedHeight {
  double z = 0, excess = 0;
};

/// The height under a load, with the roll that is given: that which is expected, and where this does not settle, for a
/// wheel on tread and flange is no power of its descent, between the last ones that bear too much and too little.
double sink(Wheelset& set, double load) {
  constexpr int kSoon = 8;
  constexpr double kSame = 1e-15;  // m
  const double close = tolerance_of(set) * load;
  TriedHeight now;
  const auto excess = [&](double z) {
    press(set, {descent_at(set.wheels[0], z), descent_at(set.wheels[1], z)});
    now = {z, set.wheels[0].force.z + set.wheels[1].force.z - load};
    return now.excess;
  };
  begin_stiffening(set);
  std::optional<TriedHeight> low, high;
  std::optional<double> refused;  // the last height where a wheel is pressed further than half-spaces bear
  for (int i = 0; i < kMostSolutions && !(i >= kSoon && low && high); ++i) {
    double z = expected_height(set, load);
    if (refused && z <= *refused)
      z = 0.5 *
          (*refused + (high ? high->z : std::max(height_touching(set.wheels[0]), height_touching(set.wheels[1]))));
    try {
      if (std::abs(excess(z)) <= close) return now.z;
      (now.excess > 0 ? low : high) = now;
    } catch (const NoAnswer&) {
      if (i >= kSoon) throw;
      refused = z;
    }
  }
  if (low && high) narrow_root(low->z, low->excess, high->z, high->excess, close, kSame, kMostSolutions, excess);
  if (std::abs(now.excess) <= close) return now.z;
  if (low && high)
    throw NoAnswer(
        fmt::format("no equilibrium: near z = {:.6g} mm the vertical force jumps past the load, by {:.4g} N at "
                    "the least",
                    1e3 * now.z, std::abs(now.excess)),
        "give z and the roll, or another y");
  throw NumericalError("the height of the wheelset under its load was not found");
}

/// The vertical forces that bear the load and the roll moment, where forces and moments keep their proportions.
std::array<double, 2> wanted_forces(const Wheelset& set, double load, double roll_moment) {
  double arm[2];
  for (std::size_t k : {0, 1}) {
    const Wheel& w = set.wheels[k];
    if (!(w.force.z > 0))
      throw NoAnswer("friction bears the wheel that is pressed: no vertical force is left",
                     "lower drive.friction_coefficient, or check y and the profiles");
    arm[k] = w.moment.x / w.force.z;
  }
  arm[1] = -arm[1];
  const double left = (-roll_moment - arm[1] * load) / (arm[0] - arm[1]);
  if (!(left > 0 && left < load))
    throw NoAnswer(fmt::format("a roll moment of {:.4g} N m tips the wheelset over: under {:.4g} N it bears {:.4g} N m "
                               "on the left wheel alone to {:.4g} N m on the right one",
                               roll_moment, load, -arm[0] * load, -arm[1] * load),
                   "give a roll_moment between these, or the roll");
  return {left, load - left};
}

/// The roll at which both wheels have their descents, and the height; none was found: nothing.
std::optional<double> tilt(Wheelset& set, const WheelsetState& state, const std::array<double, 2>& descents,
                           bool hold) {
  constexpr double kLeastTurn = 1e-9;                                // rad, that shows a slope
  constexpr double kClose = 1e-10, kRoundOff = 4e-15, kShare = 0.1;  // m; of the tolerance of the descents
  const double close = std::clamp(kShare * tolerance_of(set) * std::min(descents[0], descents[1]), kRoundOff, kClose);
  double height[2];
  const auto apart = [&] {
    for (std::size_t k : {0, 1}) {
      const Wheel& w = set.wheels[k];
      height[k] = height_of_descent(descents[k], w.track(), w.touching(), w.motion, w.rail);
    }
    return height[0] - height[1];
  };
  const double usual = -2 * std::max(tape_circle_distance(set.wheels[0].at_rest), 1e-3);
  double roll = set.roll, error = apart(), slope = set.tilting < 0 ? set.tilting : usual;
  for (int i = 0; i < kMostSolutions; ++i) {
    if (std::abs(error) <= close) return 0.5 * (height[0] + height[1]);
    hold = hold || i == kFreeSolutions;
    const double next = roll - error / slope;
    place(set, state, next, hold);
    const double after = apart(), found = (after - error) / (next - roll);
    if (std::abs(next - roll) > kLeastTurn && found < 0.1 * usual) set.tilting = slope = found;
    roll = next;
    error = after;
  }
  return {};
}

/// The force of a wheel that is the one wanted, by the two last solutions, where what is wanted follows the force
/// nearly as fast: of a wheel on the way of two planes into one, whose arm of the moment changes with its force.
class WantedForce {
 public:
  double next(double borne, double wanted) {
    constexpr double kSlow = 0.2, kMost = 0.8;
    const double slope = borne_ != borne ? (wanted - wanted_) / (borne - borne_) : 0;
    const bool follows = known_ && std::abs(slope) > kSlow && slope < kMost;
    known_ = true;
    borne_ = borne;
    wanted_ = wanted;
    return follows ? (wanted - slope * borne) / (1 - slope) : wanted;
  }

 private:
  bool known_ = false;
  double borne_ = 0, wanted_ = 0;
};

/// The descents of a wheel that bore too little and too much, nearest to each other.
class SoughtDescent {
 public:
  void add(double descent, double lacking) { (lacking > 0 ? low_ : high_) = {descent, lacking}; }
  /// The next one between them, where they are in order.
  double between(double next) const {
    constexpr double kLeast = 0.1;  // of the way from either
    if (!low_ || !high_ || !(low_->descent < high_->descent)) return next;
    if (next > low_->descent && next < high_->descent) return next;
    const double share = std::clamp(low_->lacking / (low_->lacking - high_->lacking), kLeast, 1 - kLeast);
    return low_->descent + share * (high_->descent - low_->descent);
  }

 private:
  struct Tried {
    double descent = 0, lacking = 0;  ///< m, N
  };
  std::optional<Tried> low_, high_;
};

/// Height and roll by wheels whose force follows their own descent, which is soon done. Where the wheels touch changes
/// with the roll; after some solutions they keep to a place. None: a wheel on tread and flange does not follow it.
std::optional<double> lean_by_descents(Wheelset& set, const WheelsetState& state) {
  constexpr int kSoon = 8, kOfSeveral = 12;
  place(set, state, set.roll);
  begin_stiffening(set);
  std::array<double, 2> wanted{set.left_share * *state.load, (1 - set.left_share) * *state.load};
  WantedForce follower;
  std::array<SoughtDescent, 2> sought;
  bool several = false;
  while (set.solutions < (several ? kOfSeveral : kSoon)) {
    std::array<double, 2> descents{set.stiffening[0].descent_at(wanted[0]), set.stiffening[1].descent_at(wanted[1])};
    for (std::size_t k : {0, 1})
      if (several && at_several_places(set.wheels[k])) descents[k] = sought[k].between(descents[k]);
    const std::optional<double> z = tilt(set, state, descents, set.solutions > kFreeSolutions);
    if (!z) return {};
    press(set, descents);
    wanted = wanted_forces(set, *state.load, state.roll_moment);
    set.left_share = wanted[0] / *state.load;
    const std::array<double, 2> lacking{wanted[0] - set.wheels[0].force.z, wanted[1] - set.wheels[1].force.z};
    if (std::max(std::abs(lacking[0]), std::abs(lacking[1])) <= tolerance_of(set) * *state.load) return z;
    for (std::size_t k : {0, 1}) sought[k].add(descents[k], lacking[k]);
    several = at_several_places(set.wheels[0]) || at_several_places(set.wheels[1]);
    if (!several) continue;
    const std::size_t which = at_several_places(set.wheels[0]) ? 0 : 1;
    wanted[which] = follower.next(set.wheels[which].force.z, wanted[which]);
    wanted[1 - which] = *state.load - wanted[which];
  }
  return {};
}

[[noreturn]] void refuse_jump(const Wheelset& set, double missed) {
  throw NoAnswer(fmt::format("no equilibrium: near a roll of {:.6g} rad the roll moment jumps past the one wanted, by "
                             "{:.4g} N m at the least",
                             set.roll, missed),
                 "give the roll, or another y");
}

/// Height and roll: of all rolls, under each of which the wheelset sinks until it bears its load, the one whose moment
/// is that wanted. The moment falls as the roll grows, where a wheel is lifted only while the other one changes its
/// place on the flange; on the flange it may stand still for some mrad, so that the search goes on until the lifted
/// wheel is as high as a flange. Throws NoAnswer where the moment jumps.
std::optional<double> lean_by_moment(Wheelset& set, const WheelsetState& state, double from) {
  constexpr double kSame = 1e-10, kRoundOff = 10, kHighest = 0.03;  // rad; of what is close; m
  double z = 0, last = 0;
  bool hold = false;
  const auto excess = [&](double roll) {
    place(set, state, roll, hold);
    z = sink(set, *state.load);
    return last = set.wheels[0].moment.x - set.wheels[1].moment.x + state.roll_moment;
  };
  const double arm = tape_circle_distance(set.wheels[0].at_rest), close = tolerance_of(set) * *state.load * arm;
  double a = from, at_a = excess(a);
  if (std::abs(at_a) <= close) return z;
  double step = 1.2 * at_a / (arm * arm * (set.stiffening[0].slope() + set.stiffening[1].slope()));
  for (;;) {
    const double b = a + step, at_b = excess(b);
    if (std::abs(at_b) <= close) return z;
    hold = at_a * at_b < 0;
    if (hold) {
      if (!narrow_root(a, at_a, b, at_b, close, kSame, kMostSolutions, excess)) return {};
      if (std::abs(last) > kRoundOff * close) refuse_jump(set, std::abs(last));
      return z;
    }
    const bool lifted = !(set.wheels[at_b > 0 ? 0 : 1].force.z > 0);
    if (lifted && 2 * arm * std::abs(b - from) > kHighest) return {};
    a = b;
    at_a = at_b;
    step *= 2;
  }
}

double lean_from_here(Wheelset& set, const WheelsetState& state) {
  const double from = set.roll;
  const std::array<Stiffening, 2> stiffening = set.stiffening;
  std::exception_ptr refused;
  try {
    if (const std::optional<double> z = lean_by_descents(set, state)) return *z;
  } catch (const NoAnswer&) {  // perhaps of forces on the way
    refused = std::current_exception();
  } catch (const NumericalError&) {
    refused = std::current_exception();
  }
  set.stiffening = stiffening;
  if (const std::optional<double> z = lean_by_moment(set, state, from)) return *z;
  if (refused) std::rethrow_exception(refused);
  throw NumericalError("height and roll of the wheelset under its load were not found");
}

/// What states before have left may lead astray: once more without it.
double lean(Wheelset& set, const WheelsetState& state) {
  const bool is_new = set.wheels[0].contact.start.last().empty() && set.wheels[1].contact.start.last().empty();
  try {
    return lean_from_here(set, state);
  } catch (const NoAnswer&) {
    if (is_new) throw;
  } catch (const NumericalError&) {
    if (is_new) throw;
  }
  forget(set);
  const int before = std::exchange(set.solutions, 0);
  const double z = lean_from_here(set, state);
  set.solutions += before;
  return z;
}

/// Height and, unless it is given, the roll at which the wheels touch without a force.
double hang(Wheelset& set, const WheelsetState& state) {
  if (state.roll_moment != 0)
    throw NoAnswer(fmt::format("a roll moment of {:.4g} N m tips the wheelset over under no load", state.roll_moment),
                   "give a roll_moment of 0, or the roll");
  if (!state.roll && !tilt(set, state, {0, 0}, false))
    throw NumericalError("the roll at which both wheels touch was not found");
  const double z = std::max(height_touching(set.wheels[0]), height_touching(set.wheels[1]));
  press(set, {0, 0});
  return z;
}

void require_state(const WheelsetState& s) {
  if (!(s.z && s.roll && !s.load) && !(s.load && !s.z))
    throw CaseError("the state does not say what is given", "give z and roll, load and roll, or load");
  if (s.load && !(*s.load >= 0)) throw CaseError(fmt::format("load = {:g}", *s.load), "give a load of 0 N or more");
  const auto require = [](double value, const std::string& name) {  // else answered as a wheel that misses its rail
    if (!std::isfinite(value)) throw CaseError(fmt::format("{} = {:g}", name, value), "give a finite number");
  };
  for (const auto& row : kWheelsetState)
    with_member(row, s, [&](const auto& value) {
      if constexpr (requires { value.size(); })
        for (std::size_t side : {kLeft, kRight}) require(value[side], fmt::format("{}[{}]", row.name, side));
      else if constexpr (requires { value.has_value(); })
        require(value.value_or(0), row.name);
      else
        require(value, row.name);
    });
}

}  // namespace

Wheel::Wheel(const LoadedCase& loaded) : contact(loaded), at_rest(track()) {
  at_rest.lateral_shift = 0;
  contact.of_wheelset = true;
  require_support(uses::kWheelset, loaded);
}

void drop_solution(Wheelset& set) {
  set.solved.reset();
  set.remarks.clear();
  for (Wheel& w : set.wheels) w.contact.drop_solution();
}

WheelsetForces solve(Wheelset& set, const WheelsetState& state) {
  drop_solution(set);
  require_state(state);
  set.solutions = 0;
  if (state.roll) place(set, state, *state.roll);
  WheelsetForces out;
  if (state.z) {
    out.z = *state.z;
    press(set, {descent_at(set.wheels[0], out.z), descent_at(set.wheels[1], out.z)}, state.extrapolate);
  } else {
    follow(set, state);
    out.z = *state.load == 0 ? hang(set, state) : state.roll ? sink(set, *state.load) : lean(set, state);
    remember(set, state);
  }
  out.roll = set.roll;
  out.solutions = set.solutions;
  set.solved = {state, out.z, out.roll};
  for (std::size_t side : {kLeft, kRight}) {
    out.wheels[side] = forces_of(set, side);
    out.force += out.wheels[side].force;
    out.moment += out.wheels[side].moment;
    out.beyond += out.wheels[side].beyond ? 1 : 0;
  }
  set.remarks = remarks_of(set);
  return out;
}

void keep(Wheelset& set) {
  set.kept = {set.roll,       set.tilting, set.left_share,
              set.stiffening, set.sunk,    {set.wheels[0].contact.start, set.wheels[1].contact.start}};
}

void reset(Wheelset& set) {
  set.roll = set.kept.roll;
  set.tilting = set.kept.tilting;
  set.left_share = set.kept.left_share;
  set.stiffening = set.kept.stiffening;
  set.sunk = set.kept.sunk;
  for (std::size_t side : {kLeft, kRight}) set.wheels[side].contact.start = set.kept.contacts[side];
}

void forget(Wheelset& set) {
  set.roll = set.tilting = 0;
  set.left_share = 0.5;
  set.stiffening = {};
  set.sunk = {};
  for (Wheel& w : set.wheels) w.contact.start = {};
}

}  // namespace railstrata
