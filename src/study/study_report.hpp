#pragma once
// The report of a study: figures, trends, comparisons with published numbers, all drawn from the study's table and its
// result folders.
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "report/report.hpp"
#include "study/published.hpp"
#include "study/study_file.hpp"

namespace railstrata {

/// A line of the study's table.
struct StudyEntry {
  std::string group, name;
  Engine engine = Engine::fem;
  std::string state, fault;
  std::filesystem::path folder;                             ///< of the result, if it is done
  std::vector<std::pair<std::string, std::string>> values;  ///< what is varied
  std::vector<std::pair<std::string, double>> numbers;      ///< columns of the table
  bool done() const { return state == "done"; }
  std::string value(const std::string& key) const;  ///< "" if the case has no such key
  double number(const std::string& column) const;   ///< NaN if there is none
};

/// The report. Full runs are those the maps show; the verdict is over all cases: what each says of itself, and every
/// finite element case against its half-space case (limits of report_checks).
Report study_report(const StudySpec& study, const Published& published, const std::vector<StudyEntry>& entries);

}  // namespace railstrata
