#include "bem/profile_gap.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "bem/case_patch.hpp"
#include "bem/normal_problem.hpp"
#include "geometry/profile_names.hpp"

namespace railstrata {
namespace {

const HalfSpaceMaterial kSteel{210e9, 0.3};

/// A wheel and a rail of one country, and shifts that bring the flange's root and its flank into contact.
struct Pair {
  const char *wheel_name, *rail_name;
  double root, flank;
  Profile wheel = builtin_profile(ProfileKind::wheel, wheel_name), rail = builtin_profile(ProfileKind::rail, rail_name);
};
const std::vector<Pair>& pairs() {
  static const std::vector<Pair> out{{"LMA", "CN60", 9e-3, 10e-3}, {"S1002", "UIC60", 6e-3, 7e-3}};
  return out;
}

TEST(ProfileGap, OfAPairTouchesAtTheOriginAndIsSymmetricInX) {
  for (const Pair& p : pairs()) {
    const TrackGeometry track;
    const PatchGrid g = centred_grid(20, 20, 0.5e-3, 0.5e-3);
    const ProfileGap gap = profile_gap(p.wheel, p.rail, track, place_wheel(p.wheel, p.rail, track), g);
    EXPECT_NEAR(gap.gap[g.index(20, 20)], 0, 1e-12) << p.wheel_name;
    for (double v : gap.gap) EXPECT_GT(v, -1e-12) << p.wheel_name;
    EXPECT_DOUBLE_EQ(gap.gap[g.index(3, 7)], gap.gap[g.index(37, 7)]) << p.wheel_name;
    // curvature along x: 1/(2 r)
    EXPECT_NEAR(gap.gap[g.index(40, 20)] / (0.01 * 0.01 / (2 * 0.43)), 1, 2e-3) << p.wheel_name;
  }
}

// Two arcs of radius R touching under the angle asin(shift/2R): along the normal of the contact plane their gap is 2 (R
// - sqrt(R² - t²)).
TEST(ProfileGap, OfTwoArcsIsThatOfTwoCirclesUnderAnyContactAngle) {
  const double R = 30e-3;
  const Profile wheel = circular_profile(ProfileKind::wheel, R), rail = circular_profile(ProfileKind::rail, R);
  for (double shift : {-35e-3, -20e-3, 0.0, 30e-3}) {
    TrackGeometry track;
    track.cant = 0;
    track.lateral_shift = shift;
    const RigidContact contact = place_wheel(wheel, rail, track);
    ASSERT_NEAR(std::sin(contact.angle), -shift / (2 * R), 1e-6);
    const PatchGrid g = centred_grid(4, 64, 0.5e-3, 0.5e-3);
    const ProfileGap gap = profile_gap(wheel, rail, track, contact, g);
    int compared = 0;
    for (int j = 0; j < g.ny; ++j) {
      const double t = std::abs(g.y(j)), found = gap.gap[g.index(4, j)];
      if (found == ProfileGap::kNoSurface) continue;
      EXPECT_NEAR(found, 2 * (R - std::sqrt(R * R - t * t)), 1e-9 + 1e-6 * t) << shift << ' ' << g.y(j);
      ++compared;
    }
    // the arcs reach 0.7 R to either side of their crowns: one ends on the left of the contact, the other on the right
    EXPECT_NEAR(compared, 2 * R * std::sin(std::asin(0.7) - std::abs(contact.angle)) / g.dy, 1.5) << shift;
    // the parallel circle of the wheel has the radius of the contact point; its plane is inclined by the contact angle
    EXPECT_NEAR(gap.gap[g.index(8, 64)] / (4e-6 * contact.curvature_rolling / 2), 1, 1e-3) << shift;
  }
}

TEST(ProfileGap, WhereAProfileEndsThereIsNoSurface) {
  for (const Pair& p : pairs())
    for (double shift : {p.root, p.flank}) {
      TrackGeometry track;
      track.lateral_shift = shift;
      const PatchGrid g = centred_grid(2, 120, 0.5e-3, 0.5e-3);
      const ProfileGap gap = profile_gap(p.wheel, p.rail, track, place_wheel(p.wheel, p.rail, track), g);
      EXPECT_EQ(gap.gap[g.index(2, 0)], ProfileGap::kNoSurface) << p.wheel_name;
      for (double v : gap.gap) ASSERT_GT(v, -1e-9) << p.wheel_name << ": the wheel was lowered until it touched";
    }
}

TEST(ProfileGap, OfABallDoesNotChangeWithItsYaw) {
  const double R = 0.4;
  const Profile wheel = circular_profile(ProfileKind::wheel, R), rail = circular_profile(ProfileKind::rail, 0.3);
  TrackGeometry track;
  track.cant = 0;
  track.wheel_radius = R;
  track.lateral_shift = 30e-3;
  const PatchGrid g = centred_grid(20, 20, 0.5e-3, 0.5e-3);
  const RigidContact straight = place_wheel(wheel, rail, track);
  ASSERT_GT(std::abs(straight.angle), 0.04);
  const ProfileGap before = profile_gap(wheel, rail, track, straight, g);
  track.yaw = 0.02;
  const ProfileGap after = profile_gap(wheel, rail, track, place_wheel(wheel, rail, track), g);
  for (std::size_t k = 0; k < g.size(); ++k) {
    EXPECT_NEAR(after.gap[k], before.gap[k], 1e-9 + 1e-5 * before.gap[k]);
    EXPECT_NEAR(after.radius[k], before.radius[k], 1e-9);
  }
}

// Wheel and rail turned together: a roll is the opposite cant, also for the gap and the radius rolled on.
TEST(ProfileGap, OfARolledWheelIsThatOnTheRailWithTheOppositeCant) {
  const Profile wheel = builtin_profile(ProfileKind::wheel, "S1002"),
                rail = builtin_profile(ProfileKind::rail, "UIC60");
  const double phi = 0.02;
  TrackGeometry rolled, canted;
  rolled.roll = std::tan(phi);
  rolled.cant = 0.03;
  canted.cant = std::tan(std::atan(0.03) - phi);
  const RigidContact c = place_wheel(wheel, rail, rolled);
  canted.lateral_shift = c.wheel_offset_y * std::cos(phi) + c.wheel_offset_z * std::sin(phi) -
                         place_wheel(wheel, rail, canted).wheel_offset_y;
  RigidContact other = place_wheel(wheel, rail, canted);
  EXPECT_NEAR(wheel_spin(other) / wheel_spin(c), 1, 1e-4);
  const PatchGrid g = centred_grid(12, 12, 0.5e-3, 0.5e-3);
  const ProfileGap one = profile_gap(wheel, rail, rolled, c, g), two = profile_gap(wheel, rail, canted, other, g);
  for (std::size_t k = 0; k < g.size(); ++k) {
    EXPECT_NEAR(one.gap[k], two.gap[k], 2e-8);
    EXPECT_NEAR(one.radius[k], two.radius[k], 2e-7);
  }
}

/// A point of the wheel's profile, turned about the axle by `turn`, by the roll about x and by the yaw about the
/// vertical.
struct TurnedPoint {
  double x;
  Vec2 at;
};
TurnedPoint turned_point(const Profile& wheel, const TrackGeometry& track, const RigidContact& c, double s,
                         double turn) {
  const Vec2 p = wheel.at(s).position;
  const double radius = track.wheel_radius - p.z, along = radius * std::sin(turn),
               up = track.wheel_radius - radius * std::cos(turn),
               across = p.y * std::cos(c.roll) - up * std::sin(c.roll);
  return {along * std::cos(c.yaw) - across * std::sin(c.yaw) - c.x,
          {c.wheel_offset_y + across * std::cos(c.yaw) + along * std::sin(c.yaw),
           c.wheel_offset_z + p.y * std::sin(c.roll) + up * std::cos(c.roll)}};
}

/// Points of the turned wheel over cells of the grid, which have their height above the rail's plane; their number.
int points_that_have_their_height(const Pair& pair, const TrackGeometry& track) {
  const RigidContact c = place_wheel(pair.wheel, pair.rail, track);
  const PatchGrid g = centred_grid(12, 12, 0.5e-3, 0.5e-3);
  const ProfileGap gap = profile_gap(pair.wheel, pair.rail, track, c, g);
  EXPECT_NEAR(gap.gap[g.index(12, 12)], 0, 1e-9) << pair.wheel_name;
  const Vec2 tangent{std::cos(c.angle), std::sin(c.angle)}, normal{-tangent.z, tangent.y};
  int met = 0;
  for (double s = c.wheel_s - 3e-3; s < c.wheel_s + 3e-3; s += 0.1e-3)
    for (double turn = -0.015; turn < 0.03; turn += 0.25e-3) {
      const TurnedPoint q = turned_point(pair.wheel, track, c, s, turn);
      const Vec2 d = q.at - c.point;
      const double i = (q.x - g.x0) / g.dx, j = (dot(d, tangent) - g.y0) / g.dy;
      if (std::abs(i - std::round(i)) > 0.02 || std::abs(j - std::round(j)) > 0.02) continue;
      if (i < 0 || j < 0 || i > g.nx - 1 || j > g.ny - 1) continue;
      const std::size_t k = g.index(static_cast<int>(std::round(i)), static_cast<int>(std::round(j)));
      // within a fiftieth of a cell, where the heights change by a few hundredths of it
      EXPECT_NEAR(gap.gap[k] + gap.rail_height[k], dot(d, normal), 2e-6) << pair.wheel_name;
      ++met;
    }
  return met;
}

TEST(ProfileGap, OfATurnedWheelIsItsHeightThere) {
  for (const Pair& pair : pairs())
    for (const auto& [shift, roll] : {std::pair(pair.root, 0.0), std::pair(pair.root - 3e-3, 0.03)}) {
      TrackGeometry track;
      track.lateral_shift = shift;
      track.yaw = 0.02;
      track.roll = roll;
      EXPECT_GT(points_that_have_their_height(pair, track), 3) << pair.wheel_name << ' ' << roll;
    }
}

// E = 210 GPa, nu = 0.3, 84.95 kN, wheel radius 430 mm. LMA: notes of the project, half-space solution of the exact
// profiles; S1002: cells of 0.125 mm.
TEST(ProfileGap, PeakPressureAtLateralShifts) {
  const SurfaceCompliance compliance =
      combined_compliance(homogeneous_compliance(kSteel), homogeneous_compliance(kSteel));
  struct Row {
    double shift, p_max;
  };
  const std::vector<Row> rows[] = {{{0, 1162e6}, {1e-3, 1112e6}, {1.5e-3, 1074e6}, {2e-3, 1023e6}},
                                   {{0, 1076e6}, {1e-3, 1016e6}, {2e-3, 941e6}, {3e-3, 825e6}}};
  for (std::size_t k = 0; k < pairs().size(); ++k)
    for (const Row& r : rows[k]) {
      const Pair& pair = pairs()[k];
      TrackGeometry track;
      track.lateral_shift = r.shift;
      const PatchGrid g = centred_grid(32, 64, 0.25e-3, 0.25e-3);
      const InfluenceOperator op(compliance, g.nx, g.ny, g.dx, g.dy);
      const RigidContact contact = place_wheel(pair.wheel, pair.rail, track);
      const NormalSolution s = solve_normal(op, g, profile_gap(pair.wheel, pair.rail, track, contact, g).gap,
                                            {.load = 8660 * 9.81, .approach = {}});
      EXPECT_FALSE(s.touches_edge) << pair.wheel_name << ' ' << r.shift;
      const double p_max = *std::max_element(s.pressure.begin(), s.pressure.end());
      EXPECT_NEAR(p_max / r.p_max, 1, 0.007) << pair.wheel_name << ' ' << r.shift;
    }
}

}  // namespace
}  // namespace railstrata
