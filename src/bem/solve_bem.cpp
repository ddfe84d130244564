#include "bem/solve_bem.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "bem/case_patch.hpp"
#include "core/faults.hpp"

namespace railstrata {

namespace {

void check_friction(const CaseSpec& spec, double load, double normal) {
  const double wanted = std::abs(spec.drive.traction_coefficient) * load, available = spec.drive.friction_coefficient * normal;
  if (wanted > 0 && wanted >= available)
    throw CaseError(fmt::format("a traction coefficient of {:g} needs {:.0f} N of friction, a friction coefficient of {:g} gives at most {:.0f} N", spec.drive.traction_coefficient, wanted,
                                spec.drive.friction_coefficient, available),
                    "lower drive.traction_coefficient or raise drive.friction_coefficient");
}

void fill_field(const CasePatch& patch, const RollingSolution& s, const RigidContact& contact, double speed, ContactField& field) {
  const PatchGrid& g = patch.grid;
  field.resize(g.ny, g.nx);
  const Vec2 tangent{std::cos(contact.angle), std::sin(contact.angle)}, normal{-tangent.z, tangent.y};
  for (int i = 0; i < g.nx; ++i)
    for (int j = 0; j < g.ny; ++j) {
      const std::size_t k = g.index(i, j);
      const Vec2 point = contact.point + g.y(j) * tangent + patch.profile.rail_height[k] * normal;
      field.x[k] = g.x(i);
      field.y[k] = point.y;
      field.z[k] = point.z;
      field.area[k] = g.cell_area();
      field.p[k] = s.normal.pressure[k];
      field.q_x[k] = s.tangential.q_x[k];
      field.q_y[k] = s.tangential.q_y[k];
      field.slip_x[k] = speed * s.tangential.slip_x[k];
      field.slip_y[k] = speed * s.tangential.slip_y[k];
      field.state[k] = s.tangential.state[k];
    }
}

void fill_totals(const RollingSolution& s, double speed, BemResult& r) {
  const TangentialSolution& t = s.tangential;
  const double c = std::cos(r.contact.angle), sn = std::sin(r.contact.angle);
  r.normal_force = s.normal.load;
  r.tangential_y = t.force_y;
  r.F_x = t.force_x;
  r.F_y = r.normal_force * sn + t.force_y * c;
  r.F_z = -r.normal_force * c + t.force_y * sn;
  r.moment = t.moment;
  r.approach = s.normal.approach;
  r.creepage_x = t.creepage_x;
  r.creepage_y = t.creepage_y;
  r.slip_area = t.slip_area;
  r.dissipation = t.dissipation * speed;
  r.turns = s.turns;
  r.iterations = s.normal.iterations + t.iterations;
  for (std::size_t k = 0; k < r.field.p.size(); ++k) {
    r.p_max = std::max(r.p_max, r.field.p[k]);
    r.q_max = std::max(r.q_max, std::hypot(r.field.q_x[k], r.field.q_y[k]));
    if (r.field.p[k] > 0) {
      r.patch_area += r.field.area[k];
      if (r.field.state[k] == ContactState::separated) r.field.state[k] = ContactState::slip;  // contact without friction
    }
  }
}

}  // namespace

BemResult solve_bem(const CaseSpec& spec, const Placement& placement, const BemOptions& options) {
  const auto begin = std::chrono::steady_clock::now();
  const double load = static_load(spec);
  check_friction(spec, load, load / std::cos(placement.contact.angle));
  CasePatch patch = make_case_patch(spec, placement, options);
  if (spec.drive.friction_coefficient > 0) patch.contact.x.force = -spec.drive.traction_coefficient * load;
  const RollingSolution s = solve_rolling(*patch.influence, patch.grid, patch.contact, options.rolling);

  BemResult r;
  r.contact = placement.contact;
  r.grid = patch.grid;
  r.wheel = patch.wheel;
  r.rail = patch.rail;
  r.spin = patch.contact.spin;
  r.notes = patch.notes;
  fill_field(patch, s, r.contact, spec.drive.speed, r.field);
  fill_totals(s, spec.drive.speed, r);
  r.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return r;
}

Subsurface rail_interior(const BemResult& r) { return {r.rail, r.grid, r.field.p, r.field.q_x, r.field.q_y}; }

Subsurface wheel_interior(const BemResult& r) {
  Plane q_x = r.field.q_x, q_y = r.field.q_y;
  for (Plane* q : {&q_x, &q_y})
    for (double& v : *q) v = -v;
  return {r.wheel, r.grid, r.field.p, std::move(q_x), std::move(q_y)};
}

}  // namespace railstrata
