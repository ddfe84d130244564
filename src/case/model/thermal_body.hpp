#pragma once
// The bodies of a case as heat sees them.
#include "damage/flash_temperature.hpp"
#include "spec/case_spec.hpp"

namespace railstrata {

/// Rail or wheel with the layer at its running surface, and further ones for the bounds.
ThermalBody thermal_body(const CaseSpec& spec, BodyId body);

}  // namespace railstrata
