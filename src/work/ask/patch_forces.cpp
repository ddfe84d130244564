#include "ask/patch_forces.hpp"

#include <cmath>

#include "geometry/profile.hpp"
#include "result/patch.hpp"

namespace railstrata {

void require_point(const Vec3& about) {
  if (!std::isfinite(about.x) || !std::isfinite(about.y) || !std::isfinite(about.z))
    throw CaseError("the point that moments are about is no point", "give three finite numbers in m");
}

PatchForces patch_forces(const Contact& contact, int index, Vec3 about) {
  require_point(about);
  const BemPatch& patch = contact.patch(index);
  const RigidContact& c = patch.place;
  const Wrench carried = wrench_of(patch.contact, patch.field, [&](double x, Vec2 point) {
    return Vec3{x, point.y, point.z} - about;
  });
  const PatchMeasures measures = measure_patch(patch.field);
  return {carried.force,
          carried.moment,
          patch.force.normal,
          -patch.force.tangential,
          -patch.force.moment,
          patch.approach,
          {c.x, c.point.y, c.point.z},
          contact.placement().wheel.at(c.wheel_s).position,
          contact.placement().rail.at(c.rail_s).position,
          c.angle,
          c.rolling_radius,
          measures.p_max,
          measures.area,
          patch.dissipation,
          cells_with_pressure(patch.field)};
}

}  // namespace railstrata
