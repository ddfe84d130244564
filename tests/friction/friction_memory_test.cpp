#include "friction/friction_memory.hpp"

#include <gtest/gtest.h>

#include <complex>
#include <iterator>
#include <numbers>
#include <vector>

#include "friction/friction_step.hpp"

namespace railstrata {
namespace {

constexpr double kShare = 0.4, kHalf = 0.8, kDistance = 20e-6, kLeast = 1e-3;
const FallingFriction kLaws[] = {{FrictionForm::falling_exponential, kShare, kHalf, kDistance, kLeast},
                                 {FrictionForm::falling_rational, kShare, kHalf, kDistance, kLeast}};

// At constant v the excess over the law's share decays as exp(-s/d) with the way s, in however many steps it is slid.
TEST(FrictionMemory, FollowsTheLawOverItsDistance) {
  for (const FallingFriction& law : kLaws)
    for (const double v : {0.02, 0.5, 30.0})
      for (const int steps : {1, 7, 100}) {
        const double aim = 1 - friction_share(law, v).value, way = 1.7 * kDistance;
        double lost = 0;
        for (int i = 0; i < steps; ++i) lost = lost_after(law, lost, v, way / v / steps);
        EXPECT_NEAR(lost, aim * (1 - std::exp(-1.7)), 1e-13);
        for (int i = 0; i < 40; ++i) lost = lost_after(law, lost, v, kDistance / v);
        EXPECT_NEAR(lost, aim, 1e-12);
      }
}

TEST(FrictionMemory, ComesBackAtRestByItsLeastVelocity) {
  for (const FallingFriction& law : kLaws) {
    EXPECT_NEAR(lost_after(law, 0.5, 0, kDistance / kLeast), 0.5 * std::exp(-1.0), 1e-14);
    FallingFriction never = law;
    never.memory_velocity = 0;
    EXPECT_EQ(lost_after(never, 0.5, 0, 1e9), 0.5);
  }
}

// Steps by the backward rule come to the exact decay from above, to first order in their length.
TEST(FrictionMemory, BackwardStepsGoTowardsTheExactDecay) {
  for (FallingFriction law : kLaws) {
    const double v = 0.5, aim = 1 - friction_share(law, v).value, exact = aim * (1 - std::exp(-1.0));
    law.implicit_memory = true;
    EXPECT_NEAR(lost_after(law, 0, v, kDistance / v), aim / 2, 1e-14);
    const auto error = [&](int steps) {
      double lost = 0;
      for (int i = 0; i < steps; ++i) lost = lost_after(law, lost, v, kDistance / v / steps);
      return exact - lost;
    };
    EXPECT_GT(error(100), 0);
    EXPECT_NEAR(error(100) / error(200), 2, 0.02);
  }
}

// Without a distance the law itself, to the last bit; over a long one friction stays that at rest.
TEST(FrictionMemory, LiesBetweenTheLawAndFrictionAtRest) {
  for (FallingFriction law : kLaws)
    for (const double v : {0.0, 0.1, 5.0}) {
      law.memory_distance = 0;
      const RememberedShare at_once = remembered_share(law, 0.3, v, 1e-6);
      EXPECT_EQ(at_once.share.value, friction_share(law, v).value);
      EXPECT_EQ(at_once.share.by_slip_velocity, friction_share(law, v).by_slip_velocity);
      EXPECT_EQ(at_once.by_lost_before, 0);
      law.memory_distance = 1e-15;
      EXPECT_NEAR(remembered_share(law, 0.3, v, 1e-6).share.value, friction_share(law, v).value, 1e-12);
      law.memory_distance = 1e9;
      EXPECT_NEAR(lost_after(law, 0, v, 1.0), 0, 1e-8);
    }
  EXPECT_EQ(lost_after({}, 0.3, 1.0, 1.0), 0) << "Coulomb's law has no memory";
}

TEST(FrictionMemory, DerivativesAreTheSlopes) {
  const double dt = 3e-5, h = 1e-6;
  std::vector<FallingFriction> laws(std::begin(kLaws), std::end(kLaws));
  for (FallingFriction law : kLaws) {
    law.implicit_memory = true;
    laws.push_back(law);
  }
  for (const FallingFriction& law : laws)
    for (const double lost : {0.0, 0.35})
      for (const double v : {0.1, 0.7, 4.0}) {
        const auto value = [&](double before, double velocity) {
          return remembered_share(law, before, velocity, dt).share.value;
        };
        const RememberedShare at = remembered_share(law, lost, v, dt);
        EXPECT_NEAR(at.share.by_slip_velocity, (value(lost, v + h) - value(lost, v - h)) / (2 * h), 1e-8);
        EXPECT_NEAR(at.by_lost_before, (value(lost - h, v) - value(lost + h, v)) / (2 * h), 1e-8);
      }
}

// What slid in one step is felt in the next.
TEST(FrictionMemory, TakesItsShareOfTheDisc) {
  const FrictionLaws laws{0.5, {}, kLaws[0]};
  double q1 = 3e9, q2 = 4e9;
  EXPECT_TRUE(return_to_law(laws, {1e9, 2e-8, 2e-7, 0, 0.25}, q1, q2).slips);
  EXPECT_NEAR(std::hypot(q1, q2), 0.75 * 0.5 * 1e9, 1.0);
}

TEST(FrictionMemory, SteepestFallIsThatOfALongStepOrOfTheDistance) {
  for (const FallingFriction& law : kLaws) {
    FallingFriction at_once = law;
    at_once.memory_distance = 0;
    const double own = -friction_share(law, 0).by_slip_velocity;
    EXPECT_EQ(steepest_fall(at_once, 1e-6), own);
    EXPECT_NEAR(steepest_fall(law, 1.0) / own, 1, 1e-3) << "a step of many distances";
    // Of a step much shorter than the distance (1 - m_kin)(dt/d) times the largest slope of v (1 - left(v)), with left
    // 2^(-v/v_half) or 1/(1 + v/v_half): 1 + exp(-2) or 1.
    FallingFriction step = law;
    step.half_velocity = 1e-7;
    step.memory_velocity = 0;
    const double largest = law.form == FrictionForm::falling_exponential ? 1 + std::exp(-2.0) : 1.0;
    EXPECT_NEAR(steepest_fall(step, 1e-5) / ((1 - kShare) * 1e-5 / kDistance), largest, 1e-2);
  }
}

/// Whether a disturbance of the wave number k of steady sliding at v grows: the roots of the header's equation.
bool grows(const FallingFriction& law, double bound, const SlidingWaves& w, double k, double v) {
  const double eta = 0.5 * std::sqrt(w.shear_modulus * w.density), K = 0.5 * w.shear_modulus * k,
               fall = -bound * friction_share(law, v).by_slip_velocity, way = law.memory_distance / v;
  const std::complex<double> a = eta * way, b = eta + K * way - fall, root = std::sqrt(b * b - 4.0 * a * K);
  return std::max(((-b + root) / (2.0 * a)).real(), ((-b - root) / (2.0 * a)).real()) > 0;
}

TEST(FrictionMemory, StableDistancePartsGrowthFromDecayOfTheLongestWave) {
  const SlidingWaves steel{79e9, 7850, 24e-3};
  const double bound = 0.5e9;
  for (FallingFriction law : kLaws) {
    law.memory_distance = stable_memory_distance(law, bound, steel);
    EXPECT_GT(law.memory_distance, 5e-6);
    EXPECT_LT(law.memory_distance, 50e-6);
    const auto any_grows = [&](double distance) {
      FallingFriction other = law;
      other.memory_distance = distance;
      for (double v = 1e-3 * kHalf; v < 1e3 * kHalf; v *= 1.01)
        for (const double shorter : {1.0, 3.0, 100.0})
          if (grows(other, bound, steel, 2 * std::numbers::pi * shorter / steel.longest, v)) return true;
      return false;
    };
    EXPECT_FALSE(any_grows(1.01 * law.memory_distance));
    EXPECT_TRUE(any_grows(0.99 * law.memory_distance));
  }
  FallingFriction gentle = kLaws[0];
  gentle.half_velocity = 100;
  EXPECT_EQ(stable_memory_distance(gentle, bound, steel), 0) << "waves carry it away";
}

}  // namespace
}  // namespace railstrata
