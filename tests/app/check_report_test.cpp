#include "app/check_report.hpp"

#include <gtest/gtest.h>

#include "reader/case_file.hpp"

namespace railstrata {
namespace {

AxleOnTrack axle(const std::string& keys) {
  const CaseSpec spec =
      parse_case("[geometry]\nwheel_profile = \"S1002\"\nrail_profile = \"UIC60\"\n" + keys, "a.toml").spec;
  return axle_of(spec, place(spec, {}));
}

}  // namespace

TEST(AxleReport, ACentredAxleRollsStraightWithoutCreepage) {
  const AxleOnTrack a = axle("");
  EXPECT_DOUBLE_EQ(a.radius_difference, 0);
  EXPECT_DOUBLE_EQ(a.here.creepage_x, 0);
  EXPECT_DOUBLE_EQ(a.here.contact.rolling_radius, a.other.contact.rolling_radius);
}

TEST(AxleReport, TheOtherWheelIsThatOfTheMirroredCase) {
  const AxleOnTrack a = axle("lateral_shift = \"3 mm\"\nyaw = \"2 mrad\"\ncurve_radius = \"-600 m\"\n"),
                    b = axle("lateral_shift = \"-3 mm\"\nyaw = \"-2 mrad\"\ncurve_radius = \"600 m\"\n");
  EXPECT_DOUBLE_EQ(a.other.contact.rolling_radius, b.here.contact.rolling_radius);
  EXPECT_DOUBLE_EQ(a.other.creepage_x, b.here.creepage_x);
  EXPECT_DOUBLE_EQ(a.other.creepage_y, b.here.creepage_y);
  EXPECT_DOUBLE_EQ(a.other.spin, b.here.spin);
}

TEST(AxleReport, AnAxleThatRunsOutOfACurveHasTheLargerRadiusOutside) {
  const AxleOnTrack a = axle("lateral_shift = \"5 mm\"\ncurve_radius = \"-600 m\"\n");  // this wheel is the outer one
  EXPECT_LT(a.radius_difference, 0);
  EXPECT_NEAR(a.wanted_difference, -1.5 * 0.46 / 600, 2e-6);
  EXPECT_NEAR(a.here.creepage_x + a.other.creepage_x, 0, 1e-15);
  const AxleOnTrack straight = axle("lateral_shift = \"5 mm\"\n");
  EXPECT_GT(a.here.creepage_x, straight.here.creepage_x);  // the outer rail is longer
}

}  // namespace railstrata
