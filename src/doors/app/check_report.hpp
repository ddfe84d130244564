#pragma once
// What `check` reports about a case, as text and as JSON.
#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "judge/plausibility.hpp"
#include "reader/case_file.hpp"
#include "runs/run_estimate.hpp"

namespace railstrata {

/// Title, contact point, loads and layers.
void print_case(const LoadedCase& loaded, const Placement& placement);

/// Mesh, step, memory and time.
void print_estimate(const Model& m, const RunEstimate& e);

/// The meshes as an aligned table, a row for each block of both bodies.
std::string mesh_table(const Model& model);

/// A VTU file with materials, blocks and scaled Jacobians.
void write_mesh(const std::filesystem::path& file, const SweptBody& body);

/// Warnings of the last position, which the result belongs to.
std::vector<Warning> warnings_of(const Model& m, const RunEstimate& e);

nlohmann::ordered_json placement_json(const CaseSpec& spec, const Placement& placement);

nlohmann::ordered_json run_json(const Model& m, const RunEstimate& e);

}  // namespace railstrata
