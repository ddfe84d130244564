// Bogies in a curve against closed forms and equilibrium.
#include "curving/steady_curve.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/faults.hpp"
#include "tests/places.hpp"

namespace railstrata {
namespace {

LoadedCase curve_of(const std::string& geometry, const std::string& curve, const std::string& bogie) {
  return parse_case("[geometry]\n" + geometry +
                        "\nwheel_radius = \"460 mm\"\n[drive]\nfriction_coefficient = 0.35\n"
                        "speed = \"22 m/s\"\n[curve]\n" +
                        curve + "\n[[bogie]]\nmgt = 10\n" + bogie,
                    source_dir() / "examples/vehicle/curve.toml");
}

const std::string kCones = "wheel_profile = \"cone.csv\"\nrail_profile = \"arc:R=300 mm\"\ncant = 0.0",
                  kEurope = "wheel_profile = \"S1002\"\nrail_profile = \"UIC60\"\ncant = \"1:40\"",
                  kChina = "wheel_profile = \"LMA\"\nrail_profile = \"CN60\"\ncant = \"1:40\"";

BogieInCurve only(const LoadedCase& loaded) {
  const BogieInCurve out = solve_curve(loaded, nullptr).at(0);
  EXPECT_EQ(out.fault, "");
  return out;
}

// Without cant deficiency and with soft springs along the track both wheelsets stand radially, where the rolling radii
// differ by 2 r0 e/R, Redtenbacher's formula.
TEST(SteadyCurve, ConesOnSoftSpringsRollOnTheRollingRadiusLine) {
  const double radius = 2000, speed = 22;
  const LoadedCase cones = curve_of(
      kCones,
      "radius = \"2000 m\"\nsuperelevation = \"" + std::to_string(1e3 * speed * speed / radius / 9.81 * 1.5) + " mm\"",
      "longitudinal_stiffness = \"20 kN/m\"\nwheelbase = \"2.5 m\"");
  const BogieInCurve found = only(cones);
  EXPECT_NEAR(found.deficiency, 0, 0.02);
  for (const WheelsetInCurve& set : found.wheelsets) {
    const WheelForces &left = set.forces.wheels[kLeft], &right = set.forces.wheels[kRight];
    const double base = 0.5 * (left.point.y - right.point.y);
    EXPECT_NEAR(left.rolling_radius - right.rolling_radius, 2 * base * 0.46 / radius, 0.03 * 2 * base * 0.46 / radius);
    EXPECT_NEAR(set.state.yaw, 0, 0.05e-3);
  }
}

class CurveOf : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Pairs, CurveOf, testing::Values(kEurope, kChina));

// Forces across add up to those that the cant leaves to the rails, moments of the loads to that of the height.
TEST_P(CurveOf, WheelsBearWhatTheCantLeaves) {
  const BogieInCurve found = only(curve_of(GetParam(), "radius = \"800 m\"\nsuperelevation = \"80 mm\"", ""));
  const BogieNumbers coach;
  EXPECT_NEAR(found.deficiency, 22.0 * 22 / 800 - 9.81 * 80e-3 / 1.5, 4e-3);
  double across = 0;
  for (const WheelsetInCurve& set : found.wheelsets) {
    across -= set.forces.force.y;
    const double tilt = 80e-3 / 1.5, load = coach.axle_load * (std::cos(tilt) + 22.0 * 22 / 800 / 9.81 * tilt);
    EXPECT_NEAR(set.forces.force.z, load, 2e-4 * load);
    EXPECT_NEAR(set.forces.moment.y, 0, 1e-3 * coach.axle_load * 0.46);
    const double tilted = (coach.axle_load / 9.81 - coach.wheelset_mass) * found.deficiency * (1.76 - 0.46);
    EXPECT_NEAR(set.forces.moment.x, tilted, 1e-3 * coach.axle_load);
  }
  EXPECT_NEAR(across, 2 * coach.axle_load / 9.81 * found.deficiency, 1e-3 * coach.axle_load);
  EXPECT_GT(found.wheelsets[0].state.y, found.wheelsets[1].state.y);  // the leading one runs to the outer rail
  EXPECT_GT(found.wheelsets[0].state.yaw, found.wheelsets[1].state.yaw);
}

// The loads of either rail are those of its wheels, seen from the field side.
TEST(SteadyCurve, LoadsOfARailAreThoseOfItsWheels) {
  LoadedCase loaded = curve_of(kEurope, "radius = \"800 m\"\nsuperelevation = \"80 mm\"", "name = \"unit\"");
  const std::vector<BogieInCurve> found = solve_curve(loaded, nullptr);
  const WheelsetInCurve& set = found.at(0).wheelsets[0];
  const LoadSpec outer = with_curve_loads(loaded, found).spec.loads.at(0);
  loaded.spec.collective.curve.rail = CurveRail::inner;
  const LoadSpec inner = with_curve_loads(loaded, found).spec.loads.at(0);
  EXPECT_EQ(outer.name, "unit, leading");
  EXPECT_EQ(*outer.wheel_load, set.forces.wheels[kLeft].force.z);
  EXPECT_EQ(*inner.wheel_load, set.forces.wheels[kRight].force.z);
  EXPECT_EQ(*outer.lateral_shift, -*inner.lateral_shift);
  EXPECT_EQ(*outer.yaw, -*inner.yaw);
  EXPECT_EQ(*outer.curve_radius, -800);
  EXPECT_EQ(*inner.curve_radius, 800);
  EXPECT_NEAR(*outer.creepage - *inner.creepage, 1.5 / 800, 0.02 * 1.5 / 800);  // the outer way is longer
  EXPECT_NEAR(outer.passages, 5e6 / (109.1 / 9.81), 1e-6 * outer.passages);
}

TEST(SteadyCurve, ABogieWithoutEquilibriumIsLeftOutWithItsReason) {
  const LoadedCase loaded =
      curve_of(kEurope, "radius = \"100 m\"", "centre_of_gravity = \"4 m\"\nspeed = \"160 km/h\"");
  const std::vector<BogieInCurve> found = solve_curve(loaded, nullptr);
  EXPECT_NE(found.at(0).fault, "");
  EXPECT_THROW(with_curve_loads(loaded, found), CaseError);
}

}  // namespace
}  // namespace railstrata
