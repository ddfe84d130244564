#include "app/case_of.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

#include "app/shipped_files.hpp"
#include "reader/assumed.hpp"
#include "tables/contact_input.hpp"

namespace railstrata {
namespace {

/// Under its own title a changed case would be taken for the case as it stands in its file. What is written of a result
/// changes none.
std::string title_of(const std::string& title, const std::vector<std::string>& overrides) {
  std::vector<std::string> changes;
  for (const std::string& given : overrides) {
    if (given.starts_with("case.title")) return title;
    if (!given.starts_with("output.")) changes.push_back(given);
  }
  return changes.empty() ? title : fmt::format("{} [{}]", title, fmt::join(changes, ", "));
}

}  // namespace

LoadedCase load_case_of(const CommandOptions& options, const Use& use) {
  LoadedCase loaded = load_case(shipped_unless_there(options.case_file, "case.toml"), options.overrides);
  loaded.spec.title = title_of(loaded.spec.title, options.overrides);
  require_support(use, loaded);
  for (const std::string& note : notes_for(use, loaded)) spdlog::warn("{}", note);
  return loaded;
}

void report_assumed(const LoadedCase& loaded, const Use& use) {
  if (const std::string assumed = assumed_in(loaded, use); !assumed.empty()) spdlog::info("{}", assumed);
}

std::filesystem::path output_folder_of(const CommandOptions& options, const LoadedCase& loaded,
                                       const std::string& suffix) {
  if (!options.out.empty()) return options.out;
  const std::filesystem::path file = std::filesystem::absolute(loaded.file).lexically_normal();
  const std::filesystem::path name = file.stem() == "case" ? file.parent_path().filename() : file.stem();
  const std::optional<ContactInputName> input = contact_input_name(file);
  const std::string number = input && input->number > 0 ? fmt::format("-{}", input->number) : "";
  return std::filesystem::path("results") / (name.string() + number + suffix);
}

JobOrder job_order_of(const CommandOptions& options, const std::filesystem::path& folder, bool resume) {
  return {folder, resume, options.force, options.page, {options.command_line, options.threads}};
}

ExitCode code_of(JobEnd end) {
  switch (end) {
    case JobEnd::finished:
      return ExitCode::ok;
    case JobEnd::failed_checks:
      return ExitCode::failed_checks;
    case JobEnd::out_of_time:
      return ExitCode::unfinished;
    case JobEnd::stopped:
      break;
  }
  return ExitCode::interrupted;
}

}  // namespace railstrata
