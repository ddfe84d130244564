#pragma once
// Defects of a list of profile points.
#include <optional>
#include <string>
#include <vector>

#include "core/vec.hpp"

namespace railstrata {

struct PointDefect {
  std::size_t index = 0;  ///< of the offending point
  std::string message, remedy;
};

/// The first defect of a list of points in metres: too few, not a number, repeated, length outside 5–500 mm, turning
/// back on itself, crossing itself.
std::optional<PointDefect> find_defect(const std::vector<Vec2>& points);

}  // namespace railstrata
