#include "steady/pass_class.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace railstrata {
namespace {

using OfPass = std::function<double(double)>;

std::vector<PassStrain> passes(int count, const OfPass& accumulated, const OfPass& net) {
  std::vector<PassStrain> all;
  for (int n = 1; n <= count; ++n) all.push_back({accumulated(n), net(n)});
  return all;
}

/// Tension by 2 % and simple shear by √3 · 2 % (engineering strain) count alike, and both as much as flows in them.
TEST(PassClass, NetStrainIsTheEquivalentStrainOfTheChange) {
  const double before[6] = {1e-3, 2e-3, -3e-3, 4e-3, 5e-3, 6e-3};
  const double tension[6] = {21e-3, -8e-3, -13e-3, 4e-3, 5e-3, 6e-3};
  const double shear[6] = {1e-3, 2e-3, -3e-3, 4e-3, 5e-3, 6e-3 + 0.01 * std::sqrt(3.0)};
  EXPECT_NEAR(net_strain(before, tension), 0.02, 1e-16);
  EXPECT_NEAR(net_strain(before, shear), 0.02, 1e-16);
}

TEST(PassClass, NothingFlowsIsElasticShakedown) {
  EXPECT_EQ(classify({{1e-3, 5e-4}, {0, 0}}).kind, PassClass::elastic_shakedown);
}

TEST(PassClass, ConstantNetStrainIsRatchettingWithItsRate) {
  const PassVerdict v = classify(passes(
      8, [](double) { return 3e-3; }, [](double) { return 2e-4; }));
  EXPECT_EQ(v.kind, PassClass::ratchetting);
  EXPECT_DOUBLE_EQ(v.rate, 2e-4);
  EXPECT_NEAR(v.trend, 0, 1e-12);
}

TEST(PassClass, ClosedCyclesArePlasticShakedown) {
  const auto all = passes(
      8, [](double) { return 3e-3; }, [](double n) { return 2e-3 * std::exp(-n); });
  EXPECT_EQ(classify(all).kind, PassClass::plastic_shakedown);
}

TEST(PassClass, APointHasNoClassWhileTheGoverningOneStillChanges) {
  const auto same = passes(
      8, [](double) { return 3e-3; }, [](double) { return 2e-4; });
  EXPECT_EQ(class_of_point(same, PassClass::ratchetting), PassClass::ratchetting);
  EXPECT_EQ(class_of_point(same, PassClass::transient), PassClass::transient);
  EXPECT_EQ(class_of_point({{1e-3, 5e-4}, {0, 0}}, PassClass::transient), PassClass::elastic_shakedown);
}

TEST(PassClass, NoClaimWhileItStillChangesOrAfterFewPasses) {
  const auto falling = passes(
      8, [](double) { return 3e-3; }, [](double n) { return 1e-3 / n; });
  EXPECT_EQ(classify(falling).kind, PassClass::transient);
  EXPECT_NEAR(classify(falling).trend, 1, 1e-9);
  EXPECT_EQ(classify(passes(
                         3, [](double) { return 3e-3; }, [](double) { return 2e-4; }))
                .kind,
            PassClass::transient);
  EXPECT_EQ(classify({}).kind, PassClass::transient);
  EXPECT_EQ(class_text(PassClass::transient), "transient: no claim yet");
}

TEST(PassClass, ARateThatFallsIsNoRatchettingThoughItsStepsAreSmall) {
  const auto constant = [](double) { return 3e-3; };
  const PassVerdict falling = classify(passes(60, constant, [](double n) { return 1e-3 * std::pow(n, -0.63); }));
  EXPECT_EQ(falling.kind, PassClass::transient) << "1 % from pass to pass";
  const PassVerdict slow = classify(passes(60, constant, [](double n) { return 1e-3 * std::pow(n, -0.03); }));
  EXPECT_EQ(slow.kind, PassClass::ratchetting);
}

TEST(PassClass, TheDuctilityIsUsedUpAtTheRateOfTheRatchetting) {
  const auto all = passes(
      8, [](double) { return 3e-3; }, [](double) { return 2e-4; });
  const DuctilityReach r = passes_to_ductility(0.1, 0.01, all);
  EXPECT_NEAR(r.passes, 8 + 0.09 / 2e-4, 1e-9);
  EXPECT_NEAR(r.earliest, r.passes, 1e-6);
  EXPECT_NEAR(r.latest, r.passes, 1e-6);
  EXPECT_EQ(passes_to_ductility(0.005, 0.01, all).passes, 8);
}

/// net = 1e-3 n^-1/2: its integral from 8 to N is 2e-3 (sqrt N - sqrt 8).
TEST(PassClass, AFallingRateGivesABandUpToWhereItsTrendLeads) {
  const auto all = passes(
      8, [](double) { return 3e-3; }, [](double n) { return 1e-3 / std::sqrt(n); });
  const DuctilityReach r = passes_to_ductility(0.1, 0, all);
  EXPECT_NEAR(r.latest, std::pow(0.1 / 2e-3 + std::sqrt(8.), 2), 1e-6 * r.latest);
  EXPECT_NEAR(r.passes, 8 + 0.1 * std::sqrt(8.) / 1e-3, 1e-9);
  EXPECT_NEAR(r.earliest, 8 + 0.1 * std::sqrt(5.) / 1e-3, 1e-9);  // the rate of pass 5
  const auto stops = passes(
      8, [](double) { return 3e-3; }, [](double n) { return 1e-3 / (n * n); });
  EXPECT_TRUE(std::isinf(passes_to_ductility(0.1, 0, stops).latest));
}

TEST(PassClass, WhatHasShakenDownUsesUpNothing) {
  const DuctilityReach r = passes_to_ductility(0.1, 0.01, {{1e-3, 5e-4}, {0, 0}});
  EXPECT_TRUE(std::isinf(r.passes));
  EXPECT_TRUE(std::isinf(r.earliest));
}

}  // namespace
}  // namespace railstrata
