#include "geometry/profile_change.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/faults.hpp"
#include "geometry/profile_names.hpp"

namespace railstrata {
namespace {

constexpr double kFrom = -12e-3, kTo = 8e-3, kDepth = 0.4e-3;

/// A bump of the sine squared: its area over the stretch is half of depth times length.
double worn_at(double s) {
  if (s < kFrom || s > kTo) return 0;
  const double wave = std::sin(std::numbers::pi * (s - kFrom) / (kTo - kFrom));
  return kDepth * wave * wave;
}

/// The rail's head worn so along its normal, then turned and shifted.
Profile worn(const Profile& rail, double turn, Vec2 shift, double noise = 0) {
  std::vector<Vec2> points;
  int k = 0;
  for (double s = rail.s_min() + 1e-6; s < rail.s_max(); s += 0.2e-3, ++k) {
    const ProfilePoint p = rail.at(s);
    const double out = noise * std::sin(0.7 * k) - worn_at(s);
    const Vec2 at{p.position.y + out * p.outward.y, p.position.z + out * p.outward.z};
    points.push_back({std::cos(turn) * at.y - std::sin(turn) * at.z + shift.y,
                      std::sin(turn) * at.y + std::cos(turn) * at.z + shift.z});
  }
  return Profile::from_points(ProfileKind::rail, "worn", points);
}

Profile uic60() { return builtin_profile(ProfileKind::rail, "UIC60"); }

}  // namespace

TEST(ProfileChange, FindsTheWornAreaOfAMovedMeasurement) {
  const Profile rail = uic60();
  const double area = 0.5 * kDepth * (kTo - kFrom);
  for (const double turn : {0.0, 0.01}) {
    const ProfileChange found = profile_change(rail, worn(rail, turn, {turn > 0 ? 0.6e-3 : 0, turn > 0 ? -0.3e-3 : 0}),
                                               {{kFrom - 1e-3, kTo + 1e-3}});
    EXPECT_NEAR(found.area / area, 1, 0.02) << turn;  // a crown of 300 mm shortens its inner side by a thousandth
    EXPECT_NEAR(found.deepest, kDepth, 0.01e-3);
    EXPECT_NEAR(found.turn, -turn, 2e-4);
    EXPECT_LT(found.left, 3e-6);
  }
}

TEST(ProfileChange, OfARailThatDidNotWearIsNothing) {
  const ProfileChange found = profile_change(uic60(), worn(uic60(), 0, {0.2e-3, 0.1e-3}), {{20e-3, 30e-3}});
  EXPECT_LT(std::abs(found.area), 0.6 * kDepth * (kTo - kFrom)) << "the worn place itself was taken for unworn";
  const ProfileChange same = profile_change(uic60(), uic60(), {{kFrom, kTo}});
  EXPECT_NEAR(same.area, 0, 1e-12);
}

TEST(ProfileChange, AsksForUnwornMetal) {
  const Profile rail = uic60();
  EXPECT_THROW(profile_change(rail, rail, {{rail.s_min(), rail.s_max() - 5e-3}}), CaseError);
}

}  // namespace railstrata
