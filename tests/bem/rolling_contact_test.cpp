#include "bem/rolling_contact.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "bem/leading_edge.hpp"
#include "half_space_pair.hpp"

namespace railstrata {
namespace {

/// A steel wheel on a rail half as stiff and of another Poisson's ratio.
struct Dissimilar {
  HalfSpaceMaterial wheel{210e9, 0.3}, rail{100e9, 0.15};
  double load = 6e4;
  HertzGap gap = hertz_gap(6e-3, 4e-3, contact_modulus(wheel, rail), load);
  PatchGrid grid = grid_around(6.3e-3, 4.2e-3, 0.25e-3, 0.25e-3);
  InfluenceOperator influence{pair_of(wheel, rail), grid.nx, grid.ny, grid.dx, grid.dy};
  RollingContact contact() const {
    RollingContact c;
    c.gap = quadratic_gap(grid, gap.A, gap.B);
    c.target.load = load;
    c.friction = 0.4;
    return c;
  }
};

TEST(RollingContact, CoupledSolutionMeetsTheNormalAndTheTangentialConditionsAtOnce) {
  const Dissimilar d;
  RollingContact c = d.contact();
  c.x.force = -0.5 * 0.4 * d.load;
  const RollingSolution s = solve_rolling(d.influence, d.grid, c);
  EXPECT_GT(s.outer_iterations, 1);
  const std::size_t n = d.grid.size(), row = static_cast<std::size_t>(d.grid.ny);
  Plane by_p(n);
  d.influence.normal(s.normal.pressure.data(), by_p.data());
  const Plane by_q = d.influence.normal_from_traction(s.tangential.q_x, s.tangential.q_y),
              ux = d.influence.tangential(s.tangential.q_x, s.tangential.q_y, d.grid.nx + 1).x,
              px = d.influence.tangential_from_pressure(s.normal.pressure, d.grid.nx + 1).x;
  const auto slip = [&](std::size_t k) {  // over the step from the cell ahead
    return s.tangential.creepage_x + (ux[k + row] - ux[k] + px[k + row] - px[k]) / d.grid.dx;
  };
  const Plane weight = leading_weights(d.grid, s.normal),
              by_pressure = leading_slip_by_pressure(d.influence, d.grid, s.normal, weight).x;
  int stick = 0, leading = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const double gap = c.gap[k] + by_p[k] + by_q[k] - s.normal.approach;
    if (s.normal.pressure[k] > 0)
      EXPECT_NEAR(gap / s.normal.approach, 0, 2e-5);
    else
      EXPECT_GT(gap / s.normal.approach, -2e-5);
    if (s.tangential.state[k] != ContactState::stick) continue;
    ++stick;
    leading += weight[k] > 0;
    const double of_the_patch =
        slip(k) - (weight[k] > 0 ? weight[k] * slip(k + row) + by_pressure[k] / d.grid.dx : 0.0);
    EXPECT_NEAR(of_the_patch / s.tangential.creepage_x, 0, 1e-4);
  }
  EXPECT_GT(stick, 100);
  EXPECT_GT(leading, 10);
}

TEST(RollingContact, FreeRollingOfDissimilarBodiesSlipsAndChangesThePressure) {
  const Dissimilar d;
  const RollingSolution coupled = solve_rolling(d.influence, d.grid, d.contact());
  EXPECT_GT(coupled.tangential.slip_area, 0);
  EXPECT_GT(largest_traction(coupled.tangential), 0.005 * peak(coupled.normal.pressure));
  RollingContact free = d.contact();
  free.friction = 0;
  const RollingSolution smooth = solve_rolling(d.influence, d.grid, free);
  EXPECT_NEAR(
      peak(smooth.normal.pressure) / hertz_contact(d.gap.A, d.gap.B, contact_modulus(d.wheel, d.rail), d.load).p0, 1,
      2e-3);
  EXPECT_EQ(largest_traction(smooth.tangential), 0);
}

TEST(RollingContact, SwappingTheBodiesTurnsTheCouplingRound) {
  // mirror the pair: the wheel's tractions are the negatives of the rail's, so the lateral force by coupling alone
  // keeps its size
  const Dissimilar d;
  const InfluenceOperator swapped(pair_of(d.rail, d.wheel), d.grid.nx, d.grid.ny, d.grid.dx, d.grid.dy);
  const RollingSolution a = solve_rolling(d.influence, d.grid, d.contact()),
                        b = solve_rolling(swapped, d.grid, d.contact());
  for (std::size_t k = 0; k < d.grid.size(); ++k) {
    EXPECT_NEAR(a.normal.pressure[k], b.normal.pressure[k], 1e-4 * peak(a.normal.pressure));
    EXPECT_NEAR(a.tangential.q_x[k], -b.tangential.q_x[k], 1e-4 * peak(a.normal.pressure));
  }
}

TEST(RollingContact, LocalFrictionBoundsEachCell) {
  const Dissimilar d;
  const InfluenceOperator influence(pair_of(kSteel, kSteel), d.grid.nx, d.grid.ny, d.grid.dx, d.grid.dy);
  RollingContact c = d.contact();
  c.local_friction.assign(d.grid.size(), 0.4);
  for (int i = 0; i < d.grid.nx; ++i)
    for (int j = 0; j < d.grid.ny / 2; ++j) c.local_friction[d.grid.index(i, j)] = 0.1;  // one side wet
  c.x.creepage = -0.05;
  const RollingSolution s = solve_rolling(influence, d.grid, c);
  for (std::size_t k = 0; k < d.grid.size(); ++k)
    EXPECT_NEAR(std::hypot(s.tangential.q_x[k], s.tangential.q_y[k]), c.local_friction[k] * s.normal.pressure[k], 1e3);
  EXPECT_GT(std::abs(s.tangential.moment), 1.0);
}

}  // namespace
}  // namespace railstrata
