// Tests that need a card. Without one they are skipped with the reason; the same checks run on the emulated device in
// extras/device/tests/engine_test.cpp.
#include "device/card.hpp"

#include <gtest/gtest.h>

#include "core/faults.hpp"
#include "extras/device/tests/engine_checks.hpp"

namespace railstrata::device {

using namespace device_checks;

class Card : public testing::Test {
 protected:
  void SetUp() override {
    try {
      device = open_card();
    } catch (const EnvironmentError& e) {
      GTEST_SKIP() << e.what();
    }
  }
  std::unique_ptr<Device> device;
};

TEST_F(Card, ForcesAreThoseOfTheTraversal) {
  expect_same_forces(*device, ArithmeticPrecision::double_precision, 1e-12);
}

TEST_F(Card, InSinglePrecisionToItsRounding) {
  expect_same_forces(*device, ArithmeticPrecision::single_precision, 5e-4);
}

TEST_F(Card, StepsAreThoseOfTheStepper) { expect_same_steps(*device); }

TEST_F(Card, InSinglePrecisionDisplacementsAndPressuresAre) { expect_same_steps_in_single_precision(*device); }

TEST_F(Card, CheckpointsGoEitherWay) { expect_checkpoints_go_either_way(*device); }

TEST_F(Card, TenRunsHaveTheSameBits) {
  const RollingSystem system = small_system(layered_case(ArithmeticPrecision::double_precision));
  const PreloadResult preload = solve_preload(system, 1e-3);
  Stepper first(system, preload);
  first.use(on(*device));
  roll(first, 40);
  for (int run = 1; run < 10; ++run) {
    Stepper other(system, preload);
    other.use(on(*device));
    roll(other, 40);
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_TRUE(same_bits(first.state().bodies[k].u, other.state().bodies[k].u));
      EXPECT_TRUE(same_bits(first.state().bodies[k].v, other.state().bodies[k].v));
    }
  }
}

}  // namespace railstrata::device
