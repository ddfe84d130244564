#pragma once
// What `check` reports about a case, as text and as JSON.
#include <vector>

#include <nlohmann/json.hpp>

#include "judge/plausibility.hpp"
#include "reader/case_file.hpp"
#include "runs/run_estimate.hpp"

namespace railstrata {

/// Title, contact point, loads and layers.
void print_case(const LoadedCase& loaded, const Placement& placement);

/// Mesh, step, memory and time, and what the estimate has of other machines.
void print_estimate(const Model& m, const RunEstimate& e);

/// Warnings of the last position, which the result belongs to.
std::vector<Warning> warnings_of(const Model& m, const RunEstimate& e);

nlohmann::ordered_json placement_json(const CaseSpec& spec, const Placement& placement);

/// machines: with the estimates for other machines.
nlohmann::ordered_json run_json(const Model& m, const RunEstimate& e, bool machines);

}  // namespace railstrata
