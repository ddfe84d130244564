#include "study/study_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include <nlohmann/json.hpp>

#include "core/printable.hpp"
#include "io/output_file.hpp"
#include "io/provenance.hpp"

namespace railstrata {

namespace fs = std::filesystem;

bool is_study_folder(const fs::path& folder) {
  std::ifstream in(folder / "provenance.json", std::ios::binary);
  const auto origin = nlohmann::json::parse(in, nullptr, false);
  if (!origin.is_object() || !origin.contains("command_line") || !origin["command_line"].is_array()) return false;
  const auto& words = origin["command_line"];
  return std::find(words.begin(), words.end(), "study") != words.end();
}

FolderHold prepare_study_folder(const fs::path& folder, const LoadedStudy& study,
                                const std::vector<std::string>& command_line, const std::vector<std::string>& overrides,
                                int threads, bool force) {
  FolderHold hold = prepare_output_folder(folder, force, [&] { return is_study_folder(folder); });
  std::vector<fs::path> inputs{study.file};
  for (const StudyGroup& g : study.spec.groups)
    if (std::find(inputs.begin(), inputs.end(), g.base) == inputs.end()) inputs.push_back(g.base);
  write_whole_file(folder / "provenance.json", provenance_json(command_line, overrides, inputs, threads));
  write_whole_file(
      folder / "study.toml",
      fmt::format("# A copy for the record of {}: run that one, for its base and published are named relative "
                  "to its folder.\n{}",
                  printable(study.file.filename().string()), study.source_text));
  return hold;
}

std::vector<std::string> study_origin(const LoadedStudy& study) {
  return {fmt::format("RailStrata {}", version_text()),
          fmt::format("study: {} ({})", study.file.filename().string(), study.spec.title),
          "a case by one engine a line; the names of columns say their units; stresses of the rail"};
}

}  // namespace railstrata
