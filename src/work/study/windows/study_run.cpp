// Cases are processes that are started, asked to stop and waited for as POSIX has it: not on Windows.
#include "study/study_run.hpp"

#include "core/faults.hpp"

namespace railstrata {

void require_case_processes() {
  throw EnvironmentError("study runs every case in a process of its own, which the program for Windows does not do",
                         "`sweep` solves half-space cases within one process; `study` is for Linux (on Windows: WSL)");
}

StudyRunEnd run_cases(const StudyRun&, const std::vector<const StudyCase*>&) {
  require_case_processes();
  return {};
}

}  // namespace railstrata
