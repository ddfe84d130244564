#pragma once
// Lives of rail and wheel under a collective as a table, a picture and the first line of the answer.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "lives/zone_life.hpp"
#include "report/report.hpp"

namespace railstrata {

/// A life as a cell: "never" without end, "> 50" beyond what was followed (as of LifeRow, in the unit of the life),
/// null where it is not known.
nlohmann::ordered_json life_cell(double value, double followed);

/// life.csv: a row for each zone and mechanism; "never" is a life without end, an empty cell is not known.
void write_lives(const std::filesystem::path& file, const std::vector<std::string>& origin, const Lives& lives);
/// The same rows as objects.
nlohmann::ordered_json lives_json(const Lives& lives);

/// For the page; the picture has the removed depth and the points that fail, over gross tonnes.
ReportTable lives_table(const Lives& lives);
std::optional<ReportChart> life_chart(const Lives& lives);
/// How long the rail lasts, by what, and what is not known; empty where there are no rows.
ReportAnswer life_answer(const Lives& lives);

}  // namespace railstrata
