#include "core/nearest_word.hpp"

#include <gtest/gtest.h>

namespace railstrata {
namespace {

TEST(NearestWord, OneSlipOfTheFingersIsOneEdit) {
  EXPECT_EQ(edit_distance("gauge", "gauge"), 0);
  EXPECT_EQ(edit_distance("gauge", "guage"), 1);   // swapped
  EXPECT_EQ(edit_distance("gauge", "gage"), 1);    // left out
  EXPECT_EQ(edit_distance("gauge", "gaugee"), 1);  // put in
  EXPECT_EQ(edit_distance("gauge", "gouge"), 1);   // replaced
  EXPECT_EQ(edit_distance("", "cant"), 4);
}

TEST(NearestWord, CapitalsDoNotCount) { EXPECT_EQ(edit_distance("LMA", "lma"), 0); }

TEST(NearestWord, OfSeveralTheNearestIsMeant) {
  EXPECT_EQ(nearest_word("chekc", {"check", "mesh", "info"}), "check");
  EXPECT_EQ(nearest_word("UIC06", {"CN60", "UIC54", "UIC60"}), "UIC60");
}

TEST(NearestWord, AWordThatBeginsAnotherIsMeant) {
  EXPECT_EQ(nearest_word("friction", {"cant", "friction_coefficient"}), "friction_coefficient");
}

TEST(NearestWord, AVeryLongWordCostsNoMoreThanToReadIt) {
  EXPECT_EQ(nearest_word(std::string(100'000'000, 'x'), {"friction_coefficient"}), "");
}

TEST(NearestWord, AWordUnlikeAllOthersIsNotGuessed) {
  EXPECT_EQ(nearest_word("banana", {"check", "mesh", "info"}), "");
  EXPECT_EQ(nearest_word("x", {}), "");
}

}  // namespace
}  // namespace railstrata
