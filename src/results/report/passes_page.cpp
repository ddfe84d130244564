#include "report/passes_page.hpp"

#include <fmt/format.h>

#include <fstream>
#include <string>

#include "core/faults.hpp"
#include "record/csv.hpp"
#include "record/json.hpp"
#include "record/output_file.hpp"
#include "report/page.hpp"
#include "report/payload.hpp"

namespace railstrata {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr std::size_t kMostPasses = 1000;  // of passes.csv

/// Columns of a table by passes; of many passes every so many, as a chart shows them.
Json passes_columns(const CsvTable& table) { return table_json(table, 1 + table.rows() / kMostPasses); }

Json columns_if_there(const fs::path& file) { return fs::exists(file) ? table_json(read_csv(file)) : Json(nullptr); }

Json summary_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in)
    throw CaseError("no passes.json: not a folder of `railstrata passes`, or not finished",
                    "give the folder that `railstrata passes` wrote, or continue with --resume", file.string());
  Json out = Json::parse(in, nullptr, false);
  if (!out.is_object() || !out.contains("title") || !out["title"].is_string())
    throw CaseError("is damaged", "write the results anew with `railstrata passes`", file.string());
  return out;
}

/// The points of a section as rows of depth, which the page draws: a file with lines missing makes none. Elements say
/// their row and column.
void require_grid(const CsvTable& table) {
  if (table.columns.back().name == "column") return;
  const std::vector<double> y = table.column("y_mm"), depth = table.column("depth_mm");
  std::size_t width = 0;
  while (width < depth.size() && depth[width] == depth[0]) ++width;
  bool whole = width > 0 && depth.size() % width == 0;
  for (std::size_t i = 0; whole && i < depth.size(); ++i)
    whole = y[i] == y[i % width] && depth[i] == depth[i - i % width];
  if (!whole)
    throw CaseError("its rows do not make a grid of depths", "write the results anew with `railstrata passes`",
                    table.file.string());
}

Json story_of(const fs::path& folder) {
  const CsvTable residual = read_csv(folder / "residual.csv");
  require_grid(residual);
  const fs::path name = fs::absolute(folder).lexically_normal();
  return {{"name", (name.has_filename() ? name : name.parent_path()).filename().string()},
          {"summary", summary_of(folder / "passes.json")},
          {"passes", passes_columns(read_csv(folder / "passes.csv"))},
          {"residual", table_json(residual)},
          {"profile", table_json(read_csv(folder / "profile.csv"))},
          {"loops", columns_if_there(folder / "loops.csv")},
          {"along", columns_if_there(folder / "along.csv")}};
}

}  // namespace

void write_passes_page(const fs::path& page, const std::vector<fs::path>& folders) {
  Report report;
  report.passes = Json::array();
  for (const fs::path& folder : folders) report.passes.push_back(story_of(folder));
  report.title = folders.size() == 1
                     ? fmt::format("{}: passes", report.passes[0]["summary"]["title"].get<std::string>())
                     : fmt::format("passes over {} rails", folders.size());
  write_whole_file(page, report_page(report));
}

}  // namespace railstrata
