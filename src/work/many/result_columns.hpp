#pragma once
// The main numbers of a result as columns of a table, units in their names: what `sweep` and `study` write. Which ones
// there are and what they are called stands in result/result_table.hpp.
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "record/number_text.hpp"
#include "result/result_table.hpp"

namespace railstrata {

/// Contact, then the stresses if they are wanted, then the wall time; nothing of a way.
std::vector<ResultColumn> result_columns(bool stresses);
/// Columns of a wheel's passage over a rail that varies along its length.
std::vector<ResultColumn> passage_columns();

/// Further columns of a study's table: made from the result's files (study_results.cpp), and its threads.
const std::vector<ResultColumn>& study_columns();

/// The row of a column of a study's table by its name; null if there is none.
const ResultColumn* find_column(std::string_view name);

/// The row of this symbol. It must be there.
const ResultColumn& column_of(std::string_view symbol);

/// "p_max [MPa]": as an axis or the head of a column names it; the name itself if it is no column.
std::string column_title(const std::string& name);

/// The number of a summary; NaN where it is null or missing.
double column_value(const ResultColumn& column, const nlohmann::ordered_json& summary);

/// Columns beside the numbers of a result in a table: its patches (0: no result), "ok" or the checks that fail, the
/// warnings; names separated by "; "; whether it lasts and the zone that decides, both empty without a strength;
/// whether a life ends: "ends", "never", "not known: …" with the reason, empty where none was asked for.
struct ResultRemarks {
  int patches = 0;
  std::string checks, warnings;
  std::string lasts, decided_by, life = {};
};
ResultRemarks remarks_of(const nlohmann::ordered_json& summary);

/// A line for the head of a table: which patch each column describes where a wheel touches at several places.
std::string patches_remark(const std::vector<ResultColumn>& columns);

/// "check failed: p_max_scatter": what is wrong with a result that is there; empty if nothing is.
std::string failed_check(const nlohmann::ordered_json& summary);

}  // namespace railstrata
