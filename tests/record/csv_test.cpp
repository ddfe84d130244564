#include "record/csv.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <limits>
#include <stdexcept>

#include "core/faults.hpp"
#include "tests/places.hpp"

namespace railstrata {
namespace {

namespace fs = std::filesystem;

class Csv : public ::testing::Test {
 protected:
  std::string content() const {
    std::ifstream in(file_);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  const TemporaryFolder folder_;
  const fs::path file_ = folder_.path() / "table.csv";
};

TEST_F(Csv, a_table_has_provenance_lines_a_header_and_rows) {
  write_csv(file_, {"made by a test", "two\nlines"}, {{"x_m", {0, 0.1}}, {"pressure_MPa", {1e3, -2.5}}});
  EXPECT_EQ(content(), "# made by a test\n# two\n# lines\nx_m,pressure_MPa\n0,1000\n0.1,-2.5\n");
}

TEST_F(Csv, numbers_read_back_to_the_same_doubles) {
  const std::vector<double> values = {
      1.0 / 3, M_PI * 1e-300, -0.1, 1e22, std::nextafter(1.0, 2.0), std::numeric_limits<double>::denorm_min(), -0.0};
  write_csv(file_, {}, {{"a", values}});
  std::ifstream in(file_);
  std::string line;
  std::getline(in, line);
  for (const double v : values) {
    std::getline(in, line);
    const double back = std::strtod(line.c_str(), nullptr);
    EXPECT_EQ(back, v) << line;
    EXPECT_EQ(std::signbit(back), std::signbit(v));
  }
}

TEST_F(Csv, a_log_shows_every_row_at_once) {
  CsvLog log(file_, {"run 1"}, {"time_s", "F_z_N"});
  EXPECT_EQ(content(), "# run 1\ntime_s,F_z_N\n");
  log.add({0.001, 85e3});
  EXPECT_EQ(content(), "# run 1\ntime_s,F_z_N\n0.001,85000\n");
  EXPECT_THROW(log.add({1.0}), std::invalid_argument);
}

TEST_F(Csv, unequal_columns_and_names_with_commas_are_refused) {
  EXPECT_THROW(write_csv(file_, {}, {{"a", {1}}, {"b", {}}}), std::invalid_argument);
  EXPECT_THROW(write_csv(file_, {}, {{"a,b", {1}}}), std::invalid_argument);
  EXPECT_FALSE(fs::exists(file_));
}

TEST_F(Csv, a_table_reads_back_with_its_names_and_numbers) {
  const std::vector<double> values = {1.0 / 3, -1e22, 0};
  write_csv(file_, {"made by a test"}, {{"a_mm", values}, {"b", {1, 2, std::nan("")}}});
  const CsvTable table = read_csv(file_);
  EXPECT_EQ(table.rows(), 3u);
  EXPECT_EQ(table.column("a_mm"), values);
  EXPECT_EQ(table.column("b", 1e-3)[1], 2e-3);
  EXPECT_TRUE(std::isnan(table.column("b")[2]));
  EXPECT_THROW(table.column("c"), CaseError);
}

TEST_F(Csv, what_does_not_apply_is_left_empty_and_read_back_as_no_number) {
  {
    CsvLog log(file_, {}, {"a", "b", "c"});
    log.add({1, std::nan(""), 3});
    log.add({std::nan(""), 2, std::nan("")});
  }
  std::ifstream in(file_);
  std::stringstream text;
  text << in.rdbuf();
  EXPECT_EQ(text.str(), "a,b,c\n1,,3\n,2,\n");
  const CsvTable table = read_csv(file_);
  EXPECT_TRUE(std::isnan(table.column("b")[0]));
  EXPECT_EQ(table.column("b")[1], 2);
  EXPECT_TRUE(std::isnan(table.column("a")[1]));
}

TEST_F(Csv, a_broken_table_is_refused_with_its_line) {
  EXPECT_THROW(read_csv(file_), CaseError) << "no such file";
  for (const char* row : {"1", "1,2,3", "1,x", "1;2"}) {
    std::ofstream(file_) << "# origin\na,b\n1,2\n" << row << "\n";
    try {
      read_csv(file_);
      ADD_FAILURE() << row;
    } catch (const CaseError& e) {
      EXPECT_EQ(std::string(e.what()).find(file_.string() + ":4: a row of 2 numbers is expected"), 0u) << e.what();
    }
  }
}

// A row that a crash has torn behind a comma has no end of line; an empty last field has one.
TEST_F(Csv, a_torn_row_is_refused) {
  std::ofstream(file_) << "a,b\n1,2\n1,";
  EXPECT_THROW(read_csv(file_), CaseError);
  std::ofstream(file_) << "a,b\n1,2\n1,\n";
  EXPECT_EQ(read_csv(file_).rows(), 2u);
}

TEST(CsvLogOnAFullDisk, says_which_file) {
  CsvLog log("/dev/null", {}, {"a"});
  EXPECT_NO_THROW(log.add({1.0}));
  try {
    CsvLog full("/dev/full", {}, {"a"});
    FAIL();
  } catch (const EnvironmentError& e) {
    EXPECT_STREQ(e.what(), "cannot write /dev/full: No space left on device");
  }
}

}  // namespace
}  // namespace railstrata
