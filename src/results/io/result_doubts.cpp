#include "io/result_doubts.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>

#include <nlohmann/json.hpp>

#include "io/provenance.hpp"
#include "result/patch.hpp"

namespace railstrata {
namespace {

namespace fs = std::filesystem;

constexpr const char* kContradicted = "summary_contradicted";

fs::path folder_of_origin(const fs::path& folder) {
  const fs::path full = fs::absolute(folder / "").lexically_normal().parent_path();
  std::error_code error;
  const bool position = full.filename().string().starts_with("position_");
  return position && !fs::exists(full / "provenance.json", error) ? full.parent_path() : full;
}

std::string text_of(const nlohmann::json& origin, const char* key) {
  return origin.contains(key) && origin[key].is_string() ? origin[key].get<std::string>() : "";
}

std::array<int, 3> numbers_of(const std::string& version) {
  std::array<int, 3> n{};
  static_cast<void>(std::sscanf(version.c_str(), "%d.%d.%d", &n[0], &n[1], &n[2]));
  return n;
}

void doubt_version(const nlohmann::json& origin, std::vector<ResultDoubt>& out) {
  const std::string theirs = text_of(origin, "version"), ours = build_info().version;
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
  const std::string then = text_of(origin, "case_sha256");
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

std::vector<ResultDoubt> result_doubts(const ResultFolder& result) {
  const fs::path home = folder_of_origin(result.folder);
  std::ifstream in(home / "provenance.json", std::ios::binary);
  const auto origin = nlohmann::json::parse(in, nullptr, false);
  std::vector<ResultDoubt> out;
  doubt_checks(result, out);
  doubt_patch(result, out);
  if (!origin.is_object()) return out;
  doubt_case(origin, home, out);
  doubt_version(origin, out);
  return out;
}

}  // namespace railstrata
