#pragma once
// From result folders to a report.
#include <filesystem>
#include <string>
#include <vector>

#include "report/checks.hpp"

namespace railstrata {

/// What the user should know of a page that was written.
struct WrittenPage {
  ReportVerdict verdict;           ///< the one that stands on the page
  std::vector<std::string> notes;  ///< why there is no reference; why a result may not be that of its case
};

/// Solves the case of a finite element result by half-spaces and writes it to its folder half_space/, unless that holds
/// this case already. Of several positions each has the one of the run's folder. Returns the folder; empty, with a note
/// that says why, where the case or its profiles cannot be read any more or theory has no answer.
std::filesystem::path half_space_reference(const std::filesystem::path& folder, std::vector<std::string>& notes);

/// Writes the page for these folders; throws CaseError where one is no result, EnvironmentError for the disk. A single
/// finite element result is set against its half-space reference if `reference` says so.
WrittenPage write_report(const std::filesystem::path& page, const std::vector<std::filesystem::path>& folders,
                         bool reference);

}  // namespace railstrata
