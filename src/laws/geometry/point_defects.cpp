#include "geometry/point_defects.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace railstrata {
namespace {

constexpr double kShortest = 5e-3, kLongest = 500e-3;  // m
constexpr double kCloseness = 1e-9;                    // m
constexpr double kSharpestTurn = -0.866;               // cosine of 150 degrees between neighbouring chords

bool crosses(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  if (std::max(a.y, b.y) < std::min(c.y, d.y) || std::max(c.y, d.y) < std::min(a.y, b.y)) return false;
  if (std::max(a.z, b.z) < std::min(c.z, d.z) || std::max(c.z, d.z) < std::min(a.z, b.z)) return false;
  return cross(b - a, c - a) * cross(b - a, d - a) <= 0 && cross(d - c, a - c) * cross(d - c, b - c) <= 0;
}

PointDefect loop(std::size_t first, std::size_t second) {
  return {second, fmt::format("the curve crosses itself: point {} meets point {}", second + 1, first + 1),
          "a profile is one open curve walked once from end to end: remove the loop, or cut a closed outline down to "
          "its running surface"};
}

bool turns_back(Vec2 a, Vec2 b, Vec2 c) {
  const Vec2 before = b - a, after = c - b;
  return dot(before, after) < kSharpestTurn * norm(before) * norm(after);
}

/// Whether the curve turns back nowhere without this point.
bool is_outlier(std::vector<Vec2> p, std::size_t i) {
  p.erase(p.begin() + static_cast<std::ptrdiff_t>(i));
  for (std::size_t k = 2; k < p.size(); ++k)
    if (turns_back(p[k - 2], p[k - 1], p[k])) return false;
  return true;
}

std::optional<PointDefect> bad_neighbours(const std::vector<Vec2>& p) {
  for (std::size_t i = 1; i < p.size(); ++i) {
    if (norm(p[i] - p[i - 1]) < kCloseness)
      return PointDefect{i, fmt::format("point {} is the same as the point before it", i + 1), "remove one of them"};
    if (i < 2) continue;
    if (turns_back(p[i - 2], p[i - 1], p[i]))
      return PointDefect{
          i, fmt::format("the curve turns back on itself at point {}", i),
          fmt::format("list the points in the order along the curve, without loops{}",
                      is_outlier(p, i - 1) ? fmt::format("; or remove point {} if it is an outlier", i) : "")};
  }
  return std::nullopt;
}

std::optional<PointDefect> self_crossing(const std::vector<Vec2>& p) {
  for (std::size_t i = 0; i + 1 < p.size(); ++i)
    for (std::size_t j = i + 2; j + 1 < p.size(); ++j)
      if (crosses(p[i], p[i + 1], p[j], p[j + 1])) return loop(i, j);
  return std::nullopt;
}

}  // namespace

std::optional<PointDefect> find_defect(const std::vector<Vec2>& points) {
  if (points.size() < 5)
    return PointDefect{0, fmt::format("{} points are too few for a profile", points.size()),
                       "give at least 5 points; every 0.1 to 1 mm is usual"};
  double length = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!std::isfinite(points[i].y) || !std::isfinite(points[i].z))
      return PointDefect{i, fmt::format("point {} is not a finite number", i + 1), "remove or repair it"};
    if (i > 0) length += norm(points[i] - points[i - 1]);
  }
  if (length < kShortest || length > kLongest)
    return PointDefect{
        0, fmt::format("the curve is {:.4g} m long; a wheel or rail profile measures between 5 and 500 mm", length),
        "check the unit: metres and millimetres may be mixed up"};
  if (auto defect = bad_neighbours(points)) return defect;
  return self_crossing(points);
}

}  // namespace railstrata
