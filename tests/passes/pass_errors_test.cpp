#include "passes/pass_errors.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace railstrata {
namespace {

/// Passes whose numbers have an error of order p in the size of the grid: net strain 1e-3 (1 + 0.2 h^p), stress -200
/// MPa (1 - 0.1 h^p), depth 2 mm + 0.3 mm h.
ComparedPasses passes_of(double h, double p) {
  ComparedPasses out;
  out.coarser = h;
  const auto column = [&](const char* name, double value) {
    out.table.columns.push_back({name, {value, value, value, value, value}});
  };
  const double error = std::pow(h, p);
  out.table.columns.push_back({"pass", {1, 2, 3, 4, 5}});
  for (const char* name : {"accumulated_strain", "net_strain", "cycle_accumulated", "cycle_net"})
    column(name, 1e-3 * (1 + 0.2 * error));
  for (const char* name : {"sigma_x_min_MPa", "sigma_y_min_MPa"}) column(name, -200 * (1 - 0.1 * error));
  for (const char* name : {"net_depth_mm", "sigma_x_depth_mm", "sigma_y_depth_mm"}) column(name, 2 + 0.3 * h);
  column("sinking_um", 10 + error);
  out.strain = 0.01 * (1 + 0.1 * error);
  return out;
}

const std::vector<double> kRows(10, 0.4e-3);

}  // namespace

TEST(PassErrors, BarsHoldWhatErrorsOfFirstAndSecondOrderConvergeTo) {
  for (const double p : {1.0, 2.0}) {
    const PassErrors e = pass_errors(passes_of(1, p), {passes_of(2, p), passes_of(1.5, p)}, kRows);
    const double difference = std::pow(2, p) - 1;  // in units of the error
    EXPECT_NEAR(e.of("net_strain"), 1.25 * 0.2e-3 * difference, 1e-12) << p;
    EXPECT_NEAR(e.of("sigma_x_min_MPa"), 1.25 * 20 * difference, 1e-9) << p;
    EXPECT_NEAR(e.strain, 1.25e-3 * difference, 1e-12) << p;
    EXPECT_NEAR(e.of("net_depth_mm"), 0.4 + 1.25 * 0.3, 1e-9) << "a row, and the difference";
    EXPECT_TRUE(std::isnan(e.of("iterations")));
    EXPECT_EQ(e.classes.size(), 2u);
  }
}

TEST(PassErrors, ARateThatAgreesInOnePassHasTheErrorOfTheOnesBefore) {
  const ComparedPasses fine = passes_of(1, 1), coarse = passes_of(2, 1);
  ComparedPasses crossing = coarse;
  crossing.table.columns[2].values[4] = fine.table.columns[2].values[4];
  ASSERT_EQ(crossing.table.columns[2].name, "net_strain");
  EXPECT_NEAR(pass_errors(fine, {crossing}, kRows).of("net_strain"), 1.25 * 0.2e-3, 1e-12);
  ComparedPasses falling = fine, other = coarse;
  for (std::size_t n = 0; n < 5; ++n) {
    falling.table.columns[2].values[n] *= std::pow(0.5, n);
    other.table.columns[2].values[n] *= std::pow(0.5, n);
  }
  EXPECT_NEAR(pass_errors(falling, {other}, kRows).of("net_strain"), 1.25 * 0.2e-3 / 16, 1e-12) << "by its share";
}

TEST(PassErrors, ANumberFarFromConvergedIsNamedAndNoFlowIsNot) {
  const ComparedPasses fine = passes_of(1, 2);
  const PassErrors wide = pass_errors(fine, {passes_of(2, 2)}, kRows);  // 0.75e-3 of 1.2e-3, 75 of -180
  EXPECT_EQ(not_converged(wide, fine.table),
            (std::vector<std::string>{"accumulated strain", "net strain", "residual stress along",
                                      "residual stress across", "sinking"}));
  ComparedPasses quiet = fine, other = passes_of(2, 1);
  for (ComparedPasses* p : {&quiet, &other})
    for (std::size_t c : {1U, 2U}) p->table.columns[c].values.assign(5, p == &quiet ? 0 : 5e-7);
  const PassErrors nothing = pass_errors(quiet, {other}, kRows);
  EXPECT_NEAR(nothing.of("net_strain"), 1.25 * 5e-7, 1e-15);
  const std::vector<std::string> open = not_converged(nothing, quiet.table);
  EXPECT_EQ(std::count(open.begin(), open.end(), "net strain"), 0);
}

TEST(PassErrors, GridsToCompareAreWholeAndNotCoarserThanTwoCells) {
  PassesSpec passes;
  passes.patch_cells = 6;
  passes.first_row = 0.1e-3;
  EXPECT_EQ(coarser_grids(passes), (std::vector<double>{2, 1.5}));
  const PassesSpec half = on_coarser_grid(passes, 2);
  EXPECT_EQ(half.patch_cells, 3);
  EXPECT_EQ(half.patch_rows, 4);
  EXPECT_EQ(*half.first_row, 0.2e-3);
  passes.patch_cells = 3;
  EXPECT_EQ(coarser_grids(passes), (std::vector<double>{1.5}));
  passes.patch_cells = 2;
  EXPECT_TRUE(coarser_grids(passes).empty());
}

TEST(PassErrors, AStrainIsWrittenWithTheExponentOfBoth) {
  EXPECT_EQ(strain_text(3.14e-4, 0.41e-4), "3.1e-4 ± 0.4e-4");
  EXPECT_EQ(strain_text(3.14e-4, 0.024e-4), "3.1e-4 ± 0.02e-4");
  EXPECT_EQ(strain_text(3.14e-4, std::nan("")), "3.1e-4");
}

}  // namespace railstrata
