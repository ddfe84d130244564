#include "halfspace/boussinesq_cerruti.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>

namespace railstrata {
namespace {

/// 5-point Gauss rule on n x n panels.
double integrate(double x1, double x2, double y1, double y2, int n, const std::function<double(double, double)>& f) {
  constexpr std::array<double, 5> s{-0.906179845938664, -0.538469310105683, 0, 0.538469310105683, 0.906179845938664};
  constexpr std::array<double, 5> w{0.236926885056189, 0.478628670499366, 0.568888888888889, 0.478628670499366,
                                    0.236926885056189};
  const double hx = (x2 - x1) / n, hy = (y2 - y1) / n;
  double sum = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (std::size_t k = 0; k < 5; ++k)
        for (std::size_t l = 0; l < 5; ++l)
          sum += w[k] * w[l] * f(x1 + hx * (i + 0.5 * (1 + s[k])), y1 + hy * (j + 0.5 * (1 + s[l])));
  return sum * hx * hy / 4;
}

struct Offset {
  double x, y;
};
const HalfSpaceMaterial kBody{70e9, 0.27};

TEST(BoussinesqCerruti, RectangleEqualsIntegratedPointForcesTo1em10) {
  const double G = kBody.shear(), nu = kBody.poisson, pi = std::numbers::pi, dx = 0.7, dy = 0.4;
  for (const Offset o : {Offset{1.5, 0.3}, Offset{-2.1, 1.9}, Offset{0.2, -3.0}, Offset{40, 25}}) {
    const auto over = [&](auto&& f) {
      return integrate(o.x - dx / 2, o.x + dx / 2, o.y - dy / 2, o.y + dy / 2, 12, f);
    };
    const RectangleInfluence i = rectangle_influence(homogeneous_compliance(kBody), o.x, o.y, dx, dy);
    const auto r = [](double x, double y) { return std::hypot(x, y); };
    const double scale = i.nn;
    EXPECT_NEAR(i.nn, over([&](double x, double y) { return (1 - nu) / (2 * pi * G) / r(x, y); }), 1e-10 * scale);
    EXPECT_NEAR(i.xx, over([&](double x, double y) {
                  return ((1 - nu) / r(x, y) + nu * x * x / std::pow(r(x, y), 3)) / (2 * pi * G);
                }),
                1e-10 * scale);
    EXPECT_NEAR(i.yy, over([&](double x, double y) {
                  return ((1 - nu) / r(x, y) + nu * y * y / std::pow(r(x, y), 3)) / (2 * pi * G);
                }),
                1e-10 * scale);
    EXPECT_NEAR(i.xy, over([&](double x, double y) { return nu * x * y / std::pow(r(x, y), 3) / (2 * pi * G); }),
                1e-10 * scale);
    EXPECT_NEAR(i.nx, over([&](double x, double y) { return (1 - 2 * nu) / (4 * pi * G) * x / (x * x + y * y); }),
                1e-10 * scale);
    EXPECT_NEAR(i.ny, over([&](double x, double y) { return (1 - 2 * nu) / (4 * pi * G) * y / (x * x + y * y); }),
                1e-10 * scale);
  }
}

TEST(BoussinesqCerruti, CentreOfALoadedSquareMeetsLove1929) {
  const double s = 2e-3;
  const RectangleInfluence i = rectangle_influence(homogeneous_compliance(kBody), 0, 0, s, s);
  EXPECT_NEAR(i.nn / ((1 - kBody.poisson) / kBody.shear() * 2 * s * std::log(1 + std::sqrt(2)) / std::numbers::pi), 1,
              1e-13);
  EXPECT_NEAR(i.nx / i.nn, 0, 1e-14);
}

TEST(BoussinesqCerruti, BuriedImageEqualsIntegratedGreensFunctionsTo1em10) {
  const double d = 0.35, dx = 0.7, dy = 0.4, pi = std::numbers::pi;
  for (const Offset o : {Offset{0, 0}, Offset{0.35, 0.2}, Offset{-0.9, 0.1}, Offset{3, -2}}) {
    const auto over = [&](auto&& f) {
      return integrate(o.x - dx / 2, o.x + dx / 2, o.y - dy / 2, o.y + dy / 2, 24, f) / (2 * pi);
    };
    const auto R = [&](double x, double y) { return std::sqrt(x * x + y * y + d * d); };
    const RectangleInfluence z = rectangle_influence({{d, {1, 1, 0, 0}}}, o.x, o.y, dx, dy);
    const RectangleInfluence r = rectangle_influence({{d, {0, 0, 1, 0}}}, o.x, o.y, dx, dy);
    const RectangleInfluence t = rectangle_influence({{d, {0, 0, 0, 1}}}, o.x, o.y, dx, dy);
    EXPECT_NEAR(z.nn, over([&](double x, double y) { return 1 / R(x, y); }), 1e-10);
    EXPECT_NEAR(z.nx, over([&](double x, double y) { return x / (R(x, y) * (R(x, y) + d)); }), 1e-10);
    // -d²/dx² (d ln(R + d) - R) = d/dx (x/(R + d))
    EXPECT_NEAR(r.xx, over([&](double x, double y) {
                  return 1 / (R(x, y) + d) - x * x / (R(x, y) * std::pow(R(x, y) + d, 2));
                }),
                1e-10);
    EXPECT_NEAR(r.xy, over([&](double x, double y) { return -x * y / (R(x, y) * std::pow(R(x, y) + d, 2)); }), 1e-10);
    EXPECT_NEAR(r.xx + t.xx, z.nn, 1e-14);
    EXPECT_NEAR(r.xy, -t.xy, 1e-15);
  }
}

TEST(BoussinesqCerruti, TableEqualsSingleRectangles) {
  const SurfaceCompliance c = combined_compliance(homogeneous_compliance({1, 0.1}), homogeneous_compliance({2, 0.4}));
  const auto table = rectangle_influence_table(c, 4, 5, 0.3, 0.2);
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 5; ++j) {
      const RectangleInfluence one = rectangle_influence(c, i * 0.3, j * 0.2, 0.3, 0.2),
                               &t = table[static_cast<std::size_t>(5 * i + j)];
      for (auto m : {&RectangleInfluence::nn, &RectangleInfluence::xx, &RectangleInfluence::xy, &RectangleInfluence::yy,
                     &RectangleInfluence::nx, &RectangleInfluence::ny})
        EXPECT_NEAR(t.*m, one.*m, 1e-15);
    }
}

TEST(BoussinesqCerruti, EqualBodiesDoNotCouple) {
  const SurfaceCompliance c = combined_compliance(homogeneous_compliance(kBody), homogeneous_compliance(kBody));
  ASSERT_EQ(c.size(), 1u);
  EXPECT_EQ(c[0].c.rz, 0);
  EXPECT_DOUBLE_EQ(c[0].c.zz, 2 * (1 - kBody.poisson) / kBody.shear());
}

}  // namespace
}  // namespace railstrata
