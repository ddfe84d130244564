#pragma once
// A wheel elsewhere across a rail that is meshed already: passes of wheels that wander.
#include "model/model.hpp"

namespace railstrata {

/// Like build_model, but with the rail mesh of another model of the same rail. Whether the patch lies in its fine zone
/// is for the caller: a rolling reports it (patch_reaches_edge_of_fine_zone).
Model build_model_on_rail(const CaseSpec& spec, const std::filesystem::path& folder, const SweptBody& rail);

}  // namespace railstrata
