#include "study/variation.hpp"

#include <gtest/gtest.h>

#include <string>

#include "core/faults.hpp"

namespace railstrata {

TEST(Variation, ValuesMayStandInQuotesAsInACaseFile) {
  for (const char* text :
       {"layer.0.thickness=1 mm, 3 mm", "layer.0.thickness=\"1 mm, 3 mm\"", "layer.0.thickness = \"1 mm\",'3 mm'"}) {
    const std::vector<VariedKey> keys = parse_vary({text});
    ASSERT_EQ(keys.size(), 1u);
    EXPECT_EQ(keys[0].key, "layer.0.thickness");
    EXPECT_EQ(keys[0].values, (std::vector<std::string>{"1 mm", "3 mm"})) << text;
  }
}

TEST(Variation, AKeyWithoutValuesIsRefused) {
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

}  // namespace railstrata
