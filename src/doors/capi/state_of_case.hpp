#pragma once
// Applies a state of the C interface to a case.
#include "bem/solve_bem.hpp"
#include "capi/railstrata.h"
#include "spec/case_spec.hpp"

namespace railstrata::capi {

/// The case with the members of the state that are given. Throws CaseError: out of the range of its key, members that
/// exclude each other, a size that no version of rs_state has.
CaseSpec with_state(CaseSpec spec, const rs_state& state);

/// One input of a solution: what it was, and a change that is small beside what tractions and geometry do on the way to
/// a cell's coming into contact, large beside round-off.
struct Input {
  double rs_state::*member;
  double value, step;
};
/// spec, result: of the state. Throws CaseError: no single bit, or an input that the state has as a result.
Input input_of(const rs_state& state, unsigned bit, const CaseSpec& spec, const BemResult& result);

}  // namespace railstrata::capi
