#include "core/shell_word.hpp"

#include <gtest/gtest.h>

namespace railstrata {
namespace {

TEST(ShellWord, IsQuotedWhereAShellWouldReadItDifferently) {
  EXPECT_EQ(shell_word("results/a-1.5_b"), "results/a-1.5_b");
  EXPECT_EQ(shell_word("my run"), "'my run'");
  EXPECT_EQ(shell_word("it's"), "'it'\\''s'");
  EXPECT_EQ(shell_word("$HOME"), "'$HOME'");
  EXPECT_EQ(shell_word(""), "''");
}

}  // namespace
}  // namespace railstrata
