// Given creepages, forces and mixes of them, as in a case file, against CONTACT and Kalker's table.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "ask/answer.hpp"
#include "judge/bem_summary.hpp"
#include "reader/case_file.hpp"
#include "tests/bem/reference_table.hpp"

namespace railstrata {
namespace {

constexpr double kLoad = 84954.6, kFriction = 0.5;

/// A wheel and a rail whose gap is A x² + B y² to the fourth order, both bent sideways alike: the contact plane is flat
/// and the rolling radius the same everywhere.
std::string quadratic_pair(double A, double B) {
  const double sideways = 1e3 / B, rolling = 0.5e3 / A;
  return fmt::format(
      "[geometry]\nrail_profile = \"arc:R={0:.12g} mm\"\nwheel_profile = \"arc:R={0:.12g} mm\"\n"
      "wheel_radius = \"{1:.12g} mm\"\nwheel_shape = \"disc\"\nbore_radius = \"20 mm\"\ncant = "
      "0.0\n[vehicle]\nwheel_mass = \"1 kg\"\n",
      sideways, rolling);
}

Answer solved(const std::string& text, double cell, const std::vector<std::string>& overrides = {}) {
  const LoadedCase loaded = parse_case(text, "a.toml", overrides);
  BemOptions options;
  options.cell = cell;
  return solve_contact(loaded.spec, place(loaded.spec, {}), {.bem = options});
}

std::string drive_of(const ReferenceRow& r) {
  std::string out = fmt::format("wheel_load = \"{} N\"\n[drive]\nfriction_coefficient = {}\n", kLoad, kFriction);
  if (std::isfinite(r.at("FX_rel")))
    out += fmt::format("tractive_force = \"{:.12g} kN\"\n", 1e-3 * r.at("FX_rel") * kFriction * kLoad);
  else
    out += fmt::format("creepage = {:.12g}\n", r.at("creep_x"));
  return out + fmt::format("lateral_creepage = {:.12g}\nspin = \"{:.12g} rad/mm\"\n", r.at("creep_y"),
                           r.at("spin_rad_per_mm"));
}

TEST(DrivenCase, MeetsContactForGivenForcesCreepagesAndSpin) {
  int compared = 0;
  for (const ReferenceRow& r : reference_table("half_space.csv")) {
    if (r.name.find("_norm") != std::string::npos || r.at("contact_cells") > 2000) continue;
    const std::string text = quadratic_pair(1e3 * r.at("A_1_per_mm"), 1e3 * r.at("B_1_per_mm")) + drive_of(r);
    const ContactSummary c =
        solved(text, 1e-3 * r.at("dx_mm"), {"bem.leading_edge=whole_cell"}).summary.contact;  // as CONTACT has it
    EXPECT_NEAR(c.F_x / kLoad, r.at("FX_N") / kLoad, 1e-4) << r.name;
    EXPECT_NEAR(c.lateral_force / kLoad, r.at("FY_N") / kLoad, 1e-4) << r.name;
    EXPECT_NEAR(c.normal_force / kLoad, 1, 1e-5) << r.name;
    EXPECT_NEAR(c.spin_moment, 1e-3 * r.at("MZ_Nmm"), 1e-6 * kLoad) << r.name;
    if (std::isfinite(r.at("FX_rel"))) {
      EXPECT_NEAR(c.creepage_x / r.at("out_creep_x"), 1, 1e-4) << r.name;
    } else {
      EXPECT_EQ(c.creepage_x, r.at("creep_x")) << r.name;
    }
    EXPECT_EQ(c.creepage_y, r.at("creep_y")) << r.name;
    EXPECT_DOUBLE_EQ(c.spin_per_m, 1e3 * r.at("spin_rad_per_mm")) << r.name;
    ++compared;
  }
  EXPECT_EQ(compared, 18);
}

// A locked wheel slides by its speed: the law's coefficient there, N as it is.
TEST(DrivenCase, ALockedWheelHasTheCoefficientOfItsSpeed) {
  const std::string pair = quadratic_pair(1000.0 / 840, 1000.0 / 840) +
                           "wheel_load = \"85 kN\"\n[drive]\nspeed = \"10 m/s\"\ncreepage = 1\nspin = \"0 1/m\"\n"
                           "friction_coefficient = 0.4\n[friction]\nkinetic_coefficient = 0.1\n"
                           "half_velocity = \"5 m/s\"\n";
  const ContactSummary exponential = solved(pair + "law = \"falling_exponential\"\n", 0.5e-3).summary.contact,
                       rational = solved(pair + "law = \"falling_rational\"\n", 0.5e-3).summary.contact;
  EXPECT_NEAR(exponential.F_x / -85e3, 0.1 + 0.3 / 4, 1e-4);
  EXPECT_NEAR(rational.F_x / -85e3, 0.1 + 0.3 / 3, 1e-4);
}

// A film of no stiffness to speak of has all the creep: the brush, F = 8/3 a² b G/h xi; one that yields carries no more
// than its yield shear over the patch. And steep laws are reported as such.
TEST(DrivenCase, AThirdBodyTakesTheCreepAndBoundsTheShear) {
  const std::string pair = quadratic_pair(1000.0 / 840, 1000.0 / 840) +
                           "wheel_load = \"84954.6 N\"\n[drive]\ncreepage = -0.001\nspin = \"0 1/m\"\n[third_body]\n"
                           "thickness = \"20 µm\"\n";
  const double a = 6.143981e-3;
  const ContactSummary soft = solved(pair + "shear_modulus = \"1 MPa\"\n", 0.25e-3).summary.contact;
  EXPECT_NEAR(soft.F_x / (8.0 / 3 * a * a * a * 1e6 / 20e-6 * 1e-3), 1, 0.02);
  const ContactSummary yields =
      solved(pair + "shear_modulus = \"1 GPa\"\nyield_shear = \"20 MPa\"\n", 0.25e-3).summary.contact;
  EXPECT_NEAR(yields.patch.q_max / 20e6, 1, 1e-4);
  EXPECT_GT(yields.patch.slip_area_fraction, 0.5);
}

TEST(DrivenCase, ASteepLawIsNotedAsUnstableAndAGentleOneIsNot) {
  const std::string pair = quadratic_pair(1000.0 / 840, 1000.0 / 840) +
                           "wheel_load = \"85 kN\"\n[drive]\nfriction_coefficient = 0.4\n[friction]\n"
                           "law = \"falling_rational\"\nkinetic_coefficient = 0.3\n";
  const auto notes = [&](const char* half) { return solved(pair + half, 1e-3).result.notes; };
  ASSERT_EQ(notes("half_velocity = \"1 m/s\"\n").size(), 1u);
  EXPECT_NE(notes("half_velocity = \"1 m/s\"\n")[0].find("more than the 12.5 MPa s/m that waves carry away"),
            std::string::npos);
  EXPECT_TRUE(notes("half_velocity = \"20 m/s\"\n").empty());
}

/// Two bodies under 85 kN.
struct DrivenPair : testing::TestWithParam<const char*> {
  std::string geometry() const {
    const std::string wheel = GetParam();
    return (wheel == "quadratic" ? quadratic_pair(1000.0 / 840, 1000.0 / 840)
                                 : "[geometry]\nwheel_profile = \"" + wheel + "\"\nrail_profile = \"" +
                                       (wheel == "LMA" ? "CN60" : "UIC60") + "\"\n[vehicle]\n") +
           "wheel_load = \"85 kN\"\n";
  }
};
INSTANTIATE_TEST_SUITE_P(Pairs, DrivenPair, testing::Values("quadratic", "LMA", "S1002"),
                         [](const auto& wheel) { return std::string(wheel.param); });

// A force found for a creepage gives that creepage back, along and across, whichever of the two is given.
TEST_P(DrivenPair, HasForcesAndCreepagesAsTwoWaysOfSayingOneState) {
  const std::string pair = geometry() + "[drive]\nspin = \"0.12 1/m\"\n";
  const ContactSummary both = solved(pair + "creepage = -0.001\nlateral_creepage = 0.0005\n", 0.5e-3).summary.contact;
  EXPECT_GT(both.F_x, 0);
  EXPECT_LT(both.lateral_force, 0) << "friction holds a wheel back that slips towards the field side";
  const auto same = [&](const std::string& drive) {
    const Answer s = solved(pair + drive, 0.5e-3);
    const ContactSummary& c = s.summary.contact;
    EXPECT_NEAR(c.creepage_x, -1e-3, 2e-7) << drive;
    EXPECT_NEAR(c.creepage_y, 5e-4, 2e-7) << drive;
    EXPECT_NEAR(c.F_x / both.F_x, 1, 1e-4) << drive;
    EXPECT_NEAR(c.lateral_force / both.lateral_force, 1, 1e-4) << drive;
    for (const Check& check : s.summary.checks) EXPECT_TRUE(check.ok) << check.name << drive;
  };
  same(fmt::format("tractive_force = \"{} N\"\nlateral_force = \"{} N\"\n", both.F_x, both.lateral_force));
  same(fmt::format("traction_coefficient = {}\nlateral_creepage = 0.0005\n", both.F_x / 85e3));
  same(fmt::format("creepage = -0.001\nlateral_traction_coefficient = {}\n", both.lateral_force / 85e3));
}

// F_x = -G c² C11 xi, F_y = -G c² (C22 eta + c C23 phi) on the wheel, for creepages so small that nearly all sticks;
// the error of the cells is of first order.
TEST(DrivenCase, SmallCreepagesMeetKalkersCoefficientsWithinOnePercent) {
  constexpr double kSmall = 2e-6;
  int rows = 0;
  for (const ReferenceRow& r : reference_table("kalker_table_E3.csv")) {
    const double ratio = r.at("a_over_b");
    if (r.at("nu") != 0.25 || (ratio != 0.5 && ratio != 1)) continue;
    const double a = 5e-3 * std::sqrt(ratio), b = 5e-3 / std::sqrt(ratio), shear = 210e9 / 2.5;
    const HertzGap gap = hertz_gap(a, b, contact_modulus({210e9, 0.25}, {210e9, 0.25}), kLoad);
    const std::string text = "[material.rail]\npoisson = 0.25\n[material.wheel]\npoisson = 0.25\n" +
                             quadratic_pair(gap.A, gap.B) +
                             fmt::format("wheel_load = \"{} N\"\n[drive]\nfriction_coefficient = 2\n", kLoad);
    const auto coefficient = [&](const std::string& drive, double ContactSummary::*force, double divisor) {
      const auto on_cells = [&](double cell) {
        const Answer s = solved(text + drive, cell);
        double area = 0;
        for (double p : s.result.field.p) area += p > 0 ? cell * cell : 0;
        return -(s.summary.contact.*force) / (shear * std::pow(area / std::numbers::pi, divisor)) / kSmall;
      };
      return 2 * on_cells(0.125e-3) - on_cells(0.25e-3);
    };
    const std::string lateral = "creepage = 0.0\n";
    EXPECT_NEAR(coefficient("spin = \"0 1/m\"\ncreepage = 2e-6\n", &ContactSummary::F_x, 1) / r.at("C11"), 1, 0.01);
    EXPECT_NEAR(
        coefficient(lateral + "spin = \"0 1/m\"\nlateral_creepage = 2e-6\n", &ContactSummary::lateral_force, 1) /
            r.at("C22"),
        1, 0.01);
    EXPECT_NEAR(coefficient(lateral + "spin = \"2e-6 rad/m\"\n", &ContactSummary::lateral_force, 1.5) / r.at("C23"), 1,
                0.01);
    ++rows;
  }
  EXPECT_EQ(rows, 2);
}

TEST_P(DrivenPair, SlidesUnderALargeCreepageAlongIt) {
  const std::string pair = geometry() + "[drive]\nspin = \"0 1/m\"\n";
  const ContactSummary locked = solved(pair + "creepage = 1.0\n", 0.5e-3).summary.contact;
  EXPECT_NEAR(locked.F_x / (-kFriction * locked.normal_force), 1, 1e-5) << "a locked wheel brakes";
  EXPECT_EQ(locked.patch.slip_area_fraction, 1);
  const ContactSummary aslant = solved(pair + "creepage = -0.3\nlateral_creepage = 0.4\n", 0.5e-3).summary.contact;
  constexpr double kElastic = 1e-3;  // the bodies' own slip of the order of f p / G turns the direction a little
  EXPECT_NEAR(aslant.F_x / (0.6 * kFriction * aslant.normal_force), 1, kElastic);
  EXPECT_NEAR(aslant.lateral_force / (-0.8 * kFriction * aslant.normal_force), 1, kElastic);
}

// Turning a wheel by psi is sliding it sideways by -psi, but for the bodies' shapes: without traction and spin these
// change its force with the cube of psi.
TEST(DrivenCase, YawOnAFlatContactIsLateralCreepage) {
  const std::string pair = quadratic_pair(1.92, 0.675) + "wheel_load = \"85 kN\"\n[drive]\ntraction_coefficient = 0\n";
  const auto with = [&](const std::vector<std::string>& overrides) {
    return solved(pair, 0.5e-3, overrides).summary.contact;
  };
  const ContactSummary yawed = with({"geometry.yaw=\"1 mrad\""}), slipping = with({"drive.lateral_creepage=-1e-3"});
  EXPECT_NEAR(yawed.creepage_y, -1e-3, 1e-9);
  EXPECT_GT(yawed.lateral_force, 0) << "a wheel that steers to the field side is pushed there";
  EXPECT_NEAR(yawed.lateral_force / slipping.lateral_force, 1, 1e-4);
  EXPECT_EQ(with({"geometry.yaw=\"1 mrad\"", "drive.lateral_creepage=0"}).creepage_y, 0) << "what is given counts";
}

// The wheelset turns once with the curve: 1/R about the vertical.
TEST_P(DrivenPair, AddsACurvesCurvatureToTheSpin) {
  const std::string base = geometry() + "[drive]\ntraction_coefficient = 0.1\n";
  const ContactSummary straight = solved(base, 0.5e-3).summary.contact;
  const ContactSummary inner = solved(base, 0.5e-3, {"geometry.curve_radius=\"300 m\""}).summary.contact;
  EXPECT_NEAR(inner.spin_per_m - straight.spin_per_m, std::cos(straight.contact_angle) / 300, 1e-6)
      << "and turns the plane a little, by its friction";
  EXPECT_EQ(
      solved(base, 0.5e-3, {"geometry.curve_radius=\"300 m\"", "drive.spin=\"0.1 1/m\""}).summary.contact.spin_per_m,
      0.1);
}

}  // namespace
}  // namespace railstrata
