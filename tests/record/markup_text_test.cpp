#include "record/markup_text.hpp"

#include <gtest/gtest.h>

namespace railstrata {
namespace {

TEST(MarkupText, ReadsAsItselfBetweenTagsAndInsideQuotes) {
  EXPECT_EQ(markup_text("a < b & \"c\" > 'd'"), "a &lt; b &amp; &quot;c&quot; > 'd'");
  EXPECT_EQ(markup_text(""), "");
}

}  // namespace
}  // namespace railstrata
