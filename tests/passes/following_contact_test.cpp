#include "passes/following_contact.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace railstrata {
namespace {

TEST(FollowingContact, ASurfaceOfWavesOfTheGridComesToTheCellsAsItIs) {
  SteadyGrid g{.nx = 20, .ny = 12, .dx = 1e-3, .dy = 0.8e-3, .front = 7e-3, .y0 = -4e-3, .active = 4e-3, .hold = 2e-3};
  g.thickness = {1e-3};
  const double kx = 2 * std::numbers::pi * 3 / (g.nx * g.dx), ky = 2 * std::numbers::pi * 2 / (g.ny * g.dy);
  const auto along = [&](double x, double y) { return 1e-6 * std::sin(kx * x + 0.3) * std::cos(ky * y); };
  const auto down = [&](double x, double y) { return 1e-6 * std::cos(kx * x) * std::sin(ky * y + 0.2); };
  Field surface(3 * g.plane());
  for (int i = 0; i < g.nx; ++i)
    for (int j = 0; j < g.ny; ++j) {
      surface[g.index(0, 0, i, j)] = along(g.x(i), g.y(j));
      surface[g.index(2, 0, i, j)] = down(g.x(i), g.y(j));
    }
  const PatchGrid cells = centred_grid(4, 3, 0.3e-3, 0.25e-3);
  const double middle = 0.4e-3;  // x of the patch
  const int columns = 2;         // the wheel runs farther to the side
  const RailSurface out = surface_in_cells(cells, g, middle, columns, surface);
  ASSERT_EQ(out.sinking.size(), cells.size());
  for (int i = 0; i < cells.nx; ++i)
    for (int j = 0; j < cells.ny; ++j) {
      const double x = cells.x(i) - middle, y = cells.y(j) + columns * g.dy;
      EXPECT_NEAR(out.sinking[cells.index(i, j)], down(x, y), 1e-18);
      EXPECT_NEAR(out.stretch.x[cells.index(i, j)], (along(x + cells.dx, y) - along(x, y)) / cells.dx, 1e-14);
      EXPECT_EQ(out.stretch.y[cells.index(i, j)], 0);
    }
}

TEST(FollowingContact, ALineHasOneColumnAndAnOddNumberOfStationsItsWavesToo) {
  SteadyGrid g{.nx = 15, .ny = 1, .dx = 1e-3, .dy = 0, .front = 5e-3, .y0 = 0, .active = 4e-3, .hold = 2e-3};
  g.thickness = {1e-3};
  const double k = 2 * std::numbers::pi * 7 / (g.nx * g.dx);
  Field surface(3 * g.plane());
  for (int i = 0; i < g.nx; ++i) surface[g.index(2, 0, i, 0)] = 1e-6 * std::cos(k * g.x(i));
  const PatchGrid cells = line_grid(5, 0.3e-3, 1);
  const RailSurface out = surface_in_cells(cells, g, 0, 0, surface);
  for (int i = 0; i < cells.nx; ++i)
    EXPECT_NEAR(out.sinking[cells.index(i, 0)], 1e-6 * std::cos(k * cells.x(i)), 1e-18);
}

}  // namespace
}  // namespace railstrata
