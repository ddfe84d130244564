// Tables through the C interface.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "creep/creep_table.hpp"
#include "io/table_file.hpp"
#include "tests/capi/contact_handle.hpp"

namespace railstrata {
namespace {

namespace fs = std::filesystem;

class CTable : public ::testing::Test {
 protected:
  void SetUp() override {
    write_force_table(file_,
                      {{{"creepage_x", "", {-0.01, 0, 0.02}}, {"load", "N", {50e3, 1e5}}},
                       {{"force_x", "N", {10, 20, 0, 0, -20, -40}}}},
                      {});
  }
  const TemporaryFolder folder_;
  const fs::path file_ = folder_.path() / "table.h5";
};

}  // namespace

TEST_F(CTable, AnswersByNamesUnitsAndEnds) {
  rs_error error;
  rs_table* table = rs_table_open(file_.c_str(), &error);
  ASSERT_TRUE(table) << error.message;
  ASSERT_EQ(rs_table_axes(table), 2);
  EXPECT_STREQ(rs_table_axis(table, 1), "load");
  EXPECT_STREQ(rs_table_axis_unit(table, 1), "N");
  EXPECT_EQ(rs_table_axis_first(table, 0), -0.01);
  EXPECT_EQ(rs_table_axis_last(table, 0), 0.02);
  ASSERT_EQ(rs_table_numbers(table), 1);
  EXPECT_STREQ(rs_table_number(table, 0), "force_x");
  EXPECT_STREQ(rs_table_number_unit(table, 0), "N");
  const double inside[] = {0.005, 75e3}, beyond[] = {0.5, 75e3}, nothing[] = {NAN, 75e3};
  double force = 0;
  EXPECT_EQ(rs_table_at(table, inside, &force), 0);
  EXPECT_NEAR(force, -7.5, 1e-12);
  EXPECT_EQ(rs_table_at(table, beyond, &force), 1);
  EXPECT_NEAR(force, -30, 1e-12);
  EXPECT_EQ(rs_table_at(table, nothing, &force), -1);
  EXPECT_EQ(rs_table_at(table, inside, nullptr), -1);
  EXPECT_EQ(rs_table_axis(table, 2), nullptr);
  EXPECT_EQ(rs_table_number(table, -1), nullptr);
  rs_table_close(table);
  rs_table_close(nullptr);
}

TEST_F(CTable, InScaledCreepagesIsAskedForPlainOnes) {
  ForceTable scaled{scaled_axes(4, 5, 4), {{"approach", "m", {}}, {"force_x", "N", {}}}};
  scaled.axes.push_back({"load", "N", {50e3, 1e5}});
  scaled.scaling = {{{{"creepage_x", "", {-0.01, 0.01}}, {"creepage_y", "", {-0.02, 0.02}}, {"spin", "1/m", {-1, 1}}}},
                    {{{"creep_stiffness_x", "N^(1/3)", {4e3, 5e3}},
                      {"creep_stiffness_y", "N^(1/3)", {4e3, 5e3}},
                      {"creep_stiffness_spin", "m", {0.2, 0.3}}}},
                    0.8,
                    -0.7,
                    0.7,
                    0,
                    0.3};
  for (std::size_t k = 0; k < scaled.points(); ++k) {
    scaled.numbers[0].values.push_back(1e-4 + 1e-7 * static_cast<double>(k));
    scaled.numbers[1].values.push_back(static_cast<double>(k * k % 71));
  }
  write_force_table(file_, scaled, {});
  rs_error error;
  rs_table* table = rs_table_open(file_.c_str(), &error);
  ASSERT_TRUE(table) << error.message;
  ASSERT_EQ(rs_table_axes(table), 4);
  EXPECT_STREQ(rs_table_axis(table, 1), "creepage_y");
  EXPECT_STREQ(rs_table_axis(table, 3), "load");
  EXPECT_EQ(rs_table_axis_last(table, 2), 1);
  ASSERT_EQ(rs_table_numbers(table), 2) << "stiffnesses are none";
  const double at[] = {-0.003, 0.004, 0.1, 70e3};
  double read[2], held[2];
  EXPECT_EQ(rs_table_at(table, at, read), 0);
  TableInterpolation(scaled).at(at, held);
  EXPECT_EQ(read[0], held[0]);
  EXPECT_EQ(read[1], held[1]);
  rs_table_close(table);
}

struct CTableOf : OfBothPairs {};
INSTANTIATE_TEST_SUITE_P(Pairs, CTableOf, testing::ValuesIn(kBothPairs), OfBothPairs::name);

TEST_P(CTableOf, HasTheForcesOfAContactAtItsPoints) {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "table.h5";
  CreepTable solved(
      load_case(kQuick, {GetParam().begin(), GetParam().end()}),
      parse_number_axes("--axis", {"creepage_x=-1e-3,2e-4,1e-3", "lateral_shift=0,1 mm", "load=60 kN,90 kN"}));
  CreepTableOptions options;
  options.bem.cell = 0.5e-3;
  solved.solve(options);
  write_force_table(file, solved.table(), {});
  Handle contact(GetParam());
  rs_table* table = rs_table_open(file.c_str(), &contact.error);
  ASSERT_TRUE(table) << contact.error.message;
  std::vector<double> numbers(static_cast<std::size_t>(rs_table_numbers(table)));
  const auto number = [&](const std::string& name) {
    for (int k = 0; k < rs_table_numbers(table); ++k)
      if (name == rs_table_number(table, k)) return numbers[static_cast<std::size_t>(k)];
    ADD_FAILURE() << name;
    return 0.0;
  };
  rs_state state = state_of(RS_CREEPAGE_X | RS_LATERAL_SHIFT | RS_LOAD);
  for (const double creepage : {-1e-3, 2e-4, 1e-3})
    for (const double shift : {0.0, 1e-3})
      for (const double load : {60e3, 90e3}) {
        const double at[] = {creepage, shift, load};
        EXPECT_EQ(rs_table_at(table, at, numbers.data()), 0);
        state.creepage_x = creepage;
        state.lateral_shift = shift;
        state.load = load;
        ASSERT_EQ(contact.solve(state), RS_OK) << contact.error.message;
        EXPECT_NEAR(number("force_x"), contact.forces.force_x, 1e-4 * load) << creepage << " " << shift;
        EXPECT_NEAR(number("lateral_force"), contact.forces.lateral_force, 1e-4 * load) << creepage << " " << shift;
        EXPECT_NEAR(number("normal_force"), contact.forces.normal_force, 1e-4 * load) << creepage << " " << shift;
      }
  rs_table_close(table);
}

TEST_F(CTable, ThatIsNotThereIsRefusedWithTheRemedy) {
  rs_error error;
  EXPECT_EQ(rs_table_open("/nowhere/creep_table.h5", &error), nullptr);
  EXPECT_EQ(error.code, RS_CASE);
  EXPECT_NE(std::string(error.message).find("remedy: name a creep_table.h5"), std::string::npos) << error.message;
  EXPECT_EQ(rs_table_open(nullptr, &error), nullptr);
}

}  // namespace railstrata
