#pragma once
// What was found of bogies in a curve: a table on the page, in curving.csv and in JSON, and lines for the screen.
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "curving/steady_curve.hpp"
#include "report/report.hpp"

namespace railstrata {

/// A row for every wheel, y and yaw from the track's axis, outwards positive.
void write_curving(const std::filesystem::path& file, const std::vector<std::string>& origin,
                   const std::vector<BogieInCurve>& bogies);
nlohmann::ordered_json curving_json(const std::vector<BogieInCurve>& bogies);
ReportTable curving_table(const std::vector<BogieInCurve>& bogies);
/// A heading, and a line a wheelset.
std::vector<std::string> curving_lines(const std::vector<BogieInCurve>& bogies);

}  // namespace railstrata
