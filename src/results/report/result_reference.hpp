#pragma once
// The reference of results, written from the tables of result/result_table.hpp and judge/check_limits.hpp.
#include <string>

#include <nlohmann/json_fwd.hpp>

namespace railstrata {

/// The reference page docs/results-reference.md.
std::string results_reference_markdown();

/// The same for programs: {"numbers": [{path, column, unit, ...}], "stress": {...}, "checks": [{key, limits, ...}]}.
/// The page of `report` takes its words from here.
nlohmann::ordered_json results_reference_json();

}  // namespace railstrata
