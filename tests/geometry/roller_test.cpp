// A rail that is curved along rolling: a roller, a disc, a hollow rail.
#include <gtest/gtest.h>

#include <cmath>

#include "geometry/placement.hpp"
#include "geometry/profile_names.hpp"

namespace railstrata {
namespace {

constexpr double mm = 1e-3;

/// The point of least vertical gap between the two surfaces, point by point in the model frame.
struct Nearest {
  double gap = 1, x = 0, y = 0;
};
Nearest brute_force(const Profile& w, const Profile& r, const TrackGeometry& track, const RigidContact& c) {
  const double psi = std::atan(track.yaw), R = track.rail_radius;
  Nearest out;
  for (double s = c.wheel_s - 1.5 * mm; s < c.wheel_s + 1.5 * mm; s += 0.01 * mm)
    for (double along = c.x - 2 * mm; along < c.x + 2 * mm; along += 0.02 * mm) {
      const Vec2 p = w.at(s).position;
      const double radius = track.wheel_radius - p.z, z = c.axle_height - std::sqrt(radius * radius - along * along),
                   x = along * std::cos(psi) - p.y * std::sin(psi),
                   y = c.wheel_offset_y + along * std::sin(psi) + p.y * std::cos(psi);
      double rail_s = c.rail_s;  // where the canted rail has this y
      for (int i = 0; i < 30; ++i) {
        const ProfilePoint q = r.at(rail_s);
        rail_s += (y - rail_to_model(track, q.position).y) / rail_to_model(track, q.tangent).y;
      }
      const double top = rail_to_model(track, r.at(rail_s).position).z, turned = R + top,
                   rail_z = -R + std::copysign(std::sqrt(turned * turned - x * x), R), gap = z - rail_z;
      if (gap < out.gap) out = {gap, x, y};
    }
  return out;
}

TEST(Roller, AYawedWheelTouchesItWhereTheSurfacesAreNearest) {
  const Profile wheel = builtin_profile(ProfileKind::wheel, "S1002"),
                rail = builtin_profile(ProfileKind::rail, "UIC60");
  for (const double radius : {0.25, 0.6, -0.9})
    for (const double shift : {0.0, 6e-3}) {
      TrackGeometry track;
      track.yaw = 0.02;
      track.lateral_shift = -shift;
      track.rail_radius = radius;
      const RigidContact c = place_wheel(wheel, rail, track);
      const Nearest found = brute_force(wheel, rail, track, c);
      EXPECT_NEAR(found.gap, 0, 2e-9) << radius << shift;
      EXPECT_NEAR(found.x, c.x, 0.15 * mm) << radius << shift;
      EXPECT_NEAR(found.y, c.point.y, 0.15 * mm) << radius << shift;
      EXPECT_NEAR(c.rail_turn,
                  1 / std::copysign(std::sqrt(std::pow(radius + rail_to_model(track, rail.at(c.rail_s).position).z, 2) -
                                              c.x * c.x),
                                    radius),
                  1e-9);
      EXPECT_NEAR(c.curvature_rolling, std::cos(c.angle) * (1 / c.rolling_radius + c.rail_turn), 1e-12);
    }
}

TEST(Roller, OfALargeRadiusIsAStraightRail) {
  const Profile wheel = builtin_profile(ProfileKind::wheel, "LMA"), rail = builtin_profile(ProfileKind::rail, "CN60");
  TrackGeometry straight;
  straight.yaw = 0.01;
  straight.lateral_shift = 7e-3;
  TrackGeometry turned = straight;
  turned.rail_radius = 1e7;
  const RigidContact a = place_wheel(wheel, rail, straight), b = place_wheel(wheel, rail, turned);
  EXPECT_NEAR(b.x, a.x, 1e-8);
  EXPECT_NEAR(b.rail_s, a.rail_s, 1e-8);
  EXPECT_NEAR(b.wheel_offset_z, a.wheel_offset_z, 1e-11);
  EXPECT_NEAR(wheel_spin(b), wheel_spin(a), 1e-7);
}

// Wheel and roller turn against each other: their relative rotation V (1/r + 1/R) about y, seen along the normal.
TEST(Roller, AddsItsOwnRotationToTheSpin) {
  const Profile wheel = builtin_profile(ProfileKind::wheel, "S1002"),
                rail = builtin_profile(ProfileKind::rail, "UIC60");
  TrackGeometry track;
  track.lateral_shift = 6e-3;
  track.rail_radius = 0.5;
  const RigidContact c = place_wheel(wheel, rail, track);
  ASSERT_GT(std::abs(c.angle), 0.05);
  EXPECT_NEAR(wheel_spin(c), -std::sin(c.angle) * (1 / c.rolling_radius + c.rail_turn), 1e-12);
}

}  // namespace
}  // namespace railstrata
