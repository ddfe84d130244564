#pragma once
// geometry.json: profiles in their places, contact point, layers and Hertz's estimate, so that a result folder can be
// drawn without its profile files.
#include <filesystem>

#include <nlohmann/json.hpp>

#include "model/model.hpp"

namespace railstrata {

/// SI units, model frame. Profiles and the lower borders of the layers are lists of points [y, z] half a millimetre
/// apart, at most 80 mm to either side of the contact. "hertz" holds the ellipse of the curvatures at the rigid contact
/// point, without layers.
nlohmann::ordered_json geometry_json(const CaseSpec& spec, const Placement& placement);
void write_geometry(const std::filesystem::path& file, const CaseSpec& spec, const Placement& placement);

}  // namespace railstrata
