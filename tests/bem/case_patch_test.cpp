#include "bem/case_patch.hpp"

#include <gtest/gtest.h>

#include <cmath>

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
