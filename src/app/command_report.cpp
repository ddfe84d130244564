#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>

#include <nlohmann/json.hpp>

#include "app/commands.hpp"
#include "core/faults.hpp"
#include "io/json_text.hpp"
#include "io/output_file.hpp"
#include "runs/write_report.hpp"

namespace railstrata {
namespace {

std::filesystem::path page_of(const CommandOptions& options) {
  std::filesystem::path page = options.out.empty() ? options.report.folders.front() / "report.html" : options.out;
  if (std::filesystem::is_directory(page)) page /= "report.html";
  return page;
}

}  // namespace

ExitCode command_report(const CommandOptions& options) {
  if (options.report.folders.size() > 1 && options.out.empty())
    throw CaseError("a report on several folders needs a place",
                    "name the page with --out, e.g. --out comparison.html");
  const std::filesystem::path page = page_of(options);
  if (!options.out.empty() && !options.force && std::filesystem::exists(page))
    throw CaseError(fmt::format("--out {}: there is a file of this name", page.string()),
                    "choose another name, or replace it with --force");
  for (const std::filesystem::path& folder : options.report.folders)
    if (!std::filesystem::is_directory(folder))
      throw CaseError(fmt::format("{} is not a result folder", folder.string()),
                      "give a folder that `railstrata run` or `railstrata bem` has written");
  if (page.has_parent_path()) make_folder(page.parent_path());
  for (const std::string& note : write_report(page, options.report.folders, options.report.reference))
    spdlog::warn("{}", note);
  if (options.json) fmt::print("{}\n", json_text(nlohmann::json{{"report", page.generic_string()}}));
  spdlog::info("the report is {}", page.string());
  return ExitCode::ok;
}

}  // namespace railstrata
