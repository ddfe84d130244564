#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "app/commands.hpp"
#include "app/common_options.hpp"
#include "app/control.hpp"
#include "app/page_name.hpp"
#include "bem/bem_options.hpp"
#include "core/engine.hpp"
#include "core/faults.hpp"
#include "explore/page.hpp"
#include "io/folder_kind.hpp"
#include "record/json.hpp"
#include "record/output_file.hpp"
#include "report/passes_page.hpp"
#include "report/read_run.hpp"
#include "runs/write_framed_report.hpp"

namespace railstrata {
namespace {

std::filesystem::path page_of(const CommandOptions& options) {
  std::filesystem::path page = options.out.empty() ? options.report.folders.front() / "report.html" : options.out;
  if (std::filesystem::is_directory(page)) page /= "report.html";
  return page;
}

/// Folders of `passes`, one or several beside each other.
bool of_passes(const std::vector<std::filesystem::path>& folders) {
  return std::all_of(folders.begin(), folders.end(), [](const std::filesystem::path& folder) {
    return std::filesystem::exists(folder / "passes.json");
  });
}

/// Cells of a half-space result [m], of the explorer's choice for others.
double cell_of(const ReportRun& run) {
  constexpr double kDigits = 1e9;  // of a patch file
  const ContactField& f = run.result.field;
  if (!is_engine(run.result.engine, Engine::bem) || f.stations < 2) return BemOptions{}.cell;
  const double between = std::abs(f.x[static_cast<std::size_t>(f.columns)] - f.x[0]);
  return std::clamp(std::round(kDigits * between) / kDigits, kSmallestCell, kLargestCell);
}

/// The explorer on the case of the first result, to compare with that.
FramedPage what_if(const ReportOptions& options) {
  if (!options.what_if) return {};
  const std::filesystem::path& folder = options.folders.front();
  const std::filesystem::path file = case_file_of(folder);
  if (!std::filesystem::exists(file))
    throw CaseError(fmt::format("--what-if: there is no case in {}", folder.string()),
                    "put back case.toml of the run, or leave --what-if out");
  const std::filesystem::path as_given =
      folder.is_absolute() ? file : file.lexically_proximate(std::filesystem::current_path());
  const ReportRun run = read_report_run(folder);
  return what_if_page(load_case(file), as_given, cell_of(run), run);
}

ExitCode finish(const CommandOptions& options, const std::filesystem::path& page, bool ok) {
  if (options.json) fmt::print("{}\n", json_text(nlohmann::json{{"report", page.generic_string()}}));
  spdlog::info("the report is {}", page.string());
  return ok ? ExitCode::ok : ExitCode::failed_checks;
}

ExitCode command_report(const CommandOptions& options) {
  if (options.report.folders.size() > 1 && options.out.empty())
    throw CaseError(
        fmt::format("{} folders are given and no --out: a page on one folder goes into it, a page on several could go "
                    "into any of them",
                    options.report.folders.size()),
        "say where the page is to be written, e.g. --out comparison.html");
  const std::filesystem::path page = page_of(options);
  require_name_of_page(page, "report.html");
  if (!options.out.empty() && !options.force && std::filesystem::exists(page))
    throw CaseError(fmt::format("--out {}: there is a file of this name", page.string()),
                    "choose another name, or replace it with --force");
  if (of_passes(options.report.folders)) {
    if (options.report.what_if)
      throw CaseError("--what-if: the page of passes has no explorer", "leave it out, or give a folder of run or bem");
    if (page.has_parent_path()) make_folder(page.parent_path());
    write_passes_page(page, options.report.folders);
    return finish(options, page, true);
  }
  for (const std::filesystem::path& folder : options.report.folders)
    if (!std::filesystem::exists(folder / "summary.json"))
      throw CaseError(std::vector<Diagnostic>{no_result_here(folder)});
  if (page.has_parent_path()) make_folder(page.parent_path());
  const WrittenPage written =
      write_framed_report(page, options.report.folders, options.report.reference, what_if(options.report));
  if (options.report.what_if)
    spdlog::info("with the explorer: {:.1f} MB", 1e-6 * static_cast<double>(std::filesystem::file_size(page)));
  report_page(written, control());
  return finish(options, page, written.verdict.ok);
}

void declare_report(CLI::App& sub, CommandOptions& options) {
  sub.add_option("folders", options.report.folders,
                 "Result folders of `run` or `bem`; the second is drawn beside the first")
      ->required();
  add_out(sub, options, "The page to write, NAME.html (default: report.html in the folder, made anew if it is there)");
  sub.add_flag("--force", options.force, "Replace the file that --out names");
  sub.add_flag_callback(
      "--no-reference", [&options] { options.report.reference = false; },
      "Do not set a finite element result against the half-space solution of its case");
  sub.add_flag("--what-if", options.report.what_if,
               "Put the explorer on the case of the first folder into the page: some 1.1 MB more");
}

}  // namespace

const Command kReportCommand{
    "report",
    "One page on a result, or on several side by side: verdict, patch, stresses, history; opens in any browser, "
    "without a network",
    "Examples:\n  railstrata report results/quick\n  railstrata report results/thin results/thick --out "
    "thin-thick.html\n",
    declare_report, command_report};

}  // namespace railstrata
