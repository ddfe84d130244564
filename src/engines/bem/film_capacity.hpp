#pragma once
// Whether a third-body layer that yields can carry what a transient asks for, before the first step.
#include "bem/bem_options.hpp"
#include "model/model.hpp"

namespace railstrata {

/// In every row of the history: the force must be below the sum of min(f p, tau_c) dA under the frictionless pressure.
/// The force is linear between rows and the sum a concave function of the load, so rows stand for what lies between.
/// Nothing to test where the film hardens, for then friction alone is the limit. Throws CaseError with the row.
void require_film_carries(const CaseSpec& spec, const Placement& placement, const BemOptions& options);

}  // namespace railstrata
