#include "usetab/usetab.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace railstrata {
namespace {

constexpr std::size_t kHalf = 3, kUnit = 7, kInfinite = 8;  // 3/7, 1, 7e5 of the scaled creepages

/// A few creepages of an ellipse.
UsetabAxes some() { return {{}, {0, 1.0 / 7, 1, 7e5}, {0, 1}, {0, 1.0 / 7, -1.0 / 7, 1}}; }
UsetabForce at(const std::vector<UsetabForce>& forces, std::size_t xi, std::size_t eta, std::size_t psi) {
  return forces[(xi * 2 + eta) * 4 + psi];
}

}  // namespace

TEST(Usetab, HasTheAxesOfItsForm) {
  const UsetabAxes axes = usetab_axes();
  EXPECT_EQ(axes.aspect.size(), 25u);
  EXPECT_EQ(axes.xi.size(), 16u);
  EXPECT_EQ(axes.psi.size(), 32u);
  EXPECT_EQ(axes.aspect[6], 1);
  EXPECT_EQ(axes.aspect[7], 200);
  EXPECT_DOUBLE_EQ(axes.xi[kHalf], 3.0 / 7);
  EXPECT_EQ(axes.xi[kUnit], 1);
  EXPECT_NEAR(axes.xi[kInfinite], 7e5, 1);
  EXPECT_EQ(axes.psi[16], 0);
  EXPECT_DOUBLE_EQ(axes.psi[17], -1.0 / 7);
}

// [Kalker1990 table E.3] at nu = 1/4; asymptotes meet the table at g = 0.1 within its digits.
TEST(Usetab, ScalesByKalkersCoefficients) {
  const CreepCoefficients round = usetab_coefficients(1, 0.25);
  EXPECT_NEAR(round.c11, 4.12, 1e-12);
  EXPECT_NEAR(round.c22, 3.67, 1e-12);
  EXPECT_NEAR(round.c23, 1.47, 1e-12);
  for (const double ratio : {0.1, 10.0}) {
    const CreepCoefficients beyond = usetab_coefficients(ratio, 0.25), within = kalker_coefficients(ratio, 0.25);
    EXPECT_NEAR(beyond.c11 / within.c11, 1, 0.04) << ratio;
    EXPECT_NEAR(beyond.c22 / within.c22, 1, 0.05) << ratio;
    EXPECT_NEAR(beyond.c23 / within.c23, 1, 0.12) << ratio;
  }
}

TEST(Usetab, ForcesHaveTheirLimitsAndSigns) {
  UsetabOptions options;
  options.cells = 16;
  for (const double aspect : {0.5, 1.0, 4.0}) {
    const std::vector<UsetabForce> f = usetab_forces(aspect, some(), options);
    EXPECT_EQ(at(f, 0, 0, 0).x, 0);
    EXPECT_NEAR(at(f, 3, 0, 0).x, 1, 1e-4) << "full sliding";
    EXPECT_NEAR(at(f, 1, 0, 0).x, 1 - std::pow(1 - 1.0 / 7, 3), 0.05)
        << "Vermeulen and Johnson, of the linear theory's";
    EXPECT_GT(at(f, 0, 1, 0).y, 0.8);
    EXPECT_LT(std::hypot(at(f, 2, 1, 3).x, at(f, 2, 1, 3).y), 1.0001);
    EXPECT_GT(at(f, 0, 0, 1).y, 0) << "spin pushes as lateral creepage of its sign";
    EXPECT_NEAR(at(f, 0, 0, 1).y, -at(f, 0, 0, 2).y, 2e-3);
  }
}

TEST(Usetab, TextIsThatOfTheForm) {
  const UsetabAxes axes = usetab_axes();
  const std::string head = usetab_head(axes, 20, "a test");
  EXPECT_EQ(std::count(head.begin(), head.begin() + static_cast<long>(head.find("itab")), '!'), 3);
  EXPECT_NE(head.find("\n     7    18    10     0     0  itab, naob1, imap\n  200.000000,  130.000000,"),
            std::string::npos)
      << head;
  const std::string rows = usetab_rows(200, {{200}, {0.5}, {7e5}, {0, 1}}, {{1, -2e-7, 0.25}, {0, 0, -0.1}});
  EXPECT_EQ(rows,
            "! aob=  200.000, xi= 0.500000, eta= 700000.0\n"
            "     1.000000    0.000000    0.250000\n"
            "     0.000000    0.000000   -0.100000\n");
}

}  // namespace railstrata
