#pragma once
// From result folders to a report.
#include <filesystem>
#include <functional>
#include <vector>

#include "report/report.hpp"

namespace railstrata {

/// Solves the case of a finite element result by half-spaces and writes it to its folder half_space/, unless that holds
/// this case already. Of several positions each has the one of the run's folder. Returns the folder; empty, with a
/// warning that says why, where the case or its profiles cannot be read any more or theory has no answer.
std::filesystem::path half_space_reference(const std::filesystem::path& folder, int threads);

/// Writes the page for these folders; throws CaseError where one is no result, EnvironmentError for the disk. A single
/// finite element result is set against its half-space reference if `reference` says so. Returns the verdict that
/// stands on the page.
ReportVerdict write_report(const std::filesystem::path& page, const std::vector<std::filesystem::path>& folders,
                           bool reference, int threads);

/// The verdict of a page in the terminal's words; a failed one as a warning.
void tell_verdict(const ReportVerdict& verdict);

/// write(), which makes `page`, and tells where it is. Failing, it warns: the results are there without a page.
void write_page_or_warn(const std::filesystem::path& page, const std::function<void()>& write);

/// What `run` and `bem` do when they are done: report.html in the folder, or a warning.
void add_report(const std::filesystem::path& folder, int threads);

}  // namespace railstrata
