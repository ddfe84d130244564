#pragma once
// The kinds of wheels of a case's traffic.
#include "spec/case_spec.hpp"

namespace railstrata {

/// The case with a load for each kind of wheels: with collective.lateral_deviation three for each row, and those that
/// are alike but for their names as one.
CaseSpec kinds_of_wheels(const CaseSpec& spec);

}  // namespace railstrata
