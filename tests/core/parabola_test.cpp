#include "core/parabola.hpp"

#include <gtest/gtest.h>

namespace railstrata {
namespace {

// f(t) = 3 - 2 (t - 0.3)²
TEST(ParabolaTop, FindsTheTopOfAParabola) {
  const auto f = [](double t) { return 3 - 2 * (t - 0.3) * (t - 0.3); };
  const ParabolaTop uneven = parabola_top(-1, f(-1), 0, f(0), 0.7, f(0.7));
  EXPECT_NEAR(uneven.at, 0.3, 1e-14);
  EXPECT_NEAR(uneven.above, 3 - f(0), 1e-14);
  const ParabolaTop even = parabola_top(f(-1), f(0), f(1));
  EXPECT_NEAR(even.at, 0.3, 1e-14);
  EXPECT_NEAR(even.above, 3 - f(0), 1e-14);
}

TEST(ParabolaTop, OfALineOrAValleyIsTheMiddlePoint) {
  for (const double f0 : {0.0, 2.0}) {
    const ParabolaTop uneven = parabola_top(1, f0, 2, 1, 4, f0 == 0 ? 3 : 2), even = parabola_top(f0, 1, 2);
    EXPECT_EQ(uneven.at, 2);
    EXPECT_EQ(uneven.above, 0);
    EXPECT_EQ(even.at, 0);
    EXPECT_EQ(even.above, 0);
  }
}

}  // namespace
}  // namespace railstrata
