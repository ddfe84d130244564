#pragma once
// The range of a rail's lives as a table and as JSON.
#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "traffic/traffic_range.hpp"

namespace railstrata {

/// range.csv: a row for each run: what was changed, its value, when damage first ends the metal and how, the life of
/// each zone and mechanism [MGT; "> 50": beyond what was followed; empty: not known], removed depth, fault.
void write_range(const std::filesystem::path& file, const std::vector<std::string>& origin, const TrafficRange& range);

/// The range of the first damage, the effect and share of each input on it, and the rows of range.csv.
nlohmann::ordered_json range_json(const TrafficRange& range);

}  // namespace railstrata
