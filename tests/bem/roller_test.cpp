// Rolling on a rail that is curved along rolling, by what it must share with a straight one.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "bem/solve_bem.hpp"
#include "halfspace/line_contact.hpp"
#include "reader/case_file.hpp"

namespace railstrata {
namespace {

BemResult solved(const std::string& radii, const std::vector<std::string>& overrides = {}) {
  const LoadedCase loaded = parse_case(
      "[geometry]\nrail_profile = \"arc:R=300 mm\"\nwheel_profile = \"flat\"\nrail_shape = \"block\"\nwheel_shape = "
      "\"disc\"\nbore_radius = \"20 mm\"\ncant = 0.0\n" +
          radii +
          "[vehicle]\nwheel_mass = \"1 kg\"\nwheel_load = \"60 kN\"\n[drive]\nspeed = \"10 m/s\"\ncreepage = "
          "-0.001\nlateral_creepage = 0.0005\nspin = \"0.3 1/m\"\nfriction_coefficient = 0.3\n",
      "a.toml", overrides);
  return solve_bem(loaded.spec, place(loaded.spec, {}));
}

// Half-spaces know the curvature of the gap alone: two discs whose curvatures add up to that of a wheel on a straight
// rail have its patch and, with the same creepages and spin, its forces; the arcs' fourth order differs.
TEST(Roller, TwoDiscsOfTheSameCurvatureHaveThePatchAndForcesOfAWheelOnAStraightRail) {
  const BemResult straight = solved("wheel_radius = \"430 mm\"\n");
  for (const char* radii : {"wheel_radius = \"860 mm\"\nrail_radius = \"860 mm\"\n",
                            "wheel_radius = \"600 mm\"\nrail_radius = \"1517.6470588 mm\"\n",
                            "wheel_radius = \"215 mm\"\nrail_radius = \"-430 mm\"\n"}) {
    const BemResult discs = solved(radii);
    EXPECT_NEAR(discs.patch.largest_pressure / straight.patch.largest_pressure, 1, 1e-3) << radii;
    EXPECT_NEAR(discs.patch.area / straight.patch.area, 1, 5e-3) << radii;  // of cells
    EXPECT_NEAR(discs.force.x / straight.force.x, 1, 1e-3) << radii;
    EXPECT_NEAR(discs.force.y / straight.force.y, 1, 1e-3) << radii;
    EXPECT_NEAR(discs.force.moment / straight.force.moment, 1, 1e-3) << radii;
    EXPECT_NEAR(discs.motion_power / discs.dissipation, 1, 0.01) << radii;
  }
}

// The same two bodies with their parts exchanged: the crown on the roller or on the wheel. Rigid slip changes its sign
// with the body that it is counted from, and so do the rows' own.
TEST(Roller, WheelAndRollerOfOneRadiusShareTheRowsOwnSlip) {
  const char* radii = "wheel_radius = \"500 mm\"\nrail_radius = \"500 mm\"\n";
  const auto driven = [&](double creepage, const std::vector<std::string>& profiles) {
    std::vector<std::string> all = profiles;
    all.push_back(fmt::format("drive.creepage={}", creepage));
    all.insert(all.end(), {"drive.lateral_creepage=0", "drive.spin=\"0 1/m\""});
    return solved(radii, all).force.x;
  };
  const std::vector<std::string> on_rail,
      on_wheel{"geometry.rail_profile=flat", "geometry.wheel_profile=\"arc:R=300 mm\""};
  for (const double creepage : {-1e-5, -1e-4, 5e-4})
    EXPECT_NEAR(driven(creepage, on_rail) / -driven(-creepage, on_wheel), 1, 2e-3) << creepage;
}

TEST(Roller, ALineContactOfTwoDiscsHasTheHalfWidthOfHertz) {
  const LoadedCase loaded = parse_case(
      "[geometry]\nrail_profile = \"flat\"\nwheel_profile = \"flat\"\nwheel_shape = \"disc\"\nbore_radius = \"10 "
      "mm\"\nwheel_radius = \"23.5 mm\"\nrail_radius = \"23.5 mm\"\ncontact = \"line\"\nline_length = \"10 mm\"\ncant "
      "= "
      "0.0\n[vehicle]\nwheel_mass = \"1 kg\"\nwheel_load = \"7.7 kN\"\n[drive]\nspeed = \"1 m/s\"\ncreepage = "
      "-0.002\nfriction_coefficient = 0.46\n",
      "a.toml");
  BemOptions options;
  options.cell = 0.01e-3;
  const BemResult r = solve_bem(loaded.spec, place(loaded.spec, {}), options);
  const double modulus = contact_modulus({210e9, 0.3}, {210e9, 0.3});
  const LineHertz hertz = hertz_line(0.5 * 2 / 23.5e-3, modulus, 7.7e3 / 10e-3);
  EXPECT_NEAR(r.patch.largest_pressure / hertz.p0, 1, 2e-3);
}

TEST(Roller, SpindlesGiveSpeedAndCreepage) {
  const LoadedCase loaded = parse_case(
      "[geometry]\nwheel_shape = \"disc\"\nbore_radius = \"10 mm\"\nwheel_radius = \"20 mm\"\nrail_radius = \"25 "
      "mm\"\n[drive]\nwheel_rotation = \"505 rpm\"\nrail_rotation = \"400 rpm\"\n",
      "a.toml");
  const double speed = 400 * 2 * M_PI / 60 * 25e-3;
  EXPECT_NEAR(loaded.spec.drive.speed, speed, 1e-12);
  EXPECT_NEAR(loaded.spec.drive.creepage.value(), 1 - 505.0 * 20 / (400.0 * 25), 1e-12);
}

}  // namespace
}  // namespace railstrata
