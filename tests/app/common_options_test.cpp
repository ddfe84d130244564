#include "app/common_options.hpp"

#include <gtest/gtest.h>

#include "core/faults.hpp"

namespace railstrata {

TEST(OptionValues, ACellIsALengthBetweenTheLimitsOrTheEnginesOwn) {
  EXPECT_DOUBLE_EQ(cell_size("0.5 mm"), 0.5e-3);
  EXPECT_DOUBLE_EQ(cell_size(""), 0.25e-3);
  EXPECT_THROW(cell_size("0.01 mm"), CaseError);
  EXPECT_THROW(cell_size("6 mm"), CaseError);
  EXPECT_THROW(cell_size("0.5"), CaseError);
}

TEST(OptionValues, AWallTimeIsATimeOrNever) {
  EXPECT_DOUBLE_EQ(wall_time("--max-time", "10 min"), 600);
  EXPECT_EQ(wall_time("--max-time", "never"), 0);
  EXPECT_EQ(wall_time("--max-time", "0"), 0);
  EXPECT_THROW(wall_time("--max-time", "-5 min"), CaseError);
  try {
    wall_time("--max-time", "5");
    FAIL();
  } catch (const CaseError& e) {
    EXPECT_TRUE(e.diagnostics.front().message.starts_with("--max-time \"5\":")) << e.what();
  }
}

}  // namespace railstrata
