#include "many/axis.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>

#include "core/faults.hpp"
#include "options/option_table.hpp"

namespace railstrata {

TEST(Axis, ValuesMayStandInQuotesAsInACaseFile) {
  for (const char* text :
       {"layer.0.thickness=1 mm, 3 mm", "layer.0.thickness=\"1 mm, 3 mm\"", "layer.0.thickness = \"1 mm\",'3 mm'"}) {
    const std::vector<Axis> keys = parse_axes("--vary", {text});
    ASSERT_EQ(keys.size(), 1u);
    EXPECT_EQ(keys[0].key, "layer.0.thickness");
    EXPECT_EQ(keys[0].values, (std::vector<std::string>{"1 mm", "3 mm"})) << text;
  }
}

TEST(Axis, TakesAWordForAKeyAndARangeForItsValues) {
  const std::vector<Axis> axes =
      parse_axes("--vary", {"friction=0.1:0.3:3", "load=log 10:1000 kN:3", "creepage_x=+-0.01:3", "geometry.cant=1:40",
                            "geometry.wheel_profile=arc:R=430 mm:2"});
  EXPECT_EQ(axes[0].key, "drive.friction_coefficient");
  EXPECT_EQ(axes[0].values, (std::vector<std::string>{"0.1", "0.2", "0.3"}));
  EXPECT_EQ(axes[1].values, (std::vector<std::string>{"10 kN", "100 kN", "1000 kN"}));
  EXPECT_EQ(axes[2].values, (std::vector<std::string>{"-0.01", "0", "0.01"}));
  EXPECT_EQ(axes[3].values, (std::vector<std::string>{"1:40"})) << "a slope";
  EXPECT_EQ(axes[4].values, (std::vector<std::string>{"arc:R=430 mm:2"})) << "a text";
  EXPECT_THROW(parse_axes("--vary", {"load=log -1:1 kN:3"}), CaseError);
  EXPECT_THROW(parse_axes("--vary", {"friction=0.1,0.2", "drive.friction_coefficient=0.3"}), CaseError);
}

TEST(Axis, ARangeOfRotationsKeepsItsUnit) {
  const std::vector<Axis> axes = parse_axes("--vary", {"drive.wheel_rotation=10:20 rad/s:2"});
  EXPECT_EQ(axes[0].values, (std::vector<std::string>{"10 rad/s", "20 rad/s"}));
}

TEST(Axis, EveryOptionAndColumnHasAnSiUnit) {
  EXPECT_EQ(si_unit(option_of_key("layer.0.thickness")->dimension), "m");
  EXPECT_EQ(si_unit(option_of_key("drive.friction_coefficient")->dimension), "");
  EXPECT_EQ(option_of_key("layer.0.thicknes"), nullptr);
  for (const OptionTable& table : case_tables())
    for (const Option& option : table.options) {
      EXPECT_NO_THROW(si_unit(option.dimension)) << table.name << '.' << option.key;
      for (const Option& column : option.columns)
        EXPECT_NO_THROW(si_unit(column.dimension)) << option.key << '.' << column.key;
    }
}

TEST(Axis, AKeyWithoutValuesIsRefused) {
  for (const std::vector<std::string>& values : {std::vector<std::string>{}, {""}, {"1 mm", ""}}) {
    try {
      combinations({{"drive.speed", {"1 m/s"}}, {"layer.0.thickness", values}});
      FAIL() << "values: " << values.size();
    } catch (const CaseError& e) {
      EXPECT_NE(std::string(e.what()).find("layer.0.thickness"), std::string::npos) << e.what();
    }
  }
  EXPECT_EQ(combinations({}).size(), 1u);
}

TEST(AxisValue, IsTheNumberAndItsUnit) {
  EXPECT_EQ(axis_value("0.2 mm"), (std::pair<double, std::string>(0.2, "mm")));
  EXPECT_EQ(axis_value("1.67"), (std::pair<double, std::string>(1.67, "")));
  EXPECT_TRUE(std::isnan(axis_value("full").first));
}

}  // namespace railstrata
