#include "result/result_table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

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

Summary of_sizes(double force, double creepage) {
  Summary s;
  s.contact.normal_force = 85e3;
  s.contact.patch = {};
  s.contact.patch.p_max = 1e9;
  s.contact.patch.length = 12e-3;
  s.contact.F_y = s.contact.lateral_force = force;
  s.contact.creepage_y = s.contact.spin_per_m = creepage;
  s.contact.spin_moment = force * 12e-3;
  return s;
}

double shown(std::string_view path, const Summary& s) { return shown_value(*find_number(path), s); }

// Forces that symmetry cancels to 1e-9 of the load, creepages to 1e-13; a result may be as small as 1e-6 of it.
TEST(ResultTable, ShowsZeroForWhatRoundOffLeavesAndNothingElse) {
  const Summary noise = of_sizes(1e-4, 1e-12), result = of_sizes(-0.085, 1e-7);
  for (const char* path : {"/contact/F_y_N", "/contact/lateral_force_N", "/contact/spin_moment_N_m",
                           "/contact/creepage_y", "/contact/spin_per_m"}) {
    EXPECT_EQ(shown(path, noise), 0) << path;
    EXPECT_NE(shown(path, result), 0) << path;
  }
  EXPECT_EQ(shown("/contact/F_y_N", result), -0.085);
  EXPECT_EQ(shown("/contact/normal_force_N", noise), 85e3);
  EXPECT_TRUE(std::isnan(shown("/contact/F_x_N", noise))) << "what does not apply stays so";
  Summary alone = of_sizes(1e-4, 0);
  alone.contact.normal_force = kNotApplicable;
  EXPECT_EQ(shown("/contact/F_y_N", alone), 1e-4) << "without a scale nothing is left out";
  EXPECT_EQ(find_number("/contact/nothing"), nullptr);
  for (const ResultNumber& n : result_numbers())
    for (const std::string_view path : {n.round_off.of, n.round_off.times})
      EXPECT_TRUE(path.empty() || find_number(path)) << n.path();
}

TEST(ResultTable, WritesNoSignBeforeZero) {
  EXPECT_EQ(fixed(-0.0004, 2), "0.00");
  EXPECT_EQ(fixed(-0.006, 2), "-0.01");
  EXPECT_EQ(fixed(12.345, 1), "12.3");
  EXPECT_EQ(shown_beside_limit(2.2e-16, 1e-4), 0);
  EXPECT_EQ(shown_beside_limit(4e-8, 1e-4), 4e-8);
  EXPECT_EQ(shown_beside_limit(1, 0), 1);
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
  EXPECT_EQ(with_unit(unit::kMPa, 931.26e6, 4), "931.3 MPa");
  EXPECT_EQ(with_unit(unit::kShare, 0.04, 3), "4.00 %");
  EXPECT_EQ(limit_text(unit::kShare, 0.04), "4 %");
  EXPECT_EQ(with_unit(unit::kInside, 0, 3), "inside");
  EXPECT_EQ(with_unit(unit::kInside, 1, 3), "outside");
  EXPECT_EQ(significant(0, 4), "0");
  EXPECT_EQ(significant(-1.23456e-5, 3), "-1.23e-05");
  EXPECT_EQ(significant(kNotApplicable, 4), "-");
}

}  // namespace
}  // namespace railstrata
