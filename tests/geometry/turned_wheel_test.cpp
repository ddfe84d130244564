#include "geometry/turned_wheel.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/profile_names.hpp"

namespace railstrata {
namespace {

constexpr double mm = 1e-3;

TrackGeometry rolled(double roll, double yaw = 0, double cant = 0) {
  TrackGeometry track;
  track.roll = roll;
  track.yaw = yaw;
  track.cant = cant;
  return track;
}

Profile cone(double slope) {
  return Profile::from_segments(ProfileKind::wheel, "cone",
                                {{{-60 * mm, -60 * mm * slope}, {60 * mm, 60 * mm * slope}, {}, 0}});
}

TEST(OutlineWalk, HasTheHeightsOfTheOutlineWhereverItGoes) {
  const Profile lma = builtin_profile(ProfileKind::wheel, "LMA");
  const TurnedWheel wheel(lma, rolled(0.005, 0.01));
  OutlineWalk walk(wheel);
  const auto looked_up = [&](double y) { return wheel.outline(wheel.s_at_y(y)).position.z; };
  for (double y = -25 * mm; y < 35 * mm; y += 0.05 * mm) EXPECT_NEAR(walk.height(y), looked_up(y), 1e-12) << y;
  for (const double y : {30 * mm, -20 * mm, -20 * mm, 5 * mm}) EXPECT_NEAR(walk.height(y), looked_up(y), 1e-12) << y;
}

// A cone touches a round head of radius R where the head is as steep as the cone with the roll: at -R sin(gamma + phi).
TEST(Roll, MovesAndTiltsTheContactOfAConeOnARoundHead) {
  const Profile head = builtin_profile(ProfileKind::rail, "arc:R=300 mm");
  for (const double slope : {0.0, 0.025, -0.05})
    for (const double roll : {0.01, -0.03}) {
      TrackGeometry track = rolled(roll);
      const Profile wheel = cone(slope);
      const double gamma = std::atan(slope), angle = gamma + std::atan(roll);
      // a cone has no flange: the gauge places it; here the contact itself defines its tape circle
      const RigidContact c = place_wheel(wheel, head, track);
      EXPECT_NEAR(c.angle, angle, 1e-8);
      EXPECT_NEAR(c.point.y, -300 * mm * std::sin(angle), 1e-8);
      EXPECT_NEAR(c.point.z, -300 * mm * (1 - std::cos(angle)), 1e-9);
      const double along = (c.point.y - c.wheel_offset_y) / std::cos(angle);
      EXPECT_NEAR(c.wheel_s, along, 1e-8);
      EXPECT_NEAR(c.rolling_radius, 430 * mm - along * std::sin(gamma), 1e-9);
      EXPECT_NEAR(c.curvature_rolling, std::cos(gamma) / c.rolling_radius, 1e-9);
      EXPECT_NEAR(c.roll, std::atan(roll), 1e-15);
    }
}

// Turned together, wheel and rail touch at the same places: a roll is the opposite cant.
TEST(Roll, OfTheWheelIsTheOppositeCantOfTheRailForTheContactItself) {
  for (const char* name : {"LMA", "S1002"}) {
    const Profile wheel = builtin_profile(ProfileKind::wheel, name), rail = builtin_profile(ProfileKind::rail, "UIC60");
    for (const double roll : {0.01, -0.02}) {
      const TrackGeometry track = rolled(roll, 0, 0.03);
      const RigidContact c = place_wheel(wheel, rail, track);
      const double phi = std::atan(roll);
      TrackGeometry canted = rolled(0, 0, std::tan(std::atan(0.03) - phi));
      const double y = c.wheel_offset_y * std::cos(phi) + c.wheel_offset_z * std::sin(phi),
                   z = c.wheel_offset_z * std::cos(phi) - c.wheel_offset_y * std::sin(phi);
      canted.lateral_shift = y - place_wheel(wheel, rail, canted).wheel_offset_y;
      const RigidContact other = place_wheel(wheel, rail, canted);
      EXPECT_NEAR(other.wheel_offset_y, y, 1e-12);
      EXPECT_NEAR(other.wheel_offset_z, z, 1e-9) << name << roll;
      EXPECT_NEAR(other.rail_s, c.rail_s, 2e-6) << name << roll;
      EXPECT_NEAR(other.wheel_s, c.wheel_s, 2e-6) << name << roll;
      EXPECT_NEAR(other.angle, c.angle - phi, 1e-5) << name << roll;
      EXPECT_NEAR(other.rolling_radius, c.rolling_radius, 1e-7) << name << roll;
    }
  }
}

/// Smallest vertical gap over the wheel's lower surface, turned point by point: about x by the roll, then about the
/// vertical by the yaw.
double brute_force_gap(const Profile& w, const Profile& r, const TrackGeometry& track, const RigidContact& c) {
  const double phi = std::atan(track.roll), psi = std::atan(track.yaw);
  double smallest = 1;
  for (double s = c.wheel_s - 3 * mm; s < c.wheel_s + 3 * mm; s += 0.03 * mm)
    for (double along = -12 * mm; along < 12 * mm; along += 0.1 * mm) {
      const Vec2 p = w.at(s).position;
      const double radius = track.wheel_radius - p.z,
                   up = track.wheel_radius - std::sqrt(radius * radius - along * along);
      const double y1 = p.y * std::cos(phi) - up * std::sin(phi),
                   z = p.y * std::sin(phi) + up * std::cos(phi) + c.wheel_offset_z;
      const double y = y1 * std::cos(psi) + along * std::sin(psi) + c.wheel_offset_y;
      double rail_s = c.rail_s + y - c.point.y;
      for (int i = 0; i < 4; ++i)
        rail_s -= (rail_to_model(track, r.at(rail_s).position).y - y) / rail_to_model(track, r.at(rail_s).tangent).y;
      smallest = std::min(smallest, z - rail_to_model(track, r.at(rail_s).position).z);
    }
  return smallest;
}

TEST(Roll, AWheelWithRollAndYawJustTouches) {
  const Profile lma = builtin_profile(ProfileKind::wheel, "LMA"), cn60 = builtin_profile(ProfileKind::rail, "CN60");
  for (const double shift : {1.5, 6.0})
    for (const double yaw : {0.0, 0.02}) {
      TrackGeometry track = rolled(0.02, yaw, 0.025);
      track.lateral_shift = shift * mm;
      const RigidContact c = place_wheel(lma, cn60, track);
      EXPECT_NEAR(brute_force_gap(lma, cn60, track, c), 0, 2e-7) << shift << ' ' << yaw;
      if (yaw == 0) {
        EXPECT_NEAR(c.x, 0, 1e-15);
      }
    }
}

// From one place to the next a walk follows the tangent, which may lead over the end of the profile.
TEST(Roll, AWalkToTheEndOfTheOutlineStaysOnTheProfile) {
  const Profile s1002 = builtin_profile(ProfileKind::wheel, "S1002");
  for (const double roll : {0.0, 4e-3, -0.02})
    for (const double yaw : {0.0, -9e-3, 0.02}) {
      const TrackGeometry track = rolled(roll, yaw, 0.025);
      const TurnedWheel wheel(s1002, track);
      for (const double step : {-0.7e-3, 0.7e-3}) {
        OutlineWalk walk(wheel);
        const double end = step > 0 ? wheel.y_end() : wheel.y_begin();
        for (int k = -20; k < 3; ++k) {
          const double y = end + (k + 0.3) * step;
          EXPECT_NEAR(walk.height(y), wheel.outline(wheel.s_at_y(y)).position.z, 1e-11);
        }
      }
    }
}

// A rigid wheel that turns about its axle: the point that touches moves along the contact plane, and by so much
// sideways that the creepage of roll and yaw is the opposite of lateral_motion.
TEST(Roll, VelocityAtTheContactIsTheLateralMotion) {
  const Profile lma = builtin_profile(ProfileKind::wheel, "LMA"), cn60 = builtin_profile(ProfileKind::rail, "CN60");
  for (const double roll : {0.0, 0.04})
    for (const double yaw : {0.02, -0.01}) {
      TrackGeometry track = rolled(roll, yaw, 0.025);
      track.lateral_shift = 7 * mm;
      const RigidContact c = place_wheel(lma, cn60, track);
      const double cr = std::cos(c.roll), sr = std::sin(c.roll), cy = std::cos(c.yaw), sy = std::sin(c.yaw),
                   R = track.wheel_radius;
      const Vec3 axle{-sy * cr, cy * cr, sr};
      const Vec3 centre{sy * R * sr, c.wheel_offset_y - cy * R * sr, c.wheel_offset_z + R * cr};
      const Vec3 arm = Vec3{c.x, c.point.y, c.point.z} - centre;
      const Vec3 turning{axle.y * arm.z - axle.z * arm.y, axle.z * arm.x - axle.x * arm.z,
                         axle.x * arm.y - axle.y * arm.x};
      const double rate = -1 / turning.x;  // over V: no slip along the rail
      EXPECT_NEAR(rate * (-std::sin(c.angle) * turning.y + std::cos(c.angle) * turning.z), 0, 1e-7);
      EXPECT_NEAR(rate * (std::cos(c.angle) * turning.y + std::sin(c.angle) * turning.z), -lateral_motion(c), 1e-7);
      EXPECT_NEAR(rate * c.rolling_radius, 1, 1e-3);
    }
}

// With hardly any roll the way through the turned wheel gives what the upright one has.
TEST(Roll, NoneIsTheLimitOfASmallOne) {
  const Profile lma = builtin_profile(ProfileKind::wheel, "LMA"), cn60 = builtin_profile(ProfileKind::rail, "CN60");
  for (const double yaw : {0.0, 0.02}) {
    TrackGeometry track = rolled(0, yaw, 0.025);
    track.lateral_shift = 6 * mm;
    const RigidContact upright = place_wheel(lma, cn60, track);
    track.roll = 1e-12;
    const RigidContact c = place_wheel(lma, cn60, track);
    EXPECT_NEAR(c.wheel_s, upright.wheel_s, 1e-8);
    EXPECT_NEAR(c.x, upright.x, 1e-8);
    EXPECT_NEAR(c.rolling_radius, upright.rolling_radius, 1e-9);
    EXPECT_NEAR(c.wheel_offset_z, upright.wheel_offset_z, 1e-10);
    EXPECT_NEAR(lateral_motion(c), std::tan(c.yaw) / std::cos(c.angle), 1e-9);
  }
}

}  // namespace
}  // namespace railstrata
