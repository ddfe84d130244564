#pragma once
// A report as JSON for the script of its page.
#include <nlohmann/json_fwd.hpp>

#include "report/report.hpp"

namespace railstrata {

/// The report as JSON, as web/src/report/data.ts reads it. Lines have six digits; maps and sections are packed to 16
/// bits a number and thinned to 300 points a side.
nlohmann::ordered_json report_payload(const Report& report);

/// Every `step`-th row of a table, a list of six digits for each column.
nlohmann::ordered_json table_json(const CsvTable& table, std::size_t step = 1);

}  // namespace railstrata
