#include "damage/wear.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/faults.hpp"

namespace railstrata {
namespace {

/// Cells that are all alike, 12.8 mm in contact at 20 m/s.
struct Uniform {
  std::vector<double> p, q_x, q_y, slip_x, slip_y;
  double dx, speed = 20;
  Uniform(int n, double pressure, double traction, double slip)
      : p(n, pressure), q_x(n, -traction), q_y(n, 0), slip_x(n, -slip), slip_y(n, 0), dx(12.8e-3 / n) {}
  Streamline line() const { return {p, q_x, q_y, slip_x, slip_y, dx, speed}; }
};

TEST(UsfdWear, HasItsPublishedBranches) {
  const double microgram = 1e-3;  // per m and mm²
  EXPECT_NEAR(usfd_rate(5e6), 26.5 * microgram, 1e-12);
  EXPECT_NEAR(usfd_rate(10.39e6), 55.067 * microgram, 1e-9);
  EXPECT_NEAR(usfd_rate(40e6), 55.0 * microgram, 1e-12);
  EXPECT_NEAR(usfd_rate(100e6), (6190 - 4723.68) * microgram, 1e-9);
  EXPECT_EQ(usfd_rate(-100e6), usfd_rate(100e6));
}

// With the constant 4778.7 of other programs the rate would fall from 55 to 0 at 77.2 N/mm².
TEST(UsfdWear, GoesOnWithoutAJumpIntoTheCatastrophicBranch) {
  const double below = usfd_rate(77.2e6 * (1 - 1e-9)), above = usfd_rate(77.2e6 * (1 + 1e-9));
  EXPECT_NEAR(above / below, 1, 1e-6);
  for (double x = 0; x < 200; x += 0.05) EXPECT_GE(usfd_rate((x + 0.05) * 1e6), 0.997 * usfd_rate(x * 1e6)) << x;
}

// 5 N/mm² over 12.8 mm: 26.5 µg/(m mm²) × 0.0128 m = 0.339 µg/mm², 43.5 nm of steel; however many cells.
TEST(UsfdWear, DepthOfAPassage) {
  for (int n : {1, 10, 64}) {
    const Uniform u(n, 800e6, 250e6, 0.02 * 20);  // q s/V = 250 MPa × 0.02 = 5 MPa
    EXPECT_NEAR(usfd_depth(u.line(), 7800), 43.49e-9, 0.01e-9) << n;
  }
}

TEST(Archard, DepthOfAPassage) {
  // 5 µm slid over in the patch at 800 MPa, H = 2.7 GPa, k = 5e-4: 0.74 nm
  const double slip = 5e-6 / 12.8e-3 * 20;
  const Uniform u(32, 800e6, 200e6, slip);
  EXPECT_NEAR(archard_depth(u.line(), laboratory_dry_archard(), 2.7e9), 0.7407e-9, 1e-13);
  EXPECT_NEAR(archard_depth(u.line(), laboratory_dry_archard(), 2.7e9, 0.05), 0.05 * 0.7407e-9, 1e-14);
}

// 800 MPa on metal of 0.9 GPa seizes; at 1.5 m/s on harder metal the map's chart has ended; else all is inside.
TEST(Archard, TellsWhatItsMapHardlyReaches) {
  const ArchardMap map = laboratory_dry_archard();
  const Uniform slow(8, 800e6, 200e6, 0.1), fast(8, 800e6, 200e6, 1.5);
  const OutsideMap seized = archard_outside(slow.line(), map, 0.9e9), quick = archard_outside(fast.line(), map, 2.7e9),
                   inside = archard_outside(slow.line(), map, 2.7e9);
  EXPECT_DOUBLE_EQ(seized.seized, archard_depth(slow.line(), map, 0.9e9));
  EXPECT_EQ(seized.fast, 0);
  EXPECT_DOUBLE_EQ(quick.fast, archard_depth(fast.line(), map, 2.7e9));
  EXPECT_EQ(quick.seized, 0);
  EXPECT_EQ(inside.seized + inside.fast, 0);
}

// Slip that comes and goes while q does: the mean of their product, not the product of their means.
TEST(Wear, TakesTheMeansOfProductsWhereTheyAreKnown) {
  const Uniform u(16, 800e6, 250e6, 0.4);
  const std::vector<double> power(16, 2 * 250e6 * 0.4), pressed(16, 3 * 800e6 * 0.4);
  Streamline line = u.line();
  const double usfd = usfd_depth(line, 7800), archard = archard_depth(line, laboratory_dry_archard(), 2.7e9);
  line.power = power;
  line.pressed = pressed;
  EXPECT_NEAR(friction_energy(line), 2 * friction_energy(u.line()), 1e-9);
  EXPECT_NEAR(usfd_depth(line, 7800), 2 * usfd, 1e-9 * usfd);  // linear up to 10.4 N/mm², here 10
  EXPECT_NEAR(archard_depth(line, laboratory_dry_archard(), 2.7e9), 3 * archard, 1e-9 * archard);
  line.pressed = std::span<const double>(pressed).first(3);
  EXPECT_THROW(friction_energy(line), std::invalid_argument);
}

TEST(Archard, MapHasFourFields) {
  const ArchardMap map = laboratory_dry_archard();
  EXPECT_EQ(archard_coefficient(map, 1e9, 0.1, 2.7e9), 5e-4);
  EXPECT_EQ(archard_coefficient(map, 1e9, 0.5, 2.7e9), 35e-4);
  EXPECT_EQ(archard_coefficient(map, 1e9, 0.9, 2.7e9), 5e-4);
  EXPECT_EQ(archard_coefficient(map, 2.2e9, 0.1, 2.7e9), 350e-4);
  EXPECT_EQ(archard_coefficient(map, 2.1e9, 0.1, 2.7e9), 5e-4);
}

TEST(Archard, ASurfaceWithoutHardnessIsRefused) {
  const Uniform u(4, 800e6, 200e6, 0.1);
  EXPECT_THROW(archard_depth(u.line(), laboratory_dry_archard(), 0), std::invalid_argument);
}

TEST(FrictionEnergy, IsPowerTimesTheTimeInContact) {
  const Uniform u(16, 800e6, 250e6, 0.4);
  EXPECT_NEAR(friction_energy(u.line()), 250e6 * 0.4 * 12.8e-3 / 20, 1e-6);
}

// Summed over the rows with their widths: the energy per m rolled, T-gamma. Full slip: mu F xi.
TEST(FrictionEnergy, OverAllRowsIsTGamma) {
  const double a = 6e-3, b = 5e-3, p0 = 1e9, mu = 0.3, creepage = 0.01, speed = 30;
  const int n = 400;
  double energy = 0;  // J/m
  for (int row = 0; row < n; ++row) {
    const double y = b * (2 * (row + 0.5) / n - 1);
    std::vector<double> p(n), q_x(n), zero(n, 0.0), slip(n, creepage * speed);
    for (int i = 0; i < n; ++i) {
      const double x = a * (2 * (i + 0.5) / n - 1), inside = 1 - x * x / (a * a) - y * y / (b * b);
      p[i] = inside > 0 ? p0 * std::sqrt(inside) : 0;
      q_x[i] = mu * p[i];
    }
    const Streamline line{p, q_x, zero, slip, zero, 2 * a / n, speed};
    energy += friction_energy(line) * 2 * b / n;
  }
  const double load = 2.0 / 3 * M_PI * a * b * p0;
  EXPECT_NEAR(energy, mu * load * creepage, 1e-3 * mu * load * creepage);
}

TEST(LocalFatigue, IsThatOfTheCellWithLeastReserve) {
  const std::vector<double> p{0, 200e6, 900e6, 400e6}, q{0, 60e6, 350e6, 160e6}, zero(4, 0.0);
  const Streamline line{p, q, zero, zero, zero, 1e-3, 10};
  EXPECT_NEAR(local_fatigue(line, 280e6).value(), (350.0 - 280) / 900, 1e-12);
  const Streamline nothing{zero, zero, zero, zero, zero, 1e-3, 10};
  EXPECT_FALSE(local_fatigue(nothing, 280e6));
}

TEST(Streamline, RowsOfOtherLengthsAreRefused) {
  const std::vector<double> three(3, 1.0), four(4, 1.0);
  EXPECT_THROW(friction_energy({three, four, three, three, three, 1e-3, 10}), std::invalid_argument);
  EXPECT_THROW(friction_energy({three, three, three, three, three, 1e-3, 0}), std::invalid_argument);
}

}  // namespace
}  // namespace railstrata
