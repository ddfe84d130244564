#pragma once
// The files of a half-space solution.
#include <filesystem>
#include <string>
#include <vector>

#include "ask/answer.hpp"

namespace railstrata {

/// Writes geometry.json, rail_surface.vtp, wheel_surface.vtp and view.py; patch.csv, centre_line.csv, depth_line.csv
/// and two sections a body; patch.vtp; summary.json as the last. provenance: "#" lines of the tables. Throws
/// EnvironmentError for the disk.
void write_half_space_result(const std::filesystem::path& folder, const std::vector<std::string>& provenance,
                             const CaseSpec& spec, const Placement& placement, const Answer& answer);

}  // namespace railstrata
