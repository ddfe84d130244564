#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/version.h>
#include <CLI/CLI.hpp>

#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "app/commands.hpp"
#include "app/common_options.hpp"
#include "core/faults.hpp"
#include "core/parallel.hpp"
#include "core/simd.hpp"
#include "damage/grades.hpp"
#include "device/card.hpp"
#include "geometry/profile_names.hpp"
#include "io/provenance.hpp"
#include "record/this_process.hpp"

namespace railstrata {
namespace {

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

std::vector<std::string> grade_names() {
  std::vector<std::string> out;
  for (const Grade& g : grades()) out.emplace_back(g.name);
  return out;
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

ExitCode command_info(const CommandOptions& options) {
  const BuildInfo& build = build_info();
  nlohmann::ordered_json libraries;
  for (const auto& [name, version] : library_versions()) libraries[name] = version;
  libraries["spdlog"] = fmt::format("{}.{}.{}", SPDLOG_VER_MAJOR, SPDLOG_VER_MINOR, SPDLOG_VER_PATCH);
  nlohmann::ordered_json parts;
  for (const auto& [name, state] : build.parts) parts[name] = state;
  const nlohmann::ordered_json info{{"version", version_text()},
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
  if (options.json)
    fmt::print("{}\n", info.dump(2));
  else
    print_text(info);
  return ExitCode::ok;
}

}  // namespace

const Command kInfoCommand{"info", "Built-in profiles, compiler, instruction set, libraries, threads",
                           "Examples:\n  railstrata info\n  railstrata info --json\n",
                           [](CLI::App&, CommandOptions&) {}, command_info};

}  // namespace railstrata
