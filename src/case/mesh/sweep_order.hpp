#pragma once
// The order in which a sweep goes through the quadrilaterals of a section.
#include <vector>

#include "mesh/swept.hpp"

namespace railstrata {

/// Most nodes open at a time: touched by a quadrilateral of `order` that has been passed, and by one that has not.
int widest_front(const Section& section, const std::vector<int>& order);

/// A permutation of the quadrilaterals with a narrow front: their own order if that has one, as meshes made row by row
/// do. Otherwise greedy: next is the quadrilateral at open nodes that opens the fewest new ones; of several, one that
/// shares an edge with the last; of those, the one that has waited longest. Starts at a corner.
std::vector<int> sweep_order(const Section& section);

}  // namespace railstrata
