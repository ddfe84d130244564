#pragma once
// The way of a rail's points through a pass of the finite elements, as passes/pass_way.hpp has it of the stationary
// method: rolling is steady, so that what stands along the rail when the wheel arrives is what a point has seen as the
// wheel came and went.
#include <vector>

#include "passes/rolled_pass.hpp"
#include "steady/steady_pass.hpp"

namespace railstrata {

/// State of the rail at the end of a rolling.
struct RolledRail {
  Field u;
  PlasticHistory history;
  double wheel = 0;              ///< m, where the axle is
  double behind = 0, ahead = 0;  ///< m, stations of the loops: between wheel - behind and wheel + ahead
};

/// Loops from well ahead of the wheel to well behind it, at the elements' centres; p: mean of the points. The governing
/// point: where the net strain of the pass is largest; where nothing flowed, where plastic strain is largest. Then in
/// its column of the fine zone the first row, and the rows above and below the border of each layer. None where nothing
/// has ever yielded. pass: of `section`'s quadrilaterals.
std::vector<PassLoop> rolled_loops(const RollingSystem& system, const Model& base, const PlasticSection& section,
                                   const RolledPass& pass, const RolledRail& rail);

}  // namespace railstrata
