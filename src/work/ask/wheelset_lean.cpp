#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>

#include "ask/wheelset_search.hpp"
#include "core/faults.hpp"
#include "core/root.hpp"

namespace railstrata {

namespace {

constexpr int kFreeSolutions = 5;
constexpr double kNoise = 3;  // of what is close

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

using Pair = std::array<double, 2>;

/// How the posture of a wheelset (its height, and the way of a wheel by the roll, m) has to change for what is borne
/// (the load, and the roll moment over the arm, N) to be one more: two springs to begin with, then Broyden's matrix
/// [Broyden1965] of what was tried. noise: N, of what is borne.
class Balance {
 public:
  Balance(Wheelset& set, double noise) : set_(set), noise_(noise) {}
  void add(const Pair& posture, const Pair& excess) {
    if (!set_.leaning) set_.leaning = of_springs();
    if (known_)
      learn({posture[0] - posture_[0], posture[1] - posture_[1]}, {excess[0] - excess_[0], excess[1] - excess_[1]});
    known_ = true;
    posture_ = posture;
    excess_ = excess;
  }
  /// After the last one.
  Pair next() const {
    constexpr double kFarthest = 5e-5;  // m
    const Leaning& a = *set_.leaning;
    Pair out = posture_;
    for (std::size_t k : {0, 1})
      out[k] -= std::clamp(a[2 * k] * excess_[0] + a[2 * k + 1] * excess_[1], -kFarthest, kFarthest);
    return out;
  }

 private:
  Leaning of_springs() const {
    double left = set_.stiffening[kLeft].slope(), right = set_.stiffening[kRight].slope();
    if (!(left > 0)) left = right;
    if (!(right > 0)) right = left;
    const double both = -0.25 / left - 0.25 / right, apart = 0.25 / right - 0.25 / left;
    return {both, apart, apart, both};
  }
  void learn(const Pair& moved, const Pair& more) {
    Leaning& a = *set_.leaning;
    const Pair lacks{moved[0] - a[0] * more[0] - a[1] * more[1], moved[1] - a[2] * more[0] - a[3] * more[1]},
        row{moved[0] * a[0] + moved[1] * a[2], moved[0] * a[1] + moved[1] * a[3]};
    const double along = row[0] * more[0] + row[1] * more[1];
    if (along == 0 || std::max(std::abs(more[0]), std::abs(more[1])) < noise_) return;
    for (std::size_t k : {0, 1}) {
      a[2 * k] += lacks[k] * row[0] / along;
      a[2 * k + 1] += lacks[k] * row[1] / along;
    }
  }
  Wheelset& set_;
  double noise_;
  bool known_ = false;
  Pair posture_{}, excess_{};
};

double moment_excess(const Wheelset& set, const WheelsetState& state) {
  return set.wheels[kLeft].moment.x - set.wheels[kRight].moment.x + state.roll_moment;
}

/// Height and roll together, from those before: of a wheel on tread and flange force and arm follow both.
std::optional<double> lean_by_both(Wheelset& set, const WheelsetState& state) {
  constexpr int kSoon = 10;
  const double arm = tape_circle_distance(set.wheels[0].at_rest), close = tolerance_of(set) * *state.load;
  place(set, state, set.roll);
  begin_stiffening(set);
  Balance balance(set, kNoise * close);
  Pair at{expected_height(set, *state.load), arm * set.roll};
  for (int i = 0; i < kSoon; ++i) {
    if (i > 0) place(set, state, at[1] / arm, i > kFreeSolutions);
    press(set, {descent_at(set.wheels[0], at[0]), descent_at(set.wheels[1], at[0])});
    const Pair excess{set.wheels[kLeft].force.z + set.wheels[kRight].force.z - *state.load,
                      moment_excess(set, state) / arm};
    if (std::max(std::abs(excess[0]), std::abs(excess[1])) <= close) return at[0];
    balance.add(at, excess);
    at = balance.next();
  }
  return {};
}

/// Height and roll by wheels whose force follows their own descent, which is soon done. Where the wheels touch changes
/// with the roll; after some solutions they keep to a place. None: a wheel on tread and flange does not follow it.
std::optional<double> lean_by_descents(Wheelset& set, const WheelsetState& state) {
  constexpr int kSoon = 8;
  place(set, state, set.roll);
  begin_stiffening(set);
  std::array<double, 2> wanted{set.left_share * *state.load, (1 - set.left_share) * *state.load};
  while (set.solutions < kSoon) {
    const std::array<double, 2> descents{set.stiffening[0].descent_at(wanted[0]),
                                         set.stiffening[1].descent_at(wanted[1])};
    const std::optional<double> z = tilt(set, state, descents, set.solutions > kFreeSolutions);
    if (!z) return {};
    press(set, descents);
    wanted = wanted_forces(set, *state.load, state.roll_moment);
    set.left_share = wanted[0] / *state.load;
    const double lacking =
        std::max(std::abs(wanted[0] - set.wheels[0].force.z), std::abs(wanted[1] - set.wheels[1].force.z));
    if (lacking <= tolerance_of(set) * *state.load) return z;
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
  const double arm = tape_circle_distance(set.wheels[0].at_rest), close = tolerance_of(set) * *state.load * arm;
  Balance balance(set, kNoise * close / arm);
  const auto excess = [&](double roll) {
    place(set, state, roll, hold);
    z = sink(set, *state.load);
    last = moment_excess(set, state);
    balance.add({z, arm * roll}, {0, last / arm});
    return last;
  };
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

}  // namespace

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

/// Whether under the load the axle is lower with the roll that it came from than in the equilibrium that was found far
/// from it: then there is a lower one nearer.
bool is_lower_before(Wheelset& set, const WheelsetState& state, double from, double z) {
  constexpr double kFar = 2e-3;  // rad
  const double found = set.roll;
  if (!(std::abs(found - from) > kFar)) return false;
  try {
    place(set, state, from);
    if (sink(set, *state.load) < z) return true;
  } catch (const NoAnswer&) {
  } catch (const NumericalError&) {
  }
  place(set, state, found);
  press(set, {descent_at(set.wheels[0], z), descent_at(set.wheels[1], z)});
  return false;
}

/// The first way that has an answer; of refusals, perhaps of forces on the way, that of the first.
double lean_from_here(Wheelset& set, const WheelsetState& state) {
  const double from = set.roll;
  const std::array<Stiffening, 2> stiffening = set.stiffening;
  std::exception_ptr refused;
  const auto attempt = [&](auto&& way) -> std::optional<double> {
    try {
      return way();
    } catch (const NoAnswer&) {
      if (!refused) refused = std::current_exception();
    } catch (const NumericalError&) {
      if (!refused) refused = std::current_exception();
    }
    return {};
  };
  const auto by_descents = [&] { return lean_by_descents(set, state); };
  const auto by_both = [&] { return lean_by_both(set, state); };
  const auto by_moment = [&] { return lean_by_moment(set, state, from); };
  if (set.leaning)
    if (const std::optional<double> z = attempt(by_both)) return *z;
  set.leaning.reset();
  if (const std::optional<double> z = attempt(by_descents)) {
    if (!is_lower_before(set, state, from, *z)) return *z;
    if (const std::optional<double> lower = attempt(by_moment)) return *lower;
    set.solutions = 0;
    if (const std::optional<double> again = by_descents()) return *again;
  }
  if (const std::optional<double> z = attempt(by_both)) return *z;
  set.leaning.reset();
  set.stiffening = stiffening;
  if (const std::optional<double> z = by_moment()) return *z;
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

}  // namespace railstrata
