#pragma once
// Rules of a transient's rows and of the options beside it.
#include <string>
#include <vector>

#include "spec/case_spec.hpp"
#include "text/case_source.hpp"

namespace railstrata {

/// Records every broken rule in `source`.
void check_transient(const CaseSpec& spec, CaseSource& source);

/// A column of [transient] that the case gives.
struct GivenColumn {
  std::string key;
  std::vector<double> values;
};
std::vector<GivenColumn> given_columns(CaseSpec spec);

}  // namespace railstrata
