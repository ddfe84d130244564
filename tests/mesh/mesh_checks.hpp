#pragma once
// Shared measures of the mesh tests.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "mesh/bodies.hpp"
#include "mesh/quality.hpp"

namespace railstrata::mesh_checks {

inline const TrackGeometry kTrack;

inline RailMeshSpec rail_spec(double contact_s = 0, std::vector<LayerMesh> layers = {}) {
  RailMeshSpec spec;
  spec.contact_s = contact_s;
  spec.x_begin = -0.004;
  spec.x_end = 0.020;
  spec.layers = std::move(layers);
  return spec;
}

inline WheelMeshSpec wheel_spec(double contact_s = 0, std::vector<LayerMesh> layers = {}) {
  WheelMeshSpec spec;
  spec.contact_s = contact_s;
  spec.theta_begin = -0.01;
  spec.theta_end = 0.05;
  spec.layers = std::move(layers);
  return spec;
}

inline std::vector<LayerMesh> one_layer(double thickness, double width = 0.060) {
  return {{"layer", thickness, width, 0}};
}

inline double area(const Section& section) {
  double sum = 0;
  for (const auto& quad : section.quads) sum += quad_area(section, quad);
  return sum;
}

/// Volume of a hexahedron with bilinear faces, by 2 x 2 x 2 Gauss points (exact).
inline double volume(const std::array<Vec3, 8>& x) {
  constexpr double kSign[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                  {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
  double sum = 0;
  for (const auto& gauss : kSign) {
    Vec3 d[3];
    for (int i = 0; i < 8; ++i)
      for (int k = 0; k < 3; ++k) {
        double shape = 0.125 * kSign[i][k];
        for (int m = 0; m < 3; ++m)
          if (m != k) shape *= 1 + kSign[i][m] * gauss[m] / std::numbers::sqrt3;
        d[k] += shape * x[i];
      }
    sum += dot(cross(d[0], d[1]), d[2]);
  }
  return sum;
}

inline double volume(const SweptBody& body) {
  double sum = 0;
  for (const Block& block : body.blocks)
    for (int j = 0; j < block.stations.elements(); ++j)
      for (std::size_t q = 0; q < block.section.quads.size(); ++q)
        sum += volume(element_corners(body, block, static_cast<int>(q), j));
  return sum;
}

/// Distance of a point from the profile, by bisection of the tangential offset near s.
inline double distance_from_profile(const Profile& profile, Vec2 p, double s) {
  double low = std::max(profile.s_min(), s - 2e-3), high = std::min(profile.s_max(), s + 2e-3);
  for (int i = 0; i < 80; ++i) {
    const double middle = 0.5 * (low + high);
    const ProfilePoint at = profile.at(middle);
    (dot(p - at.position, at.tangent) > 0 ? low : high) = middle;
  }
  return norm(p - profile.at(low).position);
}

inline Vec2 to_profile(const SweptBody& body, Vec2 p, double wheel_radius = 0.430) {
  return body.kind == SweepKind::extrude ? model_to_rail(kTrack, p) : Vec2{p.y, p.z + wheel_radius};
}

struct WorstQuality {
  double scaled_jacobian = 2, aspect = 0;
  std::string where;
};

inline void gather(WorstQuality& worst, const SweptBody& body, const std::string& label) {
  for (const BlockQuality& q : measure_quality(body)) {
    worst.aspect = std::max(worst.aspect, q.aspect_max);
    if (q.scaled_jacobian_min >= worst.scaled_jacobian) continue;
    worst.scaled_jacobian = q.scaled_jacobian_min;
    worst.where = label + ", block " + q.block;
  }
}

}  // namespace railstrata::mesh_checks
