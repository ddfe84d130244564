#include "app/progress.hpp"

#include <gtest/gtest.h>

namespace railstrata {
namespace {

TEST(Progress, DurationsAreToldInTheTwoUnitsThatMatter) {
  EXPECT_EQ(duration_text(2.6), "3 s");
  EXPECT_EQ(duration_text(125), "2 min 05 s");
  EXPECT_EQ(duration_text(3725), "1 h 02 min");
  EXPECT_EQ(duration_text(-1), "0 s");
}

TEST(Progress, TheTimeLeftIsTheTimeSpentScaledByWhatIsLeft) {
  EXPECT_EQ(progress_bar("rolling", 0.25, 10), "rolling  [#######-----------------------]  25 %  30 s left");
  EXPECT_EQ(progress_bar("rolling", 0, 10), "rolling  [------------------------------]   0 %  ");
  EXPECT_EQ(progress_bar("rolling", 0.75, 10, 0.5),
            "rolling  [######################--------]  75 %  10 s left");  // a run that was resumed
  EXPECT_EQ(progress_bar("rolling", 0.5, 0.1, 0.5), "rolling  [###############---------------]  50 %  ");
  EXPECT_EQ(progress_bar("rolling", 1.2, 10), "rolling  [##############################] 100 %  0 s left");
}

}  // namespace
}  // namespace railstrata
