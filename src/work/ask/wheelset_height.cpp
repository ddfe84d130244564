#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ask/wheelset_search.hpp"
#include "core/faults.hpp"
#include "core/root.hpp"
#include "halfspace/hertz.hpp"

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

/// A height and by how much more than the load is borne there, N.
struct TriedHeight {
  double z = 0, excess = 0;
};

}  // namespace

bool at_several_places(const Wheel& w) { return w.forces.patches > 1 || !w.contact.start.last().smooth.empty(); }

void place(Wheelset& set, const WheelsetState& state, double roll, bool hold) {
  constexpr double kHeldWithin = 5e-6;  // m
  for (std::size_t side : {kLeft, kRight}) {
    Wheel& w = set.wheels[side];
    place(w, side, state, roll, hold ? HeldPlace{w.touching().rail_s, kHeldWithin} : HeldPlace{});
  }
  set.roll = roll;
}

void press(Wheelset& set, const std::array<double, 2>& descents, bool extrapolate) {
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

double tolerance_of(const Wheelset& set) {
  return std::max(set.wheels[0].contact.load_tolerance(), set.wheels[1].contact.load_tolerance());
}

double height_touching(const Wheel& w) { return height_of_descent(0, w.track(), w.touching(), w.motion, w.rail); }

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

}  // namespace railstrata
