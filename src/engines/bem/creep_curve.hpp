#pragma once
// Force against creepage for the contact of a case, by the full theory and by the fast ones.
#include <vector>

#include "bem/bem_options.hpp"
#include "model/model.hpp"

namespace railstrata {

/// The creepage that a curve varies; everything else is as in the case.
enum class VariedCreepage { longitudinal, lateral, spin };

/// Forces on the rail over the friction bound f F_n, with the sign of the creepage's: along the varied creepage, F_x of
/// the longitudinal one, F_y of the lateral one and of spin.
struct CreepCurvePoint {
  double creepage = 0;  ///< the varied one; of spin 1/m
  double full = 0, fastsim = 0, polach = 0, vermeulen_johnson = 0, linear = 0;
  double slip_fraction = 0;  ///< slip area over patch area, full theory
  double across = 0;         ///< the full theory's other force over f F_n
  double moment = 0;         ///< m, the full theory's moment about the normal over f F_n
};

/// The fast theories stand on the Hertz ellipse of the curvatures at the rigid contact point and on homogeneous bodies;
/// the full one on the real gap and the layers. The fast ones take the creepages that the full one has. The normal
/// force is the weight's, or that of the given approach without friction, and does not change. Throws CaseError if
/// friction is zero or the wheel touches in a further plane under this load.
std::vector<CreepCurvePoint> creep_curve(const CaseSpec& spec, const Placement& placement, VariedCreepage varied,
                                         const std::vector<double>& creepages, const BemOptions& options = {});

}  // namespace railstrata
