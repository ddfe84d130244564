#include "steady/pass_class.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace railstrata {
namespace {

std::vector<PassStrain> passes(int count, double (*accumulated)(double), double (*net)(double)) {
  std::vector<PassStrain> all;
  for (int n = 1; n <= count; ++n) all.push_back({accumulated(n), net(n)});
  return all;
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
  EXPECT_EQ(words(PassClass::transient), "transient: no claim yet");
}

}  // namespace
}  // namespace railstrata
