#pragma once
// A number of a case by its key.
#include <string>

#include "spec/case_spec.hpp"

namespace railstrata {

/// SI; 0 or 1 of a switch; NaN: the case gives none. key: "material.rail.young", "layer.0.thickness". Throws CaseError:
/// no such key or entry of a list, no single number, a second word for another key (young_ratio).
double number_of_case(const CaseSpec& spec, const std::string& key);

}  // namespace railstrata
