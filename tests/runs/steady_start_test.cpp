// A rolling that starts in the steady state (fem/steady_start.hpp, runs/steady_friction.hpp).
#include <gtest/gtest.h>

#include <cmath>

#include "core/faults.hpp"
#include "model/rolling_start.hpp"
#include "reader/case_file.hpp"
#include "runs/solve_fem.hpp"

namespace railstrata {
namespace {

// Six elements over the patch.
CaseSpec coarse_case(std::vector<std::string> more = {}) {
  std::vector<std::string> set{"geometry.lateral_shift=1.5 mm", "mesh.element_size=2 mm"};
  set.insert(set.end(), more.begin(), more.end());
  return parse_case("[[layer]]\nname = \"clad\"\nthickness = \"2 mm\"\nyoung_ratio = 2.0\n", "coarse.toml", set).spec;
}

struct Window {
  double ratio = 0, creepage = 0, F_z = 0;
};
Window mean_of(const std::vector<HistoryRow>& history, double from, double to) {
  Window out;
  int n = 0;
  for (const HistoryRow& row : history) {
    if (row.position < from || row.position >= to) continue;
    out.ratio += row.forces.x / row.forces.z;
    out.creepage += row.creepage;
    out.F_z += row.forces.z;
    ++n;
  }
  out.ratio /= n;
  out.creepage /= n;
  out.F_z /= n;
  return out;
}

}  // namespace

// From the first rows on what they are at the end: traction, load and creepage.
TEST(SteadyStart, BeginsWhereItEnds) {
  const CaseSpec spec = coarse_case({"run.positions=[\"50 mm\"]"});
  const RollingSystem system = fem_system(spec, ".");
  const FemSolution solution = solve_fem(system);
  const Window end = mean_of(solution.history, 0.040, 0.055);
  EXPECT_NEAR(end.ratio, 0.2, 0.002);
  for (double from = 0; from < 0.04; from += 0.008) {
    const Window here = mean_of(solution.history, from, from + 0.008);
    EXPECT_NEAR(here.ratio / end.ratio, 1, 0.01) << from;
    EXPECT_NEAR(here.F_z / end.F_z, 1, 0.01) << from;
    EXPECT_NEAR(here.creepage / end.creepage, 1, 0.015) << from;
  }
  EXPECT_LT(solution.positions.back().summary.energy.closure, 1e-3);
}

// The second window is whole at the earliest; later ones are added one by one.
TEST(SteadyStart, IsLikelyToEndWithTheWindowThatItIsIn) {
  const Model model = fem_system(coarse_case(), ".").model;
  const RunSpec& run = model.spec.run;
  ASSERT_GE(run.positions.size(), 4u);
  const auto end_of = [&](int window) { return run.positions[window] + 0.5 * run.window; };
  EXPECT_EQ(model.likely_end(), end_of(1));
  EXPECT_EQ(model.likely_end(run.positions[0]), end_of(1));
  EXPECT_EQ(model.likely_end(end_of(1)), end_of(2));
  EXPECT_EQ(model.likely_end(2 * model.x_end), model.x_end);
}

// Without positions the run ends where two windows repeat, with what they differ by as error bars.
TEST(SteadyStart, EndsWhenItsWindowsRepeat) {
  const RollingSystem system = fem_system(coarse_case(), ".");
  ASSERT_TRUE(system.model.until_repeated);
  const FemSolution solution = solve_fem(system);
  ASSERT_EQ(solution.positions.size(), 1u);
  const Summary& s = solution.positions.back().summary;
  EXPECT_LT(s.position, 0.9 * system.model.x_end);
  EXPECT_GT(s.contact.error.p_max, 0);
  EXPECT_LT(s.contact.error.p_max, 0.005 * s.contact.patch.p_max);
  EXPECT_LT(s.contact.error.creepage_x, 0.02 * std::abs(s.contact.creepage_x));
  EXPECT_NEAR(s.contact.F_x / s.contact.F_z, 0.2, 0.002);
}

TEST(SteadyStart, FromRestTheTorqueRises) {
  const CaseSpec spec = coarse_case({"run.start=rest", "run.run_up=2 mm", "run.positions=[\"8 mm\"]"});
  const FemSolution solution = solve_fem(fem_system(spec, "."));
  EXPECT_LT(std::abs(solution.history.front().forces.x), 0.01 * solution.history.front().forces.z);
  EXPECT_LT(solution.history.front().torque, 1e-3);
}

TEST(SteadyStart, SaysWhyItIsNone) {
  EXPECT_EQ(why_from_rest(coarse_case()), "");
  const auto why = [](const char* set) { return why_from_rest(coarse_case({set})); };
  EXPECT_EQ(why("run.start=rest"), "run.start = \"rest\"");
  EXPECT_EQ(why_from_rest(coarse_case({"drive.friction_coefficient=0", "drive.traction_coefficient=0"})),
            "there is no friction");
  EXPECT_EQ(why("drive.torque_ramp=1 ms"), "the case gives drive.torque_ramp");
  EXPECT_EQ(why("drive.creepage_start=-0.001"), "the case gives drive.creepage_start");
  EXPECT_EQ(why("drive.friction_coefficient=0.201"), "the wheel slides all over the patch");
  EXPECT_EQ(why("run.plasticity=true"), "materials yield");
  EXPECT_EQ(why("mesh.end_length=80 mm"), "the rail ends near the wheel (mesh.end_length below 100 mm)");
}

}  // namespace railstrata
