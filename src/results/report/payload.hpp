#pragma once
// A report as JSON for the script of its page.
#include <nlohmann/json_fwd.hpp>

#include "report/report.hpp"

namespace railstrata {

/// The report as JSON, as web/src/report/data.ts reads it. Lines have six digits; maps and sections are packed to 16
/// bits a number and thinned to 300 points a side.
nlohmann::ordered_json report_payload(const Report& report);

/// Six digits of a number; null for what is not finite.
nlohmann::ordered_json short_number(double v);

}  // namespace railstrata
