#include "geometry/profile_change.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>

#include "core/faults.hpp"

namespace railstrata {
namespace {

class Alignment {
 public:
  Alignment(const Profile& before, const Profile& after, const std::vector<ProfileStretch>& worn) : after_(after) {
    for (double s = before.s_min() + 0.5 * kStep; s < before.s_max(); s += kStep) {
      const ProfilePoint p = before.at(s);
      const bool wears =
          std::any_of(worn.begin(), worn.end(), [&](const ProfileStretch& w) { return w.from <= s && s <= w.to; });
      samples_.push_back({p.position, p.outward, s, wears});
    }
  }

  void align() {
    constexpr int kMostSteps = 40;
    constexpr double kDone = 1e-10;
    for (int k = 0; k < kMostSteps; ++k) {
      sum_up();
      const Eigen::Vector3d step = normal_.ldlt().solve(-gradient_);
      if (!step.allFinite()) break;
      motion_.y += step[0];
      motion_.z += step[1];
      motion_.turn += step[2];
      if (std::abs(step[0]) + std::abs(step[1]) + kLeastAligned * std::abs(step[2]) < kDone) return;
    }
    throw CaseError("the second profile does not come onto the first",
                    "measure both in the same frame to some mm and degrees, or mirror one of them");
  }

  ProfileChange result() {
    sum_up();
    ProfileChange out{.shift_y = motion_.y, .shift_z = motion_.z, .turn = motion_.turn};
    out.length = static_cast<double>(outside_) * kStep;
    out.left = std::sqrt(squares_ / std::max(1.0, static_cast<double>(outside_ - 3)));
    Eigen::Vector3d area_by_motion = Eigen::Vector3d::Zero();
    double worn = 0;
    for (const Sample& sample : samples_) {
      const std::optional<Distance> d = sample.worn ? distance(sample) : std::nullopt;
      if (!d) continue;
      worn += kStep;
      out.area -= kStep * d->value;
      area_by_motion += kStep * d->by_motion;
      if (-d->value > out.deepest) {
        out.deepest = -d->value;
        out.deepest_y = sample.position.y;
      }
    }
    const double alike = kAlike / kStep;
    const double of_motion = alike * area_by_motion.dot(normal_.ldlt().solve(area_by_motion)),
                 of_stretch = worn * kAlike;
    out.area_error = out.left * std::sqrt(of_motion + of_stretch);
    return out;
  }

  double length_outside() {
    sum_up();
    return static_cast<double>(outside_) * kStep;
  }

 private:
  static constexpr double kStep = 0.25e-3;    // m, of the samples
  static constexpr double kAlike = 5e-3;      // m, over which errors are alike
  static constexpr double kFarthest = 20e-3;  // m, that a point of the second profile may lie away
  static constexpr double kMargin = 1e-3;     // m, kept from the ends of the second profile

  /// A motion in the plane: shift after a turn about the origin.
  struct Motion {
    double y = 0, z = 0, turn = 0;
    Vec2 back(Vec2 p) const {
      const double c = std::cos(turn), s = std::sin(turn), dy = p.y - y, dz = p.z - z;
      return {c * dy + s * dz, -s * dy + c * dz};
    }
    Vec2 turned(Vec2 v) const {
      const double c = std::cos(turn), s = std::sin(turn);
      return {c * v.y - s * v.z, s * v.y + c * v.z};
    }
  };

  struct Sample {
    Vec2 position, outward;
    double s = 0;
    bool worn = false;
  };

  /// How far the second profile lies outside a point of the first [m], and the derivatives by the motion; nothing where
  /// it has ended.
  struct Distance {
    double value = 0;
    Eigen::Vector3d by_motion;
  };

  std::optional<Distance> distance(const Sample& sample) const {
    const Vec2 point = motion_.back(sample.position);
    const double c = std::cos(motion_.turn), s = std::sin(motion_.turn);
    const Vec2 outward{c * sample.outward.y + s * sample.outward.z, -s * sample.outward.y + c * sample.outward.z};
    const Vec2 along{-outward.z, outward.y};
    constexpr int kMostSteps = 40;
    double at = std::clamp(sample.s, after_.s_min(), after_.s_max());
    for (int k = 0; k < kMostSteps; ++k) {
      const ProfilePoint p = after_.at(at);
      const double slope = dot(p.tangent, along);
      if (std::abs(slope) < 0.2) return std::nullopt;
      const double next = std::clamp(at - dot(p.position - point, along) / slope, after_.s_min(), after_.s_max());
      const bool there = std::abs(next - at) < 1e-10;
      at = next;
      if (there) break;
    }
    if (at < after_.s_min() + kMargin || at > after_.s_max() - kMargin) return std::nullopt;
    const ProfilePoint p = after_.at(at);
    if (std::abs(dot(p.position - point, along)) > 1e-7) return std::nullopt;
    const double value = dot(p.position - point, outward);
    if (std::abs(value) > kFarthest) return std::nullopt;
    // along the sample's normal the moved curve shifts by its own normal over the cosine between both
    const Vec2 normal = motion_.turned(p.outward), arm = motion_.turned(p.position);
    const double cosine = dot(normal, sample.outward);
    return Distance{value, Eigen::Vector3d(normal.y, normal.z, -normal.y * arm.z + normal.z * arm.y) / cosine};
  }

  void sum_up() {
    normal_.setZero();
    gradient_.setZero();
    squares_ = 0;
    outside_ = 0;
    for (const Sample& sample : samples_) {
      const std::optional<Distance> d = sample.worn ? std::nullopt : distance(sample);
      if (!d) continue;
      normal_ += d->by_motion * d->by_motion.transpose();
      gradient_ += d->value * d->by_motion;
      squares_ += d->value * d->value;
      ++outside_;
    }
  }

  const Profile& after_;
  std::vector<Sample> samples_;
  Motion motion_;
  Eigen::Matrix3d normal_ = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gradient_ = Eigen::Vector3d::Zero();
  double squares_ = 0;
  long outside_ = 0;
};

}  // namespace

ProfileChange profile_change(const Profile& before, const Profile& after, const std::vector<ProfileStretch>& worn) {
  Alignment change(before, after, worn);
  const double outside = change.length_outside();
  if (outside < kLeastAligned)
    throw CaseError(fmt::format("only {:.1f} mm of both profiles lie outside the worn stretch, {:.0f} mm are needed",
                                1e3 * outside, 1e3 * kLeastAligned),
                    "measure the rail down to where no wheel has run, at the field side and below the gauge corner");
  change.align();
  return change.result();
}

}  // namespace railstrata
