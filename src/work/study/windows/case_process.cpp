// Nobody starts a case of a study here (study_run.cpp).
#include "study/running_case.hpp"
#include "study/study_run.hpp"

namespace railstrata {

std::unique_ptr<RunningCase> start_process(const StudyCase&, const CaseSettings&, const std::filesystem::path&, bool) {
  require_case_processes();
  return nullptr;
}

}  // namespace railstrata
