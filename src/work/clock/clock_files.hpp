#pragma once
// The history of a rail through its traffic as a table.
#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "clock/clock.hpp"

namespace railstrata {

/// history.csv: a row for the beginning and one for each stretch of traffic, at its end.
void write_history(const std::filesystem::path& file, const std::vector<std::string>& origin,
                   const ClockResult& result);
/// worn_rail.csv: a profile in the frame of the unworn one.
void write_worn_rail(const std::filesystem::path& file, const std::vector<std::string>& origin,
                     const std::vector<Vec2>& profile);
/// The same rows in SI, with what was followed and why it ended.
nlohmann::ordered_json history_json(const ClockResult& result);

}  // namespace railstrata
