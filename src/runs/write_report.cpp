#include "runs/write_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "case/case_file.hpp"
#include "core/engine.hpp"
#include "core/faults.hpp"
#include "core/parallel.hpp"
#include "io/output_file.hpp"
#include "io/output_folder.hpp"
#include "report/checks.hpp"
#include "report/page.hpp"
#include "report/read_run.hpp"
#include "runs/write_half_space_result.hpp"

namespace railstrata {
namespace {

namespace fs = std::filesystem;

void solve_reference(const fs::path& case_file, const fs::path& folder) {
  const LoadedCase loaded = load_case(case_file);
  const Placement placement = place(loaded.spec, loaded.folder());
  const HalfSpaceSolution solution = solve_half_space(loaded.spec, placement);
  fs::create_directories(folder);
  write_origin(folder, loaded, {"railstrata", "bem", case_file.string(), "--out", folder.string()}, max_threads());
  write_half_space_result(folder, table_origin(loaded), loaded.spec, placement, solution);
}

bool same_text(const fs::path& a, const fs::path& b) {
  std::ifstream left(a, std::ios::binary), right(b, std::ios::binary);
  return left && right &&
         std::equal(std::istreambuf_iterator<char>(left), {}, std::istreambuf_iterator<char>(right), {});
}

std::string title_of(const std::vector<ReportRun>& runs) {
  std::vector<std::string> titles;
  for (const ReportRun& run : runs)
    if (std::find(titles.begin(), titles.end(), run.result.title) == titles.end()) titles.push_back(run.result.title);
  return titles.size() <= 2 ? fmt::format("{}", fmt::join(titles, " against "))
                            : fmt::format("{} and {} more", titles[0], titles.size() - 1);
}

}  // namespace

fs::path half_space_reference(const fs::path& folder, std::vector<std::string>& notes) {
  const fs::path full = fs::absolute(folder / "").lexically_normal().parent_path();
  const fs::path home = full.filename().string().starts_with(kPositionFolder) ? full.parent_path() : full;
  fs::path out = home / kReferenceFolder;
  if (fs::exists(out / "summary.json") && same_text(home / "case.toml", out / "case.toml")) return out;
  try {
    solve_reference(home / "case.toml", out);
    return out;
  } catch (const CaseError& e) {
    notes.push_back(fmt::format("no half-space reference: {}", e.what()));
  } catch (const NumericalError& e) {
    notes.push_back(fmt::format("no half-space reference: {}", e.what()));
  }
  return {};
}

std::vector<std::string> write_report(const fs::path& page, const std::vector<fs::path>& folders, bool reference) {
  std::vector<std::string> notes;
  Report report;
  for (const fs::path& folder : folders) report.runs.push_back(read_report_run(folder));
  if (reference && report.runs.size() == 1 && is_engine(report.runs[0].result.engine, Engine::fem))
    if (const fs::path beside = half_space_reference(folders[0], notes); !beside.empty()) {
      report.runs.push_back(read_report_run(beside));
      report.runs[1].name = report.runs[0].name;
    }
  report.title = title_of(report.runs);
  report.checks = report_checks(report.runs);
  write_whole_file(page, report_page(report));
  return notes;
}

}  // namespace railstrata
