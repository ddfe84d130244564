#include "capi/patch_forces.hpp"

#include <fmt/format.h>

#include <cmath>

#include "capi/contact.hpp"
#include "capi/guarded.hpp"
#include "geometry/profile.hpp"
#include "result/patch.hpp"

using namespace railstrata;

namespace {

void put(double (&out)[3], Vec3 v) {
  out[0] = v.x;
  out[1] = v.y;
  out[2] = v.z;
}

void put(double (&out)[2], Vec2 v) {
  out[0] = v.y;
  out[1] = v.z;
}

Vec3 point_of(const double* about) {
  if (!about) return {};
  if (!std::isfinite(about[0]) || !std::isfinite(about[1]) || !std::isfinite(about[2]))
    throw CaseError("the point that moments are about is no point", "give three finite numbers in m, or NULL");
  return {about[0], about[1], about[2]};
}

void fill(const rs_contact& contact, const BemPatch& patch, Vec3 about, rs_patch& out) {
  const ContactField& f = patch.field;
  const RigidContact& c = patch.place;
  const capi::Wrench carried = capi::wrench_of(patch, [&](double x, Vec2 point) {
    return Vec3{x, point.y, point.z} - about;
  });
  put(out.force, carried.force);
  put(out.moment, carried.moment);
  out.normal_force = patch.force.normal;
  out.lateral_force = -patch.force.tangential;
  out.spin_moment = -patch.force.moment;
  out.approach = patch.approach;
  put(out.point, {c.x, c.point.y, c.point.z});
  put(out.on_wheel, contact.placement.wheel.at(c.wheel_s).position);
  put(out.on_rail, contact.placement.rail.at(c.rail_s).position);
  out.contact_angle = c.angle;
  out.rolling_radius = c.rolling_radius;
  const PatchMeasures measures = measure_patch(f);
  out.p_max = measures.p_max;
  out.patch_area = measures.area;
  out.cells = capi::cells_with_pressure(f);
  out.dissipation = patch.dissipation;
}

}  // namespace

extern "C" int rs_patch_forces(const rs_contact* contact, int patch, const double* about, rs_patch* out,
                               rs_error* error) {
  return capi::guarded(error, [&] {
    if (!out) throw CaseError("out is NULL", "give an rs_patch with its size set");
    if (out->size != sizeof(rs_patch))
      throw CaseError(fmt::format("rs_patch.size = {} is of another version of the library", out->size),
                      "set size = sizeof(rs_patch), and compile with this version's railstrata.h");
    const BemPatch& found = capi::patch_of(contact, patch);
    fill(*contact, found, point_of(about), *out);
  });
}
