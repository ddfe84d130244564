#include <gtest/gtest.h>

#include <cmath>

#include "fem/preload.hpp"

using namespace railstrata;

namespace {

// Descent of the axle of a wheel with a spherical tread on a flat block.
double descent(double sprung_mass) {
  CaseSpec spec;
  spec.geometry.rail_profile = "flat";
  spec.geometry.wheel_profile = "arc:R=430 mm";
  spec.geometry.rail_shape = RailShape::block;
  spec.geometry.wheel_shape = WheelShape::disc;
  spec.geometry.cant = 0;
  spec.vehicle.sprung_mass = sprung_mass;
  spec.run.rolling = false;
  const RollingSystem system(build_model(spec, {}));
  return -solve_preload(system, 1e-6).axle_z;
}

}  // namespace

// Finite bodies add a linear term to Hertz's approach: d(F) = c F^(2/3) + F/k. Two loads separate them; c is Hertz's
// within 2 %. [Johnson1985 eq. 4.23]
TEST(SlowApproach, ThePartThatGrowsWithTheTwoThirdsPowerOfTheLoadIsHertz) {
  const double g = 9.81, wheel = 660, heavy = (wheel + 8000) * g, light = (wheel + 3670) * g;
  const double d1 = descent(8000), d2 = descent(3670);
  const double c = (d1 / heavy - d2 / light) / (std::pow(heavy, -1.0 / 3) - std::pow(light, -1.0 / 3));
  const double modulus = 210e9 / (1 - 0.3 * 0.3) / 2;
  EXPECT_NEAR(c / std::cbrt(9 / (16 * 0.43 * modulus * modulus)), 1, 0.02);
}
