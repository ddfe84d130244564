#pragma once
// A study as a job: its cases, each with a folder and a claim of its own (study/study_run.hpp), so that several
// processes may work on one study; study.csv, study.toml and report.html over all of them. Any study goes on in the
// folder of a study: cases that have their result are not computed again.
#include <functional>
#include <string>
#include <vector>

#include "jobs/job.hpp"
#include "study/study_file.hpp"
#include "study/study_results.hpp"
#include "study/study_run.hpp"

namespace railstrata {

struct StudyOrder : JobOrder {
  std::vector<std::string> overrides;  ///< of every case
  int jobs = 0;                        ///< cases at a time; 0: as many as threads
  double lease = kDefaultLease;        ///< s, of claims
  bool wait = true;                    ///< as of StudyRun
  LifeOfFolder life_of = nullptr;      ///< as of StudyRun
};

/// Carries the study out. `ours`: of the cases those that this job sees to; `at_end`: called with their rows. Throws
/// EnvironmentError for a device that a case asks for and this machine lacks, or where no processes are started.
JobEnd carry_out_study(const LoadedStudy& study, std::vector<StudyCase> cases, std::vector<bool> ours, StudyOrder order,
                       Control& control, const std::function<void(const std::vector<CaseRow>&)>& at_end);

/// The rows of the cases of `ours`.
std::vector<CaseRow> rows_of(const std::vector<CaseRow>& all, const std::vector<bool>& ours);

}  // namespace railstrata
