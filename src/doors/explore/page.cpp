#include "explore/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <map>
#include <set>
#include <string_view>

#include <nlohmann/json.hpp>

#include "core/faults.hpp"
#include "explore/assets.hpp"
#include "io/provenance.hpp"
#include "record/escaped_text.hpp"
#include "record/json.hpp"
#include "report/result_reference.hpp"
#include "result/patch.hpp"
#include "rules/clashes.hpp"
#include "spec/case_spec.hpp"
#include "text/text_file.hpp"

namespace railstrata {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

/// Deep enough for a case that names a file some folders above its own.
constexpr const char* kFolder = "/a/b/c/d/e/f/g/case";

/// A profile file goes into the page's own folder under its bare name, and an override leads to it.
void place_profile(const LoadedCase& loaded, std::string_view key, const std::string& name, Json& seed) {
  for (const fs::path& input : loaded.inputs)
    if (input.string() == name) {
      const std::string own = fmt::format("{}_profile/{}", key.substr(0, key.find('_')), input.filename().string());
      seed["files"][own] = read_text_file(input, "name a profile's file");
      seed["placed"].push_back(fmt::format("geometry.{}={}", key, own));
    }
}

/// Other files that the case reads keep their place beside it.
void place_others(const LoadedCase& loaded, Json& seed) {
  const GeometrySpec& g = loaded.spec.geometry;
  const fs::path folder = fs::absolute(loaded.file).lexically_normal().parent_path();
  for (std::size_t k = 1; k < loaded.inputs.size(); ++k) {
    const fs::path& input = loaded.inputs[k];
    if (input.string() == g.rail_profile || input.string() == g.wheel_profile) continue;
    const fs::path beside = fs::absolute(input).lexically_normal().lexically_relative(folder);
    seed["files"][beside.generic_string()] = read_text_file(input, "name a file beside the case");
  }
}

/// Whether a layer of the case may be given its stiffness as a ratio: not where the case has a modulus.
bool takes_ratio(const LoadedCase& loaded, std::size_t layer) {
  try {
    static_cast<void>(with_overrides(loaded, {fmt::format("layer.{}.young_ratio=1", layer)}));
    return true;
  } catch (const CaseError&) {
    return false;
  }
}

/// Names and units of the numbers, so that a new one needs no new script.
Json number_words() {
  const Json all = results_reference_json();
  return {{"numbers", all["numbers"]}, {"zones", all["zones"]}, {"measures", all["measures"]}};
}

std::string engine_version() {
  const std::string_view line = explorer_engine_version();
  return std::string(line.substr(0, line.find('\n')));
}

Json seed_of(const LoadedCase& loaded, const fs::path& as_given, double cell) {
  require_support(uses::kExplorer, loaded);
  const fs::path file = loaded.file.lexically_normal();
  const fs::path stem = file.stem() == "case" ? fs::absolute(file).parent_path().filename() : file.stem();
  Json seed{{"case", loaded.source_text},
            {"file", as_given.is_absolute() ? file.filename().string() : as_given.generic_string()},
            {"folder", kFolder},
            {"name", stem.string()},
            {"title", loaded.spec.title},
            {"overrides", loaded.overrides},
            {"placed", Json::array()},
            {"files", Json::object()},
            {"ratioKeys", Json::array()},
            {"cell", cell},
            {"version", version_text()},
            {"engine", engine_version()},
            {"words", number_words()}};
  place_profile(loaded, "rail_profile", loaded.spec.geometry.rail_profile, seed);
  place_profile(loaded, "wheel_profile", loaded.spec.geometry.wheel_profile, seed);
  place_others(loaded, seed);
  for (std::size_t k = 0; k < loaded.spec.layers.size(); ++k) seed["ratioKeys"].push_back(takes_ratio(loaded, k));
  return seed;
}

/// A block of data: no browser runs it.
std::string data_block(std::string_view id, std::string_view type, std::string_view text) {
  return fmt::format("<script type=\"{}\" id=\"{}\">{}</script>\n", type, id, text);
}

/// Seven digits: nothing is computed with them.
Json rounded(const std::vector<double>& values) {
  Json out = Json::array();
  for (const double v : values) out.push_back(static_cast<double>(static_cast<float>(v)));
  return out;
}

/// Which points bear pressure, x and y rising: one letter each, station by station.
Json pressed_json(const ContactField& f) {
  const std::size_t columns = static_cast<std::size_t>(f.columns), last = f.p.size() - columns;
  const bool back = f.x[last] < f.x[0], left = f.y[columns - 1] < f.y[0];
  std::string pressed(f.p.size(), '0');
  for (std::size_t k = 0; k < f.p.size(); ++k) {
    const std::size_t i = k / columns, j = k % columns,
                      to = (back ? last - i * columns : i * columns) + (left ? columns - 1 - j : j);
    if (f.p[k] > 0) pressed[to] = '1';
  }
  return {{"stations", f.stations},
          {"columns", f.columns},
          {"x", rounded({std::min(f.x[0], f.x[last]), std::max(f.x[0], f.x[last])})},
          {"y", rounded({std::min(f.y[0], f.y[columns - 1]), std::max(f.y[0], f.y[columns - 1])})},
          {"pressed", pressed}};
}

/// The largest of each depth of the section along the rail, with its sign.
Json depth_json(const CsvTable& section) {
  const std::vector<double> depth = section.column("depth_mm", kMilli);
  Json out{{"depth", std::set(depth.begin(), depth.end())}};
  for (const auto& [name, column] : {std::pair{"von_mises", "von_mises_MPa"}, std::pair{"tau_xz", "sigma_xz_MPa"},
                                     std::pair{"sigma_1", "sigma_1_MPa"}}) {
    const std::vector<double> values = section.column(column, kMega);
    std::map<double, double> largest;
    for (std::size_t k = 0; k < depth.size(); ++k)
      if (double& most = largest[depth[k]]; std::abs(values[k]) > std::abs(most)) most = values[k];
    for (const auto& [at, most] : largest) out[name].push_back(most);
  }
  return out;
}

/// Numbers, centre line, border and stresses over depth of a result, for the page to compare with.
Json reported_json(const ReportRun& run) {
  const CentreLine line = centre_line(run.result.field);
  Json summary{{"stress", Json::object()}, {"damage", Json::object()}};
  for (const char* key : {"contact", "stress", "damage", "shakedown"})
    if (run.result.summary.contains(key)) summary[key] = run.result.summary[key];
  Json out{{"summary", summary}, {"x", rounded(line.x)}, {"p", rounded(line.p)}, {"q_x", rounded(line.q_x)}};
  if (!run.result.field.p.empty()) out["patch"] = pressed_json(run.result.field);
  if (const CsvTable* section = run.table("rail_longitudinal_section")) out["section"] = depth_json(*section);
  return out;
}

std::string scripts() { return policy_hash(explorer_script()) + " 'wasm-unsafe-eval'"; }
/// The worker comes from a blob that the page makes of its own text; it may make a WebAssembly module and nothing else.
constexpr const char* kWorkers = "worker-src blob:; ";

std::string page_of(const LoadedCase& loaded, const Json& seed) {
  const std::string policy =
      fmt::format("default-src 'none'; script-src {}; style-src {}; {}base-uri 'none'; form-action 'none'", scripts(),
                  policy_hash(explorer_style()), kWorkers);
  return fmt::format(
             "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta "
             "http-equiv=\"Content-Security-Policy\" content=\"{}\">\n"
             "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<meta name=\"generator\" "
             "content=\"RailStrata {}\">\n<title>What if? {}</title>\n<style>{}</style>\n</head>\n<body>\n"
             "<noscript>This page computes with a script of its own; allow scripts to use it.</noscript>\n",
             policy, version_text(), markup_text(loaded.spec.title), explorer_style()) +
         data_block("data", "application/json", json_in_page(json_text(seed))) +
         data_block("worker", "text/plain", fmt::format("{}\n{}", explorer_engine_script(), explorer_worker())) +
         data_block("engine", "text/plain", base64_of(explorer_engine())) +
         data_block("licences", "text/plain", explorer_licences()) +
         fmt::format("<script>{}</script>\n</body>\n</html>\n", explorer_script());
}

}  // namespace

std::string explorer_page(const LoadedCase& loaded, const fs::path& as_given, double cell) {
  return page_of(loaded, seed_of(loaded, as_given, cell));
}

FramedPage what_if_page(const LoadedCase& loaded, const fs::path& as_given, double cell, const ReportRun& reported) {
  Json seed = seed_of(loaded, as_given, cell);
  seed["reported"] = reported_json(reported);
  return {page_of(loaded, seed), " " + scripts(), " " + policy_hash(explorer_style()), kWorkers};
}

}  // namespace railstrata
