#pragma once
// What options ask of each other.
#include <string>
#include <vector>

#include "case/case_source.hpp"
#include "case/case_spec.hpp"

namespace railstrata {

/// Records every broken rule in `source`.
void check_case_rules(const CaseSpec& spec, CaseSource& source);

/// Settings that have no effect in this case, one sentence each.
std::vector<std::string> idle_settings(const CaseSpec& spec);

}  // namespace railstrata
