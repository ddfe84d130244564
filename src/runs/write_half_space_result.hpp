#pragma once
// The half-space solution of a case, from the spec to the files of its folder.
#include <filesystem>
#include <string>
#include <vector>

#include "bem/solve_bem.hpp"
#include "post/summary.hpp"

namespace railstrata {

/// What half-space theory takes of a case. A static case (run.rolling = false) has frictionless contact, as the finite
/// elements' preload has.
CaseSpec half_space_case(CaseSpec spec);

/// The cell size of --cell ("0.25 mm"), m; the engine's own default for an empty text. Throws CaseError.
double cell_size(const std::string& text);

/// Writes summary.json, patch.csv, centre_line.csv, depth_line.csv and patch.vtp. provenance: "#" lines of the tables.
void write_bem_result(const std::filesystem::path& folder, const std::vector<std::string>& provenance,
                      const BemResult& result, const Summary& summary);

/// Writes geometry.json, rail_surface.vtp, wheel_surface.vtp and view.py; wheel_x: where patch.vtp has the axle [m].
void write_bem_geometry(const std::filesystem::path& folder, const CaseSpec& spec, const Placement& placement,
                        double wheel_x);

}  // namespace railstrata
