#include "bem/profile_gap.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "geometry/turned_wheel.hpp"

namespace railstrata {

namespace {

/// Axes of the contact plane: t along the common tangent, w along the normal from the rail to the wheel.
struct PlaneAxes {
  Vec2 origin, tangent, normal;
  explicit PlaneAxes(const RigidContact& c)
      : origin(c.point), tangent{std::cos(c.angle), std::sin(c.angle)}, normal{-tangent.z, tangent.y} {}
};

/// A point of a section curve and its derivative along the profile's arc length, in the contact plane's axes.
struct PlanePoint {
  double t, w, dt;
};

struct RailCurve {
  const Profile& profile;
  const TrackGeometry& track;
  PlaneAxes axes;
  PlanePoint at(double s, double) const {
    const ProfilePoint p = profile.at(s);
    const Vec2 d = rail_to_model(track, p.position) - axes.origin;
    return {dot(d, axes.tangent), dot(d, axes.normal), dot(rail_to_model(track, p.tangent), axes.tangent)};
  }
};

/// The wheel cut at x from the contact point: every point of the profile moves on its circle about the axle, which is
/// turned by the yaw.
struct WheelCurve {
  const Profile& profile;
  const RigidContact& contact;
  PlaneAxes axes;
  double sine = std::sin(contact.yaw), cosine = std::cos(contact.yaw), slope = std::tan(contact.yaw);
  PlanePoint at(double s, double x) const {
    const ProfilePoint p = profile.at(s);
    const double along = (contact.x + x + p.position.y * sine) / cosine,  // in the wheel's own frame
        across = p.position.y * cosine + along * sine;
    const double r = contact.axle_height - contact.wheel_offset_z - p.position.z,
                 below = std::sqrt(std::max(0.0, (r - along) * (r + along)));
    const Vec2 d = Vec2{contact.wheel_offset_y + across, contact.axle_height - below} - axes.origin;
    return {dot(d, axes.tangent), dot(d, axes.normal),
            p.tangent.y / cosine * axes.tangent.y +
                (r / below * p.tangent.z + along / below * slope * p.tangent.y) * axes.tangent.z};
  }
};

/// The same of a wheel that has a roll too.
struct RolledWheelCurve {
  const Profile& profile;
  const RigidContact& contact;
  PlaneAxes axes;
  TurnedWheel wheel;
  PlanePoint at(double s, double x) const {
    const TurnedPoint p = wheel.cut(s, contact.x + x);
    const Vec2 d = Vec2{contact.wheel_offset_y + p.position.y, contact.wheel_offset_z + p.position.z} - axes.origin;
    return {dot(d, axes.tangent), dot(d, axes.normal), dot(p.along, axes.tangent)};
  }
};

struct Found {
  double s, w;
};

/// Height of a curve over the contact plane, point by point; the part of it around the contact that faces the plane.
template <class Curve>
class HeightOverPlane {
 public:
  HeightOverPlane(const Curve& curve, double contact_s)
      : curve_(curve), contact_s_(contact_s), low_(end(-1)), high_(end(1)) {}

  /// At (x, t), by Newton's method kept inside the facing part; nothing where that has ended. guess: arc length to
  /// start from.
  std::optional<Found> at(double x, double t, double guess) const { return at(x, reach(x), t, guess); }
  /// Where at x the facing part begins and ends.
  struct Reach {
    double first, last;
  };
  Reach reach(double x) const { return {curve_.at(low_, x).t, curve_.at(high_, x).t}; }
  std::optional<Found> at(double x, const Reach& reach, double t, double guess) const {
    double low = low_, high = high_, s = std::clamp(guess, low, high);
    if (t < reach.first || t > reach.last) return {};
    PlanePoint p{};
    for (int i = 0; i < 100; ++i) {
      p = curve_.at(s, x);
      const double error = p.t - t;
      (error > 0 ? high : low) = s;
      double next = s - error / p.dt;
      if (!(next >= low && next <= high)) next = 0.5 * (low + high);
      if (std::abs(next - s) < 1e-15) break;
      s = next;
    }
    return Found{s, p.w};
  }

 private:
  /// Where, walking away from the contact, the curve has turned its back on the plane (steeper than 87 degrees to it).
  double end(int direction) const {
    constexpr double kStep = 0.05e-3, kFacing = 0.05;
    const double last = direction > 0 ? curve_.profile.s_max() : curve_.profile.s_min();
    double s = contact_s_;
    while ((last - s) * direction > kStep && curve_.at(s + direction * kStep, 0).dt > kFacing) s += direction * kStep;
    return s;
  }
  const Curve& curve_;
  double contact_s_, low_, high_;
};

/// from_axle: distance of a point of the section plane (model frame) from the axle.
template <class WheelSection, class FromAxle>
ProfileGap gap_to(const WheelSection& wheel_curve, const Profile& rail, const TrackGeometry& track,
                  const RigidContact& contact, const PatchGrid& grid, FromAxle&& from_axle) {
  const PlaneAxes axes(contact);
  const RailCurve rail_curve{rail, track, axes};
  const HeightOverPlane rail_height(rail_curve, contact.rail_s);
  const HeightOverPlane wheel_height(wheel_curve, contact.wheel_s);
  std::vector<typename HeightOverPlane<WheelSection>::Reach> reach;
  for (int i = 0; i < grid.nx; ++i) reach.push_back(wheel_height.reach(grid.x(i)));
  ProfileGap out{Plane(grid.size()), Plane(grid.size()), Plane(grid.size())};
  for_each_if(threads_pay_for(grid.size()), grid.ny, [&](int j) {
    const double t = grid.y(j);
    const auto on_rail = rail_height.at(0, t, contact.rail_s + t),
               under_axle = wheel_height.at(0, t, contact.wheel_s + t);
    for (int i = 0; i < grid.nx; ++i) {
      const double x = grid.x(i);
      const auto on_wheel = under_axle ? wheel_height.at(x, reach[i], t, under_axle->s) : under_axle;
      const std::size_t k = grid.index(i, j);
      const bool present = on_rail && on_wheel;
      out.gap[k] = present ? on_wheel->w - on_rail->w : ProfileGap::kNoSurface;
      out.rail_height[k] = on_rail ? on_rail->w : 0.0;
      const double middle = present ? 0.5 * (on_rail->w + on_wheel->w) : 0.0;
      out.radius[k] = std::hypot(x, from_axle(axes.origin + t * axes.tangent + middle * axes.normal));
    }
  });
  return out;
}

}  // namespace

ProfileGap profile_gap(const Profile& wheel, const Profile& rail, const TrackGeometry& track,
                       const RigidContact& contact, const PatchGrid& grid) {
  const PlaneAxes axes(contact);
  if (contact.roll == 0)
    return gap_to(WheelCurve{.profile = wheel, .contact = contact, .axes = axes}, rail, track, contact, grid,
                  [&](Vec2 point) { return contact.axle_height - point.z; });
  const RolledWheelCurve rolled{wheel, contact, axes, TurnedWheel(wheel, track)};
  return gap_to(rolled, rail, track, contact, grid, [&](Vec2 point) {
    return rolled.wheel.from_axle({point.y - contact.wheel_offset_y, point.z - contact.wheel_offset_z});
  });
}

}  // namespace railstrata
