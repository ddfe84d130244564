#pragma once
// Writes a report of result folders.
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/control.hpp"
#include "report/checks.hpp"
#include "report/page.hpp"

namespace railstrata {

/// Verdict and notes of a written page.
struct WrittenPage {
  ReportVerdict verdict;           ///< the one that stands on the page
  std::vector<std::string> notes;  ///< why there is no reference; why a result may not be that of its case
};

/// write(), which makes `page`, and reports its notes, its verdict and where it is. Failing, it warns: the results are
/// there without a page. Returns whether the page's verdict holds, true without a page.
bool write_page_or_warn(const std::filesystem::path& page, const Control& control,
                        const std::function<WrittenPage()>& write);
/// Reports the notes and the verdict of a written page, a failed one as a warning.
void report_page(const WrittenPage& page, const Control& control);

/// The case of a result folder: of a position that of the run's folder. The file need not be there.
std::filesystem::path case_file_of(const std::filesystem::path& folder);

/// Writes the page for these folders, with `what_if` in a frame unless its text is empty; throws CaseError where one is
/// no result, EnvironmentError for the disk. A single finite element result is compared with its half-space reference
/// if `reference` is true.
WrittenPage write_report(const std::filesystem::path& page, const std::vector<std::filesystem::path>& folders,
                         bool reference, const FramedPage& what_if = {});

/// The last step of `run` and `bem`: report.html of a folder, or a warning. Returns whether its verdict holds, true
/// without a page.
bool add_report(const std::filesystem::path& folder, const Control& control);

}  // namespace railstrata
