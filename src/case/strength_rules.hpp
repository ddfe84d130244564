#pragma once
// What the strengths of a case ask of each other.
#include "case/case_source.hpp"
#include "case/case_fwd.hpp"

namespace railstrata {

/// Complains in `source` of strengths that contradict each other and of tables that end too early.
void check_strengths(const CaseSpec& spec, CaseSource& source);

}  // namespace railstrata
