#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <memory>

#include <nlohmann/json.hpp>

#include "app/common_options.hpp"
#include "app/control.hpp"
#include "app/folder_comparison.hpp"
#include "app/page_name.hpp"
#include "bem/bem_options.hpp"
#include "core/engine.hpp"
#include "core/faults.hpp"
#include "explore/page.hpp"
#include "io/folder_kind.hpp"
#include "io/output_folder.hpp"
#include "record/json.hpp"
#include "record/output_file.hpp"
#include "report/passes_page.hpp"
#include "report/report.hpp"
#include "runs/write_report.hpp"

namespace railstrata {
namespace {

struct ReportOptions {
  std::vector<std::filesystem::path> folders;
  bool reference = true;  ///< --no-reference: without the half-space solution beside a single result
  bool what_if = false;   ///< --what-if: with the explorer on the case
};

std::filesystem::path page_of(const ReportOptions& own, const CommandOptions& options) {
  std::filesystem::path page = options.out.empty() ? own.folders.front() / "report.html" : options.out;
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

void require_results(const std::vector<std::filesystem::path>& folders) {
  for (const std::filesystem::path& folder : folders)
    if (!std::filesystem::exists(folder / "summary.json"))
      throw CaseError(std::vector<Diagnostic>{no_result_here(folder)});
}

/// Returns whether the page's verdict holds.
bool write_page(const std::filesystem::path& page, const ReportOptions& own) {
  const WrittenPage written = write_report(page, own.folders, own.reference, what_if(own));
  if (own.what_if)
    spdlog::info("with the explorer: {:.1f} MB", 1e-6 * static_cast<double>(std::filesystem::file_size(page)));
  report_page(written, control());
  return written.verdict.ok;
}

/// Of two folders, unless --out names a page: a folder with tables of their differences, and the page on both.
ExitCode compare(const ReportOptions& own, const CommandOptions& options) {
  const std::filesystem::path &a = own.folders[0], &b = own.folders[1];
  const FolderComparison comparison(a, b);
  const std::filesystem::path out = options.out.empty() ? comparison_folder(a, b) : options.out;
  const FolderHold hold = prepare_output_folder(out, options.force);
  comparison.write(out);
  comparison.print(options.json);
  const bool ok = !options.page || write_page(out / "report.html", own);
  spdlog::info("results are in {}", out.string());
  return ok ? ExitCode::ok : ExitCode::failed_checks;
}

ExitCode write_alone(const ReportOptions& own, const CommandOptions& options, bool passes) {
  if (own.folders.size() > 1 && options.out.empty())
    throw CaseError(
        fmt::format("{} folders are given and no --out: a page on one folder goes into it, a page on several could go "
                    "into any of them",
                    own.folders.size()),
        "say where the page is to be written, e.g. --out comparison.html");
  const std::filesystem::path page = page_of(own, options);
  require_name_of_page(page, "report.html");
  if (!options.out.empty() && !options.force && std::filesystem::exists(page))
    throw CaseError(fmt::format("--out {}: there is a file of this name", page.string()),
                    "choose another name, or replace it with --force");
  if (passes && own.what_if)
    throw CaseError("--what-if: the page of passes has no explorer", "leave it out, or give a folder of run or bem");
  if (!passes) require_results(own.folders);
  if (page.has_parent_path()) make_folder(page.parent_path());
  if (passes) write_passes_page(page, own.folders);
  const bool ok = passes || write_page(page, own);
  if (options.json) fmt::print("{}\n", json_text(nlohmann::json{{"report", page.generic_string()}}));
  spdlog::info("the report is {}", page.string());
  return ok ? ExitCode::ok : ExitCode::failed_checks;
}

ExitCode command_report(const ReportOptions& own, const CommandOptions& options) {
  const bool passes = of_passes(own.folders), page = is_page_name(options.out);
  return own.folders.size() == 2 && !passes && !page ? compare(own, options) : write_alone(own, options, passes);
}

CommandWork declare_report(CLI::App& sub, CommandOptions& options) {
  const auto own = std::make_shared<ReportOptions>();
  sub.add_option("folders", own->folders,
                 "Result folders of `run` or `bem`; of two, A and B, also tables of their differences, relative to B")
      ->required();
  add_out(sub, options,
          "The page to write, NAME.html (default: report.html in the folder, made anew if it is there); of two folders "
          "also a folder (default: results/<folder A>-against-<folder B>)");
  sub.add_flag("--force", options.force, "Replace the file or the folder's files that --out names");
  sub.add_flag_callback(
      "--no-reference", [own] { own->reference = false; },
      "Do not set a finite element result against the half-space solution of its case");
  sub.add_flag("--what-if", own->what_if,
               "Put the explorer on the case of the first folder into the page: some 1.1 MB more");
  sub.add_flag_callback(
      "--no-report", [&options] { options.page = false; }, "Of two folders: the tables without the page");
  return [own, &options] { return command_report(*own, options); };
}

}  // namespace

extern const Command kReportCommand{
    "report",
    "One page on a result, or on several side by side: verdict, patch, stresses, history; opens in any browser, "
    "without a network. Of two results, of either engine, also the differences of numbers and fields on one grid",
    "Examples:\n  railstrata report results/quick\n  railstrata report results/quick results/quick-bem\n  railstrata "
    "report results/thin results/thick --out thin-thick.html\n",
    declare_report};

}  // namespace railstrata
