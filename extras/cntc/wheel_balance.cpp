#include "cntc/wheel_balance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace railstrata::cntc {
namespace {

constexpr int kMostHeights = 60;

/// A zero of `residual`, which rises or falls: steps that double from `start` until its sign changes, then regula falsi
/// that halves the end that stays (Illinois). `most`: the longest way.
double zero_of(const std::function<double(double)>& residual, double start, double step, double most, double close,
               const char* what) {
  double a = start, at_a = residual(a);
  if (std::abs(at_a) <= close) return a;
  double b = a + step, at_b = residual(b);
  while (at_a * at_b > 0) {
    if (std::abs(at_b) > std::abs(at_a)) step = -step;
    if (std::abs(b - start) > most) throw Refused(kTotalForce, fmt::format("no {} has the given force", what));
    step *= 2;
    if (std::abs(at_b) < std::abs(at_a)) {
      a = b;
      at_a = at_b;
    }
    b = a + step;
    at_b = residual(b);
  }
  for (int k = 0; k < kMostHeights && std::abs(at_b) > close; ++k) {
    const double next = b - at_b * (b - a) / (at_b - at_a), at_next = residual(next);
    if (at_next * at_b < 0) {
      a = b;
      at_a = at_b;
    } else {
      at_a *= 0.5;
    }
    const bool settled = std::abs(next - b) < 1e-12 * std::max(std::abs(b), 1e-6);
    b = next;
    at_b = at_next;
    if (settled) return b;
  }
  if (std::abs(at_b) > close) throw Refused(kTotalForce, fmt::format("the {} of the given force was not found", what));
  return b;
}

Vec3 force_of(const std::vector<WheelRailPatch>& patches, Vec3 WheelRailPatch::*which) {
  Vec3 out;
  for (const WheelRailPatch& p : patches) out += p.*which;
  return out;
}

class Balance {
 public:
  Balance(ModuleOne& one, const Problem& base, const AtHeight& wheel) : one_(one), base_(base), wheel_(wheel) {}

  void run() {
    const int force = flag(base_.settings, kForce);
    if (force != 3) one_.forces.rail.way[0] = one_.forces.rail.way[1] = 0;
    if (force == 3)
      give_way();
    else if (force == 1)
      drive();
    else
      stand();
  }

 private:
  bool loaded() const { return flag(base_.settings, kNorm) == 1; }
  double tolerance() const { return base_.settings.tolerance; }

  void stand() {
    if (!loaded()) {
      wheel_.press(one_.wheelset.at[2]);
      return;
    }
    const bool near = flag(base_.settings, kTime) == 0 || flag(base_.settings, kEstimate) > 0;
    sink(near, [this](double) { return one_.forces.load; });
  }

  /// The pitch rate under FX_WS, from pure rolling on.
  void drive() {
    if (!loaded()) throw Refused(kOther, "F = 1, a force along the track, needs a vertical force, N = 1");
    const double speed =
        on_roller(base_) ? one_.pitch_rate_of_roller * one_.track.roller_radius : one_.wheelset.rate[0];
    const double rolling = -speed / one_.wheel_radius;
    if (rolling == 0) throw Refused(kOther, "F = 1, a force along the track, needs a rolling velocity");
    bool near = false;
    const auto excess = [&](double rate) {
      one_.wheelset.rate[5] = rate;
      sink(std::exchange(near, true), [this](double) { return one_.forces.load; });
      return force_of(one_.found.patches, &WheelRailPatch::force_of_wheelset).x - one_.forces.along;
    };
    constexpr double kFirstCreepage = 1e-4, kMostCreepage = 0.5;
    const double friction = base_.settings.friction ? base_.settings.friction->at_rest : 1;
    zero_of(excess, rolling, kFirstCreepage * rolling, kMostCreepage * std::abs(rolling),
            tolerance() * friction * one_.forces.load, "pitch rate");
  }

  /// The way of the rail across, by its springs; down it gives way under the force at that place.
  void give_way() {
    RailSupport& rail = one_.forces.rail;
    const double side = side_of(base_);
    if (flag(base_.settings, kTang) == 0)
      throw Refused(kOther, "F = 3, a rail that gives way, needs friction, T = 1 to 3");
    if (!loaded() && !(rail.stiffness[1] > 0))
      throw Refused(kOther, "F = 3 with a given height, N = 0, needs the rail's stiffness, KZRAIL");
    bool near = flag(base_.settings, kEstimate) > 0;
    const auto excess = [&](double across) {
      rail.way[0] = across;
      settle_down(std::exchange(near, true));
      return side * force_of(one_.found.patches, &WheelRailPatch::force).y - rail.stiffness[0] * across + rail.force[0];
    };
    const double close = tolerance() * std::max(std::abs(rail.force[0]), loaded() ? one_.forces.load : 0);
    constexpr double kMost = 0.05;  // m
    zero_of(excess, near ? rail.way[0] : 0.0, rail.first_step, kMost, close, "way of the rail");
  }

  void settle_down(bool near) {
    RailSupport& rail = one_.forces.rail;
    const double height = one_.wheelset.at[2];
    rail.way[1] = 0;
    if (loaded()) {
      if (rail.stiffness[1] > 0) rail.way[1] = (one_.forces.load + rail.force[1]) / rail.stiffness[1];
      sink(near, [this](double) { return one_.forces.load; });
      return;
    }
    // The wheel sinks into a rail at its place; then both stand higher or lower together.
    sink(near, [&](double z) { return rail.stiffness[1] * (height - z) - rail.force[1]; });
    rail.way[1] = height - one_.wheelset.at[2];
    wheel_.press(height);
  }

  /// The height under a load: F = k (z - z_0)^(3/2) through the last heights, between heights that bracket it.
  void sink(bool near, const std::function<double(double)>& load_at) {
    const double touching = wheel_.touch();
    constexpr double kFirst = 5e-5;  // m
    double low = touching, high = touching, z = touching + (near && one_.found.sunk > 0 ? one_.found.sunk : kFirst);
    bool bracketed = false;
    last_force_ = 0;
    for (int k = 0; k < kMostHeights; ++k) {
      const double force = wheel_.press(z), load = load_at(z), sunk = z - touching;
      one_.found.sunk = sunk;
      if (!(load > 0)) throw Refused(kTotalForce, "the rail's springs do not press it against the wheel");
      if (std::abs(force - load) <= tolerance() * load) return;
      if (force < load)
        low = std::max(low, z);
      else {
        high = z;
        bracketed = true;
      }
      double next = touching + (force > 0 ? sunk * std::pow(load / force, power(sunk, force)) : 2 * sunk);
      next = std::min(next, touching + 4 * sunk);
      if (bracketed && !(next > low && next < high)) next = 0.5 * (low + high);
      if (!bracketed && next <= low) next = low + 0.5 * sunk;
      if (std::abs(next - z) < 1e-13) return;
      z = next;
    }
    throw Refused(kTotalForce, fmt::format("no height of the wheelset was found for the vertical force {:g}",
                                           load_at(one_.wheelset.at[2])));
  }

  /// 1/n of F = k sunk^n through this height and the one before.
  double power(double sunk, double force) {
    double out = 2.0 / 3;
    if (last_force_ > 0 && force > 0 && force != last_force_ && sunk != last_sunk_)
      out = std::clamp(std::log(sunk / last_sunk_) / std::log(force / last_force_), 0.1, 1.5);
    last_sunk_ = sunk;
    last_force_ = force;
    return out;
  }

  ModuleOne& one_;
  const Problem& base_;
  const AtHeight& wheel_;
  double last_sunk_ = 0, last_force_ = 0;
};

}  // namespace

void balance(ModuleOne& one, const Problem& base, const AtHeight& wheel) { Balance(one, base, wheel).run(); }

}  // namespace railstrata::cntc
