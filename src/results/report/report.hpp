#pragma once
// Data of a report: a list of runs, the checks of their quality, and for a study tables and charts over all of them.
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "io/result_folder.hpp"
#include "record/csv.hpp"

namespace railstrata {

/// An option of the resolved case; layers are the tables "layer.0", "layer.1", …
struct CaseOption {
  std::string table, key, value;
};

/// A result folder, read whole. What an older folder has not is empty.
struct ReportRun {                                    // NOLINT(bugprone-exception-escape): as of ResultFolder
  std::string name;                                   ///< what the report calls it
  ResultFolder result;                                ///< summary.json, patch.csv
  std::vector<CaseOption> options;                    ///< case.toml
  std::map<std::string, std::string> profile_sha256;  ///< of the content of profile files, by "rail_profile" and
                                                      ///< "wheel_profile"; none for built-in profiles and lost files
  nlohmann::ordered_json provenance, geometry;        ///< provenance.json, geometry.json
  double shear_on_elements = std::numeric_limits<double>::quiet_NaN();  ///< of a finite element run: q_max_point [Pa]
                                                                        ///< of the half-space solution on cells as
                                                                        ///< large as its elements; NaN: not solved
  std::vector<ResultDoubt> doubts;         ///< why its numbers may not be those of its case
  std::map<std::string, CsvTable> tables;  ///< its further tables with rows, by their names without ".csv"

  /// The value of an option as the case writes it; empty if it is not there.
  std::string option(const std::string& table, const std::string& key) const;
  /// Null: it is not there.
  const CsvTable* table(const std::string& file) const;
};

/// Reads a folder of `run` or `bem`. A position_<mm> folder takes case, provenance and history from the folder it
/// stands in. Throws CaseError as read_result_folder does.
ReportRun read_report_run(const std::filesystem::path& folder);

/// One line of the verdict.
struct ReportCheck {
  std::string name;
  std::vector<int> runs;  ///< one: that run's own; two: the first against the second; none: over all cases of a study
  bool judged = true;     ///< false: shown, and no part of the verdict
  bool ok = true;
  double value = 0, limit = 0;
  std::string note{};
};

/// An answer of the page, in its banner.
struct ReportAnswer {
  std::string tone;         ///< "good", "open", "bad": green, amber, red; "plain": a number without a verdict
  std::string title, text;  ///< "Does not last", "wheel, at the surface: …"
};

/// For a study. Cells hold text, numbers or null.
struct ReportTable {
  std::string id, title, note;
  std::vector<std::string> columns;
  std::vector<std::vector<nlohmann::ordered_json>> rows;
};

/// A column of rows, whose cells are texts, numbers or null.
template <class Row>
struct TextColumn {
  std::string name;
  std::function<nlohmann::ordered_json(const Row&)> cell;
};
/// Adds the rows and the names of these columns, all that the table has.
template <class Row>
void add_rows(ReportTable& table, const std::vector<Row>& rows, const std::vector<TextColumn<Row>>& columns) {
  for (const TextColumn<Row>& c : columns) table.columns.push_back(c.name);
  for (const Row& row : rows) {
    std::vector<nlohmann::ordered_json>& cells = table.rows.emplace_back();
    for (const TextColumn<Row>& c : columns) cells.push_back(c.cell(row));
  }
}

struct ReportSeries {
  std::string name;
  std::vector<double> x, y;
  bool markers = true;
  int colour = -1;  ///< place among the page's colours; -1: the series' own
  std::string dash = "solid";
};
struct ReportChart {
  std::string id, title, note;
  std::string x, y;  ///< axes, with units
  std::vector<ReportSeries> series;
  std::vector<std::string> bars{};  ///< names of y = 0, 1, … from below, where lines are bars; x is logarithmic then
  bool wide = false;                ///< as wide as the page
  std::string log = {};             ///< logarithmic axes: "x", "xy"
};

/// A row of maps of one quantity, one for each run, on one scale.
struct ReportMaps {
  std::string id, title, note;
  std::string kind;  ///< "state", "von_mises", "sigma_1"
  std::vector<int> runs;
  std::vector<std::string> names;  ///< of the maps
};

/// Verdict of a case and its factor to shakedown under any traffic; or a value alone.
struct ReportGridCell {
  std::string verdict;                                       ///< empty: no result, or a value alone
  double factor = std::numeric_limits<double>::quiet_NaN();  ///< or the value
  std::vector<std::string> fails_by;                         ///< all that ends it
};
struct ReportGrid {
  std::string name;
  std::vector<std::string> x, y;      ///< values of the keys, in order
  std::vector<ReportGridCell> cells;  ///< x + x.size() * y
};
/// A row of grids over two keys, of verdicts (judge/judgement.hpp) or of a value.
struct ReportGrids {
  std::string id, title, note;
  std::string x, y;   ///< axes, with units
  std::string value;  ///< with its unit; empty: verdicts
  std::vector<ReportGrid> grids;
};

struct Report {
  std::string title;
  std::vector<ReportRun> runs;
  std::vector<ReportAnswer> answers;
  std::vector<ReportCheck> checks;
  std::vector<ReportTable> tables;
  std::vector<ReportChart> charts;
  std::vector<ReportMaps> maps;
  std::vector<ReportGrids> grids;
  nlohmann::ordered_json passes;  ///< over rails that yield, report/passes_page.hpp; null: none
};

}  // namespace railstrata
