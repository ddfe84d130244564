#pragma once
// What the tractions of a patch carry together.
#include <cmath>
#include <cstddef>

#include "bem/solve_bem.hpp"
#include "core/vec.hpp"

namespace railstrata::capi {

/// N and N m, on the wheel, model axes.
struct Wrench {
  Vec3 force, moment;
};

/// Sum over the cells of dF and arm x dF, dF = dA (-q_x, -p sin(delta) - q_y cos(delta), p cos(delta) - q_y
/// sin(delta)). arm_of(x, point): from where the moment is asked for to a point of the model frame; x from the middle
/// of the tape circle.
template <class ArmOf>
Wrench wrench_of(const BemPatch& patch, ArmOf&& arm_of) {
  const ContactField& f = patch.field;
  const double c = std::cos(patch.contact.angle), s = std::sin(patch.contact.angle);
  Wrench out;
  for (std::size_t k = 0; k < f.p.size(); ++k) {
    if (!(f.p[k] > 0)) continue;
    const Vec3 force = f.area[k] * Vec3{-f.q_x[k], -f.p[k] * s - f.q_y[k] * c, f.p[k] * c - f.q_y[k] * s};
    out.force += force;
    out.moment += cross(arm_of(patch.contact.x + f.x[k], Vec2{f.y[k], f.z[k]}), force);
  }
  return out;
}

}  // namespace railstrata::capi
