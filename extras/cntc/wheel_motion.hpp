#pragma once
// Module 1: where wheel and rail stand, how they move, and what they slide over each other.
#include <vector>

#include "cntc/contact_search.hpp"
#include "cntc/module_one.hpp"

namespace railstrata::cntc {

/// With the wheelset at the height z. Notes the places in `one.found`.
RigidPair place(ModuleOne& one, const Problem& base, double z);

struct Rolling {
  double speed = 0, chi = 0;
  Creepages creepages;  ///< SI, at the patch's reference
};

/// (rail - wheel) over the mean of the wheel's way along the track and around its axle. [eve70a/CONTACT, user guide]
Rolling rolling(const ModuleOne& one, const Problem& base, const WheelRailPatch& patch);

/// D = 3 and 4: slip where the surfaces of wheel and rail lie, along the plane between their paths. `more` is what the
/// creepages, those nearest to it where the bodies overlap, leave over in each element.
struct SurfaceSlip {
  Rolling rolling;
  std::vector<double> more_x, more_y;  ///< in the order of the elements; m of a shift
};
SurfaceSlip surface_slip(const ModuleOne& one, const Problem& base, const PatchPlane& plane, const Distance& distance);

}  // namespace railstrata::cntc
