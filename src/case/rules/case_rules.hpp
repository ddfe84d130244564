#pragma once
// Rules between the numbers of a case, and the table of clashes (clashes.hpp).
#include "spec/case_fwd.hpp"
#include "text/case_source.hpp"

namespace railstrata {

/// Records every broken rule in `source`.
void check_case_rules(const CaseSpec& spec, CaseSource& source);

}  // namespace railstrata
