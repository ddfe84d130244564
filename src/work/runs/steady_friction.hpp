#pragma once
// The friction of steady rolling that finite elements start with (fem/steady_start.hpp), by half-spaces with the case's
// layers.
#include "fem/steady_start.hpp"
#include "spec/case_fwd.hpp"

namespace railstrata {

/// None for a case that starts from rest (model/rolling_start.hpp).
SteadyFriction steady_friction(const CaseSpec& spec);

}  // namespace railstrata
