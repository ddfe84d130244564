#pragma once
// Elements of the rail whose stress is followed while the wheel passes them: where the rail changes along its way.
#include <vector>

#include "mesh/swept.hpp"
#include "spec/case_spec.hpp"

namespace railstrata {

/// An element of the contact band, in the column in the middle of the strip that touches.
struct WatchedPoint {
  int quad, element;
  double x, depth;  ///< m, of its centre
  int layer;        ///< 0 the rail, then its layers from the surface down
};

/// On either side of a layer's end: at the surface, above and below the layer's bottom; there too on either side of the
/// ends of an unbonded stretch. At the rows of a stretch, and
/// at the beginning, the middle and the end of an irregularity: at the surface and half a contact's semi-axis below it.
/// end: of the wheel's way, m; semi_axis: m, along it. None where the rail is the same all along.
std::vector<WatchedPoint> watched_points(const CaseSpec& spec, const SweptBody& rail, double end, double semi_axis);

}  // namespace railstrata
