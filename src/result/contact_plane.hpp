#pragma once
// Places and tensors of the rail's section in the axes of the rigid contact point: y in the contact plane to the field
// side, z into the rail.
#include <algorithm>
#include <array>

#include "model/model.hpp"

namespace railstrata {

struct ContactPlane {
  Vec2 point, across, into;
  explicit ContactPlane(const Model& m) {
    const double s = m.placement.contact.rail_s;
    const Vec2 outward = m.rail_section_normal(s);
    point = m.rail_section_point(s);
    into = {-outward.y, -outward.z};
    across = {outward.z, -outward.y};
  }
  /// Components xx, yy, zz, xy, yz, xz of a tensor given in the rail's axes.
  std::array<double, 6> turned(const Sym3& s) const {
    const auto pair = [&](Vec2 a, Vec2 b) { return a.y * (s.yy * b.y + s.yz * b.z) + a.z * (s.yz * b.y + s.zz * b.z); };
    return {s.xx,
            pair(across, across),
            pair(into, into),
            s.xy * across.y + s.xz * across.z,
            pair(across, into),
            s.xy * into.y + s.xz * into.z};
  }
};

inline Vec2 centre_of(const Section& section, int quad) {
  Vec2 sum{};
  for (int n : section.quads[quad]) sum = sum + 0.25 * section.nodes[n];
  return sum;
}

}  // namespace railstrata
