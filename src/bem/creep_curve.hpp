#pragma once
// Force against creepage for the contact of a case, by the full theory and by the fast ones.
#include <vector>

#include "bem/bem_options.hpp"
#include "model/model.hpp"

namespace railstrata {

/// Longitudinal force on the rail over the friction bound, F_x/(f F_n), at a creepage; the sign of the creepage's. Spin
/// is the geometry's in all of them.
struct CreepCurvePoint {
  double creepage = 0;
  double full = 0, fastsim = 0, polach = 0, vermeulen_johnson = 0, linear = 0;
  double slip_fraction = 0;  ///< slip area over patch area, full theory
};

/// The fast theories stand on the Hertz ellipse of the curvatures at the rigid contact point and on homogeneous bodies;
/// the full one on the real gap and the layers. Throws CaseError if friction is zero.
std::vector<CreepCurvePoint> creep_curve(const CaseSpec& spec, const Placement& placement,
                                         const std::vector<double>& creepages, const BemOptions& options = {});

}  // namespace railstrata
