#pragma once
// The worst of all layers and of all interfaces of a result: what cracks a brittle layer, and what shears it off.
#include "result/summary.hpp"

namespace railstrata {

/// Worst values of layers on rail and wheel, residual stress of the process included; NaN where there is no layer, or
/// where the case gives no strength to compare with.
struct LayerWorst {
  double sigma_1 = kNotApplicable;            ///< Pa, the largest principal stress in a layer
  double share_of_tensile = kNotApplicable;   ///< of its tensile strength; 1: it cracks
  double critical_flaw = kNotApplicable;      ///< m, the smallest flaw that the stress opens
  double interface_tension = kNotApplicable;  ///< Pa
  double interface_shear = kNotApplicable;    ///< Pa
  double shear_range = kNotApplicable;        ///< Pa, of tau_xz over a passage
  double delamination = kNotApplicable;       ///< 1: the interface gives way
};
LayerWorst layer_worst(const Summary& summary);

}  // namespace railstrata
