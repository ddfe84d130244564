// Circles of pressure on half-spaces; on layers they are held against programs for pavements by `railstrata validate`
// (cases/validation/ellea, kenpave).
#include "halfspace/circular_pressure.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "halfspace/interior.hpp"

namespace railstrata {
namespace {

const HalfSpaceMaterial kSteel{210e9, 0.3};

// On the axis of a circle [Johnson1985 sec. 3.4(a)]: sigma_z/p = -(1 - z^3/s^3), s^2 = a^2 + z^2, sigma_r/p =
// -((1 + 2 nu)/2 - (1 + nu) z/s + z^3/(2 s^3)), and the sinking by the strain between.
TEST(CircularPressure, OnTheAxisIsBoussinesqsClosedForm) {
  const double a = 5e-3, p = 1e9;
  const PressedCircle circle{0, 0, a, p};
  for (const double z : {0.5e-3, 5e-3, 20e-3}) {
    const PointBelow at = below_circles({{}, kSteel}, {&circle, 1}, {0, 0, z});
    const double u = z / std::hypot(a, z), nu = kSteel.poisson;
    EXPECT_NEAR(at.stress.zz / p, -(1 - u * u * u), 5e-5) << z;
    EXPECT_NEAR(at.stress.xx / p, -(0.5 * (1 + 2 * nu) - (1 + nu) * u + 0.5 * u * u * u), 5e-5) << z;
    EXPECT_NEAR(at.stress.yy, at.stress.xx, 1e-9 * p) << z;
    const double s = std::hypot(a, z), sinking = (1 + nu) * p / kSteel.young * (s - z) * (2 * (1 - nu) + z / s);
    EXPECT_NEAR(at.sinking / sinking, 1, 1e-4) << z;
  }
}

// The same of many small squares; away from the axis, all six stresses, in axes turned against the radius.
TEST(CircularPressure, IsTheSumOfSquaresUnderTheSamePressure) {
  const double a = 5e-3, cell = 0.1e-3;
  const Vec3 at{3e-3, -4.5e-3, 2e-3};
  const PressedCircle circle{0, 0, a, 1};
  Sym3 squares;
  for (int i = -50; i <= 50; ++i)
    for (int j = -50; j <= 50; ++j)
      if (std::hypot(i, j) * cell <= a)
        squares = squares +
                  stress_of(rectangle_interior(kSteel, at.x - i * cell, at.y - j * cell, at.z, cell, cell)[0], kSteel);
  const Sym3 s = below_circles({{}, kSteel}, {&circle, 1}, at).stress;
  for (const double Sym3::*component : {&Sym3::xx, &Sym3::yy, &Sym3::zz, &Sym3::xy, &Sym3::yz, &Sym3::xz})
    EXPECT_NEAR(s.*component, squares.*component, 3e-3);
}

TEST(CircularPressure, LayersOfTheSameMaterialChangeNothing) {
  const std::vector<PressedCircle> two{{0, 4e-3, 3e-3, 1e9}, {0, -4e-3, 3e-3, 1e9}};
  const LayeredHalfSpace cut{{{2e-3, kSteel}, {5e-3, kSteel}}, kSteel};
  const PointBelow plain = below_circles({{}, kSteel}, two, {1e-3, 1e-3, 3e-3}),
                   layered = below_circles(cut, two, {1e-3, 1e-3, 3e-3});
  for (const double Sym3::*component : {&Sym3::xx, &Sym3::yy, &Sym3::zz, &Sym3::xy, &Sym3::yz, &Sym3::xz})
    EXPECT_NEAR(layered.stress.*component, plain.stress.*component, 1e5);
  EXPECT_NEAR(layered.sinking / plain.sinking, 1, 1e-4);
}

}  // namespace
}  // namespace railstrata
