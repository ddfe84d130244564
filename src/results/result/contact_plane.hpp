#pragma once
// Tensors of the rail's section in the axes of the rigid contact point: y in the contact plane to the field side, z
// into the rail.
#include <array>

#include "model/section_axes.hpp"

namespace railstrata {

struct ContactPlane : SectionAxes {
  explicit ContactPlane(const Model& m) : SectionAxes(m, BodyId::rail) {}
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

}  // namespace railstrata
