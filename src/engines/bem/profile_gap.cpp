#include "bem/profile_gap.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "geometry/profile_walk.hpp"
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
  double t, w, dt, dw;
  PlanePoint(const PlaneAxes& axes, Vec2 position, Vec2 along)
      : t(dot(position - axes.origin, axes.tangent)),
        w(dot(position - axes.origin, axes.normal)),
        dt(dot(along, axes.tangent)),
        dw(dot(along, axes.normal)) {}
};

/// Curves end where they have turned their back on the contact plane (steeper than 87 degrees to it).
constexpr double kFacing = 0.05, kWalkingStep = 0.05e-3;

/// The same by looking at every place in the section below the axle, up to `farthest` (m) from the contact.
template <class Curve>
double last_facing_place(const Curve& curve, double begin, int direction, double farthest) {
  const double last = direction > 0 ? curve.profile.s_max() : curve.profile.s_min();
  double s = begin;
  while ((last - s) * direction > kWalkingStep) {
    const PlanePoint next = curve.at(s + direction * kWalkingStep, 0);
    if (!(next.dt > kFacing)) break;
    s += direction * kWalkingStep;
    if (next.t * direction > farthest) break;
  }
  return s;
}

/// Up to where sections of a grid ask for the curve below the axle, m: half the grid's width, and |x| for a section
/// at x, which lies x tan(yaw) beside it.
double farthest_of(const PatchGrid& grid) {
  constexpr double kSpare = 1e-3;
  return std::max(std::abs(grid.y(0)), std::abs(grid.y(grid.ny - 1))) +
         std::max(std::abs(grid.x(0)), std::abs(grid.x(grid.nx - 1))) + kSpare;
}

/// The rail, cut at x from the contact point.
struct RailCurve {
  const Profile& profile;
  const TrackGeometry& track;
  const RigidContact& contact;
  PlaneAxes axes;
  PlanePoint at(double s, double x) const {
    const ProfilePoint p = profile.at(s);
    Vec2 position = rail_to_model(track, p.position), along = rail_to_model(track, p.tangent);
    if (turns()) {
      const double radius = track.rail_radius + position.z;
      position.z -= rail_drop(radius, contact.x + x);
      along.z *= radius / axle_depth(radius, contact.x + x);
    }
    return {axes, position, along};
  }
  bool turns() const { return contact.rail_turn != 0; }
  double end(double begin, int direction, double) const {
    return last_facing(profile, begin, direction * kWalkingStep, model_to_rail(track, axes.tangent), kFacing);
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
    return {axes,
            {contact.wheel_offset_y + across, contact.axle_height - below},
            {p.tangent.y / cosine, r / below * p.tangent.z + along / below * slope * p.tangent.y}};
  }
  double end(double begin, int direction, double farthest) const {
    return symmetric() ? last_facing(profile, begin, direction * kWalkingStep, axes.tangent, kFacing)
                       : last_facing_place(*this, begin, direction, farthest);
  }
  /// The same before and behind the axle.
  bool symmetric() const { return contact.yaw == 0 && contact.x == 0; }
};

/// The same of a wheel that has a roll too.
struct RolledWheelCurve {
  const Profile& profile;
  const RigidContact& contact;
  PlaneAxes axes;
  TurnedWheel wheel;
  PlanePoint at(double s, double x) const {
    const TurnedPoint p = wheel.cut(s, contact.x + x);
    return {axes, {contact.wheel_offset_y + p.position.y, contact.wheel_offset_z + p.position.z}, p.along};
  }
  double end(double begin, int direction, double farthest) const {
    return last_facing_place(*this, begin, direction, farthest);
  }
  bool symmetric() const { return false; }
};

struct Found {
  double s, w;
};

/// Height of a curve over the contact plane, point by point; the part of it around the contact that faces the plane.
template <class Curve>
class HeightOverPlane {
 public:
  HeightOverPlane(const Curve& curve, double contact_s, double farthest)
      : curve_(curve), low_(curve.end(contact_s, -1, farthest)), high_(curve.end(contact_s, 1, farthest)) {}

  /// At (x, t), by Newton's method kept inside the facing part; nothing where that has ended. guess: arc length to
  /// start from.
  std::optional<Found> at(double x, double t, double guess) const { return at(x, reach(x), t, guess); }
  /// Where at x the facing part begins and ends.
  struct Reach {
    double first, last;
  };
  Reach reach(double x) const { return {curve_.at(low_, x).t, curve_.at(high_, x).t}; }
  std::optional<Found> at(double x, const Reach& reach, double t, double guess) const {
    constexpr double kStraight = 1e-9;  // m: over which the curve is straight to the last digit
    double low = low_, high = high_, s = std::clamp(guess, low, high), w = 0;
    if (t < reach.first || t > reach.last) return {};
    for (int i = 0; i < 100; ++i) {
      const PlanePoint p = curve_.at(s, x);
      const double error = p.t - t, step = -error / p.dt;
      (error > 0 ? high : low) = s;
      const bool inside = s + step >= low && s + step <= high;
      if (inside && std::abs(step) < kStraight) return Found{s + step, p.w + p.dw * step};
      const double next = inside ? s + step : 0.5 * (low + high);
      w = p.w;
      if (std::abs(next - s) < 1e-15) break;
      s = next;
    }
    return Found{s, w};
  }

 private:
  const Curve& curve_;
  double low_, high_;
};

/// Arc lengths at three places beside one another, continued to a fourth.
class NextGuess {
 public:
  explicit NextGuess(double first) : s_{first, first, first} {}
  void add(double s) {
    s_[0] = count_ > 1 ? s_[1] : s;
    s_[1] = count_ > 0 ? s_[2] : s;
    s_[2] = s;
    ++count_;
  }
  double value() const { return count_ > 2 ? 3 * (s_[2] - s_[1]) + s_[0] : s_[2]; }

 private:
  double s_[3];
  int count_ = 0;
};

/// from_axle: distance of a point of the section plane (model frame) from the axle.
template <class WheelSection, class FromAxle>
ProfileGap gap_to(const WheelSection& wheel_curve, const Profile& rail, const TrackGeometry& track,
                  const RigidContact& contact, const PatchGrid& grid, FromAxle&& from_axle) {
  const PlaneAxes axes(contact);
  const RailCurve rail_curve{rail, track, contact, axes};
  const HeightOverPlane rail_height(rail_curve, contact.rail_s, farthest_of(grid));
  const HeightOverPlane wheel_height(wheel_curve, contact.wheel_s, farthest_of(grid));
  std::vector<typename HeightOverPlane<WheelSection>::Reach> reach;
  for (int i = 0; i < grid.nx; ++i) reach.push_back(wheel_height.reach(grid.x(i)));
  ProfileGap out{Plane(grid.size()), Plane(grid.size()), Plane(grid.size()), {}, {}};
  if (rail_curve.turns()) out.rail_radius.resize(grid.size());
  const bool mirrors = wheel_curve.symmetric() && std::abs(grid.x(0) + grid.x(grid.nx - 1)) < 1e-9 * grid.dx;
  for_each_if(threads_pay_for(grid.size()), grid.ny, [&](int j) {
    const double t = grid.y(j);
    const auto rail_under_axle = rail_height.at(0, t, contact.rail_s + t),
               under_axle = wheel_height.at(0, t, contact.wheel_s + t);
    NextGuess guess(under_axle ? under_axle->s : contact.wheel_s);
    for (int i = 0; i < grid.nx; ++i) {
      const double x = grid.x(i);
      const std::size_t k = grid.index(i, j), mirrored = grid.index(grid.nx - 1 - i, j);
      if (mirrors && mirrored < k) {
        for (Plane* plane : {&out.gap, &out.rail_height, &out.radius, &out.rail_radius})
          if (!plane->empty()) (*plane)[k] = (*plane)[mirrored];
        continue;
      }
      const auto on_wheel = under_axle ? wheel_height.at(x, reach[i], t, guess.value()) : under_axle;
      if (on_wheel) guess.add(on_wheel->s);
      const auto on_rail =
          rail_curve.turns() && rail_under_axle ? rail_height.at(x, t, rail_under_axle->s) : rail_under_axle;
      const bool present = on_rail && on_wheel;
      out.gap[k] = present ? on_wheel->w - on_rail->w : ProfileGap::kNoSurface;
      out.rail_height[k] = on_rail ? on_rail->w : 0.0;
      const double middle = present ? 0.5 * (on_rail->w + on_wheel->w) : 0.0;
      const Vec2 point = axes.origin + t * axes.tangent + middle * axes.normal;
      const double height = from_axle(point);
      out.radius[k] = std::sqrt(x * x + height * height);
      if (rail_curve.turns())
        out.rail_radius[k] = std::copysign(std::hypot(contact.x + x, track.rail_radius + point.z), track.rail_radius);
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

ProfileGap local_gap(const Profile& wheel, const Profile& rail, const TrackGeometry& track, const RigidContact& contact,
                     const PatchGrid& grid) {
  ProfileGap out{Plane(grid.size(), ProfileGap::kNoSurface), Plane(grid.size()), Plane(grid.size()), {}, {}};
  const auto within = [](const Profile& profile, double s) { return s > profile.s_min() && s < profile.s_max(); };
  for (int j = 0; j < grid.ny; ++j) {
    RigidContact here = contact;  // arcs of the two surfaces agree where the gap is small
    here.rail_s += grid.y(j);
    here.wheel_s += grid.y(j);
    const bool present = within(rail, here.rail_s) && within(wheel, here.wheel_s);
    if (present) {
      const ProfilePoint on_rail = rail.at(here.rail_s);
      const Vec2 of_rail = rail_to_model(track, on_rail.tangent), of_wheel = wheel.at(here.wheel_s).tangent;
      here.point = rail_to_model(track, on_rail.position);
      here.angle = 0.5 * (std::atan2(of_rail.z, of_rail.y) + std::atan2(of_wheel.z, of_wheel.y) + contact.roll);
    } else {
      here.point = out.rows.empty() ? contact.point : out.rows.back().point;
      here.angle = out.rows.empty() ? contact.angle : out.rows.back().angle;
    }
    out.rows.push_back({here.point, here.angle});
    if (!present) continue;
    PatchGrid row = grid;
    row.ny = 1;
    row.y0 = 0;
    const ProfileGap own = profile_gap(wheel, rail, track, here, row);
    for (int i = 0; i < grid.nx; ++i) {
      const auto from = static_cast<std::size_t>(i);
      const std::size_t to = grid.index(i, j);
      out.gap[to] = own.gap[from];
      out.rail_height[to] = own.rail_height[from];
      out.radius[to] = own.radius[from];
    }
  }
  return out;
}

}  // namespace railstrata
