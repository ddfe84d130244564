#include "passes/rail_passes.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "model/model.hpp"
#include "reader/case_file.hpp"

namespace railstrata {
namespace {

// A crown of 300 mm sinks in the middle of the grid: its radius there falls by the depth, beside the grid it stays.
TEST(PressedProfile, IsLoweredAlongItsNormalWhereTheGridIs) {
  const CaseSpec spec =
      parse_case("[geometry]\nrail_profile = \"arc:R=300 mm\"\nwheel_profile = \"flat\"\ncant = 0\n", "a.toml").spec;
  const Placement placement = place(spec, {});
  const SteadyGrid grid{.nx = 4, .ny = 41, .dx = 1e-3, .dy = 0.5e-3, .front = 2e-3, .y0 = -10e-3};
  PassResult last;
  for (int j = 0; j < grid.ny; ++j) last.sinking.push_back(20e-6 * std::exp(-std::pow(grid.y(j) / 3e-3, 2)));
  const Profile& rail = placement.rail;
  const Vec2 middle = rail.at(0).position - 0.3 * rail.at(0).outward;
  double lowest = 1, beside = 0;
  for (const Vec2& p : pressed_profile(placement, grid, last)) {
    const double radius = norm(p - middle), y = p.y - rail.at(placement.contact.rail_s).position.y;
    if (std::abs(y) < 12e-3) lowest = std::min(lowest, radius);
    if (std::abs(y) > 11e-3 && std::abs(y) < 12e-3) beside = std::max(beside, std::abs(radius - 0.3));
  }
  EXPECT_NEAR(0.3 - lowest, 20e-6, 0.3e-6);
  EXPECT_LT(beside, 1e-9);
}

}  // namespace
}  // namespace railstrata
