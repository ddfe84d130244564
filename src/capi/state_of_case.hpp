#pragma once
// Applies a state of the C interface to a case.
#include "capi/railstrata.h"
#include "case/case_spec.hpp"

namespace railstrata::capi {

/// The case with the members of the state that are given. Throws CaseError: out of the range of its key, members that
/// exclude each other, a size that no version of rs_state has.
CaseSpec with_state(CaseSpec spec, const rs_state& state);

}  // namespace railstrata::capi
