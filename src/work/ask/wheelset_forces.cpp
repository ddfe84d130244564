#include "ask/wheelset_forces.hpp"

#include <fmt/format.h>

#include <cmath>
#include <sstream>

#include "core/faults.hpp"

namespace railstrata {
namespace {

/// Signs of what a wheel has in its own axes, of the left one that rolls on, in those of the track.
struct InTrack {
  InTrack(std::size_t side, const SolvedWheelset& solved)
      : x(solved.state.speed < 0 ? -1 : 1), y(side == kRight ? -1 : 1), centre(solved.state.y) {}
  double x, y;
  double centre;  ///< m, y of the axle's
  Vec3 polar(Vec3 v) const { return {x * v.x, y * v.y, v.z}; }
  Vec3 axial(Vec3 v) const { return {y * v.x, x * v.y, x * y * v.z}; }
};

Vec3 arm(const Wheel& w, double x, Vec2 point) { return arm_of(w.track(), w.touching(), w.motion, w.rail, x, point); }

/// m, track axes.
Vec3 point_of(const Wheel& w, const RigidContact& place, const InTrack& sign) {
  const Vec3 from_centre = yaw(rotation_by(w.rail.yaw), arm(w, place.x, place.point));
  Vec3 out = sign.polar({from_centre.x, from_centre.y, place.point.z + w.rail.z});
  out.y += sign.centre;
  return out;
}

}  // namespace

Wrench carried_by(const Wheel& w, const RigidContact& plane, const ContactField& field) {
  const Rotation<double> rail = rotation_by(w.rail.yaw);
  const Wrench on_rail = wrench_of(plane, field, [&](double x, Vec2 point) { return arm(w, x, point); });
  return {yaw(rail, on_rail.force), yaw(rail, on_rail.moment)};
}

std::vector<TractionSum> wrench_sums(const Wheel& w, const RigidContact& plane, const ContactField& field) {
  const std::size_t n = field.p.size();
  std::vector<TractionSum> out(6, {Plane(n, 0.0), Plane(n, 0.0), Plane(n, 0.0)});
  Plane TractionSum::*const tractions[] = {&TractionSum::p, &TractionSum::q_x, &TractionSum::q_y};
  for (std::size_t k = 0; k < n; ++k) {
    if (!(field.p[k] > 0)) continue;
    const Vec3 place = arm(w, plane.x + field.x[k], Vec2{field.y[k], field.z[k]});
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec3 force = force_of(plane, field.area[k], c == 0, c == 1, c == 2), moment = cross(place, force);
      const double numbers[] = {force.x, force.y, force.z, moment.x, moment.y, moment.z};
      for (std::size_t i = 0; i < out.size(); ++i) (out[i].*tractions[c])[k] = numbers[i];
    }
  }
  return out;
}

Wrench wrench_from(const Wheel& w, const std::vector<double>& sums) {
  const Rotation<double> rail = rotation_by(w.rail.yaw);
  return {yaw(rail, {sums[0], sums[1], sums[2]}), yaw(rail, {sums[3], sums[4], sums[5]})};
}

Wrench in_track(const Wheelset& set, std::size_t side, const Wrench& of_wheel) {
  const InTrack sign(side, *set.solved);
  return {sign.polar(of_wheel.force), sign.axial(of_wheel.moment)};
}

Wrench carried_by(const Wheel& w) {
  Wrench out;
  out.force = yaw(rotation_by(w.rail.yaw), {w.forces.force_x, w.forces.force_y, w.forces.force_z});
  if (!w.contact.last()) return out;
  const Wrench of_cells = mean_of_solutions(*w.contact.last(), [&](const std::vector<const BemPatch*>& patches) {
    Wrench sum;
    for (const BemPatch* patch : patches) sum = sum + carried_by(w, patch->contact, patch->field);
    return sum;
  });
  out.moment = of_cells.moment;
  if (w.forces.beyond)  // what the cells do not carry acts at the place
    out.moment +=
        cross(yaw(rotation_by(w.rail.yaw), arm(w, w.reference.x, w.reference.point)), out.force - of_cells.force);
  return out;
}

WheelForces forces_of(const Wheelset& set, std::size_t side) {
  const Wheel& w = set.wheels[side];
  const InTrack sign(side, *set.solved);
  const RigidContact& place = w.reference;
  const WheelSlip slip = slip_at(w.track(), place, w.motion, w.rail);
  WheelForces out;
  out.force = sign.polar(w.force);
  out.moment = sign.axial(w.moment);
  out.normal_force = w.forces.normal_force;
  out.lateral_force = sign.y * w.forces.lateral_force;
  out.spin_moment = sign.x * sign.y * w.forces.spin_moment;
  out.creepage_x = sign.x * slip.creepage_x;
  out.creepage_y = sign.y * slip.creepage_y;
  out.spin = sign.x * sign.y * slip.spin;
  out.approach = w.forces.approach;
  out.point = point_of(w, place, sign);
  out.on_wheel = w.contact.placement().wheel.at(place.wheel_s).position;
  out.on_rail = w.contact.placement().rail.at(place.rail_s).position;
  out.contact_angle = sign.y * place.angle;
  out.rolling_radius = place.rolling_radius;
  out.p_max = w.forces.p_max;
  out.patch_area = w.forces.patch_area;
  out.dissipation = w.forces.dissipation;
  out.patches = w.forces.patches;
  out.cells = w.forces.cells;
  out.checks_hold = w.forces.checks_hold;
  out.beyond = w.forces.beyond;
  return out;
}

PatchForces patch_forces(const Wheelset& set, int side, int index, const std::optional<Vec3>& about) {
  if (side < 0 || side > 1) throw CaseError(fmt::format("there is no side {}", side), "give 0 (left) or 1 (right)");
  if (!set.solved) throw CaseError("there is no solution", "solve a state first");
  const Wheel& w = set.wheels[static_cast<std::size_t>(side)];
  const InTrack sign(static_cast<std::size_t>(side), *set.solved);
  PatchForces out = patch_forces(w.contact, index, {});
  const BemPatch& patch = w.contact.patch(index);
  const Wrench carried = carried_by(w, patch.contact, patch.field);
  out.force = sign.polar(carried.force);
  out.moment = sign.axial(carried.moment);
  if (about) {
    require_point(*about);
    const Vec3 centre{0, set.solved->state.y, w.track().wheel_radius + set.solved->z};
    out.moment += cross(centre - *about, out.force);
  }
  out.lateral_force *= sign.y;
  out.spin_moment *= sign.x * sign.y;
  out.point = point_of(w, patch.place, sign);
  out.contact_angle *= sign.y;
  return out;
}

std::string remarks_of(const Wheelset& set) {
  std::string out;
  for (std::size_t side : {kLeft, kRight}) {
    std::istringstream lines(set.wheels[side].contact.remarks());
    for (std::string line; std::getline(lines, line);)
      out += fmt::format("{}{} wheel: {}", out.empty() ? "" : "\n", side == kLeft ? "left" : "right", line);
  }
  return out;
}

}  // namespace railstrata
