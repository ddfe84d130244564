#include "fatigue/rail_damage.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "fatigue/wheel_damage.hpp"
#include "geometry/profile_names.hpp"

namespace railstrata {
namespace {

/// A patch on an arc of radius R under a cant: streamlines `width` wide along the tangent at the angle `at` from the
/// crown, each on the surface, wear 1 nm times its number.
PatchDamage patch_on_arc(const Profile& rail, const TrackGeometry& track, double s, double width, int lines) {
  PatchDamage out;
  const ProfilePoint p = rail.at(s);
  out.contact.rail_s = s;
  out.contact.point = rail_to_model(track, p.position);
  const Vec2 tangent = rail_to_model(track, p.position + p.tangent) - out.contact.point;
  out.contact.angle = std::atan2(tangent.z, tangent.y);
  for (int k = 0; k < lines; ++k) {
    StreamlineRow row;
    const double along = (k - 0.5 * (lines - 1)) * width;
    const double radius = 1 / p.curvature;
    const double drop = radius - std::sqrt(radius * radius - along * along);
    const Vec2 normal{-tangent.z, tangent.y};
    const Vec2 at = out.contact.point + along * tangent - drop * normal;
    row.y = at.y;
    row.z = at.z;
    row.width = width;
    row.usfd_depth = 1e-9 * (k + 1);
    row.friction_energy = 5;
    out.rows.push_back(row);
  }
  out.rcf_damage = 1e-5;
  return out;
}

}  // namespace

TEST(RailDamage, KeepsTheAreaOfTheStreamlinesOnACurvedHead) {
  const Profile rail = circular_profile(ProfileKind::rail, 0.080, 0.03);
  TrackGeometry track;
  for (const double s : {-0.012, 0.0, 0.0073}) {
    RailDamage damage = undamaged(rail, 0.25e-3);
    const PatchDamage patch = patch_on_arc(rail, track, s, 0.4e-3, 25);
    add_passages(damage, rail, track, patch, 1e5);
    EXPECT_NEAR(worn_area(damage, damage.usfd), 1e5 * 0.4e-3 * 1e-9 * 25 * 26 / 2, 1e-15);
    EXPECT_NEAR(worn_area(damage, damage.friction_energy), 1e5 * 0.4e-3 * 25 * 5, 1e-6);
  }
}

TEST(RailDamage, StandsWhereThePatchIsOnTheCantedRail) {
  const Profile rail = circular_profile(ProfileKind::rail, 0.080, 0.03);
  TrackGeometry track;
  track.cant = 0.1;
  const double s = 0.0073, width = 0.5e-3;
  RailDamage damage = undamaged(rail, 0.1e-3);
  add_passages(damage, rail, track, patch_on_arc(rail, track, s, width, 9), 2);
  double first = 0, last = 0, inside = 0;
  for (std::size_t i = 0; i < damage.s.size(); ++i) {
    if (damage.passages[i] <= 0) continue;
    if (first == 0) first = damage.s[i];
    last = damage.s[i];
    if (std::abs(damage.s[i] - s) < 3 * width) {
      inside += 1;
      EXPECT_NEAR(damage.passages[i], 2, 0.02) << "neighbouring strips leave no gap wider than their turn";
      EXPECT_NEAR(damage.rcf_damage[i], 2e-5, 2e-7);
    }
  }
  EXPECT_GT(inside, 20);
  EXPECT_NEAR(0.5 * (first + last), s, damage.cell);
  EXPECT_NEAR(last - first, 9 * width, 2 * damage.cell + 0.02 * 9 * width);
}

TEST(RailDamage, SaysNothingOfALawWithoutData) {
  const Profile rail = circular_profile(ProfileKind::rail, 0.080, 0.03);
  RailDamage damage = undamaged(rail, 0.25e-3);
  add_passages(damage, rail, {}, patch_on_arc(rail, {}, 0, 0.4e-3, 5), 1);
  EXPECT_TRUE(std::isnan(worn_area(damage, damage.archard)));
  EXPECT_TRUE(std::isfinite(worn_area(damage, damage.usfd)));
}

TEST(WheelDamage, LosesTheVolumeThatTheRailLoses) {
  const Profile rail = circular_profile(ProfileKind::rail, 0.300, 0.03),
                wheel = circular_profile(ProfileKind::wheel, -0.5, 0.03);
  PatchDamage patch = patch_on_arc(rail, {}, 0, 0.4e-3, 25);
  patch.contact.wheel_s = 0.004;
  patch.contact.rolling_radius = 0.46;
  for (StreamlineRow& row : patch.rows) row.wheel_usfd_depth = row.usfd_depth;  // one material
  RailDamage below = undamaged(rail, 0.25e-3);
  add_passages(below, rail, {}, patch, 1);
  WheelDamage turned = unworn_wheel(wheel, 0.25e-3);
  add_distance(turned, patch, 0.25);
  add_distance(turned, patch, 0.75);
  const double turn = 2 * std::numbers::pi * 0.46, drop = 0.005 * 0.005 / 0.6;
  EXPECT_NEAR(turn * worn_area(turned, turned.usfd) / worn_area(below, below.usfd), 1, drop / 0.46);
  EXPECT_TRUE(std::isnan(worn_area(turned, turned.kth))) << "no hardness";
  double first = 0, last = 0;
  for (std::size_t i = 0; i < turned.s.size(); ++i) {
    if (turned.share[i] <= 0) continue;
    EXPECT_LE(turned.share[i], 1 + 1e-9);
    if (first == 0) first = turned.s[i];
    last = turned.s[i];
  }
  EXPECT_NEAR(0.5 * (first + last), 0.004, turned.cell);
}

TEST(RailDamage, FindsTheNearestPoint) {
  const Profile rail = circular_profile(ProfileKind::rail, 0.080, 0.03);
  TrackGeometry track;
  const double angle = 0.2;
  const Vec2 outside = rail_to_model(track, {0.0805 * std::sin(angle), 0.0805 * std::cos(angle) - 0.080});
  EXPECT_NEAR(nearest_on_rail(rail, track, outside, 0.01), 0.080 * angle, 1e-9);
}

}  // namespace railstrata
