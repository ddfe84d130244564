#include "damage/wear_indices.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/faults.hpp"
#include "halfspace/hertz.hpp"

namespace railstrata {
namespace {

TEST(TGammaOfPatch, CountsSpinOnlyWhereItIsSaid) {
  // braking wheel: slips forward over the rail, friction backward
  const TGamma t = t_gamma({-10e3, -2e3, -5, 0.002, 0.003, 0.4});
  EXPECT_DOUBLE_EQ(t.without_spin, 20 + 6);
  EXPECT_DOUBLE_EQ(t.with_spin, 28);
  EXPECT_DOUBLE_EQ(t.energy, 28) << "all three dissipate";
}

TEST(TGammaOfPatch, EnergyHasTheSignOfEachTerm) {
  const TGamma t = t_gamma({-10e3, 1e3, -5, 0.002, 0.001, 0.4});  // spin's lateral force acts along eta
  EXPECT_DOUBLE_EQ(t.with_spin, 20 + 1 + 2);
  EXPECT_DOUBLE_EQ(t.energy, 20 - 1 + 2);
}

TEST(RcfDamage, PresetsHaveTheirPublishedValues) {
  EXPECT_NEAR(rcf_damage(rcf_damage_15(), 40), 5e-6, 1e-18);
  EXPECT_NEAR(rcf_damage(rcf_damage_20(), 40), 4.444e-6, 1e-9);
  for (const auto& f : {rcf_damage_15(), rcf_damage_15_clipped(), rcf_damage_20()}) {
    EXPECT_NEAR(rcf_damage(f, 120), 5e-6, 1e-18);
    EXPECT_NEAR(rcf_damage(f, 65), 1e-5, 1e-18);
    EXPECT_EQ(rcf_damage(f, 10), 0);
    EXPECT_NEAR(rcf_damage(f, 175), 0, 1e-18);
  }
  const double slope = rcf_damage(rcf_damage_15(), 276) - rcf_damage(rcf_damage_15(), 275);
  EXPECT_NEAR(slope, -9.09e-8, 1e-10) << "wear removes cracks";
  EXPECT_EQ(rcf_damage(rcf_damage_15_clipped(), 275), 0);
  EXPECT_EQ(rcf_damage(rcf_damage_20(), 275), 0);
  EXPECT_NEAR(rcf_damage(rcf_damage_20(), 30) - rcf_damage(rcf_damage_20(), 29), 2.22e-7, 1e-9);
}

TEST(RcfDamage, AFaultyTableIsNamedByItsRow) {
  const auto message = [](const RcfDamageFunction& f) {
    try {
      rcf_damage(f, 50);
    } catch (const CaseError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_NE(message({{{15, 0}}, false}).find("two break points"), std::string::npos);
  EXPECT_NE(message({{{15, 0}, {65, 1e-5}, {65, 0}}, false}).find("row 3"), std::string::npos);
  EXPECT_NE(message({{{-15, 0}, {65, 1e-5}}, false}).find("row 1"), std::string::npos);
  EXPECT_NE(message({{{15, 0}, {65, std::nan("")}}, false}).find("row 2"), std::string::npos);
}

TEST(BrrWear, HasItsThreeBranchesAndItsJump) {
  const double diameter = 0.92, unit = 1e-9 / 920;  // mm²/km with D in mm
  EXPECT_NEAR(brr_wear(60, diameter), 15 * unit, 1e-12 * unit);
  EXPECT_NEAR(brr_wear(100, diameter), 25 * unit, 1e-12 * unit);
  EXPECT_NEAR(brr_wear(200, diameter), 25 * unit, 1e-12 * unit);
  EXPECT_NEAR(brr_wear(200.0001, diameter), 84 * unit, 1e-3 * unit);
  EXPECT_NEAR(brr_wear(300, diameter), 203 * unit, 1e-9 * unit);
  EXPECT_THROW(brr_wear(300, 0), std::invalid_argument);
}

// FI_surf = mu - k/p0 with p0 of Hertz's own solution; FI_sub from its definition.
TEST(EkbergIndices, AreThoseOfHertz) {
  const HertzContact hertz = hertz_contact(1.1, 1.7, 115e9, 100e3);
  const EllipticPatch patch{hertz.a, hertz.b, hertz.load, 0.35};
  EXPECT_NEAR(surface_fatigue_index(patch, 280e6), 0.35 - 280e6 / hertz.p0, 1e-12);
  const double sub = 100e3 * (1 + 0.35 * 0.35) / (4 * std::numbers::pi * hertz.a * hertz.b) + 0.3 * -50e6;
  EXPECT_NEAR(subsurface_fatigue_index(patch, 0.3, -50e6), sub, 1e-9 * sub);
  EXPECT_THROW(surface_fatigue_index({0, 1e-3, 1e5, 0}, 280e6), std::invalid_argument);
}

}  // namespace
}  // namespace railstrata
