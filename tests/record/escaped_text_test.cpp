#include "record/escaped_text.hpp"

#include <gtest/gtest.h>

namespace railstrata {
namespace {

TEST(MarkupText, ReadsAsItselfBetweenTagsAndInsideQuotes) {
  EXPECT_EQ(markup_text("a < b & \"c\" > 'd'"), "a &lt; b &amp; &quot;c&quot; > 'd'");
  EXPECT_EQ(markup_text(""), "");
}

TEST(SpreadsheetText, FormulasGetAnApostrophe) {
  for (const char* formula :
       {"=1+1", "=cmd|' /C calc'!A0", "@SUM(A1)", "+cmd|x", "-2+3", "-cmd", "\t=1", "\r=1", "+", "-1:40=x", "-5 mm+A1"})
    EXPECT_EQ(without_formula(formula), std::string("'") + formula);
}

TEST(SpreadsheetText, NumbersQuantitiesAndWordsStayAsTheyAre) {
  for (const char* text : {"", "-5 mm", "+0.3", "-1e-3", "-0.025", "1:40", "-1:40", "-2 %", "a=b", "x@y", "3 - 4"})
    EXPECT_EQ(without_formula(text), text);
}

TEST(ShellWord, IsQuotedWhereAShellWouldReadItDifferently) {
  EXPECT_EQ(shell_word("results/a-1.5_b"), "results/a-1.5_b");
  EXPECT_EQ(shell_word("my run"), "'my run'");
  EXPECT_EQ(shell_word("it's"), "'it'\\''s'");
  EXPECT_EQ(shell_word("$HOME"), "'$HOME'");
  EXPECT_EQ(shell_word(""), "''");
}

}  // namespace
}  // namespace railstrata
