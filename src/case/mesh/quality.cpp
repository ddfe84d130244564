#include "mesh/quality.hpp"

#include <algorithm>
#include <cmath>

namespace railstrata {

namespace {

struct ElementQuality {
  double scaled_jacobian = 1, longest = 0, shortest = 1e300;
};

ElementQuality measure(const std::array<Vec3, 8>& x) {
  ElementQuality q;
  for (int i = 0; i < 8; ++i) {
    const int face = i & 4, next = face + (i + 1) % 4, previous = face + (i + 3) % 4, across = i ^ 4;
    const Vec3 a = x[face == 0 ? next : previous] - x[i], b = x[face == 0 ? previous : next] - x[i],
               c = x[across] - x[i];
    const double la = norm(a), lb = norm(b), lc = norm(c);
    q.scaled_jacobian = std::min(q.scaled_jacobian, dot(cross(a, b), c) / (la * lb * lc));
    q.longest = std::max({q.longest, la, lb, lc});
    q.shortest = std::min({q.shortest, la, lb, lc});
  }
  return q;
}

double spacing(const Stations& stations, int j) {
  if (j + 1 < stations.nodes()) return stations.at[j + 1] - stations.at[j];
  return stations.at.front() + 2 * std::acos(-1.0) - stations.at.back();
}

/// One station of every distinct spacing.
std::vector<int> distinct_stations(const Stations& stations) {
  std::vector<int> out;
  for (int j = 0; j < stations.elements(); ++j) {
    const double d = spacing(stations, j);
    if (std::none_of(out.begin(), out.end(), [&](int k) { return std::abs(spacing(stations, k) - d) < 1e-9 * d; }))
      out.push_back(j);
  }
  return out;
}

}  // namespace

double scaled_jacobian(const std::array<Vec3, 8>& corners) { return measure(corners).scaled_jacobian; }

std::array<Vec3, 8> element_corners(const SweptBody& body, const Block& block, int quad, int station) {
  const Stations& stations = block.stations;
  const double t0 = stations.at[station], t1 = t0 + spacing(stations, station);
  std::array<Vec3, 8> corners;
  for (int i = 0; i < 4; ++i) {
    const Vec2 p = block.section.nodes[block.section.quads[quad][i]];
    corners[i] = swept_point(body.kind, body.origin, p, t0);
    corners[i + 4] = swept_point(body.kind, body.origin, p, t1);
  }
  return corners;
}

std::vector<BlockQuality> measure_quality(const SweptBody& body) {
  std::vector<BlockQuality> out;
  for (const Block& block : body.blocks) {
    const int quads = static_cast<int>(block.section.quads.size());
    BlockQuality result{block.name, static_cast<long>(quads) * block.stations.elements(), 2.0, 0.0, 1e300, {}};
    for (int station : distinct_stations(block.stations))
      for (int quad = 0; quad < quads; ++quad) {
        const std::array<Vec3, 8> corners = element_corners(body, block, quad, station);
        const ElementQuality q = measure(corners);
        result.aspect_max = std::max(result.aspect_max, q.longest / q.shortest);
        result.edge_min = std::min(result.edge_min, q.shortest);
        if (q.scaled_jacobian >= result.scaled_jacobian_min) continue;
        result.scaled_jacobian_min = q.scaled_jacobian;
        result.worst_at = {};
        for (Vec3 c : corners) result.worst_at += 0.125 * c;
      }
    out.push_back(result);
  }
  return out;
}

}  // namespace railstrata
