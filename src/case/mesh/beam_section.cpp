#include "mesh/beam_section.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace railstrata {
namespace {

constexpr int kLevels = 2000;

/// Horizontal chord of a quadrilateral.
double chord(const Section& s, const std::array<int, 4>& quad, double z) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec2 a = s.nodes[quad[i]], b = s.nodes[quad[(i + 1) % 4]];
    if ((a.z > z) == (b.z > z)) continue;
    const double y = a.y + (b.y - a.y) * (z - a.z) / (b.z - a.z);
    low = std::min(low, y);
    high = std::max(high, y);
  }
  return std::max(0.0, high - low);
}

}  // namespace

BeamSection beam_section(const SweptBody& body) {
  double bottom = std::numeric_limits<double>::infinity(), top = -bottom;
  for (const Block& b : body.blocks)
    for (const Vec2 p : b.section.nodes) {
      bottom = std::min(bottom, p.z);
      top = std::max(top, p.z);
    }
  const double dz = (top - bottom) / kLevels;
  const auto height = [&](std::size_t k) { return bottom + (static_cast<double>(k) + 0.5) * dz; };
  std::vector<double> width(kLevels, 0.0);
  double area = 0, moment = 0;
  for (std::size_t k = 0; k < width.size(); ++k) {
    for (const Block& b : body.blocks)
      for (const auto& quad : b.section.quads) width[k] += chord(b.section, quad, height(k));
    area += width[k] * dz;
    moment += width[k] * dz * height(k);
  }
  const double centre = moment / area;
  double inertia = 0, above = 0, flexibility = 0;
  for (std::size_t k = width.size(); k-- > 0;) {
    const double arm = height(k) - centre, part = width[k] * dz * arm;
    inertia += width[k] * dz * (arm * arm + dz * dz / 12);
    if (width[k] > 0) flexibility += (above + 0.5 * part) * (above + 0.5 * part) / width[k] * dz;
    above += part;
  }
  return {area, inertia, inertia * inertia / (area * flexibility)};
}

}  // namespace railstrata
