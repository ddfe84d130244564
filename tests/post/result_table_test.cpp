#include "post/result_table.hpp"

#include <gtest/gtest.h>

#include <set>

#include "post/check_limits.hpp"

namespace railstrata {
namespace {

TEST(ResultTable, NamesNoNumberTwiceAndDescribesEachOne) {
  std::set<std::string> paths, names, columns;
  for (const ResultNumber& n : result_numbers()) {
    EXPECT_TRUE(paths.insert(n.path()).second) << n.path();
    EXPECT_TRUE(names.insert(std::string(n.name)).second) << n.name;
    EXPECT_FALSE(n.label.empty() || n.doc.empty()) << n.path();
    EXPECT_FALSE(n.doc.ends_with('.')) << n.doc;
  }
  for (const ResultColumn& c : table_columns()) EXPECT_TRUE(columns.insert(c.name).second) << c.name;
}

TEST(ResultTable, MakesKeysAndColumnsFromOneSymbol) {
  const ResultNumber& p = result_numbers().at(1);
  EXPECT_EQ(p.key(), "p_max_Pa");
  EXPECT_EQ(p.path(), "/contact/p_max_Pa");
  EXPECT_EQ(p.column_name(), "p_max_MPa");
}

// The head of sweep.csv and of study.csv, which scripts and recorded results read; new columns may stand between them.
TEST(ResultTable, KeepsTheColumnsOfTables) {
  const std::string known =
      "p_max_MPa,q_max_MPa,patch_length_mm,patch_width_mm,patch_area_mm2,slip_area_fraction,F_x_kN,F_y_kN,F_z_kN,"
      "normal_force_kN,lateral_force_kN,creepage_x,spin_per_m,approach_um,rail_surface_von_mises_MPa,"
      "rail_surface_sigma_1_MPa,rail_subsurface_von_mises_MPa,rail_subsurface_von_mises_depth_mm,"
      "rail_layer_von_mises_MPa,rail_layer_sigma_1_MPa,rail_interface_von_mises_MPa,rail_matrix_von_mises_MPa,"
      "wall_s,";
  std::string head;
  for (const ResultColumn& c : table_columns())
    if (("," + known).find("," + c.name + ",") != std::string::npos) head += c.name + ",";
  EXPECT_EQ(head, known);
}

TEST(ResultTable, WritesNumbersAsPeopleReadThem) {
  EXPECT_EQ(with_unit(result_unit::kMPa, 931.26e6, 4), "931.3 MPa");
  EXPECT_EQ(with_unit(result_unit::kShare, 0.04, 3), "4.00 %");
  EXPECT_EQ(limit_text(result_unit::kShare, 0.04), "4 %");
  EXPECT_EQ(with_unit(result_unit::kInside, 0, 3), "inside");
  EXPECT_EQ(with_unit(result_unit::kInside, 1, 3), "outside");
  EXPECT_EQ(significant(0, 4), "0");
  EXPECT_EQ(significant(-1.23456e-5, 3), "-1.23e-05");
  EXPECT_EQ(significant(kNotApplicable, 4), "-");
}

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
