#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cctype>

#include <nlohmann/json.hpp>

#include "app/commands.hpp"
#include "app/write_page.hpp"
#include "core/faults.hpp"
#include "core/shell_word.hpp"
#include "io/folder_kind.hpp"
#include "io/json_text.hpp"
#include "io/output_file.hpp"

namespace railstrata {
namespace {

std::filesystem::path page_of(const CommandOptions& options) {
  std::filesystem::path page = options.out.empty() ? options.report.folders.front() / "report.html" : options.out;
  if (std::filesystem::is_directory(page)) page /= "report.html";
  return page;
}

/// A page by another name opens in no browser, and a result's own files have other names.
void require_name_of_page(const std::filesystem::path& page) {
  std::string ending = page.extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (ending == ".html" || ending == ".htm") return;
  const std::filesystem::path other =
      page.has_filename() ? std::filesystem::path(page).replace_extension(".html") : page / "report.html";
  throw CaseError(fmt::format("--out {}: a page has a name that ends in .html", page.string()),
                  fmt::format("write for example --out {}", shell_word(other.string())));
}

}  // namespace

ExitCode command_report(const CommandOptions& options) {
  if (options.report.folders.size() > 1 && options.out.empty())
    throw CaseError(
        fmt::format("{} folders are given and no --out: a page on one folder goes into it, a page on several could go "
                    "into any of them",
                    options.report.folders.size()),
        "say where the page is to be written, e.g. --out comparison.html");
  const std::filesystem::path page = page_of(options);
  require_name_of_page(page);
  if (!options.out.empty() && !options.force && std::filesystem::exists(page))
    throw CaseError(fmt::format("--out {}: there is a file of this name", page.string()),
                    "choose another name, or replace it with --force");
  for (const std::filesystem::path& folder : options.report.folders)
    if (!std::filesystem::exists(folder / "summary.json"))
      throw CaseError(std::vector<Diagnostic>{no_result_here(folder)});
  if (page.has_parent_path()) make_folder(page.parent_path());
  const WrittenPage written = write_report(page, options.report.folders, options.report.reference);
  log_page(written);
  if (options.json) fmt::print("{}\n", json_text(nlohmann::json{{"report", page.generic_string()}}));
  spdlog::info("the report is {}", page.string());
  return written.verdict.ok ? ExitCode::ok : ExitCode::failed_checks;
}

}  // namespace railstrata
