#pragma once
// The pair that a case has without profiles, LMA on CN60, and a European one.
#include <string>
#include <vector>

namespace railstrata {

inline const std::vector<std::vector<std::string>> kBothPairs{
    {}, {"geometry.wheel_profile=S1002", "geometry.rail_profile=UIC60"}};

}  // namespace railstrata
