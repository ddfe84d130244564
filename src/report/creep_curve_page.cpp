#include "report/creep_curve_page.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>

#include "io/output_file.hpp"
#include "report/page.hpp"

namespace railstrata {
namespace {

struct Named {
  const char *column, *name, *dash;
};
constexpr Named kTheories[] = {{"full", "full half-space theory, with the case's layers", "solid"},
                               {"fastsim", "FASTSIM, Hertz ellipse", "dash"},
                               {"polach", "Polach", "dot"},
                               {"vermeulen_johnson", "Vermeulen-Johnson", "dashdot"}};

std::string heading_of(const std::string& column) {
  static const std::map<std::string, std::string> names{{"creepage", "longitudinal creepage"},
                                                        {"lateral_creepage", "lateral creepage"},
                                                        {"spin_per_m", "spin [1/m]"},
                                                        {"full", "full theory"},
                                                        {"fastsim", "FASTSIM"},
                                                        {"polach", "Polach"},
                                                        {"vermeulen_johnson", "Vermeulen-Johnson"},
                                                        {"linear", "Kalker, linear"},
                                                        {"slip_area_fraction", "slip area / patch area"},
                                                        {"full_across", "other force"},
                                                        {"full_moment_mm", "moment [mm]"}};
  const auto found = names.find(column);
  return found == names.end() ? column : found->second;
}

const CsvColumn* find(const std::vector<CsvColumn>& table, const std::string& name) {
  for (const CsvColumn& c : table)
    if (c.name == name) return &c;
  return nullptr;
}

ReportSeries line(const std::string& name, const CsvColumn& x, const CsvColumn& y, const char* dash = "solid",
                  double factor = 1) {
  ReportSeries out{.name = name, .x = x.values, .y = y.values, .markers = true, .dash = dash};
  for (double& v : out.y) v *= factor;
  return out;
}

std::string axis_of(const CsvColumn& varied) {
  if (varied.name == "spin_per_m") return "spin [1/m]";
  return varied.name == "creepage" ? "longitudinal creepage (negative: driving)" : "lateral creepage";
}

ReportTable points_of(const std::vector<CsvColumn>& table) {
  ReportTable out{.id = "points",
                  .title = "Points",
                  .note = "Forces and moment over f F_n, on the wheel. creep_curve.csv has every digit.",
                  .columns = {},
                  .rows = {}};
  for (const CsvColumn& c : table) out.columns.push_back(heading_of(c.name));
  for (std::size_t i = 0; i < table.front().values.size(); ++i) {
    std::vector<nlohmann::ordered_json> row;
    for (const CsvColumn& c : table) row.emplace_back(c.values[i]);
    out.rows.push_back(std::move(row));
  }
  return out;
}

}  // namespace

void write_creep_curve_page(const std::filesystem::path& page, const std::string& title, const std::string& force,
                            const std::vector<CsvColumn>& table, const std::vector<std::string>& notes) {
  const CsvColumn& x = table.front();
  Report report;
  report.title = fmt::format("{}: creep curve", title);
  ReportChart curve{"creep",
                    "Creep curve",
                    fmt::format("Force on the wheel over friction limit. Kalker's linear theory is in the table. {}",
                                fmt::join(notes, " ")),
                    axis_of(x),
                    fmt::format("{} / (f F_n)", force),
                    {}};
  for (const Named& t : kTheories)
    if (const CsvColumn* y = find(table, t.column)) curve.series.push_back(line(t.name, x, *y, t.dash));
  report.charts.push_back(std::move(curve));
  if (const CsvColumn* slip = find(table, "slip_area_fraction"))
    report.charts.push_back({"slip",
                             "Slip",
                             "By the full theory.",
                             axis_of(x),
                             "slip area / patch area [%]",
                             {line("full half-space theory", x, *slip, "solid", 100)}});
  if (const CsvColumn* across = find(table, "full_across"))
    report.charts.push_back({"across",
                             "The other force",
                             "By the full theory, on the wheel.",
                             axis_of(x),
                             "other force / (f F_n)",
                             {line("full half-space theory", x, *across)}});
  if (const CsvColumn* moment = find(table, "full_moment_mm"))
    report.charts.push_back({"moment",
                             "Moment about the contact normal",
                             "By the full theory, on the wheel.",
                             axis_of(x),
                             "moment / (f F_n) [mm]",
                             {line("full half-space theory", x, *moment)}});
  report.tables = {points_of(table)};
  write_whole_file(page, report_page(report));
}

}  // namespace railstrata
