// Solutions that start from the one before.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "bem/solve_bem.hpp"
#include "several_patches_cases.hpp"

namespace railstrata {
namespace {

/// Both ways of one case; the neighbour goes on to the next.
struct Successive {
  BemNeighbour neighbour{};
  int iterations_cold = 0, iterations_warm = 0;

  void expect_the_same(const CaseSpec& spec, const Placement& placement) {
    constexpr double kShare = 2e-5;  // of the load: twice the tolerance
    const BemResult cold = solve_bem(spec, placement, coarse());
    BemOptions options = coarse();
    options.neighbour = &neighbour;
    const BemResult warm = solve_bem(spec, placement, options);
    const Vec3 a = force_on_rail(cold), b = force_on_rail(warm);
    EXPECT_EQ(warm.further.size(), cold.further.size());
    EXPECT_NEAR(norm(b - a) / norm(a), 0, kShare);
    EXPECT_NEAR(warm.rigid_slip.x, cold.rigid_slip.x, 1e-7);
    for (std::size_t k = 0; k < cold.further.size() && k < warm.further.size(); ++k) {
      EXPECT_NEAR(warm.further[k].force.normal, cold.further[k].force.normal, kShare * spec.vehicle.load());
    }
    iterations_cold += cold.effort.load_iterations;
    iterations_warm += warm.effort.load_iterations;
  }
};

// One crown sinks away; forces are given in the first row, creepages in the second.
TEST(WarmPatches, OnTwoCrownsAreTheColdOnes) {
  for (const bool given_force : {true, false}) {
    CaseSpec spec = driven(0.05);
    if (!given_force) spec.drive.creepage = 1e-3;
    Successive way;
    for (double cant = 0.5e-3; cant < 1.2e-3; cant += 0.1e-3) way.expect_the_same(spec, two_crowns(cant, 0));
    EXPECT_LE(way.iterations_warm, way.iterations_cold);
  }
}

// Tread and flange, in one plane after they were tried apart, and beyond them.
TEST(WarmPatches, OfS1002OnUic60AreTheColdOnes) {
  Successive way;
  for (const double shift : {5.10e-3, 5.18e-3, 5.26e-3, 5.34e-3, 5.60e-3, 5.66e-3, 5.70e-3}) {
    CaseSpec spec = european(shift);
    spec.drive.friction_coefficient = 0.3;
    way.expect_the_same(spec, place(spec, {}));
  }
  EXPECT_LE(way.iterations_warm, way.iterations_cold);
}

// Apart, tread and flange press each other's cells by far: the trial of the state before shows it for the next one too,
// but not for one of another load.
TEST(WarmPatches, ATrialThatShowsSurelyOnePatchIsKept) {
  BemNeighbour neighbour;
  BemOptions options = coarse();
  options.neighbour = &neighbour;
  const auto trial_at = [&](double shift, double load) {
    CaseSpec spec = european(shift);
    spec.vehicle.set_load(load);
    solve_bem(spec, place(spec, {}), options);
    EXPECT_EQ(neighbour.smooth.size(), 1u);
    return neighbour.smooth.empty() ? Plane{} : neighbour.smooth.front().front().solution.normal.pressure;
  };
  const Plane first = trial_at(5.300e-3, 80e3), next = trial_at(5.302e-3, 80e3), lighter = trial_at(5.302e-3, 60e3);
  EXPECT_EQ(first, next);
  EXPECT_NE(next, lighter);
}

}  // namespace
}  // namespace railstrata
