#include "io/csv.hpp"

#include <fmt/format.h>

#include <iterator>
#include <sstream>
#include <stdexcept>

namespace railstrata {
namespace {

std::string heading(const std::vector<std::string>& provenance, const std::vector<std::string>& names) {
  std::string out;
  for (const std::string& text : provenance) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) out += "# " + line + '\n';
  }
  for (const std::string& name : names)
    if (name.empty() || name.find_first_of(",\"#\r\n") != std::string::npos) throw std::invalid_argument("bad name of a CSV column: '" + name + "'");
  return out + fmt::format("{}\n", fmt::join(names, ","));
}

}  // namespace

void write_csv(const std::filesystem::path& file, const std::vector<std::string>& provenance, const std::vector<CsvColumn>& columns) {
  std::vector<std::string> names;
  for (const CsvColumn& c : columns) names.push_back(c.name);
  std::string text = heading(provenance, names);
  const std::size_t rows = columns.empty() ? 0 : columns.front().values.size();
  for (const CsvColumn& c : columns)
    if (c.values.size() != rows) throw std::invalid_argument("CSV column '" + c.name + "' is not as long as the first");
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t j = 0; j < columns.size(); ++j) fmt::format_to(std::back_inserter(text), "{}{}", columns[j].values[i], j + 1 < columns.size() ? ',' : '\n');
  write_whole_file(file, text);
}

CsvLog::CsvLog(const std::filesystem::path& file, const std::vector<std::string>& provenance, const std::vector<std::string>& names)
    : file_(file), columns_(names.size()) {
  file_.write(heading(provenance, names));
}

void CsvLog::add(std::span<const double> row) {
  if (row.size() != columns_) throw std::invalid_argument("a CSV row has another number of values than there are columns");
  file_.write(fmt::format("{}\n", fmt::join(row, ",")));
}

}  // namespace railstrata
