#include "io/result_doubts.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <fstream>

#include <nlohmann/json.hpp>

#include "io/provenance.hpp"

namespace railstrata {
namespace {

namespace fs = std::filesystem;

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
                   newer ? "its files may say more or other things than are read here"
                         : "today's program may give other numbers"),
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

}  // namespace

std::vector<ResultDoubt> result_doubts(const fs::path& folder) {
  const fs::path home = folder_of_origin(folder);
  std::ifstream in(home / "provenance.json", std::ios::binary);
  const auto origin = nlohmann::json::parse(in, nullptr, false);
  std::vector<ResultDoubt> out;
  if (!origin.is_object()) return out;
  doubt_case(origin, home, out);
  doubt_version(origin, out);
  return out;
}

}  // namespace railstrata
