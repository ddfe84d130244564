#include "report/report.hpp"

#include <fmt/format.h>

#include <sstream>

#include "core/faults.hpp"
#include "core/text.hpp"
#include "io/provenance.hpp"

namespace railstrata {
namespace {

namespace fs = std::filesystem;

/// A file of the folder, or of the one it stands in if it is one of several positions; empty if neither has it.
fs::path file_of(const fs::path& folder, const std::string& name) {
  if (fs::exists(folder / name)) return folder / name;
  const fs::path full = fs::absolute(folder).lexically_normal();
  if (full.filename().string().starts_with("position_") && fs::exists(full.parent_path() / name))
    return full.parent_path() / name;
  return {};
}

nlohmann::ordered_json json_of(const fs::path& file) {
  if (file.empty()) return nullptr;
  nlohmann::ordered_json out = nlohmann::ordered_json::parse(file_text(file), nullptr, false);
  if (!out.is_object())
    throw CaseError("this is not a JSON object", "write the results again with `railstrata run` or `railstrata bem`",
                    file.string());
  return out;
}

std::string unquoted(const std::string& text) {
  return text.size() >= 2 && text.front() == '"' && text.back() == '"' ? text.substr(1, text.size() - 2) : text;
}

/// The resolved case has a line for each option: "[table]", "[[layer]]", "key = value".
std::vector<CaseOption> options_of(const std::string& text) {
  std::vector<CaseOption> out;
  std::string table;
  int layers = 0;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    line = trimmed(line);
    if (line.empty() || line[0] == '#') continue;
    if (line.starts_with("[["))
      table = fmt::format("layer.{}", layers++);
    else if (line[0] == '[')
      table = line.substr(1, line.find(']') - 1);
    else if (const auto equals = line.find('='); equals != std::string::npos)
      out.push_back({table, std::string(trimmed(line.substr(0, equals))),
                     unquoted(std::string(trimmed(line.substr(equals + 1))))});
  }
  return out;
}

std::map<std::string, std::string> profiles_of(const ReportRun& run, const fs::path& folder) {
  std::map<std::string, std::string> out;
  std::error_code error;  // of a name too long: a file that is not there
  for (const char* key : {"rail_profile", "wheel_profile"})
    if (const std::string name = run.option("geometry", key);
        !name.empty() && fs::is_regular_file(folder / name, error))
      out[key] = sha256_of_file(folder / name);
  return out;
}

void read_tables(const fs::path& folder, ReportRun& run) {
  for (const std::string name : {"crack",
                                 "crack_depths",
                                 "depth_line",
                                 "history",
                                 "force_spectrum",
                                 "interface_slip",
                                 "points_history",
                                 "patch_film",
                                 "residual",
                                 "rail_longitudinal_section",
                                 "rail_cross_section",
                                 "wheel_longitudinal_section",
                                 "wheel_cross_section",
                                 "rail_slices",
                                 "wheel_slices",
                                 "shakedown_rail",
                                 "shakedown_rail_map",
                                 "shakedown_rail_sliding",
                                 "shakedown_wheel",
                                 "shakedown_wheel_map",
                                 "shakedown_wheel_sliding"})
    if (const fs::path file = file_of(folder, name + ".csv"); !file.empty())
      if (CsvTable table = read_csv(file); table.rows() > 0) run.tables.emplace(name, std::move(table));
}

}  // namespace

std::string ReportRun::option(const std::string& table, const std::string& key) const {
  for (const CaseOption& o : options)
    if (o.table == table && o.key == key) return o.value;
  return {};
}

const CsvTable* ReportRun::table(const std::string& file) const {
  const auto found = tables.find(file);
  return found == tables.end() ? nullptr : &found->second;
}

ReportRun read_report_run(const fs::path& folder) {
  ReportRun run;
  run.result = read_result_folder(folder);
  run.name = fs::absolute(folder / "").lexically_normal().parent_path().filename().string();
  if (const fs::path file = file_of(folder, "case.toml"); !file.empty()) {
    run.options = options_of(file_text(file));
    run.profile_sha256 = profiles_of(run, file.parent_path());
  }
  run.doubts = result_doubts(run.result);
  run.provenance = json_of(file_of(folder, "provenance.json"));
  run.geometry = json_of(file_of(folder, "geometry.json"));
  read_tables(folder, run);
  if (auto residual = json_of(file_of(folder, "residual.json")); residual.is_object())
    run.result.summary["residual"] = nlohmann::json::parse(residual.dump());
  return run;
}

}  // namespace railstrata
