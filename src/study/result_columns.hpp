#pragma once
// The main numbers of a result as columns of a table, units in their names: what `sweep` and `study` write.
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "post/summary.hpp"

namespace railstrata {

/// A number of summary.json, where it stands there and by what it is multiplied.
struct ResultColumn {
  const char *name, *path;
  double factor;
};

/// Contact, then the stresses if they are wanted, then the wall time.
std::vector<ResultColumn> result_columns(bool stresses);

/// The number of a summary; NaN where it is null or missing.
double column_value(const ResultColumn& column, const nlohmann::ordered_json& summary);

/// A cell of a CSV table: in quotes where it needs them, no formula to a spreadsheet (io/spreadsheet_text.hpp).
std::string csv_cell(const std::string& text);
/// Empty for a number that does not apply.
std::string csv_cell(double value);

/// "check failed: p_max_scatter": what is wrong with a result that is there; empty if nothing is.
std::string failed_check(const nlohmann::ordered_json& summary);

}  // namespace railstrata
