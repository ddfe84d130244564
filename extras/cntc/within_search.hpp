#pragma once
// Whether wheel and rail touch where the search does not look: where a profile turns over.
#include "cntc/contact_search.hpp"

namespace railstrata::cntc {

/// Throws Refused where the wheel is inside the rail beside the overlaps that were found.
void require_found(const RigidPair& pair, const std::vector<Overlap>& found);

}  // namespace railstrata::cntc
