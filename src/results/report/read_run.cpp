#include "report/read_run.hpp"

#include <fmt/format.h>

#include <fstream>
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

std::optional<CsvTable> table_of(const fs::path& file) {
  if (file.empty()) return std::nullopt;
  CsvTable table = read_csv(file);
  if (table.rows() == 0) return std::nullopt;
  return table;
}

}  // namespace

std::string ReportRun::option(const std::string& table, const std::string& key) const {
  for (const CaseOption& o : options)
    if (o.table == table && o.key == key) return o.value;
  return {};
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
  run.depth_line = table_of(file_of(folder, "depth_line.csv"));
  run.history = table_of(file_of(folder, "history.csv"));
  run.spectrum = table_of(file_of(folder, "force_spectrum.csv"));
  run.points = table_of(file_of(folder, "points_history.csv"));
  run.film = table_of(file_of(folder, "patch_film.csv"));
  for (const char* name : {"rail_longitudinal", "rail_cross", "wheel_longitudinal", "wheel_cross"})
    if (auto table = table_of(file_of(folder, std::string(name) + "_section.csv")))
      run.sections.emplace(name, std::move(*table));
  if (auto table = table_of(file_of(folder, "residual.csv"))) run.sections.emplace("residual", std::move(*table));
  if (auto residual = json_of(file_of(folder, "residual.json")); residual.is_object())
    run.result.summary["residual"] = nlohmann::json::parse(residual.dump());
  for (const char* body : {"rail", "wheel"})
    if (auto table = table_of(file_of(folder, std::string(body) + "_slices.csv")))
      run.slices.emplace(body, std::move(*table));
  for (const char* name : {"rail", "rail_map", "rail_sliding", "wheel", "wheel_map", "wheel_sliding"})
    if (auto table = table_of(file_of(folder, fmt::format("shakedown_{}.csv", name))))
      run.shakedown.emplace(name, std::move(*table));
  return run;
}

}  // namespace railstrata
