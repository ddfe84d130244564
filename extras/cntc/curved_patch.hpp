#pragma once
// Conformal contact, D = 4: elements on the curve in the middle between the profiles of wheel and rail.
// [eve70a/CONTACT, user guide, conformal contact]
#include "cntc/contact_search.hpp"

namespace railstrata::cntc {

/// Puts the rows of elements on the curve: equal steps of the rail's arc, as far as the bodies overlap, and two more.
void bend(PatchPlane& plane, const Overlap& overlap, const RigidPair& pair);

/// So many elements more before and behind, and rows on both sides; those of a curve go on straight.
struct More {
  int before = 0, behind = 0, below = 0, above = 0;
};
void widen(PatchPlane& plane, const More& by);

}  // namespace railstrata::cntc
