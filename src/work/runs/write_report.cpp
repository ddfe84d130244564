#include "runs/write_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "bem/contact_places.hpp"
#include "core/engine.hpp"
#include "core/faults.hpp"
#include "core/parallel.hpp"
#include "core/text.hpp"
#include "io/output_folder.hpp"
#include "reader/case_file.hpp"
#include "record/output_file.hpp"
#include "report/page.hpp"
#include "report/report.hpp"
#include "runs/write_half_space_result.hpp"

namespace railstrata {
namespace {

namespace fs = std::filesystem;

void solve_reference(const LoadedCase& loaded, const fs::path& folder) {
  const Placement placement = place(loaded.spec, loaded.folder());
  const Answer answer = ask(loaded.spec, placement);
  fs::create_directories(folder);
  write_origin(folder, loaded, {"railstrata", "bem", loaded.file.string(), "--out", folder.string()}, max_threads());
  write_half_space_result(folder, table_origin(loaded), loaded.spec, placement, answer);
}

std::string title_of(const std::vector<ReportRun>& runs) {
  std::vector<std::string> titles;
  for (const ReportRun& run : runs)
    if (std::find(titles.begin(), titles.end(), run.result.title) == titles.end()) titles.push_back(run.result.title);
  return titles.size() <= 2 ? fmt::format("{}", fmt::join(titles, " against "))
                            : fmt::format("{} and {} more", titles[0], titles.size() - 1);
}

/// The folder that has case.toml: a position's is the one it stands in.
fs::path folder_of_case(const fs::path& folder) {
  const fs::path full = fs::absolute(folder / "").lexically_normal().parent_path();
  return full.filename().string().starts_with(kPositionFolder) ? full.parent_path() : full;
}

/// The largest shear of half-spaces on cells as large as the elements [Pa], whose leading edge lies between cells as
/// that of the elements lies between nodes; NaN where there is no such solution.
double shear_on_elements(const fs::path& case_file) {
  constexpr double kFinest = 0.1e-3;  // m: below, the peak hardly changes any more, and a solution takes seconds
  try {
    const LoadedCase loaded = load_case(case_file);
    CaseSpec spec = loaded.spec;
    spec.bem.leading_edge = LeadingEdge::whole_cell;
    AskOptions how;
    how.bem.cell = std::max(spec.mesh.element_size, kFinest);
    Placement at = place(spec, loaded.folder());
    const double deepest = 2 * hertz_estimate(spec, at.contact).approach;
    at.contact.settled = places_of(spec, at, deepest).size() == 1;  // cells from the place that elements begin at
    return solve_contact(spec, at, how).result.patch.largest_traction;
  } catch (const CaseError&) {
    return std::numeric_limits<double>::quiet_NaN();
  } catch (const NumericalError&) {
    return std::numeric_limits<double>::quiet_NaN();
  }
}

/// For finite element runs that a half-space run stands beside.
void add_shear_on_elements(const std::vector<fs::path>& folders, std::vector<ReportRun>& runs) {
  const auto is_bem = [](const ReportRun& run) { return !is_engine(run.result.engine, Engine::fem); };
  if (std::none_of(runs.begin(), runs.end(), is_bem)) return;
  for (std::size_t k = 0; k < folders.size(); ++k)
    if (is_engine(runs[k].result.engine, Engine::fem))
      runs[k].shear_on_elements = shear_on_elements(folder_of_case(folders[k]) / "case.toml");
}

/// Solves the case of a finite element result on half-spaces and on its sections and writes both to its folders
/// half_space/ and sections/, unless they hold this case already. Of several positions each has those of the run's
/// folder. Returns the folders; fewer, with a note of the reason, where the case or its profiles cannot be read any
/// more or theory has no answer; without a note where sections do not have what the case asks for.
std::vector<fs::path> references(const fs::path& folder, std::vector<std::string>& notes) {
  const fs::path home = folder_of_case(folder);
  std::vector<fs::path> out;
  if (!fs::exists(home / "case.toml")) {
    notes.push_back(
        fmt::format("no half-space reference: {} has no case.toml; put back the one of the run, or leave "
                    "the reference out with --no-reference",
                    home.string()));
    return out;
  }
  for (const auto& [name, bodies] : {std::pair{kReferenceFolder, "half_spaces"}, {kSectionsFolder, "sections"}}) {
    const fs::path beside = home / name;
    std::optional<LoadedCase> loaded;
    try {
      loaded = load_case(home / "case.toml", {fmt::format("bem.bodies=\"{}\"", bodies)});
    } catch (const CaseError& e) {
      if (out.empty()) notes.push_back(fmt::format("no half-space reference: {}", e.what()));
      break;
    }
    try {
      const bool there =
          fs::exists(beside / "summary.json") && file_text(beside / "case.original.toml") == loaded->source_text;
      if (!there) solve_reference(*loaded, beside);
      out.push_back(beside);
    } catch (const CaseError& e) {
      notes.push_back(fmt::format("no reference in {}: {}", name, e.what()));
    } catch (const NumericalError& e) {
      notes.push_back(fmt::format("no reference in {}: {}", name, e.what()));
    }
  }
  return out;
}

}  // namespace

fs::path case_file_of(const fs::path& folder) { return folder_of_case(folder) / "case.toml"; }

bool write_page_or_warn(const fs::path& page, const Control& control, const std::function<WrittenPage()>& write) {
  try {
    const WrittenPage written = write();
    report_page(written, control);
    control.info("everything on one page: {}", page.string());
    return written.verdict.ok;
  } catch (const CaseError& e) {
    control.warn("no report: {}", e.what());
  } catch (const EnvironmentError& e) {
    control.warn("no report: {}{}{}", e.what(), e.remedy.empty() ? "" : "\n    remedy: ", e.remedy);
  }
  return true;
}

void report_page(const WrittenPage& page, const Control& control) {
  for (const std::string& note : page.notes) control.warn("{}", note);
  const std::string verdict = fmt::format("checks of the page: {}", page.verdict.text);
  page.verdict.ok ? control.info("{}", verdict) : control.warn("{}", verdict);
}

bool add_report(const fs::path& folder, const Control& control) {
  const fs::path page = folder / "report.html";
  return write_page_or_warn(page, control, [&] { return write_report(page, {folder}, true); });
}

WrittenPage write_report(const fs::path& page, const std::vector<fs::path>& folders, bool reference,
                         const FramedPage& what_if) {
  std::vector<std::string> notes;
  Report report;
  for (const fs::path& folder : folders) report.runs.push_back(read_report_run(folder));
  if (reference && report.runs.size() == 1 && is_engine(report.runs[0].result.engine, Engine::fem))
    for (const fs::path& beside : references(folders[0], notes)) {
      report.runs.push_back(read_report_run(beside));
      report.runs.back().name = report.runs[0].name;
    }
  add_shear_on_elements(folders, report.runs);
  report.title = title_of(report.runs);
  report.answers = run_answers(report.runs);
  report.checks = report_checks(report.runs);
  write_whole_file(page, report_page(report, what_if));
  for (const ReportRun& run : report.runs)
    for (const ResultDoubt& doubt : run.doubts)
      notes.push_back(fmt::format("{}: {}", run.result.folder.string(), doubt.text));
  return {verdict_of(report), std::move(notes)};
}

}  // namespace railstrata
