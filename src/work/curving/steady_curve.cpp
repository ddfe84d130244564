#include "curving/steady_curve.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "ask/wheelset_slopes.hpp"
#include "core/faults.hpp"
#include "many/each_case.hpp"
#include "tables/load_rows.hpp"

namespace railstrata {
namespace {

/// Of a wheelset y, yaw and pitch rate; of the frame y and yaw.
constexpr int kOfWheelset = 3, kFrame = 2 * kOfWheelset, kUnknowns = kFrame + 2;
using Posture = Eigen::Matrix<double, kUnknowns, 1>;
using Slope = Eigen::Matrix<double, kUnknowns, kUnknowns>;

/// A case of the contact of such wheels alone.
LoadedCase contact_of(const LoadedCase& loaded, const BogieSpec& bogie) {
  LoadedCase out = loaded;
  LoadSpec wheel;
  wheel.wheel_profile = bogie.wheel_profile;
  wheel.wheel_radius = bogie.wheel_radius;
  out.spec = with_load(loaded.spec, wheel);
  out.spec.drive.creepage.reset();
  out.spec.drive.lateral_creepage.reset();
  return out;
}

class CurvingBogie {
 public:
  CurvingBogie(const LoadedCase& loaded, const BogieSpec& bogie)
      : bogie_(bogie),
        speed_(bogie.speed.value_or(loaded.spec.drive.speed)),
        curve_(loaded.spec.collective.curve),
        model_(contact_of(loaded, bogie)),
        sets_{Wheelset(model_, model_), Wheelset(model_, model_)},
        base_(2 * tape_circle_distance(sets_[0].wheels[kLeft].at_rest)),
        radius_(model_.spec.geometry.wheel_radius) {
    for (Wheelset& set : sets_)
      for (Wheel& wheel : set.wheels) wheel.contact.set_cell(kCell);
  }

  /// The curve is entered by steps, each from the posture of the one before.
  BogieInCurve solve(const Control* control) {
    constexpr int kSteps = 4;
    BogieInCurve out;
    out.name = bogie_.title();
    Posture at = Posture::Zero();
    try {
      for (int i = 1; i <= kSteps; ++i) {
        into_ = static_cast<double>(i) / kSteps;
        out.iterations += settle(at, i == kSteps ? kClose : kOnTheWay, control);
      }
      for (std::size_t i : {0, 1}) {
        const WheelsetState state = state_of(i, at);
        const double both = radius_ * state.pitch_rate, apart = arm() * state.yaw_rate;
        out.wheelsets[i] = {state, forces_[i], {-(both + apart) / speed_, -(both - apart) / speed_}};
      }
    } catch (const std::exception& e) {
      out.fault = fault_line(e);
    }
    out.deficiency = outwards();
    out.frame_y = at[kFrame];
    out.frame_yaw = at[kFrame + 1];
    return out;
  }

 private:
  static constexpr double kCell = 1e-3;                     // m
  static constexpr double kClose = 1e-4, kOnTheWay = 0.01;  // of the load

  double bend() const { return into_ / *curve_.radius; }
  double tilt() const { return std::asin(into_ * curve_.superelevation / base_); }
  double outwards() const { return speed_ * speed_ * bend() * std::cos(tilt()) - kGravity * std::sin(tilt()); }
  /// Across the plane of the track, N.
  double load() const {
    return bogie_.axle_load * (std::cos(tilt()) + speed_ * speed_ * bend() / kGravity * std::sin(tilt()));
  }
  double place(std::size_t i) const { return (i == 0 ? 0.5 : -0.5) * bogie_.wheelbase; }

  WheelsetState state_of(std::size_t i, const Posture& at) const {
    WheelsetState s;
    const auto row = static_cast<Eigen::Index>(kOfWheelset * i);
    s.y = at[row];
    s.yaw = at[row + 1];
    s.pitch_rate = at[row + 2];
    s.speed = speed_;
    s.yaw_rate = -speed_ * bend();
    s.load = load();
    s.roll_moment =
        -(bogie_.axle_load / kGravity - bogie_.wheelset_mass) * outwards() * (bogie_.centre_of_gravity - radius_);
    return s;
  }

  /// What is left of the equations, moments over lengths: N.
  Posture lacking(const Posture& at) const {
    const double mass = bogie_.axle_load / kGravity, push = outwards();
    const double sideways = 2 * bogie_.lateral,
                 turning = 0.5 * bogie_.longitudinal * bogie_.box_distance * bogie_.box_distance;
    Posture out = Posture::Zero();
    double& side = out[kFrame] = 2 * (mass - bogie_.wheelset_mass) * push;
    double& turn = out[kFrame + 1];
    for (std::size_t i : {0, 1}) {
      const auto row = static_cast<Eigen::Index>(kOfWheelset * i);
      const double x = place(i);
      const double spring = sideways * (at[row] - 0.5 * bend() * x * x - at[kFrame] - x * at[kFrame + 1]);
      const double yaw = turning * (at[row + 1] - bend() * x - at[kFrame + 1]);
      out[row] = forces_[i].force.y - spring + bogie_.wheelset_mass * push;
      out[row + 1] = (forces_[i].moment.z - yaw) / arm();
      out[row + 2] = forces_[i].moment.y / radius_ + bogie_.traction_coefficient * bogie_.axle_load;
      side += spring;
      turn += (yaw + x * spring) / arm();
    }
    return out;
  }
  double arm() const { return 0.5 * base_; }

  void press(const Posture& at) {
    for (std::size_t i : {0, 1}) forces_[i] = railstrata::solve(sets_[i], state_of(i, at));
  }

  /// Derivatives of what is left; those of the springs by their own differences, for they are linear.
  Slope slope(const Posture& at) {
    static const std::vector<WheelsetInput> inputs{wheelset_input("y"), wheelset_input("yaw"),
                                                   wheelset_input("pitch_rate")};
    Slope out;
    const Posture here = lacking(at);
    for (Eigen::Index k = 0; k < kUnknowns; ++k) out.col(k) = lacking(at + Posture::Unit(k)) - here;
    for (std::size_t i : {0, 1}) {
      const auto row = static_cast<Eigen::Index>(kOfWheelset * i);
      const std::vector<WheelsetSlopes> of = slopes(sets_[i], inputs);
      for (Eigen::Index k = 0; k < kOfWheelset; ++k) {
        const WheelsetSlopes& s = of[static_cast<std::size_t>(k)];
        out(row, row + k) += s.force.y;
        out(row + 1, row + k) += s.moment.z / arm();
        out(row + 2, row + k) += s.moment.y / radius_;
      }
    }
    return out;
  }

  /// Newton's method with steps that are shortened until less is left. Returns the iterations. Throws NumericalError.
  int settle(Posture& at, double close, const Control* control) {
    constexpr int kMost = 40, kShorter = 6, kStuck = 3;
    constexpr double kShift = 1e-3, kYaw = 2e-3;  // m, rad: the longest step
    press(at);
    int stuck = 0;  // steps after which no less was left
    for (int n = 0; n < kMost && stuck < kStuck; ++n) {
      if (asked_to_stop(control)) throw NumericalError("stopped");
      const Posture left = lacking(at);
      if (left.lpNorm<Eigen::Infinity>() <= close * bogie_.axle_load) return n;
      const Posture step = -slope(at).partialPivLu().solve(left);
      double share = 1;
      for (std::size_t i : {0, 1}) {
        const auto row = static_cast<Eigen::Index>(kOfWheelset * i);
        share = std::min({share, kShift / std::abs(step[row]), kYaw / std::abs(step[row + 1])});
      }
      Posture next = at + share * step;
      press(next);
      int k = 0;
      for (; k < kShorter && lacking(next).norm() >= left.norm(); ++k) {
        next = at + (share *= 0.5) * step;
        press(next);
      }
      stuck += k == kShorter ? 1 : 0;
      at = next;
    }
    throw NumericalError(
        fmt::format("between flange and friction no equilibrium was found: the nearest state lacks {:.3g} N",
                    lacking(at).lpNorm<Eigen::Infinity>()));
  }

  BogieSpec bogie_;
  double speed_;
  CurveSpec curve_;
  LoadedCase model_;
  std::array<Wheelset, 2> sets_;
  double base_, radius_;
  double into_ = 0;  ///< of the curvature and of the superelevation
  std::array<WheelsetForces, 2> forces_;
};

/// A wheel as the left one of its track: y to its field side.
LoadSpec load_of(const CaseSpec& spec, const BogieSpec& bogie, const BogieInCurve& found, std::size_t which) {
  const WheelsetInCurve& set = found.wheelsets[which];
  const bool outer = spec.collective.curve.rail == CurveRail::outer;
  const double side = outer ? 1 : -1;
  const WheelForces& wheel = set.forces.wheels[outer ? kLeft : kRight];
  LoadSpec out;
  const double radius = bogie.wheel_radius.value_or(spec.geometry.wheel_radius);
  out.name = fmt::format("{}, {}", found.name, which == 0 ? "leading" : "trailing");
  out.axle_weight = bogie.axle_load;
  out.passages = 1e6 * 0.5 * bogie.mgt.value_or(0) / out.tonnes(0);
  out.wheel_profile = bogie.wheel_profile;
  out.wheel_radius = bogie.wheel_radius;
  out.wheel_load = wheel.force.z;
  out.lateral_shift = side * (set.state.y + radius * set.forces.roll);
  out.yaw = side * std::tan(set.state.yaw);
  out.roll = side * std::tan(set.forces.roll);
  out.curve_radius = -side * *spec.collective.curve.radius;
  out.speed = set.state.speed;
  out.creepage = set.creepage[outer ? kLeft : kRight];
  out.lateral_creepage = -side * set.state.yaw;
  out.guiding_force = -side * wheel.force.y;
  out.friction_energy = wheel.dissipation / set.state.speed;
  return out;
}

}  // namespace

std::vector<BogieInCurve> solve_curve(const LoadedCase& loaded, const Control* control) {
  const std::vector<BogieSpec>& bogies = loaded.spec.collective.curve.bogies;
  std::vector<BogieInCurve> out(bogies.size());
  std::size_t done = 0;
  for_each_completed(bogies.size(), control, [&](std::size_t i) {
    out[i] = CurvingBogie(loaded, bogies[i]).solve(control);
    return [&] {
      if (control) control->progress("curve", static_cast<double>(++done) / static_cast<double>(bogies.size()));
    };
  });
  return out;
}

void require_equilibrium(const std::vector<BogieInCurve>& found) {
  if (std::all_of(found.begin(), found.end(), [](const BogieInCurve& b) { return !b.fault.empty(); }))
    throw CaseError(fmt::format("no bogie has an equilibrium in the curve: {}", found.empty() ? "" : found[0].fault),
                    "check curve.radius, curve.superelevation and the speed");
}

LoadedCase with_curve_loads(const LoadedCase& loaded, const std::vector<BogieInCurve>& found) {
  if (loaded.spec.collective.curve.rail == CurveRail::both)
    throw CaseError("curve.rail = \"both\": a collective is of one rail", "give curve.rail = \"outer\" or \"inner\"");
  require_equilibrium(found);
  LoadedCase out = loaded;
  out.spec.loads.clear();
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (!found[i].fault.empty()) continue;
    for (std::size_t which : {0, 1})
      out.spec.loads.push_back(load_of(loaded.spec, loaded.spec.collective.curve.bogies[i], found[i], which));
  }
  out.spec.drive.creepage_of = CreepageOf::wheel;
  return out;
}

}  // namespace railstrata
