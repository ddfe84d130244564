#pragma once
// What the tractions of a patch carry together.
#include <array>
#include <cmath>
#include <cstddef>

#include "ask/contact.hpp"
#include "ask/named.hpp"
#include "bem/solve_bem.hpp"
#include "core/vec.hpp"

namespace railstrata {

/// One of the patches that share the load; meanings are those of rs_patch (railstrata.h).
struct PatchForces {
  Vec3 force, moment;
  double normal_force = 0, lateral_force = 0, spin_moment = 0;
  double approach = 0;
  Vec3 point;
  Vec2 on_wheel, on_rail;
  double contact_angle = 0, rolling_radius = 0;
  double p_max = 0, patch_area = 0, dissipation = 0;
  int cells = 0;
};
inline constexpr std::array<Named<PatchForces, double, int, Vec2, Vec3>, 15> kPatchForces{
    {{"force", "N", &PatchForces::force},
     {"moment", "N m", &PatchForces::moment},
     {"normal_force", "N", &PatchForces::normal_force},
     {"lateral_force", "N", &PatchForces::lateral_force},
     {"spin_moment", "N m", &PatchForces::spin_moment},
     {"approach", "m", &PatchForces::approach},
     {"point", "m", &PatchForces::point},
     {"on_wheel", "m", &PatchForces::on_wheel},
     {"on_rail", "m", &PatchForces::on_rail},
     {"contact_angle", "rad", &PatchForces::contact_angle},
     {"rolling_radius", "m", &PatchForces::rolling_radius},
     {"p_max", "Pa", &PatchForces::p_max},
     {"patch_area", "m2", &PatchForces::patch_area},
     {"dissipation", "W", &PatchForces::dissipation},
     {"cells", "", &PatchForces::cells}}};

/// Throws CaseError: the point that moments are about is no point.
void require_point(const Vec3& about);
/// Of a patch of the last solution, moments about a point, m, model axes. Throws CaseError.
PatchForces patch_forces(const Contact& contact, int patch, Vec3 about);

/// N and N m, on the wheel, model axes.
struct Wrench {
  Vec3 force, moment;
};
constexpr Wrench operator+(const Wrench& a, const Wrench& b) { return {a.force + b.force, a.moment + b.moment}; }
constexpr Wrench operator*(double s, const Wrench& w) { return {s * w.force, s * w.moment}; }

/// dF = dA (-q_x, -p sin(delta) - q_y cos(delta), p cos(delta) - q_y sin(delta)): on the wheel, model axes.
inline Vec3 force_of(const RigidContact& plane, double area, double p, double q_x, double q_y) {
  const double c = std::cos(plane.angle), s = std::sin(plane.angle);
  return area * Vec3{-q_x, -p * s - q_y * c, p * c - q_y * s};
}

/// Sum over the cells of dF and arm x dF. arm_of(x, point): from where the moment is asked for to a point of the model
/// frame; x from the middle of the tape circle.
template <class ArmOf>
Wrench wrench_of(const RigidContact& plane, const ContactField& f, ArmOf&& arm_of) {
  Wrench out;
  for (std::size_t k = 0; k < f.p.size(); ++k) {
    if (!(f.p[k] > 0)) continue;
    const Vec3 force = force_of(plane, f.area[k], f.p[k], f.q_x[k], f.q_y[k]);
    out.force += force;
    out.moment += cross(arm_of(plane.x + f.x[k], Vec2{f.y[k], f.z[k]}), force);
  }
  return out;
}

}  // namespace railstrata
