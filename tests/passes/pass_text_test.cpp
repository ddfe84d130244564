#include "passes/pass_series.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "damage/low_cycle.hpp"

namespace railstrata {
namespace {

PassProgress standing(PassClass kind) {
  PassProgress s;
  s.verdict = {kind, 3.1e-4, 0.5};
  s.last.pass = 12;
  s.last.net_depth = 2.14e-3;
  s.last.largest.accumulated = 2.8e-3;
  s.ever_yielded = true;
  s.first_quiet = 5;
  return s;
}

TEST(PassText, EachClassIsOneSentenceWithItsNumberAndPlace) {
  EXPECT_EQ(describe(standing(PassClass::ratchetting)),
            "Ratchets: 3.1e-4 net strain per pass at 2.1 mm depth, the same from pass to pass.");
  EXPECT_EQ(describe(standing(PassClass::elastic_shakedown)), "Shakes down: no plastic flow from pass 5 on.");
  EXPECT_EQ(describe(standing(PassClass::plastic_shakedown)),
            "Closed cycles (plastic shakedown): 2.8e-3 plastic strain in every pass, 3.1e-4 of it remains: low-cycle "
            "fatigue, a grade, a tensile_strength or passes.ductility would give its life by Coffin and Manson.");
  EXPECT_EQ(describe(standing(PassClass::transient)),
            "Still settling: 3.1e-4 net strain in pass 12 at 2.1 mm depth, falling as the pass to the power of -0.50; "
            "more passes will show.");
  PassProgress scattered = standing(PassClass::transient);
  scattered.verdict.trend = 0.01;
  EXPECT_EQ(describe(scattered), "No claim yet: 3.1e-4 net strain in pass 12 at 2.1 mm depth; more passes will show.");
  PassProgress strong = standing(PassClass::elastic_shakedown);
  strong.ever_yielded = false;
  EXPECT_EQ(describe(strong), "Stays elastic: no point has yielded.");
}

TEST(PassText, ClosedCyclesHaveALifeByCoffinAndManson) {
  PassProgress s = standing(PassClass::plastic_shakedown);
  s.last.largest.accumulated = 4e-3;
  s.ductility = 0.1;  // (2 N) = 100^2 and 100^(1/0.7)
  EXPECT_NE(describe(s).find("360 to 5000 passes until a crack"), std::string::npos) << describe(s);
  EXPECT_EQ(low_cycle_life(0.5, 0.1).most, 0) << "the first reversal is too much";
}

// Amplitude 1e-3 of e_f = 0.1: 2 N = 100^(1/0.5) by one curve, 100^(1/0.7) by the other.
TEST(PassText, ACurveThatIsGivenGoesBeforeDuctilityAndAnEstimateAfterIt) {
  PassProgress s = standing(PassClass::plastic_shakedown);
  s.last.largest.accumulated = 4e-3;
  s.strain_life = StrainLifeOfMaterial{{1e9, -0.1, 0.1, -0.5}, {1e9, -0.1, 0.1, -0.7}, "estimates"};
  EXPECT_NE(describe(s).find("360 to 5000 passes until a crack by Coffin and Manson, estimates"), std::string::npos)
      << describe(s);
  s.ductility = 0.05;
  EXPECT_NE(describe(s).find("passes.ductility = 0.05"), std::string::npos) << describe(s);
  s.strain_life->other = s.strain_life->life;
  s.strain_life->note = "";
  EXPECT_NE(describe(s).find("fatigue, 5000 passes until a crack"), std::string::npos) << describe(s);
}

TEST(PassText, LargeStrainFollowsTheClass) {
  PassProgress s = standing(PassClass::elastic_shakedown);
  s.last.strain = 0.06;
  EXPECT_NE(describe(s).find("from pass 5 on. Plastic strain reaches 6.0 %: "), std::string::npos) << describe(s);
  s.last.strain = 0.12;
  EXPECT_NE(describe(s).find("from pass 5 on. No claim of accuracy: plastic strain reaches 12.0 %"), std::string::npos)
      << describe(s);
}

TEST(PassText, ALawIsDescribedByWhatItAllows) {
  PlasticParameters<double> law{80e9, 300e6, 0, 0, {}, {}};
  EXPECT_NE(describe_law(law).find("perfect plasticity"), std::string::npos);
  law.saturation = 50e6;
  EXPECT_NE(describe_law(law).find("isotropic"), std::string::npos);
  law.modulus[0] = 60e9;
  law.recall[0] = 250;
  EXPECT_NE(describe_law(law).find("Armstrong"), std::string::npos);
  law.power = 3;
  EXPECT_NE(describe_law(law).find("Ohno"), std::string::npos);
  law.power = 0;
  law.modulus[1] = 1e9;  // without recall: its backstress grows without limit
  EXPECT_NE(describe_law(law).find("linear kinematic"), std::string::npos);
  law.yield = std::numeric_limits<double>::infinity();
  EXPECT_NE(describe_law(law).find("elastic"), std::string::npos);
}

}  // namespace
}  // namespace railstrata
