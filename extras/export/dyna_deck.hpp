#pragma once
// The meshed case as an LS-DYNA keyword deck: the static preload by implicit steps.
//
// Units mm, t, s, N, MPa. Columns have the fixed widths of the standard format: eight in *NODE and *ELEMENT_SOLID, ten
// elsewhere. Hanging nodes are *CONSTRAINED_LINEAR_GLOBAL, the bore is a nodal rigid body.
#include <string>

#include "export/solid_model.hpp"

namespace railstrata {

/// The whole deck as text. Nodes and elements count from 1, the rail's first, then the wheel's; the axle is the last
/// node. A part, section and material for each material of a body. Throws CaseError for a mesh of more nodes or
/// elements than eight columns can number.
std::string dyna_deck(const SolidModel& model, bool friction);

}  // namespace railstrata
