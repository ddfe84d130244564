#pragma once
// A page on many cases: a number over a key, and the cases as a table.
#include <string>
#include <vector>

#include "many/case_row.hpp"
#include "report/report.hpp"

namespace railstrata {

/// The columns that pages show, those of them that any row has.
std::vector<const ResultColumn*> shown_columns(const std::vector<CaseRow>& rows);

/// A row as a point of the line `name`.
struct LinePoint {
  const CaseRow* row = nullptr;
  std::string name;
  int colour = -1;  ///< as of ReportSeries
  std::string dash = "solid";
};

/// Adds to the chart the numbers of a column over a key: lines in the order in which their first points come, points
/// in the order of their values. A row without the key is a level from the first to the last of all.
void add_trend(ReportChart& chart, const std::string& key, const std::string& column,
               const std::vector<LinePoint>& points);

/// A key as the name of an axis: "friction coefficient".
std::string key_name(const std::string& key);

/// Over all cases with a strength: how many last, and what decides; without one the range of p_max.
std::vector<ReportAnswer> cases_answers(const std::vector<CaseRow>& rows);

/// "name [unit]", the unit that the values have.
std::string axis_title(const std::string& name, const std::vector<std::string>& values);

/// A number of a result as a column of a page's table, in the unit that pages show.
CaseColumn number_column(const ResultColumn& column);

/// The shown columns of all cases between those of `head` and answers and state.
ReportTable cases_table(const std::string& note, const std::vector<CaseColumn>& head, const std::vector<CaseRow>& rows);

}  // namespace railstrata
