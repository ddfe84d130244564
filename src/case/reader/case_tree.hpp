#pragma once
// Converts a TOML document to a CaseSpec by the option tables. toml++ is used in this room only.
#include <string>
#include <vector>

#include "spec/case_spec.hpp"
#include "text/case_source.hpp"

namespace railstrata {

/// Fills the spec; everything that is wrong with keys, types, units and ranges is recorded in `source`, which
/// afterwards also knows where each key stands. Throws CaseError at once when the text is no TOML or an override cannot
/// be understood.
CaseSpec read_case_tree(CaseSource& source, const std::vector<std::string>& overrides);

}  // namespace railstrata
