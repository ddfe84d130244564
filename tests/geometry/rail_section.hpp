#pragma once
// The whole section of a rail and its properties, to be held against drawings.
#include <algorithm>
#include <cmath>
#include <vector>

#include "geometry/rail_outline.hpp"

namespace railstrata {

/// Arc lengths 0.1 mm apart, with the knots.
inline std::vector<double> spaced(const Profile& head, double from, double to) {
  constexpr double step = 0.1e-3;
  std::vector<double> s;
  const int n = static_cast<int>(std::ceil((to - from) / step));
  for (int i = 0; i <= n; ++i) s.push_back(from + (to - from) * i / n);
  for (const double knot : head.knots())
    if (knot > from && knot < to) s.push_back(knot);
  std::sort(s.begin(), s.end());
  return s;
}

/// The whole section as a closed polygon, walked anticlockwise seen from +x (y to the right, z up); the last point is
/// not the first again.
inline std::vector<Vec2> outline_polygon(const Profile& head, const RailOutline& outline) {
  std::vector<Vec2> left;  // from the gauge-side flank's end down to the base
  for (const auto* part : {&outline.underside, &outline.web, &outline.foot_top, &outline.toe})
    for (const Vec2 p : *part)
      if (left.empty() || norm(p - Vec2{-left.back().y, left.back().z}) > 0) left.push_back({-p.y, p.z});
  std::vector<Vec2> polygon = left;
  for (auto p = left.rbegin(); p != left.rend(); ++p) polygon.push_back({-p->y, p->z});
  const std::vector<double> s = spaced(head, head.s_at_y(head.y_min()), head.s_at_y(head.y_max()));
  for (auto i = s.rbegin(); i != s.rend(); ++i)
    if (const Vec2 p = head.at(*i).position; p.z > outline.flank_z) polygon.push_back(p);
  return polygon;
}

/// Area [m²], centroid height above the lowest point [m], second moments about the horizontal and vertical axes through
/// the centroid [m⁴] of a closed polygon walked anticlockwise.
struct SectionProperties {
  double area, centroid_height, i_horizontal, i_vertical;
};
inline SectionProperties section_properties(const std::vector<Vec2>& polygon) {
  double area = 0, sy = 0, sz = 0, iyy = 0, izz = 0, lowest = polygon.front().z;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    const double w = cross(a, b);
    area += w / 2;
    sy += w * (a.y + b.y) / 6;
    sz += w * (a.z + b.z) / 6;
    iyy += w * (a.y * a.y + a.y * b.y + b.y * b.y) / 12;
    izz += w * (a.z * a.z + a.z * b.z + b.z * b.z) / 12;
    lowest = std::min(lowest, a.z);
  }
  const double y = sy / area, z = sz / area;
  return {area, z - lowest, izz - area * z * z, iyy - area * y * y};
}

}  // namespace railstrata
