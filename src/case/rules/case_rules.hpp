#pragma once
// Rules between the numbers of a case, and the table of clashes (clashes.hpp).
#include <string>
#include <vector>

#include "spec/case_fwd.hpp"
#include "text/case_source.hpp"

namespace railstrata {

/// Records every broken rule in `source`, those of the parts below included.
void check_case_rules(const CaseSpec& spec, CaseSource& source);

/// Of [[layer]] and [[stretch]].
void check_layers(const CaseSpec& spec, CaseSource& source);
/// Strengths that contradict each other, and tables that end too early.
void check_strengths(const CaseSpec& spec, CaseSource& source);
/// Of a transient's rows and of the options beside it.
void check_transient(const CaseSpec& spec, CaseSource& source);

/// A column of [transient] that the case gives.
struct GivenColumn {
  std::string key;
  std::vector<double> values;
};
std::vector<GivenColumn> given_columns(CaseSpec spec);

}  // namespace railstrata
