#pragma once
// Whether steady sliding under friction that falls with slip is stable in a case.
#include "model/model.hpp"

namespace railstrata {

/// The friction memory [m] that keeps it so at every slip velocity (friction/friction_memory.hpp), in the rail's
/// material under the pressure p0 [Pa]. longer_axis [m]: of the patch; the longest wave is twice as long, its traction
/// of one sign over the whole patch. 0: it needs none.
double stable_memory_distance(const CaseSpec& spec, double p0, double longer_axis);

/// The half-space engine's note on a case whose friction falls by more than waves carry away, and whose memory does
/// not make up for it; else empty.
std::string note_of_instability(const CaseSpec& spec, const HertzContact& patch);

}  // namespace railstrata
