#include "damage/enclosing_ball.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace railstrata {
namespace {

using Points = std::vector<Vec5>;

double squared_distance(const Vec5& p, const Vec5& c) {
  double sum = 0;
  for (int d = 0; d < 5; ++d) sum += (p[d] - c[d]) * (p[d] - c[d]);
  return sum;
}

/// Optimal for certain (a convex problem): every point inside, the supports on the sphere, the centre their mean with
/// weights that are positive and add up to 1.
void expect_optimal(const Points& points, FreeDirections free, double tolerance) {
  const EnclosingBall ball = enclosing_ball(points, free);
  const double r2 = ball.radius * ball.radius;
  double scale = r2;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double d2 = squared_distance(points[i], ball.centre);
    EXPECT_LE(d2, r2 * (1 + 1e-14));
    scale = std::max(scale, squared_distance(points[i], points[0]));
  }
  ASSERT_GT(ball.support_count, 0);
  Vec5 mean{};
  double weights = 0;
  for (int s = 0; s < ball.support_count; ++s) {
    const int i = ball.support[s];
    EXPECT_GT(ball.weight[s], 0);
    weights += ball.weight[s];
    EXPECT_NEAR(squared_distance(points[i], ball.centre), r2, tolerance * scale);
    for (int d = 0; d < 5; ++d) mean[d] += ball.weight[s] * points[i][d];
  }
  EXPECT_NEAR(weights, 1, 1e-12);
  for (int d = 0; d < 5; ++d) {
    const bool moves = free >> d & 1U;
    EXPECT_NEAR(ball.centre[d], moves ? mean[d] : 0., moves ? tolerance * std::sqrt(scale) : 0.);
  }
}

TEST(EnclosingBall, NoPointOnePointAndRepeatedPoints) {
  EXPECT_EQ(enclosing_ball({}).radius, 0);
  EXPECT_EQ(enclosing_ball({}).support_count, 0);
  const Vec5 p{1, -2, 3, 4, 5};
  for (const std::size_t n : {1U, 2U, 9U}) {
    const EnclosingBall ball = enclosing_ball(Points(n, p));
    EXPECT_EQ(ball.radius, 0);
    EXPECT_EQ(ball.centre, p);
    EXPECT_EQ(ball.support_count, 1);
  }
  // Free in u1 and u2: what is left is the length of the other three.
  EXPECT_NEAR(enclosing_ball(Points(3, p), free_directions(0, 1)).radius, std::sqrt(9. + 16 + 25), 1e-15);
  EXPECT_NEAR(enclosing_ball(Points(3, p), free_directions()).radius, std::sqrt(55.), 1e-15);
}

TEST(EnclosingBall, CollinearPointsTakeTheirEnds) {
  Points points;
  for (const double t : {0.3, -1., 0.2, 2., 0.5, 1.99}) points.push_back({t, 2 * t, -t, 0.5 * t, 1 + t});
  const EnclosingBall ball = enclosing_ball(points);
  EXPECT_NEAR(ball.radius, 1.5 * std::sqrt(7.25), 1e-14);
  EXPECT_NEAR(ball.centre[4], 1.5, 1e-14);
  EXPECT_EQ(ball.support_count, 2);
}

TEST(EnclosingBall, RegularSimplexCubeAndObtuseTriangle) {
  // Unit vectors: circumradius sqrt((n - 1)/n) about the mean.
  Points simplex(5, Vec5{});
  for (std::size_t d = 0; d < 5; ++d) simplex[d][d] = 1;
  EXPECT_NEAR(enclosing_ball(simplex).radius, std::sqrt(0.8), 1e-15);
  Points cube;
  for (unsigned corner = 0; corner < 32; ++corner) {
    Vec5 p{};
    for (unsigned d = 0; d < 5; ++d) p[d] = (corner >> d & 1U) ? 3 : 1;
    cube.push_back(p);
  }
  EXPECT_NEAR(enclosing_ball(cube).radius, std::sqrt(5.), 1e-14);
  EXPECT_NEAR(enclosing_ball(cube, free_directions(1, 3)).radius, std::sqrt(2. + 27), 1e-14);
  // Obtuse: the longest side; acute (3-4-5 halved is right-angled): circumradius a b c / 4 A.
  EXPECT_NEAR(enclosing_ball(Points{{0, 0}, {4, 0}, {1, 0.5}}).radius, 2, 1e-15);
  EXPECT_NEAR(enclosing_ball(Points{{0, 0}, {4, 0}, {1, 3}}).radius, 4 * std::sqrt(10.) * std::sqrt(18.) / 24, 1e-14);
}

TEST(EnclosingBall, IsOptimalForCloudsCurvesAndEveryChoiceOfDirections) {
  std::mt19937 draw(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (FreeDirections free = 0; free <= kAllFree; ++free)
    for (const int n : {2, 3, 6, 40, 1000}) {
      Points points(static_cast<std::size_t>(n));
      for (Vec5& p : points)
        for (double& x : p) x = uniform(draw);
      expect_optimal(points, free, 1e-12);
    }
  // A smooth closed path, finely sampled and repeated: supports are next to each other and nearly in one flat.
  Points path;
  for (int i = 0; i < 2000; ++i) {
    const double t = 2 * M_PI * (i % 1000) / 1000;
    path.push_back({std::cos(t), std::sin(t), 0.3 * std::cos(2 * t), 0.2 * std::sin(3 * t), 0.1 * std::cos(t)});
  }
  for (const FreeDirections free : {free_directions(0, 1), free_directions(0, 1, 3), kAllFree})
    expect_optimal(path, free, 1e-12);
  // All on one sphere, as many supports as one likes.
  Points sphere;
  for (int i = 0; i < 300; ++i) {
    Vec5 p{};
    for (double& x : p) x = uniform(draw);
    const double length = std::sqrt(norm_squared(p));
    for (double& x : p) x = 7 + x / length;
    sphere.push_back(p);
  }
  const EnclosingBall ball = enclosing_ball(sphere);
  EXPECT_NEAR(ball.radius, 1, 1e-12);
  for (const double c : ball.centre) EXPECT_NEAR(c, 7, 1e-10);
}

/// Minimum of a convex function in [-4, 4] by thirds.
template <class F>
double least(F&& f) {
  double from = -4, to = 4;
  while (to - from > 1e-10) {
    const double a = from + (to - from) / 3, b = to - (to - from) / 3;
    (f(a) < f(b) ? to : from) = f(a) < f(b) ? b : a;
  }
  return f(0.5 * (from + to));
}

// Two free coordinates against nested searches.
TEST(EnclosingBall, AgreesWithBruteForce) {
  std::mt19937 draw(3);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 10; ++trial) {
    Points points(60);
    for (Vec5& p : points)
      for (double& x : p) x = normal(draw);
    const auto radius = [&](double c0, double c3) {
      double largest = 0;
      for (const Vec5& p : points) largest = std::max(largest, squared_distance(p, {c0, 0, 0, c3, 0}));
      return std::sqrt(largest);
    };
    const double best = least([&](double c0) { return least([&](double c3) { return radius(c0, c3); }); });
    const EnclosingBall ball = enclosing_ball(points, free_directions(0, 3));
    EXPECT_NEAR(ball.radius, best, 1e-9);
    EXPECT_LE(ball.radius, best * (1 + 1e-12));
  }
}

// Megapascals with an offset: the scale of the numbers does not matter.
TEST(EnclosingBall, ScalesWithItsPoints) {
  Points points, large;
  std::mt19937 draw(11);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 500; ++i) {
    Vec5 p{};
    for (double& x : p) x = normal(draw);
    points.push_back(p);
    for (double& x : p) x = 3e8 * x - 1e9;
    large.push_back(p);
  }
  EXPECT_NEAR(enclosing_ball(large).radius, 3e8 * enclosing_ball(points).radius, 3e8 * 1e-11);
}

}  // namespace
}  // namespace railstrata
