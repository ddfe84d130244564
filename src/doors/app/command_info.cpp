#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/version.h>
#include <CLI/CLI.hpp>

#include <memory>

#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "app/common_options.hpp"
#include "core/faults.hpp"
#include "core/parallel.hpp"
#include "core/simd.hpp"
#include "device/card.hpp"
#include "geometry/profile_names.hpp"
#include "io/provenance.hpp"
#include "material/steels.hpp"
#include "options/case_schema.hpp"
#include "record/this_process.hpp"
#include "report/result_reference.hpp"
#include "rules/clashes.hpp"

namespace railstrata {
namespace {

struct InfoOptions {
  bool schema = false;      ///< --schema: of cases
  bool results = false;     ///< --results: of results instead
  bool markdown = false;    ///< --markdown: their reference page instead
  bool exclusions = false;  ///< --exclusions
};

void print_schema(const InfoOptions& wanted) {
  if (wanted.exclusions)
    fmt::print("{}", exclusions_markdown());
  else if (wanted.results)
    fmt::print("{}", wanted.markdown ? results_reference_markdown() : results_reference_json().dump(2) + "\n");
  else
    fmt::print("{}", wanted.markdown ? case_reference_markdown() : case_json_schema());
}

void print_text(const nlohmann::ordered_json& info) {
  for (const auto& [key, value] : info.items()) {
    std::string text = value.is_string() ? value.get<std::string>() : value.dump();
    if (value.is_array()) text = fmt::format("{}", fmt::join(value.get<std::vector<std::string>>(), ", "));
    if (key == "parts") {
      for (const auto& [name, state] : value.items()) fmt::print("{:<16} {}\n", name, state.get<std::string>());
      continue;
    }
    if (value.is_object()) {
      text.clear();
      for (const auto& [name, version] : value.items())
        text += fmt::format("{}{} {}", text.empty() ? "" : ", ", name, version.get<std::string>());
    }
    fmt::print("{:<16} {}\n", key, text);
  }
}

/// The card that run.device = "gpu" would use, or why there is none.
std::string card() {
  try {
    device::require_card();
    return device::card_name();
  } catch (const EnvironmentError& e) {
    return fmt::format("none: {}", e.what());
  }
}

nlohmann::ordered_json info_json() {
  const BuildInfo& build = build_info();
  nlohmann::ordered_json libraries;
  for (const auto& [name, version] : library_versions()) libraries[name] = version;
  libraries["spdlog"] = fmt::format("{}.{}.{}", SPDLOG_VER_MAJOR, SPDLOG_VER_MINOR, SPDLOG_VER_PATCH);
  nlohmann::ordered_json parts;
  for (const auto& [name, state] : build.parts) parts[name] = state;
  return {{"version", version_text()},
          {"rail_profiles", builtin_profile_names(ProfileKind::rail)},
          {"wheel_profiles", builtin_profile_names(ProfileKind::wheel)},
          {"grades", grade_names()},
          {"compiler", build.compiler},
          {"flags", build.flags},
          {"build_type", build.build_type},
          {"isa", instruction_set()},
          {"cpu", cpu_name()},
          {"cores", std::thread::hardware_concurrency()},
          {"threads", max_threads()},
          {"card", card()},
          {"parts", parts},
          {"libraries", libraries}};
}

ExitCode command_info(const InfoOptions& wanted, const CommandOptions& options) {
  if (wanted.schema) {
    print_schema(wanted);
    return ExitCode::ok;
  }
  const nlohmann::ordered_json info = info_json();
  if (options.json)
    fmt::print("{}\n", info.dump(2));
  else
    print_text(info);
  return ExitCode::ok;
}

CommandWork declare_info(CLI::App& sub, CommandOptions& options) {
  const auto own = std::make_shared<InfoOptions>();
  auto* schema = sub.add_flag("--schema", own->schema, "The JSON schema of case files, for editors");
  sub.add_flag("--results", own->results, "With --schema: of results, every number of summary.json and every check")
      ->needs(schema);
  sub.add_flag("--markdown", own->markdown, "With --schema: the reference page in Markdown")->needs(schema);
  sub.add_flag("--exclusions", own->exclusions, "With --schema: a page in Markdown, which settings exclude each other")
      ->needs(schema);
  return [own, &options] { return command_info(*own, options); };
}

}  // namespace

extern const Command kInfoCommand{
    "info", "Version, built-in profiles, steels, libraries, this machine; the schema of case files and results",
    "Examples:\n  railstrata info\n  railstrata info --json\n  railstrata info --schema > case.schema.json\n  "
    "railstrata info --schema --results --markdown\n",
    declare_info};

}  // namespace railstrata
