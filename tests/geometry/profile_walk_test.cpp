#include "geometry/profile_walk.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "geometry/profile_names.hpp"

namespace railstrata {
namespace {

/// Exact curves, and one through points.
std::vector<Profile> all_profiles() {
  std::vector<Profile> out;
  for (const char* name : {"LMA", "S1002"}) out.push_back(builtin_profile(ProfileKind::wheel, name));
  for (const char* name : {"CN60", "UIC60"}) out.push_back(builtin_profile(ProfileKind::rail, name));
  std::vector<Vec2> points;
  for (double s = -0.03; s < 0.03; s += 1e-3) points.push_back(out[2].at(s).position);
  out.push_back(Profile::from_points(ProfileKind::rail, "points", points));
  return out;
}

/// What last_facing says, by looking at every place.
double last_facing_by_looking(const Profile& p, double begin, double step, Vec2 direction, double cosine) {
  const double end = step > 0 ? p.s_max() : p.s_min();
  int k = 0;
  while ((end - begin - k * step) / step > 1 && dot(p.at(begin + (k + 1) * step).tangent, direction) > cosine) ++k;
  return begin + k * step;
}

TEST(ProfileWalk, EvenPositionsAreThoseOfTheProfile) {
  for (const Profile& p : all_profiles()) {
    constexpr double step = 0.05e-3;
    const auto count = static_cast<std::size_t>((p.s_max() - p.s_min()) / step) + 1;
    const std::vector<Vec2> places = even_positions(p, p.s_min(), step, count);
    ASSERT_EQ(places.size(), count);
    for (std::size_t k = 0; k < count; ++k)
      EXPECT_LT(norm(places[k] - p.at(p.s_min() + static_cast<double>(k) * step).position), 2e-15) << p.name() << k;
    EXPECT_THROW(even_positions(p, p.s_min(), step, count + 2), std::out_of_range);
    EXPECT_TRUE(even_positions(p, 0, step, 0).empty());
  }
}

TEST(ProfileWalk, FacingEndsWhereALookAtEveryPlaceSaysIt) {
  constexpr double pi = std::numbers::pi;
  for (const Profile& p : all_profiles())
    for (const double begin : {-0.011, 0.0, 0.0123})
      for (const double step : {0.1e-3, -0.1e-3, 0.05e-3, -0.37e-3})
        for (const double angle : {-0.25 * pi, 0.0, 0.25 * pi, 0.9 * pi})
          for (const double cosine : {0.0, 0.05}) {
            const Vec2 direction{std::cos(angle), std::sin(angle)};
            EXPECT_NEAR(last_facing(p, begin, step, direction, cosine),
                        last_facing_by_looking(p, begin, step, direction, cosine), 1e-15)
                << p.name() << " from " << begin << " by " << step << " at " << angle;
          }
}

TEST(ProfileWalk, HeightsAndSlopesAreThoseOfTheProfileWhereverTheNextOneLies) {
  for (const Profile& p : all_profiles()) {
    RunningSurface surface(p);
    const double width = p.y_max() - p.y_min();
    for (int k = 0; k <= 4000; ++k) {
      const double share = k < 2000 ? k / 2000.0 : std::fmod(0.61803398875 * k, 1.0), y = p.y_min() + share * width;
      const double slope = place_on(p, y).slope, steep = 1 + std::min(std::abs(slope), 1e6);
      EXPECT_NEAR(surface.height(y), p.height(y), 1e-14 * steep) << p.name() << " at " << y;
      EXPECT_NEAR(std::atan(surface.place(y).slope), std::atan(slope), 1e-13 * steep) << p.name() << " at " << y;
    }
  }
}

}  // namespace
}  // namespace railstrata
