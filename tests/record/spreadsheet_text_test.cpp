#include "record/spreadsheet_text.hpp"

#include <gtest/gtest.h>

namespace railstrata {
namespace {

TEST(SpreadsheetText, FormulasGetAnApostrophe) {
  for (const char* formula :
       {"=1+1", "=cmd|' /C calc'!A0", "@SUM(A1)", "+cmd|x", "-2+3", "-cmd", "\t=1", "\r=1", "+", "-1:40=x", "-5 mm+A1"})
    EXPECT_EQ(without_formula(formula), std::string("'") + formula);
}

TEST(SpreadsheetText, NumbersQuantitiesAndWordsStayAsTheyAre) {
  for (const char* text : {"", "-5 mm", "+0.3", "-1e-3", "-0.025", "1:40", "-1:40", "-2 %", "a=b", "x@y", "3 - 4"})
    EXPECT_EQ(without_formula(text), text);
}

}  // namespace
}  // namespace railstrata
