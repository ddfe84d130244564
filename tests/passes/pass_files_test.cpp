#include "passes/pass_files.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "core/faults.hpp"
#include "tests/places.hpp"

namespace railstrata {
namespace {

SteadyGrid small_grid() {
  SteadyGrid g{.nx = 12, .ny = 3, .dx = 1e-3, .dy = 1e-3, .front = 4e-3, .y0 = -1e-3, .active = 2e-3, .hold = 2e-3};
  g.thickness = {5e-4, 5e-4};
  return g;
}

/// After two passes; numbers that no rounding of texts would keep.
PassSeries series_of(const SteadyGrid& g) {
  PassSeries series;
  series.state.passes = 2;
  series.state.history.resize(g.points() * kStreamlineHistory);
  series.state.residual_strain.resize(6 * g.points() * static_cast<std::size_t>(g.active_stations()));
  double v = 1e-3;
  for (double& x : series.state.history) x = v = std::sin(1 / v);
  for (double& x : series.state.residual_strain) x = v = std::sin(1 / v);
  PassResult pass;
  pass.accumulated.assign(g.points(), std::sqrt(2e-6));
  pass.net.assign(g.points(), std::sqrt(3e-7));
  pass.residual_stress.resize(g.points());
  pass.plastic_strain.resize(g.points());
  pass.forward = pass.lateral = pass.sinking = {1e-6, -2e-6, 0};
  for (int n = 1; n <= 2; ++n) add_pass(pass_row(g, n, pass), pass, series);
  return series;
}

class PassFiles : public ::testing::Test {
 protected:
  const TemporaryFolder temporary_;
  const std::filesystem::path folder_ = temporary_.path();
};

TEST_F(PassFiles, StateAndTableAreReadBackToTheSameBits) {
  const SteadyGrid g = small_grid();
  PassSeries series = series_of(g);
  write_pass_state(folder_ / "state.csv", {}, g, series);
  const CsvTable table = series.table;
  for (CsvColumn& c : series.table.columns) c.values.push_back(c.values.back());  // a table that has gone on
  write_csv(folder_ / "passes.csv", {}, series.table.columns);
  const PassSeries back = read_pass_series(folder_ / "state.csv", folder_ / "passes.csv", g);
  EXPECT_EQ(back.state.passes, 2);
  EXPECT_TRUE(back.state.history == series.state.history);
  EXPECT_TRUE(back.state.residual_strain == series.state.residual_strain);
  ASSERT_EQ(back.table.columns.size(), table.columns.size());
  for (std::size_t c = 0; c < table.columns.size(); ++c)
    EXPECT_EQ(back.table.columns[c].values, table.columns[c].values) << c;
  ASSERT_EQ(back.strains.size(), 2u);
  EXPECT_EQ(back.strains[1].net, series.strains[1].net);
  ASSERT_EQ(back.cycles.size(), 2u);
  EXPECT_EQ(back.cycles[1].accumulated, series.cycles[1].accumulated);
  ASSERT_EQ(back.points[3].size(), 2u);
  EXPECT_EQ(back.points[3][1].net, series.points[3][1].net);
  EXPECT_EQ(back.begun, series.begun);
}

TEST_F(PassFiles, TheStateOfASeriesWithJumpsIsReadBackAndJumpedPassesLieOnAPower) {
  const SteadyGrid g = small_grid();
  PassSeries series = series_of(g);
  series.jump.length = 7;
  series.jump.error = 1 / 3.0;
  std::vector<double> history = series.state.history;
  for (double& x : history) x += 1e-3 / 3;
  jump_over(6, history, series);
  EXPECT_EQ(series.state.passes, 8);
  EXPECT_EQ(series.begun[2][3], history[2 * kStreamlineHistory + 3]);
  PassResult pass;
  pass.accumulated.assign(g.points(), std::sqrt(2e-6) / 9);
  pass.net.assign(g.points(), std::sqrt(3e-7) / 9);
  pass.residual_stress.resize(g.points());
  pass.plastic_strain.resize(g.points());
  pass.forward = pass.lateral = pass.sinking = {0, 0, 0};
  series.state.passes = 9;
  add_pass(pass_row(g, 9, pass), pass, series);
  ASSERT_EQ(series.strains.size(), 9u);
  const double power = std::log(1 / 9.0) / std::log(9.0 / 2);
  EXPECT_NEAR(series.strains[3].net, std::sqrt(3e-7) * std::pow(4.0 / 2, power), 1e-15);
  write_csv(folder_ / "passes.csv", {}, series.table.columns);
  write_pass_state(folder_ / "state.csv", {}, g, series);
  const PassSeries back = read_pass_series(folder_ / "state.csv", folder_ / "passes.csv", g);
  EXPECT_EQ(back.table.rows(), 3u);
  EXPECT_TRUE(back.state.history == series.state.history);
  EXPECT_EQ(back.jump.length, 7);
  EXPECT_EQ(back.jump.error, 1 / 3.0);
  ASSERT_EQ(back.strains.size(), 9u);
  EXPECT_EQ(back.strains[3].net, series.strains[3].net);
  EXPECT_EQ(back.cycles[5].accumulated, series.cycles[5].accumulated);
}

/// To and fro by 1e-3 in turn: every pass has a net strain, a cycle of two has none.
TEST_F(PassFiles, APlanOfSeveralPassesIsJudgedByWholeCycles) {
  const SteadyGrid g = small_grid();
  PassSeries series;
  series.cycle = 2;
  PassResult pass;
  pass.accumulated.assign(g.points(), 1e-3);
  pass.net.assign(g.points(), 1e-3);
  pass.residual_stress.resize(g.points());
  pass.forward = pass.lateral = pass.sinking = {0, 0, 0};
  for (int n = 1; n <= 9; ++n) {
    pass.plastic_strain.assign(g.points(), {n % 2 == 1 ? 1e-3 : 0, 0, 0, 0, 0, 0});
    add_pass(pass_row(g, n, pass), pass, series);
  }
  ASSERT_EQ(series.cycles.size(), 4u);
  EXPECT_DOUBLE_EQ(series.cycles[3].accumulated, 2e-3);
  EXPECT_EQ(series.cycles[3].net, 0);
  EXPECT_EQ(verdict_of(series).kind, PassClass::plastic_shakedown);
  EXPECT_EQ(classify(series.points[0]).kind, PassClass::plastic_shakedown);
}

TEST_F(PassFiles, AStateThatIsNotOfThisGridOrNotWholeIsRefused) {
  const SteadyGrid g = small_grid();
  PassSeries series = series_of(g);
  write_csv(folder_ / "passes.csv", {}, series.table.columns);
  write_pass_state(folder_ / "state.csv", {}, g, series);
  SteadyGrid other = g;
  other.ny = 4;
  EXPECT_THROW(read_pass_series(folder_ / "state.csv", folder_ / "passes.csv", other), CaseError);
  series.state.history[5] = std::nan("");
  write_pass_state(folder_ / "state.csv", {}, g, series);
  EXPECT_THROW(read_pass_series(folder_ / "state.csv", folder_ / "passes.csv", g), CaseError);
  series.state.history[5] = 0;
  series.state.passes = 7;  // the table has two
  write_pass_state(folder_ / "state.csv", {}, g, series);
  EXPECT_THROW(read_pass_series(folder_ / "state.csv", folder_ / "passes.csv", g), CaseError);
}

}  // namespace
}  // namespace railstrata
