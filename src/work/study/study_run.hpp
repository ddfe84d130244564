#pragma once
// Computes the cases of a study, several at a time (study/running_case.hpp). What it does with a case is what `run` and
// `bem` do, so that any line of the table can be had again by hand.
#include <filesystem>
#include <functional>
#include <vector>

#include "ask/answer.hpp"
#include "core/control.hpp"
#include "study/claim.hpp"
#include "study/study_plan.hpp"

namespace railstrata {

struct StudyRun {
  std::filesystem::path out;
  std::string cell;              ///< of the half-space engine; empty: its default
  int jobs = 1, threads = 1;     ///< cases at a time; threads of each
  double lease = kDefaultLease;  ///< of the claims (study/claim.hpp), s
  bool wait = true;  ///< for cases that others compute, to take over those that die; false: they are left to them
  LifeOfFolder life_of = nullptr;  ///< of cases with life.until, by the half-space engine; null: lives are left out
  Control* control = nullptr;  ///< its stop and save are handed on to the cases, which write checkpoints; must be given
  std::function<void(const StudyCase&, const std::string& fault, double seconds, int done)>
      ended;  ///< a case has ended; fault: empty if it has a result
};

/// Throws EnvironmentError on a system where the program does not start processes.
void require_case_processes();

/// Computes those of these cases that no living process claims, in their order; of the others it waits for the results.
/// Cases not yet ended when the control asks to stop are left for the next time, those by finite elements with a
/// checkpoint to go on from. Throws EnvironmentError for the disk, CaseError where another study writes into the
/// folder, after the processes it has started are gone.
struct StudyRunEnd {
  int elsewhere = 0;                       ///< ended meanwhile by other processes
  std::vector<const StudyCase*> not_ours;  ///< that others compute still
};
StudyRunEnd run_cases(const StudyRun& run, const std::vector<const StudyCase*>& cases);

}  // namespace railstrata
