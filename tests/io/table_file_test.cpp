#include "io/table_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>

#include "core/faults.hpp"
#include "tests/places.hpp"

namespace railstrata {
namespace {

namespace fs = std::filesystem;

class TableFile : public ::testing::Test {
 protected:
  std::string content() const {
    std::ifstream in(file_, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  void put(const std::string& bytes) const { std::ofstream(file_, std::ios::binary) << bytes; }
  const TemporaryFolder folder_;
  const fs::path file_ = folder_.path() / "table.h5";
};

ForceTable sample() {
  return {{{"creepage_x", "", {-0.01, 0, 0.02}}, {"load", "N", {50e3, 1e5}}},
          {{"force_x", "N", {1, 2, 3, NAN, 5, 6}}, {"slip", "", {0, 0.1, 0.2, 0.3, 0.4, 0.5}}}};
}

}  // namespace

TEST_F(TableFile, IsReadBackAsItWasWritten) {
  write_force_table(file_, sample(), {{"origin", "a test"}});
  const ForceTable back = read_force_table(file_);
  ASSERT_EQ(back.axes.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(back.axes[k].name, sample().axes[k].name);
    EXPECT_EQ(back.axes[k].unit, sample().axes[k].unit);
    EXPECT_EQ(back.axes[k].at, sample().axes[k].at);
    EXPECT_EQ(back.numbers[k].name, sample().numbers[k].name);
    EXPECT_EQ(back.numbers[k].unit, sample().numbers[k].unit);
  }
  EXPECT_TRUE(std::isnan(back.numbers[0].values[3]));
  EXPECT_EQ(back.numbers[0].values[5], 6);
  EXPECT_EQ(back.numbers[1].values, sample().numbers[1].values);
}

TEST_F(TableFile, HasTheSameBytesForTheSameTable) {
  write_force_table(file_, sample(), {{"origin", "a test"}});
  const std::string first = content();
  write_force_table(file_, sample(), {{"origin", "a test"}});
  EXPECT_EQ(content(), first);
}

TEST_F(TableFile, ThatIsNoTableIsRefused) {
  EXPECT_THROW(read_force_table(file_), CaseError) << "there is none";
  put("no table at all");
  EXPECT_THROW(read_force_table(file_), CaseError);
  write_force_table(file_, sample(), {});
  const std::string whole = content();
  put(whole.substr(0, whole.size() / 2));
  EXPECT_THROW(read_force_table(file_), CaseError);
}

}  // namespace railstrata
