#include "passes/metal.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "bem/contact_places.hpp"
#include "core/faults.hpp"
#include "reader/case_file.hpp"

namespace railstrata {
namespace {

/// A wheel that ratchets the rail's surface, or one of a steel that bears it.
CaseSpec wheel(const std::string& steel, const std::string& traction) {
  CaseSpec spec =
      parse_case(
          std::string("[geometry]\nrail_profile = \"arc:R=80 mm\"\nwheel_profile = \"arc:R=-400 mm\"\ncant = 0\n") +
              "[material.rail]\n" + steel + "[vehicle]\nwheel_load = \"60 kN\"\n[drive]\ntraction_coefficient = " +
              traction + "\nfriction_coefficient = 0.3\nspin = \"0 1/m\"\n",
          "a.toml")
          .spec;
  spec.passes.patch_cells = 4;
  return spec;
}

CaseSpec ratchetting() { return wheel("grade = \"R260\"\nhardening = \"R260\"\n", "0.2"); }

struct OnMetal {
  MetalGrid grid;
  MetalWheel wheel;
};
/// The metal is as wide as the wheel's own grid, so that both have the same neighbours.
OnMetal on_metal(const CaseSpec& spec, double share, double first_row = 0.4e-3) {
  BemOptions bem;
  bem.cell = 1e-3;
  const BemResult result = solve_bem(spec, place(spec, {}), bem);
  constexpr double kApart = 1.5e-3;
  OnMetal out{metal_grid(0, 1e-3, kApart, first_row, 12e-3), {}};
  const PassLattice lattice{kApart, 0, out.grid.thickness};
  out.wheel = {.rail = rail_passes(spec, {result}, &lattice), .share = share};
  out.grid.columns = out.wheel.rail.grid.ny;
  out.grid.from = out.wheel.rail.grid.y0;
  return out;
}

double largest(const std::vector<double>& v) { return *std::max_element(v.begin(), v.end()); }

constexpr SettleLimits kClose{.tolerance = 0.01, .changes = 400};

TEST(Metal, ImplicitStepsFollowTheWheelsOneByOne) {
  constexpr int kWheels = 1 + 2 + 4 + 8 + 16 + 32 + 64 + 128;
  OnMetal one = on_metal(ratchetting(), 1);
  const RailPasses& rail = one.wheel.rail;
  const SteadyBody body(rail.grid, rail.rows, rail.below, rail.initial_stress);
  const Field strain = contact_strain(rail, body, rail.contact_stress.front());
  PassState state = body.virgin();
  std::vector<double> sum(body.grid().points(), 0.0), last;
  for (int n = 0; n < kWheels; ++n) {
    last = body.run_pass(strain, state).net;
    for (std::size_t p = 0; p < sum.size(); ++p) sum[p] += last[p];
  }
  Metal metal(one.grid, 5);
  metal.put({one.wheel});
  std::vector<double> grown(sum.size(), 0.0);
  int changes = 0;
  for (int wheels = 1; wheels <= 128; wheels *= 2) {
    changes += metal.roll(wheels, kClose).changes;
    for (std::size_t p = 0; p < grown.size(); ++p) grown[p] += wheels * metal.flow().net[p];
  }
  ASSERT_GT(largest(last), 1e-5) << "it must ratchet";
  EXPECT_NEAR(largest(grown) / largest(sum), 1, 0.1);
  EXPECT_NEAR(largest(metal.flow().net) / largest(last), 1, 0.15);
  EXPECT_LT(changes, kWheels);
}

TEST(Metal, AKindCutInTwoIsTheSame) {
  const OnMetal whole = on_metal(ratchetting(), 1), half = on_metal(ratchetting(), 0.5);
  Metal one(whole.grid, 5), two(whole.grid, 5);
  one.put({whole.wheel});
  two.put({half.wheel, half.wheel});
  one.roll(30, kClose);
  two.roll(30, kClose);
  for (std::size_t p = 0; p < one.flow().net.size(); ++p) {
    EXPECT_NEAR(two.flow().net[p], one.flow().net[p], 1e-12);
    for (std::size_t v = 0; v < 3; ++v) EXPECT_NEAR(two.flow().cycles[p][v], one.flow().cycles[p][v], 1e-15);
  }
}

TEST(Metal, WheelsThatLeaveItElasticAloneChangeNothing) {
  OnMetal one = on_metal(wheel("yield_strength = \"3000 MPa\"\n", "0"), 1);
  Metal metal(one.grid, 5);
  metal.put({one.wheel});
  const SettledState out = metal.roll(1e6, {});
  EXPECT_EQ(out.changes, 0);
  EXPECT_EQ(largest(metal.flow().net), 0);
}

TEST(Metal, WhatWasBelowComesNearerToTheSurface) {
  OnMetal one = on_metal(ratchetting(), 1);
  Metal metal(one.grid, 5);
  metal.put({one.wheel});
  metal.roll(10, kClose);
  const std::vector<double> before = metal.state();
  const double row = one.grid.depths()[1] - one.grid.depths()[0];
  metal.sink(std::vector<double>(static_cast<std::size_t>(one.grid.columns), row));
  const auto columns = static_cast<std::size_t>(one.grid.columns);
  for (std::size_t c = 0; c < columns; ++c)
    EXPECT_NEAR(metal.state()[c * kStreamlineHistory + 6], before[(columns + c) * kStreamlineHistory + 6], 1e-15);
}

/// Of every row no force across the depth, at the surface no stress upon it; and nothing but the state decides.
TEST(Metal, ResidualStressIsInEquilibrium) {
  const OnMetal one = on_metal(ratchetting(), 1, 0.05e-3);
  Metal metal(one.grid, 5);
  metal.put({one.wheel});
  metal.roll(30, kClose);
  const std::size_t rows = one.grid.thickness.size();
  std::vector<Sym3> sum(rows);
  double largest_xx = 0, compressed = 0, at_surface = 0;
  for (int c = 0; c < one.grid.columns; ++c) {
    const std::vector<Sym3> column = metal.residual(static_cast<std::size_t>(c));
    for (std::size_t r = 0; r < rows; ++r) {
      sum[r] = sum[r] + column[r];
      largest_xx = std::max(largest_xx, std::abs(column[r].xx));
    }
    compressed = std::min(compressed, column[0].xx);
    at_surface = std::max(at_surface, std::abs(column[0].zz));
  }
  EXPECT_LT(compressed, -20e6);
  EXPECT_LT(at_surface, 0.1 * largest_xx);
  for (const Sym3& of_row : sum) {
    EXPECT_NEAR(of_row.zz, 0, 1e-6 * largest_xx);
    EXPECT_NEAR(of_row.yz, 0, 1e-6 * largest_xx);
    EXPECT_NEAR(of_row.xz, 0, 1e-6 * largest_xx);
  }
  const Sym3 before = metal.residual(3)[1];
  metal.put({one.wheel});
  EXPECT_EQ(metal.residual(3)[1].xx, before.xx);
}

}  // namespace
}  // namespace railstrata
