#include "bem/case_patch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/faults.hpp"
#include "model/drive_at_contact.hpp"
#include "model/sliding_waves.hpp"
#include "model/thermal_body.hpp"

namespace railstrata {

namespace {

/// Of the modulus within one of the layers that a graded one is cut into: p_max is within 1e-4 (docs/bem-theory.md).
constexpr double kGradingTolerance = 0.05;

HalfSpaceMaterial half_space(const MaterialSpec& m) { return {m.young, m.poisson}; }

struct Touches {
  bool x = false, y = false;
};
/// At which ends of the grid a cell of the outermost ring carries pressure; ahead one of the two outermost columns, for
/// leading_weights looks at two.
Touches touches(const PatchGrid& g, const Plane& pressure) {
  Touches out;
  for (int i = 0; i < g.nx; ++i)
    for (int j = 0; j < g.ny; ++j) {
      if (!(pressure[g.index(i, j)] > 0)) continue;
      out.x |= i == 0 || i >= g.nx - 2;
      out.y |= !g.line && (j == 0 || j == g.ny - 1);
    }
  return out;
}

/// Takes the surface outside of the room away.
void keep_to_room(const PatchGrid& g, const PatchRoom& room, Plane& gap) {
  for (std::size_t k = 0; k < g.size(); ++k)
    if (g.y_of(k) < room.low || g.y_of(k) > room.high) gap[k] = ProfileGap::kNoSurface;
}

double across_of(const BemOptions& options) { return options.across > 0 ? options.across : options.cell; }

/// On each side of the middle.
int most_cells(const BemOptions& options, double cell) { return static_cast<int>(0.5 * options.largest_patch / cell); }

std::string describe(const NormalTarget& target) {
  return target.load ? fmt::format("load of {:.1f} kN", 1e-3 * *target.load)
                     : fmt::format("approach of {:.3g} mm", 1e3 * *target.approach);
}

void gap_and_influence(const CaseSpec& spec, const Placement& placement, const BemOptions& options,
                       ContactBodies bodies, InfluenceCache& cache, CasePatch& patch) {
  const auto gap = spec.bem.normals == ContactNormals::local ? &local_gap : &profile_gap;
  patch.profile = gap(placement.wheel, placement.rail, placement.track, placement.contact, patch.grid);
  patch.contact.turn.clear();
  for (const RowPlane& row : patch.profile.rows) patch.contact.turn.push_back(row.angle - placement.contact.angle);
  if (options.rail_surface) {
    patch.surface = options.rail_surface(patch.grid);
    for (std::size_t k = 0; k < patch.profile.gap.size(); ++k)
      if (patch.profile.gap[k] < ProfileGap::kNoSurface) patch.profile.gap[k] += patch.surface.sinking[k];
  }
  const double film = patch.contact.third_body.flexibility();
  patch.sections = bodies == ContactBodies::sections ? cache.sections() : nullptr;
  patch.influence = bodies == ContactBodies::half_spaces
                        ? cache.get(patch.wheel, patch.rail, patch.grid, film)
                        : cache.get(patch.wheel, patch.rail, patch.grid, film, {spec, placement});
  if (!patch.contact.turn.empty())
    patch.influence = std::make_shared<const InfluenceOperator>(*patch.influence, patch.contact.turn);
}

void fit_grid(const CaseSpec& spec, const Placement& placement, const NormalTarget& target, const PatchRoom& room,
              const BemOptions& options, ContactBodies bodies, InfluenceCache& cache, CasePatch& patch) {
  const int most_x = most_cells(options, options.cell), most_y = most_cells(options, across_of(options));
  for (int grown = 0;; ++grown) {
    PatchGrid& g = patch.grid;
    gap_and_influence(spec, placement, options, bodies, cache, patch);
    keep_to_room(g, room, patch.profile.gap);
    patch.frictionless =
        solve_normal(*patch.influence, g, gap_after(patch, 0), target, options.rolling.normal, {}, patch.contact.turn);
    const Touches edge = touches(g, patch.frictionless.pressure);
    if (!edge.x && !edge.y) {
      if (grown > 0)
        patch.notes.push_back(fmt::format("the potential contact area was grown to {:.1f} mm x {:.1f} mm",
                                          1e3 * g.nx * g.dx, 1e3 * g.ny * g.dy));
      return;
    }
    const int half_x = edge.x ? std::min(g.nx * 7 / 10 + 1, most_x) : g.nx / 2,
              half_y = edge.y ? std::min(g.ny * 7 / 10 + 1, most_y) : g.ny / 2;
    if (half_x == g.nx / 2 && half_y == g.ny / 2)
      throw CaseError(fmt::format("the {} flattens the whole potential contact area of {:.0f} mm", describe(target),
                                  1e3 * options.largest_patch),
                      "check the load, the profiles and the moduli; half-space theory no longer applies",
                      target.load ? "vehicle.wheel_load" : "vehicle.approach");
    g = g.line ? line_grid(half_x, g.dx, g.dy) : centred_grid(half_x, half_y, g.dx, g.dy);
  }
}

/// Rigid slip of the wheel's surface beyond creepage: each point moves with its local rolling radius, of a rail that
/// turns too with its own. The part linear in y, -spin y, is left to the spin, which also brings the lateral slip.
/// Surfaces meet halfway; of sections the wheel's own counts, whose influence brings its displacement.
Plane slip_of_radius(const PatchGrid& g, const ProfileGap& gap, const RigidContact& contact, double spin,
                     ContactBodies bodies) {
  Plane slip(g.size());
  for (std::size_t k = 0; k < g.size(); ++k) {
    const std::size_t under_axle = g.index(g.nx / 2, static_cast<int>(k) % g.ny);
    double radius = gap.radius[under_axle];
    if (bodies == ContactBodies::sections && gap.gap[under_axle] < ProfileGap::kNoSurface)
      radius -= 0.5 * std::cos(contact.angle) * gap.gap[under_axle];
    slip[k] = (contact.rolling_radius - radius) / contact.rolling_radius + spin * g.y_of(k);
    if (!gap.rail_radius.empty()) slip[k] += gap.rail_radius[under_axle] * contact.rail_turn - 1;
  }
  return slip;
}

CasePatch bodies_of(const CaseSpec& any_place, const Placement& placement) {
  const CaseSpec spec = case_at_contact(any_place, placement);
  CasePatch patch;
  patch.wheel = layered_body(spec, BodyId::wheel);
  patch.rail = layered_body(spec, BodyId::rail);
  patch.contact.third_body = third_body(spec);
  patch.rail_heights = {spec.irregularities, BodyId::rail, spec.geometry.wheel_radius};
  patch.wheel_heights = {spec.irregularities, BodyId::wheel, spec.geometry.wheel_radius};
  return patch;
}

/// Of a cell on the rail.
Vec2 point_of(const CasePatch& patch, const RigidContact& contact, std::size_t cell) {
  const std::size_t row = cell % static_cast<std::size_t>(patch.grid.ny);
  if (!patch.profile.rows.empty()) return patch.profile.rows[row].point;
  const Vec2 tangent{std::cos(contact.angle), std::sin(contact.angle)}, normal{-tangent.z, tangent.y};
  return contact.point + patch.grid.y_of(cell) * tangent + patch.profile.rail_height[cell] * normal;
}

/// Coefficients over y of the rail's own profile.
Plane friction_across(const CaseSpec& spec, const Placement& placement, const CasePatch& patch) {
  Plane out(patch.grid.size());
  for (std::size_t k = 0; k < out.size(); ++k) {
    const Vec2 on_rail = model_to_rail(placement.track, point_of(patch, placement.contact, k));
    out[k] = over_table(spec.friction.lateral_table, on_rail.y);
  }
  return out;
}

void fill_heat(const CaseSpec& spec, CasePatch& patch, const HertzContact& estimate) {
  if (spec.friction.temperature_table.empty() && spec.third_body.temperature_table.empty()) return;
  patch.contact.heat = ContactHeat{thermal_body(spec, BodyId::rail),       thermal_body(spec, BodyId::wheel),
                                   spec.friction.rail_temperature.value(), spec.friction.wheel_temperature.value(),
                                   spec.friction.temperature_table,        spec.third_body.temperature_table};
  const double diffusivity =
                   std::max(patch.contact.heat->rail.base.diffusivity(), patch.contact.heat->wheel.base.diffusivity()),
               peclet = spec.drive.speed * estimate.a / (2 * diffusivity);
  if (peclet < kLeastPeclet)
    patch.notes.push_back(
        fmt::format("the contact moves so slowly that heat spreads sideways (Péclet number {:.2g}; at least {:g} is "
                    "needed): temperatures, and friction that depends on them, are too high",
                    peclet, kLeastPeclet));
}

}  // namespace

PatchGrid first_grid(const CaseSpec& spec, const Placement& placement, const BemOptions& options,
                     const NormalTarget& target, const PatchRoom& room) {
  const HertzContact estimate = hertz_estimate(spec, placement.contact);
  const double scale = target.approach ? std::sqrt(*target.approach / estimate.approach) : 1.0,
               held = std::max(-room.held_low, room.held_high);
  const auto cells = [&](double half, double cell) {
    return static_cast<int>(std::min(std::ceil(half / cell) + 2, static_cast<double>(most_cells(options, cell))));
  };
  const double across = across_of(options);
  const int half_x = cells(1.15 * scale * estimate.a, options.cell);
  if (spec.geometry.in_line()) return line_grid(half_x, options.cell, *spec.geometry.line_length);
  return centred_grid(half_x, cells(std::max(1.15 * scale * estimate.b, held), across), options.cell, across);
}

LayeredHalfSpace layered_body(const CaseSpec& spec, BodyId body) {
  LayeredHalfSpace out{{}, half_space(body == BodyId::wheel ? spec.wheel_material : spec.rail_material)};
  for (const LayerSpec& layer : spec.layers) {
    if (layer.on != body || !(layer.thickness > 0)) continue;
    const auto give = [](const std::optional<double>& stiffness) { return stiffness ? 1 / *stiffness : 0.0; };
    const Bond bond{give(layer.interface_normal_stiffness), give(layer.interface_shear_stiffness)};
    if (!layer.graded()) {
      out.layers.push_back({.thickness = layer.thickness, .material = half_space(layer.material), .bond = bond});
      continue;
    }
    std::vector<GradedPoint> table;
    for (const ModulusPoint& point : layer.young_table)
      table.push_back({point.depth, {point.young, layer.material.poisson}});
    const std::vector<HalfSpaceLayer> cuts = cut_into_layers(table, kGradingTolerance);
    out.layers.insert(out.layers.end(), cuts.begin(), cuts.end());
    out.layers.back().bond = bond;
  }
  return out;
}

Plane local_spin(const PatchGrid& grid, const ProfileGap& profile, const RigidContact& contact) {
  Plane spin(static_cast<std::size_t>(grid.ny), 0.0);
  const auto row = [&](int j) { return grid.index(grid.nx / 2, j); };
  const auto present = [&](int j) { return profile.gap[row(j)] < ProfileGap::kNoSurface; };
  const auto middle = [&](int j) { return profile.rail_height[row(j)] + 0.5 * profile.gap[row(j)]; };
  for (int j = 0; j < grid.ny; ++j) {
    const int low = std::max(j - 1, 0), high = std::min(j + 1, grid.ny - 1);
    if (!present(low) || !present(j) || !present(high)) continue;
    RigidContact here = contact;
    here.angle = profile.rows.empty()
                     ? contact.angle + std::atan((middle(high) - middle(low)) / ((high - low) * grid.dy))
                     : profile.rows[static_cast<std::size_t>(j)].angle;
    spin[static_cast<std::size_t>(j)] = wheel_spin(here) - wheel_spin(contact);
  }
  return spin;
}

void drive_contact(const CaseSpec& spec, const RigidContact& contact, double weight, RollingContact& problem) {
  const DriveSpec drive = drive_at_contact(spec, contact);
  problem.x = {drive.creepage.value_or(0), {}};
  problem.y = {drive.lateral_creepage.value_or(yaw_creepage(contact)), {}};
  if (!(problem.friction > 0)) return;
  if (drive.traction()) problem.x.force = -*drive.traction() * weight;
  if (drive.lateral_traction_coefficient) problem.y.force = -*drive.lateral_traction_coefficient * weight;
}

void carry_creepages(double turn, const RigidContact& first, const RigidContact& own, RollingContact& problem) {
  const double cosines = std::cos(first.angle) / std::cos(own.angle),
               rail = own.rail_turn == 0 ? 1.0 : first.rail_turn / own.rail_turn;
  problem.x.creepage = rail - (1 - problem.x.creepage) * own.rolling_radius / first.rolling_radius -
                       (own.point.y - first.point.y) * turn;
  problem.y.creepage *= cosines;
  problem.spin = wheel_spin(own) + turn * std::cos(own.angle);
}

double normal_load(double weight, double lateral, const RigidContact& contact) {
  return (weight + lateral * std::sin(contact.angle)) / std::cos(contact.angle);
}

void refuse_wedged(const char* borne, const RigidContact& contact) {
  throw CaseError(
      fmt::format(
          "no normal force balances the {} at a contact angle of {:.1f} degrees: the wheel is wedged by friction",
          borne, std::abs(contact.angle) * 180 / std::numbers::pi),
      "lower drive.friction_coefficient, or check lateral_shift and the profiles", "drive.friction_coefficient");
}

Plane gap_after(const CasePatch& patch, double distance) {
  Plane gap = patch.profile.gap;
  if (patch.rail_heights.none() && patch.wheel_heights.none()) return gap;
  const PatchGrid& g = patch.grid;
  for (std::size_t k = 0; k < g.size(); ++k) {
    if (gap[k] == ProfileGap::kNoSurface) continue;
    const double x = distance + g.x_of(k), y = g.y_of(k);
    gap[k] -= patch.rail_heights.at(x, y).z + patch.wheel_heights.at(x, y).z;
  }
  return gap;
}

void set_problem(const CaseSpec& spec, const Placement& placement, const NormalTarget& target, CasePatch& patch) {
  RollingContact& contact = patch.contact;
  contact.gap = gap_after(patch, 0);
  contact.target = target;
  contact.friction = spec.drive.friction_coefficient;
  contact.leading_edge = spec.bem.leading_edge;
  contact.spin = spin_at(spec, placement.contact);
  contact.extra_slip.x =
      slip_of_radius(patch.grid, patch.profile, placement.contact, wheel_spin(placement.contact), spec.bem.bodies);
  scale_by(contact.extra_slip.x, spec.drive.rolling_share);
  if (const PlanePair& stretch = patch.surface.stretch; !stretch.x.empty()) {
    add_scaled(contact.extra_slip.x, 1, stretch.x);
    contact.extra_slip.y = stretch.y;
  }
  if (spec.bem.spin_angle == SpinAngle::local && !patch.grid.line)
    scale_by(contact.local_spin = local_spin(patch.grid, patch.profile, placement.contact), spec.drive.rolling_share);
  contact.falling = falling_friction(spec);
  const HertzContact estimate = hertz_estimate(spec, placement.contact);
  if (const std::string note = note_of_instability(spec, estimate); !note.empty()) patch.notes.push_back(note);
  if (!spec.friction.lateral_table.empty()) contact.local_friction = friction_across(spec, placement, patch);
  contact.lateral_share = lateral_friction_share(spec);
  fill_heat(case_at_contact(spec, placement), patch, estimate);
  contact.speed = spec.drive.speed;
  if (!patch.influence->stretches()) return;
  const Plane stretch = patch.influence->stretch_by_rotation(contact.speed);
  patch.notes.push_back(
      fmt::format("the contact has the sections of rail and wheel; centrifugal force widens the wheel by {:.1e} of its "
                  "radius, by which creepages along the rail would "
                  "be larger",
                  -stretch[stretch.size() / 2]));
  if (const double bent = patch.influence->stretch_by_load(); bent != 0)
    patch.notes.push_back(fmt::format(
        "the rail bends on its track: by that its running surface is stretched by {:.2e} per kN of load, the lower are "
        "creepages along the rail",
        1e3 * bent));
}

CasePatch make_case_patch(const CaseSpec& spec, const Placement& placement, const BemOptions& options,
                          const NormalTarget& target, const PatchRoom& room) {
  CasePatch patch = bodies_of(spec, placement);
  patch.grid = first_grid(spec, placement, options, target, room);
  InfluenceCache own;
  InfluenceCache& cache = options.cache ? *options.cache : own;
  fit_grid(spec, placement, target, room, options, ContactBodies::half_spaces, cache, patch);
  if (spec.bem.bodies != ContactBodies::half_spaces)  // on the grid of half-spaces: sections take seconds
    fit_grid(spec, placement, target, room, options, spec.bem.bodies, cache, patch);
  set_problem(spec, placement, target, patch);
  return patch;
}

CasePatch case_patch_on(const PatchGrid& grid, const CaseSpec& spec, const Placement& placement,
                        const BemOptions& options, const NormalTarget& target, const PatchRoom& room) {
  CasePatch patch = bodies_of(spec, placement);
  patch.grid = grid;
  InfluenceCache own;
  gap_and_influence(spec, placement, options, spec.bem.bodies, options.cache ? *options.cache : own, patch);
  keep_to_room(grid, room, patch.profile.gap);
  set_problem(spec, placement, target, patch);
  return patch;
}

void place_cells(const CasePatch& patch, const RigidContact& contact, ContactField& field) {
  const PatchGrid& g = patch.grid;
  field.resize(g.ny, g.nx);
  for (std::size_t k = 0; k < g.size(); ++k) {
    const Vec2 point = point_of(patch, contact, k);
    field.x[k] = g.x_of(k);
    field.y[k] = point.y;
    field.z[k] = point.z;
    field.area[k] = g.cell_area();
  }
}

bool reaches_edge(const PatchGrid& grid, const Plane& pressure) {
  const Touches edge = touches(grid, pressure);
  return edge.x || edge.y;
}

bool holds(const PatchGrid& grid, const PatchRoom& room) {
  return grid.y(0) <= room.held_low && grid.y(grid.ny - 1) >= room.held_high;
}

bool suits(const BemStart& start, const PatchGrid& wanted) {
  const PatchGrid& grid = start.grid;
  if (grid.line != wanted.line || grid.dx != wanted.dx || grid.dy != wanted.dy) return false;
  int along = 0, across = 0;  // from the middle to the farthest cell with pressure
  for (std::size_t k = 0; k < grid.size(); ++k) {
    if (!(start.solution.normal.pressure[k] > 0)) continue;
    along = std::max(along, std::abs(static_cast<int>(k) / grid.ny - grid.nx / 2));
    across = std::max(across, std::abs(static_cast<int>(k) % grid.ny - grid.ny / 2));
  }
  const auto near = [](int have, int want, int reach) {
    return have >= want - 4 && have <= std::max(2 * want + 8, 4 * reach);
  };
  return near(grid.nx, wanted.nx, along) && near(grid.ny, wanted.ny, across);
}

}  // namespace railstrata
