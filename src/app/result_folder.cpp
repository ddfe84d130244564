#include "app/result_folder.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>

#include "core/faults.hpp"

namespace railstrata {
namespace {

namespace fs = std::filesystem;
using Columns = std::map<std::string, std::vector<double>>;

std::ifstream open_for_reading(const fs::path& file) {
  std::ifstream in(file);
  if (!in) throw CaseError(fmt::format("{} is not a result folder: it has no {}", file.parent_path().string(), file.filename().string()), "give a folder that `railstrata run` or `railstrata bem` has written");
  return in;
}

[[noreturn]] void refuse(const fs::path& file, int line, const std::string& what) {
  throw CaseError(what, "write the results anew with `railstrata run` or `railstrata bem`", line > 0 ? fmt::format("{}:{}", file.string(), line) : file.string());
}

std::vector<std::string> names_of(const std::string& line) {
  std::vector<std::string> names(1);
  for (char c : line) {
    if (c == ',') names.emplace_back();
    else if (c != '\r') names.back() += c;
  }
  return names;
}

void read_row(const std::string& text, const fs::path& file, int line, const std::vector<std::string>& names, Columns& columns) {
  const char *at = text.data(), *end = at + text.size();
  for (std::size_t k = 0; k < names.size(); ++k) {
    double value = 0;
    const auto [next, error] = std::from_chars(at, end, value);
    const bool last = k + 1 == names.size();
    if (error != std::errc{} || (last ? next != end && *next != '\r' : next == end || *next != ',')) refuse(file, line, fmt::format("a row of {} numbers is expected", names.size()));
    columns[names[k]].push_back(value);
    at = last ? next : next + 1;
  }
}

Columns read_columns(const fs::path& file) {
  std::ifstream in = open_for_reading(file);
  std::vector<std::string> names;
  Columns columns;
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    if (line.empty() || line[0] == '#') continue;
    if (names.empty()) names = names_of(line);
    else read_row(line, file, number, names, columns);
  }
  return columns;
}

std::vector<double> take(Columns& columns, const fs::path& file, const std::string& name, double unit) {
  const auto found = columns.find(name);
  if (found == columns.end()) refuse(file, 0, fmt::format("there is no column {}", name));
  for (double& v : found->second) v *= unit;
  return std::move(found->second);
}

ContactField read_patch(const fs::path& file) {
  Columns columns = read_columns(file);
  ContactField f;
  f.x = take(columns, file, "x_mm", 1e-3), f.y = take(columns, file, "y_mm", 1e-3), f.z = take(columns, file, "z_mm", 1e-3);
  f.area = take(columns, file, "area_mm2", 1e-6);
  f.p = take(columns, file, "p_MPa", 1e6), f.q_x = take(columns, file, "q_x_MPa", 1e6), f.q_y = take(columns, file, "q_y_MPa", 1e6);
  f.slip_x = take(columns, file, "slip_x_mm_s", 1e-3), f.slip_y = take(columns, file, "slip_y_mm_s", 1e-3);
  for (double s : take(columns, file, "state_0separated_1stick_2slip", 1)) f.state.push_back(static_cast<ContactState>(std::lround(s)));
  std::size_t run = 0;
  while (run < f.x.size() && std::abs(f.x[run] - f.x[0]) < 1e-9) ++run;
  if (run < 2 || f.x.size() % run != 0) refuse(file, 0, "the points are not a grid");
  f.columns = static_cast<int>(run);
  f.stations = static_cast<int>(f.x.size() / run);
  return f;
}

std::string text_at(const nlohmann::json& summary, const std::string& path) {
  const nlohmann::json::json_pointer at(path);
  return summary.contains(at) && summary[at].is_string() ? summary[at].get<std::string>() : "";
}

}  // namespace

double ResultFolder::number(const std::string& path) const {
  const nlohmann::json::json_pointer at(path);
  return summary.contains(at) && summary[at].is_number() ? summary[at].get<double>() : std::numeric_limits<double>::quiet_NaN();
}

ResultFolder read_result_folder(const fs::path& folder) {
  ResultFolder r;
  r.folder = folder;
  const fs::path file = folder / "summary.json";
  std::ifstream in = open_for_reading(file);
  r.summary = nlohmann::json::parse(in, nullptr, false);
  if (!r.summary.is_object() || !r.summary.contains("contact")) refuse(file, 0, "this is not a summary");
  r.title = text_at(r.summary, "/title");
  r.engine = text_at(r.summary, "/run/engine");
  r.field = read_patch(folder / "patch.csv");
  return r;
}

}  // namespace railstrata
