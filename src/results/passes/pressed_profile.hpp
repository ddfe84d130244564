#pragma once
// The rail's profile as passes have pressed it.
#include <vector>

#include "model/model.hpp"
#include "steady/steady_pass.hpp"

namespace railstrata {

/// Points of the unworn profile at most 0.25 mm apart, lowered along its normal by what the surface has sunk at their
/// arc length from the contact point (PassResult::sinking, linear between columns), in the rail's own frame
/// (geometry.rail_mirror and rail_offset are in it). Beside the grid it stays as it is. Needs a grid with columns.
std::vector<Vec2> pressed_profile(const Placement& placement, const SteadyGrid& grid, const PassResult& last);

}  // namespace railstrata
