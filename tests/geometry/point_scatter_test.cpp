#include "geometry/point_scatter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "geometry/profile_names.hpp"
#include "geometry/profile_scatter.hpp"
#include "geometry/profile_signs.hpp"

namespace railstrata {
namespace {

constexpr double um = 1e-6, mm = 1e-3;

std::vector<Vec2> points_of(const Profile& profile, double spacing) {
  std::vector<Vec2> out;
  for (double y = profile.y_min() + spacing; y < profile.y_max() - spacing; y += spacing)
    out.push_back({y, profile.height(y)});
  return out;
}

std::vector<Vec2> scattered(std::vector<Vec2> points, double deviation, unsigned seed) {
  std::mt19937 random(seed);
  for (Vec2& p : points) {
    double sum = -6;
    for (int i = 0; i < 12; ++i) sum += static_cast<double>(random()) / 4294967296.0;
    p.z += deviation * sum;
  }
  return points;
}

Profile turned(const Profile& rail, double slope) {
  std::vector<Vec2> points = points_of(rail, 0.2 * mm);
  const double angle = std::atan(slope);
  for (Vec2& p : points)
    p = {std::cos(angle) * p.y - std::sin(angle) * p.z, std::sin(angle) * p.y + std::cos(angle) * p.z};
  return Profile::from_points(ProfileKind::rail, "turned", points);
}

}  // namespace

TEST(PointScatter, TheLastDigitIsThatOfTheNumbersAndNoneOfExactOnes) {
  EXPECT_EQ(last_digit({13.62, 15.15, 16.42, 11.93, 10.77, 9.83, 9.04, 8.36}), 0.01);
  EXPECT_EQ(last_digit({0.1478001, 0.1709638, 0.1737064, 0.1747607, 0.1754602, 0.1758225, 0.1759553}), 1e-7);
  EXPECT_EQ(last_digit({0, 0, 0, 0, 0, 0, 0}), 0);
  EXPECT_EQ(last_digit({1, 2, 3, 4, 1, 2, 3}), 0);
  EXPECT_EQ(last_digit({std::sqrt(2), std::sqrt(3), std::sqrt(5)}), 0);
}

TEST(PointScatter, TheScatterIsFoundAtAnySpacing) {
  const Profile lma = builtin_profile(ProfileKind::wheel, "LMA");
  for (const double spacing : {0.1, 0.2, 0.4, 0.5, 0.7, 1.0})
    for (const double deviation : {2.0, 5.0, 10.0}) {
      const double found = scatter_of(scattered(points_of(lma, spacing * mm), deviation * um, 3)).noise;
      EXPECT_NEAR(found, deviation * um, 0.4 * deviation * um) << spacing;
    }
}

TEST(PointScatter, TheShapeOfAProfileIsNotTakenForScatter) {
  for (const auto& [kind, name] : {std::pair{ProfileKind::wheel, "LMA"}, std::pair{ProfileKind::wheel, "S1002"},
                                   std::pair{ProfileKind::rail, "CN60"}, std::pair{ProfileKind::rail, "UIC60"}})
    for (const double spacing : {0.1, 0.3, 0.5, 0.8, 1.0})
      EXPECT_LT(scatter_of(points_of(builtin_profile(kind, name), spacing * mm)).noise, 0.05 * um)
          << name << " every " << spacing << " mm";
}

TEST(PointScatter, StrayPointsAreFoundAndBendsAreNot) {
  const Profile rail = builtin_profile(ProfileKind::rail, "CN60");
  std::vector<Vec2> points = scattered(points_of(rail, 0.2 * mm), 3 * um, 5);
  EXPECT_TRUE(stray_points(points, scatter_of(points)).empty());
  points[100].z += 30 * um;
  points[200].z -= 60 * um;
  points[201].z -= 60 * um;
  const std::vector<StrayPoint> found = stray_points(points, scatter_of(points));
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0].index, 100u);
  EXPECT_NEAR(found[0].off, 30 * um, 12 * um);
  EXPECT_EQ(found[1].index, 200u);
  EXPECT_EQ(found[2].index, 201u);
  for (const char* name : {"CN60", "UIC60", "UIC54"})
    for (const double spacing : {0.1, 0.2, 0.5, 1.0}) {
      const std::vector<Vec2> exact = points_of(builtin_profile(ProfileKind::rail, name), spacing * mm);
      EXPECT_TRUE(stray_points(exact, scatter_of(exact)).empty()) << name << " every " << spacing << " mm";
    }
  std::vector<Vec2> kinked;
  for (int i = -100; i <= 100; ++i) kinked.push_back({0.2 * mm * i, i < 0 ? 0.0 : -0.02 * mm * i});
  EXPECT_TRUE(stray_points(kinked, scatter_of(kinked)).empty());
}

TEST(PointScatter, OtherFitsOfAListAreTheSameEachTimeAndThoseOfAnExactCurveAreItself) {
  const Profile rail = builtin_profile(ProfileKind::rail, "CN60");
  EXPECT_FALSE(leaves_open(rail));
  EXPECT_FALSE(leaves_open(builtin_profile(ProfileKind::wheel, "S1002")));
  const Profile scan = Profile::from_points(ProfileKind::rail, "scan", scattered(points_of(rail, 0.2 * mm), 3 * um, 7));
  ASSERT_TRUE(leaves_open(scan));
  for (const double y : {-10 * mm, 0.0, 7 * mm}) {
    EXPECT_EQ(other_fit(scan, 2).height(y), other_fit(scan, 2).height(y));
    EXPECT_NE(other_fit(scan, 2).height(y), other_fit(scan, 3).height(y));
    EXPECT_NEAR(other_fit(scan, 2).height(y), scan.height(y), 6 * um);
  }
}

TEST(ProfileSigns, AHeadTurnedByOneInFortyIsInclinedByThatAndAnUprightOneIsNot) {
  const Profile rail = builtin_profile(ProfileKind::rail, "CN60");
  EXPECT_NEAR(head_inclination(rail).value(), 0, 1e-9);
  EXPECT_NEAR(head_inclination(turned(rail, 0.025)).value(), 0.025, 1e-3);
  EXPECT_NEAR(head_inclination(turned(rail, -0.05)).value(), -0.05, 2e-3);
  EXPECT_TRUE(looks_laid(0.025) && looks_laid(-0.05) && !looks_laid(0.01) && !looks_laid(0.1));
}

TEST(ProfileSigns, TheMiddleOfAHeadAndTheBackOfAFlangeAreFound) {
  const Profile rail = builtin_profile(ProfileKind::rail, "CN60");
  EXPECT_NEAR(head_middle(rail).value(), 0, 0.1 * mm);
  std::vector<Vec2> points = points_of(rail, 0.1 * mm);
  for (Vec2& p : points) p.y += 3 * mm;
  EXPECT_NEAR(head_middle(Profile::from_points(ProfileKind::rail, "aside", points)).value(), 3 * mm, 0.1 * mm);
  EXPECT_NEAR(flange_back(builtin_profile(ProfileKind::wheel, "LMA")).value(), 70 * mm, 0.1 * mm);
}

}  // namespace railstrata
