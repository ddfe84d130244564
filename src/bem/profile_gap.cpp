#include "bem/profile_gap.hpp"

#include <cmath>
#include <limits>

namespace railstrata {

namespace {

/// Height of a profile over the model frame's y.
struct RailCurve {
  const Profile& profile;
  const TrackGeometry& track;
  double floor, ceiling;  // y range in the model frame
  RailCurve(const Profile& p, const TrackGeometry& t) : profile(p), track(t) {
    floor = rail_to_model(t, p.at(p.s_at_y(p.y_min())).position).y;
    ceiling = rail_to_model(t, p.at(p.s_at_y(p.y_max())).position).y;
  }
  bool covers(double y) const { return y > floor && y < ceiling; }
  double z(double y) const {
    // the canted profile over y: rotate back at a height found by iteration
    double z = 0;
    for (int i = 0; i < 30; ++i) {
      const Vec2 in_profile = model_to_rail(track, {y, z});
      if (in_profile.y <= profile.y_min() || in_profile.y >= profile.y_max()) return std::numeric_limits<double>::quiet_NaN();
      const double step = rail_to_model(track, {in_profile.y, profile.height(in_profile.y)}).z - z;
      z += step;
      if (std::abs(step) < 1e-15) break;
    }
    return z;
  }
};

struct WheelCurve {
  const Profile& profile;
  const RigidContact& contact;
  bool covers(double y) const { return y - contact.wheel_offset_y > profile.y_min() && y - contact.wheel_offset_y < profile.y_max(); }
  double radius(double y) const { return contact.axle_height - contact.wheel_offset_z - profile.height(y - contact.wheel_offset_y); }
  double z(double y, double x) const {
    const double r = radius(y);
    return contact.axle_height - std::sqrt((r - x) * (r + x));
  }
};

/// Height above the contact plane, at the tangential coordinate t, of a curve z(y) in the section plane; NaN where the curve has ended.
template <class Curve>
double height_over_plane(Vec2 origin, Vec2 tangent, double t, double guess, const Curve& curve) {
  const Vec2 normal{-tangent.z, tangent.y}, foot = origin + t * tangent;
  double w = guess, previous_w = 0, previous_f = 0;
  for (int i = 0; i < 40; ++i) {
    const Vec2 p = foot + w * normal;
    const double f = p.z - curve(p.y);
    if (!(std::abs(f) > 1e-16)) break;
    const double slope = i > 0 && std::abs(w - previous_w) > 1e-14 ? (f - previous_f) / (w - previous_w) : normal.z;
    previous_w = w, previous_f = f;
    const double step = f / slope;
    w -= step;
    if (std::abs(step) < 1e-15) break;
  }
  return w;
}

}  // namespace

ProfileGap profile_gap(const Profile& wheel, const Profile& rail, const TrackGeometry& track, const RigidContact& contact, const PatchGrid& grid) {
  const RailCurve rail_curve(rail, track);
  const WheelCurve wheel_curve{wheel, contact};
  const Vec2 tangent{std::cos(contact.angle), std::sin(contact.angle)}, normal{-tangent.z, tangent.y};
  const double none = std::numeric_limits<double>::quiet_NaN();
  ProfileGap out{Plane(grid.size()), Plane(grid.size()), Plane(grid.size())};
  for_each_if(threads_pay_for(grid.size()), grid.ny, [&](int j) {
    const double t = grid.y(j);
    const double rail_w = height_over_plane(contact.point, tangent, t, 0, [&](double y) { return rail_curve.covers(y) ? rail_curve.z(y) : none; });
    for (int i = 0; i < grid.nx; ++i) {
      const double x = grid.x(i);
      const double wheel_w = height_over_plane(contact.point, tangent, t, 0, [&](double y) { return wheel_curve.covers(y) && std::abs(x) < wheel_curve.radius(y) ? wheel_curve.z(y, x) : none; });
      const double middle = 0.5 * (rail_w + wheel_w), gap = wheel_w - rail_w;
      const bool present = std::isfinite(gap);
      const std::size_t k = grid.index(i, j);
      out.gap[k] = present ? gap : ProfileGap::kNoSurface;
      out.rail_height[k] = std::isfinite(rail_w) ? rail_w : 0.0;
      const double z = (contact.point + t * tangent + (present ? middle : 0.0) * normal).z;
      out.radius[k] = std::hypot(x, contact.axle_height - z);
    }
  });
  return out;
}

}  // namespace railstrata
