#include "reader/assumed.hpp"

#include <gtest/gtest.h>

#include <string>

namespace railstrata {

TEST(Assumed, WhatTheCaseDoesNotGiveIsNamedWithItsValue) {
  const auto said = [](const std::string& text, const Use& use) { return assumed_in(parse_case(text, "a.toml"), use); };
  EXPECT_EQ(said("", uses::kHalfSpaces),
            "assumed, for the case does not give them: friction coefficient 0.5, wheel load 84.95 kN");
  EXPECT_EQ(said("[vehicle]\naxle_load = \"20 t\"\n[drive]\nfriction_coefficient = 0.5\n", uses::kHalfSpaces), "");
  EXPECT_EQ(said("[friction]\ncondition = \"wet\"\n[vehicle]\nwheel_load = \"85 kN\"\n", uses::kHalfSpaces), "");
  const std::string rows = "[[load]]\nwheel_load = \"80 kN\"\nfriction_coefficient = 0.3\n";
  EXPECT_EQ(said(rows, uses::kCollective),
            "assumed, for the case does not give them: wear factor 1 (dry laboratory surfaces)");
  EXPECT_EQ(said(rows + "[collective]\nwear_factor = 0.5\n", uses::kCollective), "");
}

}  // namespace railstrata
