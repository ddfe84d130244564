#pragma once
// How long the commands of a case would take, estimated by `check`.
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "reader/case_file.hpp"

namespace railstrata {

/// What is asked besides the commands that every case has.
struct TimesWanted {
  double cell = 0;                ///< m
  int threads = 1;                ///< that `collective` and `sweep` share their cases among
  std::vector<std::string> vary;  ///< axes of a sweep; empty: none
  bool stresses = false;          ///< of the sweep
  int passes = 0;                 ///< by the stationary method; 0: none
  double before = 0;              ///< s of one core, that `collective` takes before its loads
  double own = 0;                 ///< s that each command takes to start, read the case and write its page
};

struct TimeEstimate {
  std::string command;
  std::string what;    ///< "7 loads", "of one core", …
  double seconds = 0;  ///< of wall time on as many threads; of `bem` and `passes` on one. NaN: unknown
};

/// By half-space theory: `bem`, `collective` of a case with loads, and what is wanted. A command that refuses the case
/// is left out. Carries out trials. Throws CaseError: wrong axes, passes over a rail that cannot have them.
std::vector<TimeEstimate> time_estimates(const LoadedCase& loaded, const TimesWanted& wanted);

void print_times(const std::vector<TimeEstimate>& times);
nlohmann::ordered_json times_json(const std::vector<TimeEstimate>& times);

}  // namespace railstrata
