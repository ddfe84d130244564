#include "bem/case_patch.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/wheelset.hpp"
#include "model/drive_at_contact.hpp"

namespace railstrata {
namespace {

/// Velocity over V of the wheel's surface at its contact point, by the motion of a rigid body: the axle goes along x,
/// the wheel turns about the yawed axle so that it does not slip along its own rolling direction's part of x.
Vec3 surface_velocity(const RigidContact& c, double on_wheel_y) {
  const double yaw = c.yaw;
  const Vec3 arm{c.x, on_wheel_y, -c.rolling_radius}, axis{-std::sin(yaw), std::cos(yaw), 0};
  const double turn = 1 / (c.rolling_radius * std::cos(yaw));
  return {1 + turn * (axis.y * arm.z - axis.z * arm.y), turn * (axis.z * arm.x - axis.x * arm.z),
          turn * (axis.x * arm.y - axis.y * arm.x)};
}

TEST(YawCreepage, IsTheVelocityOfTheRigidWheelAlongTheContactPlane) {
  for (const double shift : {0.0, 4e-3, 9.5e-3})
    for (const double yaw : {-0.01, 0.005}) {
      CaseSpec spec;
      spec.geometry.lateral_shift = shift;
      spec.geometry.yaw = yaw;
      const Placement placement = place(spec, {});
      const RigidContact& c = placement.contact;
      const Vec3 v = surface_velocity(c, c.point.y - c.wheel_offset_y);
      const double along_normal = v.z * std::cos(c.angle) - v.y * std::sin(c.angle),
                   along_tangent = v.y * std::cos(c.angle) + v.z * std::sin(c.angle);
      EXPECT_NEAR(v.x, 0, 1e-12);
      EXPECT_NEAR(along_normal, 0, 2e-4 * std::abs(yaw)) << "it does not move into the rail " << shift;
      EXPECT_NEAR(yaw_creepage(c) / along_tangent, 1, 1e-3) << shift << ' ' << yaw;
    }
}

// The lateral slip of a wheel that turns about its axle is its surface's velocity along the surface, at every place of
// a patch whose angle turns by some degrees (S1002 on UIC60 in the throat).
TEST(LocalSpin, IsTheVelocityOfTheWheelAlongTheSurfaceAtEachPlace) {
  CaseSpec spec;
  spec.geometry.rail_profile = "UIC60";
  spec.geometry.wheel_profile = "S1002";
  spec.geometry.wheel_radius = 0.46;
  spec.geometry.back_to_back = 1.36;
  spec.geometry.lateral_shift = 4e-3;
  const Placement placement = place(spec, {});
  const RigidContact& c = placement.contact;
  const PatchGrid grid = centred_grid(4, 24, 0.25e-3, 0.25e-3);
  const ProfileGap profile = profile_gap(placement.wheel, placement.rail, placement.track, c, grid);
  const Plane spin = local_spin(grid, profile, c);
  const auto height = [&](int j) {
    const std::size_t k = grid.index(4, j);
    return profile.rail_height[k] + 0.5 * profile.gap[k];
  };
  const double x = grid.x(8);
  double turns = 0;
  for (int j = 1; j + 1 < grid.ny; ++j) {
    const double angle = c.angle + std::atan2(height(j + 1) - height(j - 1), 2 * grid.dy);
    const Vec3 omega{0, 1 / c.rolling_radius, 0},
        arm{x, 0, 0};  // of the rolled distance; the rest does not depend on x
    const double up = omega.x * arm.y - omega.y * arm.x;
    EXPECT_NEAR(x * (wheel_spin(c) + spin[static_cast<std::size_t>(j)]), up * std::sin(angle), 1e-12);
    turns = std::max(turns, std::abs(angle - c.angle));
  }
  EXPECT_GT(turns, 0.03);
  EXPECT_NEAR(spin[24], 0, 1e-3 * std::abs(wheel_spin(c))) << "the rigid contact point has the patch's own";
}

// On tread and flange, in a curve: from one contact to the other, and from the wheel to both, as the velocities of the
// rigid wheelset are, but for products of creepages (1e-3 and r/r0 - 1 = 0.01) and the axle's turning by 1/r for V/r0.
TEST(CarryCreepages, FollowsTheVelocitiesOfARigidWheelset) {
  CaseSpec spec;
  spec.geometry.rail_profile = "UIC60";
  spec.geometry.wheel_profile = "S1002";
  spec.geometry.gauge_depth = 14e-3;
  spec.geometry.wheel_radius = 0.46;
  spec.geometry.back_to_back = 1.36;
  spec.geometry.cant = 0.025;
  const auto contact_at = [&](double shift) {
    spec.geometry.lateral_shift = shift;
    return place(spec, {}).contact;
  };
  const RigidContact tread = contact_at(3e-3);
  RigidContact flange = contact_at(6.5e-3);
  const double moved = flange.wheel_offset_y - tread.wheel_offset_y;  // as places of one wheel
  flange.point.y -= moved;
  flange.wheel_offset_y -= moved;
  ASSERT_LT(tread.angle, 0.1);
  ASSERT_GT(flange.angle, 0.4);
  constexpr double kSpeed = 20, kRadius = -800, kPitch = 0.05, kSideways = -0.02;  // m/s, m, rad/s, m/s
  const Placement placement = place(spec, {});
  const auto slip = [&](const RigidContact& c) {
    WheelsetMotion m{.speed = kSpeed, .yaw_rate = kSpeed / kRadius, .pitch_rate = kPitch};
    m.y_rate = kSideways;
    m.z_rate = kSideways * std::tan(c.angle);  // along the surface: it cannot move into the rail
    return slip_at(placement.track, c, m, {});
  };
  const WheelSlip from = slip(tread), to = slip(flange);
  RollingContact problem;
  problem.x.creepage = from.creepage_x;
  problem.y.creepage = from.creepage_y;
  carry_creepages(1 / kRadius, tread, flange, problem);
  EXPECT_NEAR(problem.x.creepage, to.creepage_x, 2e-5);
  EXPECT_NEAR(problem.y.creepage, to.creepage_y, 1e-12);
  EXPECT_NEAR(problem.spin, to.spin, 0.02 * std::abs(to.spin));

  spec.geometry.curve_radius = kRadius;
  spec.drive.creepage_of = CreepageOf::wheel;
  spec.drive.creepage =
      -(kPitch * spec.geometry.wheel_radius + kSpeed / kRadius * tape_circle_distance(placement.track)) / kSpeed;
  spec.drive.lateral_creepage = kSideways / kSpeed;
  for (const RigidContact& c : {tread, flange}) {
    const DriveSpec there = drive_at_contact(spec, c);
    EXPECT_EQ(there.creepage_of, CreepageOf::contact);
    EXPECT_NEAR(there.creepage.value(), slip(c).creepage_x, 2e-5);
    EXPECT_NEAR(there.lateral_creepage.value(), slip(c).creepage_y, 1e-12);
  }
  EXPECT_GT(std::abs(from.creepage_x - to.creepage_x), 1e-3);
}

TEST(DriveContact, GivesEachDirectionAForceOrACreepage) {
  CaseSpec spec;
  const RigidContact contact = place(spec, {}).contact;
  RollingContact problem;
  problem.friction = 0.5;
  drive_contact(spec, contact, 1e5, problem);
  EXPECT_EQ(problem.x.force, -2e4);
  EXPECT_FALSE(problem.y.force);
  EXPECT_EQ(problem.y.creepage, 0);
  spec.drive.creepage = -1e-3;
  spec.drive.lateral_traction_coefficient = 0.1;
  drive_contact(spec, contact, 1e5, problem);
  EXPECT_FALSE(problem.x.force);
  EXPECT_EQ(problem.x.creepage, -1e-3);
  EXPECT_EQ(problem.y.force, -1e4);
  problem.friction = 0;
  drive_contact(spec, contact, 1e5, problem);
  EXPECT_FALSE(problem.y.force) << "there is no force without friction";
}

}  // namespace
}  // namespace railstrata
