#include "io/result_folder.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <utility>

#include "core/engine.hpp"
#include "core/faults.hpp"
#include "core/text.hpp"
#include "io/folder_kind.hpp"
#include "io/provenance.hpp"
#include "io/result_files.hpp"
#include "record/csv.hpp"

namespace railstrata {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in && file.filename() == "summary.json")
    throw CaseError(std::vector<Diagnostic>{no_result_here(file.parent_path())});
  if (!in)
    throw CaseError(
        fmt::format("{} is not a result folder: it has no {}", file.parent_path().string(), file.filename().string()),
        "give a folder that `railstrata run` or `railstrata bem` has written");
  std::ostringstream text;
  text << in.rdbuf();
  return std::move(text).str();
}

[[noreturn]] void refuse(const fs::path& file, const std::string& what) {
  throw CaseError(what, "write the results again with `railstrata run` or `railstrata bem`", file.string());
}

/// The tables of the patches, which the column `patch` numbers in order; without it there is one.
std::vector<CsvTable> tables_of_patches(const CsvTable& table) {
  const auto numbered =
      std::find_if(table.columns.begin(), table.columns.end(), [](const CsvColumn& c) { return c.name == "patch"; });
  if (numbered == table.columns.end()) return {table};
  std::vector<CsvTable> out;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const double number = numbered->values[row];
    if (number != static_cast<double>(out.size())) {
      if (number != static_cast<double>(out.size() + 1)) refuse(table.file, "the patches are not numbered in order");
      out.push_back({table.file, {}});
      for (const CsvColumn& c : table.columns) out.back().columns.push_back({c.name, {}});
    }
    for (std::size_t c = 0; c < table.columns.size(); ++c)
      out.back().columns[c].values.push_back(table.columns[c].values[row]);
  }
  if (out.empty()) refuse(table.file, "there is no patch");
  return out;
}

ContactField patch_of(const CsvTable& table) {
  const fs::path& file = table.file;
  ContactField f;
  const std::string slip_of_shift = patch_numbers(true).back().column_name();
  f.slip_is_distance = std::any_of(table.columns.begin(), table.columns.end(),
                                   [&](const CsvColumn& c) { return c.name == slip_of_shift; });
  for (const PatchNumber& n : patch_numbers(f.slip_is_distance)) {
    const std::vector<double>& values = f.*n.values = table.column(n.column_name(), 1 / n.unit.column_factor);
    if (!std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); }))
      refuse(file, "a value is not a finite number");
  }
  for (const double s : table.column(kPatchState)) {
    if (s != 0 && s != 1 && s != 2) refuse(file, fmt::format("there is no contact state {}", s));
    f.state.push_back(static_cast<ContactState>(static_cast<int>(s)));
  }
  std::size_t run = 0;
  while (run < f.x.size() && std::abs(f.x[run] - f.x[0]) < 1e-9) ++run;
  if (run < 2 || f.x.size() % run != 0) refuse(file, "the points are not a grid");
  f.columns = static_cast<int>(run);
  f.stations = static_cast<int>(f.x.size() / run);
  return f;
}

const char* kind_of(const nlohmann::json& v) {
  if (v.is_string()) return "a text";
  if (v.is_boolean()) return "true or false";
  return v.is_array() ? "a list" : "a table";
}

/// Numbers or null, in tables within tables.
void require_numbers(const nlohmann::json& v, const std::string& name, const fs::path& file, int depth = 0) {
  constexpr int kDeepest = 8;  // of a summary: 4
  if (v.is_number() || v.is_null()) return;
  if (!v.is_object() || depth == kDeepest) refuse(file, fmt::format("{} is {}, not a number", name, kind_of(v)));
  for (const auto& [key, value] : v.items()) require_numbers(value, fmt::format("{}.{}", name, key), file, depth + 1);
}

/// Every value is of the kind that this program writes; otherwise a page would leave it out without a message.
void require_kinds(const nlohmann::json& summary, const fs::path& file) {
  for (const char* table : {"contact", "stress", "energy", "position_m"})
    if (summary.contains(table)) require_numbers(summary[table], table, file);
  if (summary.contains("patches")) {
    if (!summary["patches"].is_array())
      refuse(file, fmt::format("patches is {}, not a list", kind_of(summary["patches"])));
    for (const nlohmann::json& patch : summary["patches"]) {
      if (!patch.is_object()) refuse(file, fmt::format("a patch is {}, not a table", kind_of(patch)));
      require_numbers(patch, "patches", file);
    }
  }
  const std::string engine = text_at(summary, "/run/engine");
  if (!engine.empty() && !engine_of(engine))
    refuse(file, fmt::format("the engine is \"{}\", which this program does not have; its engines are {}", engine,
                             fmt::join(engine_words(), ", ")));
}

constexpr const char* kContradicted = "summary_contradicted";

fs::path folder_of_origin(const fs::path& folder) {
  const fs::path full = fs::absolute(folder / "").lexically_normal().parent_path();
  std::error_code error;
  const bool position = full.filename().string().starts_with("position_");
  return position && !fs::exists(full / "provenance.json", error) ? full.parent_path() : full;
}

std::array<int, 3> numbers_of(const std::string& version) {
  std::array<int, 3> n{};
  static_cast<void>(std::sscanf(version.c_str(), "%d.%d.%d", &n[0], &n[1], &n[2]));
  return n;
}

void doubt_version(const nlohmann::json& origin, std::vector<ResultDoubt>& out) {
  const std::string theirs = text_at(origin, "/version"), ours = build_info().version;
  if (theirs == ours || theirs.empty()) return;
  const bool newer = numbers_of(theirs) > numbers_of(ours);
  out.push_back(
      {"other_version",
       fmt::format("written by RailStrata {}, {} than this one ({}): {}", theirs, newer ? "newer" : "older", ours,
                   newer ? "its files may contain more or other data than this program reads"
                         : "this program may give other numbers"),
       false});
}

void doubt_case(const nlohmann::json& origin, const fs::path& folder, std::vector<ResultDoubt>& out) {
  const std::string then = text_at(origin, "/case_sha256");
  std::error_code error;
  if (then.empty() || !fs::exists(folder / "case.toml", error)) return;
  if (sha256_of_file(folder / "case.toml") == then) return;
  out.push_back({"case_edited",
                 "case.toml was changed after the run (its SHA-256 is not that of provenance.json): the numbers do not "
                 "belong to the options shown",
                 true});
}

void doubt_checks(const ResultFolder& result, std::vector<ResultDoubt>& out) {
  for (const KeptCheck& c : checks_of(result.summary))
    if (c.said_ok && !c.ok)
      out.push_back(
          {kContradicted,
           fmt::format("summary.json reports that the check {} holds, but its value is {:.4g}, its limit {:.4g}: it "
                       "was changed after the run",
                       c.name, c.value, c.limit),
           true});
}

/// Both files come from one computation. `tolerance`: how far the two numbers may be apart, relative.
void doubt_number(const ResultFolder& result, const char* path, double scale, const char* what, double of_patch,
                  double tolerance, std::vector<ResultDoubt>& out) {
  const double said = result.number(path);
  if (!std::isfinite(said) || std::abs(of_patch - said) <= tolerance * std::abs(said)) return;
  out.push_back({kContradicted,
                 fmt::format("summary.json has {} {:.6g}, but patch.csv gives {:.6g}: one of them was changed, is "
                             "incomplete or comes from another run",
                             what, scale * said, scale * of_patch),
                 true});
}

void doubt_patch(const ResultFolder& result, std::vector<ResultDoubt>& out) {
  constexpr double kRoundOff = 1e-9;   // of a table in MPa and mm
  constexpr double kOneNormal = 0.05;  // the sum takes the pressures of a curved surface as parallel
  const PatchMeasures patch = measure_patch(result.field);
  doubt_number(result, "/contact/p_max_Pa", 1e-6, "p_max [MPa]", patch.p_max, kRoundOff, out);
  doubt_number(result, "/contact/q_max_point_Pa", 1e-6, "q_max of a point [MPa]", patch.q_max_point, kRoundOff, out);
  doubt_number(result, "/contact/normal_force_N", 1e-3, "a normal force [kN] of", patch.force_z, kOneNormal, out);
}

}  // namespace

double number_at(const nlohmann::json& object, const std::string& path) {
  const nlohmann::json::json_pointer at(path);
  return object.contains(at) && object[at].is_number() ? object[at].get<double>() : kNotApplicable;
}

std::string text_at(const nlohmann::json& object, const std::string& path) {
  const nlohmann::json::json_pointer at(path);
  return object.contains(at) && object[at].is_string() ? object[at].get<std::string>() : "";
}

std::vector<nlohmann::json> objects_of(const nlohmann::json& object, const char* list) {
  std::vector<nlohmann::json> out;
  if (!object.contains(list) || !object[list].is_array()) return out;
  for (const nlohmann::json& entry : object[list])
    if (entry.is_object()) out.push_back(entry);
  return out;
}

std::vector<KeptCheck> checks_of(const nlohmann::json& summary) {
  std::vector<KeptCheck> out;
  for (const nlohmann::json& entry : objects_of(summary, "checks")) {
    const std::string name = text_at(entry, "/name");
    const Check check = at_most(name.empty() ? "check" : name, number_at(entry, "/value"), number_at(entry, "/limit"));
    out.push_back({check, entry.contains("ok") && entry["ok"].is_boolean() && entry["ok"].get<bool>()});
    out.back().ok = check.ok && out.back().said_ok;
  }
  return out;
}

ResultFolder parse_results(const std::string& summary, const std::string& patch, const fs::path& folder) {
  ResultFolder r;
  r.folder = folder;
  r.summary = nlohmann::json::parse(summary, nullptr, false);
  if (!r.summary.is_object() || !r.summary.contains("contact"))
    refuse(folder / "summary.json", "this is not a summary");
  require_kinds(r.summary, folder / "summary.json");
  r.title = text_at(r.summary, "/title");
  r.engine = text_at(r.summary, "/run/engine");
  const std::vector<CsvTable> tables = tables_of_patches(parse_csv(patch, folder / "patch.csv"));
  r.field = patch_of(tables.front());
  for (std::size_t k = 1; k < tables.size(); ++k) r.further.push_back(patch_of(tables[k]));
  return r;
}

ResultFolder read_result_folder(const fs::path& folder) {
  const std::string summary = text_of(folder / "summary.json");  // the one whose absence is reported first
  return parse_results(summary, text_of(folder / "patch.csv"), folder);
}

std::vector<ResultDoubt> result_doubts(const ResultFolder& result) {
  const fs::path home = folder_of_origin(result.folder);
  const auto origin = nlohmann::json::parse(file_text(home / "provenance.json"), nullptr, false);
  std::vector<ResultDoubt> out;
  doubt_checks(result, out);
  doubt_patch(result, out);
  if (!origin.is_object()) return out;
  doubt_case(origin, home, out);
  doubt_version(origin, out);
  return out;
}

}  // namespace railstrata
