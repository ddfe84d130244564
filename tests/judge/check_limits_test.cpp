#include "judge/check_limits.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace railstrata {
namespace {

TEST(CheckRows, NameNoCheckTwiceAndHaveALimitOrSayWhereItComesFrom) {
  std::set<std::string_view> keys, names;
  for (const CheckRow& c : kCheckRows) {
    EXPECT_TRUE(keys.insert(c.key).second) << c.key;
    EXPECT_TRUE(names.insert(c.name).second) << c.name;
    const bool limited = !std::isnan(c.fem_limit) || !std::isnan(c.bem_limit) || !c.case_option.empty();
    EXPECT_EQ(limited, c.kind != CheckKind::note) << c.key;
    EXPECT_EQ(c.kind == CheckKind::warning, !c.advice.empty()) << c.key;
  }
  EXPECT_EQ(find_check("p_max_of_another_version"), nullptr);
}

}  // namespace
}  // namespace railstrata
