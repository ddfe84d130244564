#pragma once
// The zones of a body as a case names them: 0 the matrix, then its layers from the surface down.
#include <cstddef>
#include <string>
#include <vector>

#include "core/body_id.hpp"
#include "spec/case_fwd.hpp"

namespace railstrata {

/// The layers of a body from the surface down, by their place in the case.
std::vector<std::size_t> layers_on(const CaseSpec& spec, BodyId body);

const MaterialSpec& zone_material(const CaseSpec& spec, BodyId body, int zone);
/// "rail", "wheel", or the layer's name.
std::string zone_name(const CaseSpec& spec, BodyId body, int zone);
/// A zone's table in the case: "material.rail", "layer.0" by the layer's place there.
std::string zone_key(const CaseSpec& spec, BodyId body, int zone);

}  // namespace railstrata
