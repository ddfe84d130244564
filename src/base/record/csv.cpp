#include "record/csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "core/faults.hpp"
#include "core/text.hpp"

namespace railstrata {
namespace {

std::string heading(const std::vector<std::string>& provenance, const std::vector<std::string>& names) {
  const std::string out = csv_remarks(provenance);
  for (const std::string& name : names)
    if (name.empty() || name.find_first_of(",\"#\r\n") != std::string::npos)
      throw std::invalid_argument("bad name of a CSV column: '" + name + "'");
  return out + fmt::format("{}\n", fmt::join(names, ","));
}

/// NaN (not applicable) is written as an empty cell.
std::string row_text(std::span<const double> row) {
  std::string text;
  for (std::size_t k = 0; k < row.size(); ++k) {
    const bool last = k + 1 == row.size();
    if (!std::isnan(row[k])) fmt::format_to(std::back_inserter(text), "{}", row[k]);
    text += last ? '\n' : ',';
  }
  return text;
}

[[noreturn]] void refuse(const std::filesystem::path& file, int line, const std::string& what) {
  throw CaseError(what, "write the results again with `railstrata run` or `railstrata bem`",
                  line > 0 ? fmt::format("{}:{}", file.string(), line) : file.string());
}

/// Names of columns in files of earlier versions, with the present names.
constexpr std::array<std::pair<std::string_view, std::string_view>, 5> kPresentNames{
    {{"tau_xy_MPa", "sigma_xy_MPa"},
     {"tau_yz_MPa", "sigma_yz_MPa"},
     {"tau_xz_MPa", "sigma_xz_MPa"},
     {"spin_1_m", "spin_per_m"},
     {"plastic_p", "plastic_strain_accumulated"}}};

std::vector<CsvColumn> columns_named(const std::string& line) {
  std::vector<CsvColumn> columns(1);
  for (char c : line) {
    if (c == ',')
      columns.emplace_back();
    else if (c != '\r')
      columns.back().name += c;
  }
  for (CsvColumn& column : columns)
    for (const auto& [old, present] : kPresentNames)
      if (column.name == old) column.name = present;
  return columns;
}

/// A row without its end of line that stops behind a comma is torn; one with it has an empty last field.
void read_row(const std::string& text, const std::filesystem::path& file, int line, bool ended,
              std::vector<CsvColumn>& columns) {
  const char *at = text.data(), *end = at + text.size();
  for (std::size_t k = 0; k < columns.size(); ++k) {
    double value = std::numeric_limits<double>::quiet_NaN();
    const bool last = k + 1 == columns.size(),
               empty = last ? k > 0 && ended && (at == end || *at == '\r') : at != end && *at == ',';
    const auto [next, error] = empty ? std::from_chars_result{at, std::errc{}} : std::from_chars(at, end, value);
    if (error != std::errc{} || (last ? next != end && *next != '\r' : next == end || *next != ','))
      refuse(file, line, fmt::format("a row of {} numbers is expected", columns.size()));
    columns[k].values.push_back(value);
    at = last ? next : next + 1;
  }
}

}  // namespace

std::vector<double> CsvTable::column(const std::string& name, double unit) const {
  for (const CsvColumn& c : columns)
    if (c.name == name) {
      std::vector<double> values = c.values;
      for (double& v : values) v *= unit;
      return values;
    }
  refuse(file, 0, fmt::format("there is no column {}", name));
}

CsvTable read_csv(const std::filesystem::path& file) {
  if (!std::ifstream(file)) refuse(file, 0, "the table cannot be read");
  return parse_csv(file_text(file), file);
}

CsvTable parse_csv(const std::string& text, const std::filesystem::path& file) {
  std::istringstream in(text);
  CsvTable table{file, {}};
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    if (line.empty() || line[0] == '#') continue;
    if (table.columns.empty())
      table.columns = columns_named(line);
    else
      read_row(line, file, number, !in.eof(), table.columns);
  }
  return table;
}

std::string csv_remarks(const std::vector<std::string>& texts) {
  std::string out;
  for (std::string text : texts) {
    std::replace(text.begin(), text.end(), '\r', '\n');
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) out += "# " + line + '\n';
  }
  return out;
}

void write_csv(const std::filesystem::path& file, const std::vector<std::string>& provenance,
               const std::vector<CsvColumn>& columns) {
  std::vector<std::string> names;
  for (const CsvColumn& c : columns) names.push_back(c.name);
  std::string text = heading(provenance, names);
  const std::size_t rows = columns.empty() ? 0 : columns.front().values.size();
  for (const CsvColumn& c : columns)
    if (c.values.size() != rows)
      throw std::invalid_argument("CSV column '" + c.name + "' does not have the length of the first");
  std::vector<double> row(columns.size());
  for (std::size_t i = 0; i < rows; ++i) {
    std::transform(columns.begin(), columns.end(), row.begin(), [i](const CsvColumn& c) { return c.values[i]; });
    text += row_text(row);
  }
  write_whole_file(file, text);
}

CsvLog::CsvLog(const std::filesystem::path& file, const std::vector<std::string>& provenance,
               const std::vector<std::string>& names)
    : file_(file), columns_(names.size()) {
  file_.write(heading(provenance, names));
}

void CsvLog::add(std::span<const double> row) {
  if (row.size() != columns_)
    throw std::invalid_argument("a CSV row has a different number of values than there are columns");
  file_.write(row_text(row));
}

}  // namespace railstrata
