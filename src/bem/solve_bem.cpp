#include "bem/solve_bem.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "bem/profile_gap.hpp"
#include "core/faults.hpp"

namespace railstrata {

namespace {

HalfSpaceMaterial half_space(const MaterialSpec& m) { return {m.young, m.poisson}; }

void check_friction(const CaseSpec& spec, double load, double normal) {
  const double wanted = std::abs(spec.drive.traction_coefficient) * load, available = spec.drive.friction_coefficient * normal;
  if (wanted > 0 && wanted >= available)
    throw CaseError(fmt::format("a traction coefficient of {:g} needs {:.0f} N of friction, a friction coefficient of {:g} gives at most {:.0f} N", spec.drive.traction_coefficient, wanted,
                                spec.drive.friction_coefficient, available),
                    "lower drive.traction_coefficient or raise drive.friction_coefficient");
}

PatchGrid first_grid(const CaseSpec& spec, const Placement& placement, const BemOptions& options) {
  const HertzContact estimate = hertz_estimate(spec, placement.contact);
  const auto cells = [&](double semi_axis) { return static_cast<int>(std::ceil(std::min(1.15 * semi_axis, 0.5 * options.largest_patch) / options.cell)) + 2; };
  return centred_grid(cells(estimate.a), cells(estimate.b), options.cell, options.cell);
}

struct Patch {
  PatchGrid grid;
  ProfileGap gap;
  std::shared_ptr<const InfluenceOperator> influence;
};

/// Grows the grid until the frictionless patch, with one ring to spare, lies inside.
Patch fit_patch(const CaseSpec& spec, const Placement& placement, double normal, const BemOptions& options, InfluenceCache& cache, BemResult& result) {
  Patch patch{first_grid(spec, placement, options), {}, {}};
  for (int grown = 0;; ++grown) {
    PatchGrid& g = patch.grid;
    patch.gap = profile_gap(placement.wheel, placement.rail, placement.track, placement.contact, g);
    patch.influence = cache.get(result.wheel, result.rail, g);
    const NormalSolution s = solve_normal(*patch.influence, g, patch.gap.gap, {.load = normal, .approach = {}}, options.rolling.normal);
    if (!s.touches_edge) {
      if (grown > 0) result.notes.push_back(fmt::format("the potential contact area was grown to {:.1f} mm x {:.1f} mm", 1e3 * g.nx * g.dx, 1e3 * g.ny * g.dy));
      return patch;
    }
    const int half_x = g.nx * 7 / 10 + 1, half_y = g.ny * 7 / 10 + 1;
    if (std::max(half_x, half_y) * 2 * options.cell > options.largest_patch)
      throw CaseError(fmt::format("the load of {:.1f} kN flattens the whole potential contact area of {:.0f} mm", 1e-3 * normal, 1e3 * options.largest_patch),
                      "check the load, the profiles and the moduli; half-space theory no longer applies");
    g = centred_grid(half_x, half_y, options.cell, options.cell);
  }
}

/// Rigid slip of the wheel's surface beyond creepage: it turns with its local radius. The spin part is given apart (its lateral slip).
Plane slip_of_radius(const PatchGrid& g, const ProfileGap& gap, const RigidContact& contact, double spin) {
  Plane slip(g.size());
  for (int i = 0; i < g.nx; ++i)
    for (int j = 0; j < g.ny; ++j) {
      const double radius = gap.radius[g.index(g.nx / 2, j)];
      slip[g.index(i, j)] = (contact.rolling_radius - radius) / contact.rolling_radius + spin * g.y(j);
    }
  return slip;
}

void fill_field(const Patch& patch, const RollingSolution& s, const RigidContact& contact, double speed, ContactField& field) {
  const PatchGrid& g = patch.grid;
  field.resize(g.ny, g.nx);
  const Vec2 tangent{std::cos(contact.angle), std::sin(contact.angle)}, normal{-tangent.z, tangent.y};
  for (int i = 0; i < g.nx; ++i)
    for (int j = 0; j < g.ny; ++j) {
      const std::size_t k = g.index(i, j);
      const Vec2 point = contact.point + g.y(j) * tangent + patch.gap.rail_height[k] * normal;
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

LayeredHalfSpace layered_body(const CaseSpec& spec, const std::string& body) {
  LayeredHalfSpace out{{}, half_space(body == "wheel" ? spec.wheel_material : spec.rail_material)};
  for (const LayerSpec& layer : spec.layers)
    if (layer.on == body) out.layers.push_back({layer.thickness, half_space(layer.material)});
  return out;
}

BemResult solve_bem(const CaseSpec& spec, const Placement& placement, const BemOptions& options) {
  const auto begin = std::chrono::steady_clock::now();
  BemResult r;
  r.contact = placement.contact;
  r.wheel = layered_body(spec, "wheel");
  r.rail = layered_body(spec, "rail");
  const double load = static_load(spec), normal = load / std::cos(r.contact.angle);
  check_friction(spec, load, normal);

  InfluenceCache own;
  const Patch patch = fit_patch(spec, placement, normal, options, options.cache ? *options.cache : own, r);
  r.grid = patch.grid;
  r.spin = -std::sin(r.contact.angle) / r.contact.rolling_radius;

  RollingContact contact;
  contact.gap = patch.gap.gap;
  contact.target.load = normal;
  contact.friction = spec.drive.friction_coefficient;
  if (spec.drive.friction_coefficient > 0) contact.x.force = -spec.drive.traction_coefficient * load;
  contact.spin = r.spin;
  contact.extra_x = slip_of_radius(patch.grid, patch.gap, r.contact, r.spin);
  const RollingSolution s = solve_rolling(*patch.influence, patch.grid, contact, options.rolling);
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
