#pragma once
// Rules between the strengths of a case.
#include "spec/case_fwd.hpp"
#include "text/case_source.hpp"

namespace railstrata {

/// Complains in `source` of strengths that contradict each other and of tables that end too early.
void check_strengths(const CaseSpec& spec, CaseSource& source);

}  // namespace railstrata
