#pragma once
// Values of a case by their keys.
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "spec/case_fwd.hpp"

namespace railstrata {

/// {key: value}, SI, of keys that hold a number ("layer.0.thickness", "vehicle.wheel_load"); null: the case has none,
/// or there is no such key. What is derived (young_ratio, wheel_load) is found from what it gives.
nlohmann::ordered_json case_values(const CaseSpec& spec, const std::vector<std::string>& keys);

}  // namespace railstrata
