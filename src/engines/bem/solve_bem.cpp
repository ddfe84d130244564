#include "bem/solve_bem.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "bem/several_patches.hpp"
#include "core/faults.hpp"
#include "model/drive_at_contact.hpp"
#include "rules/support.hpp"

namespace railstrata {

namespace {

void check_friction(const CaseSpec& spec, double load, double normal) {
  const double along = spec.drive.traction().value_or(0), across = spec.drive.lateral_traction_coefficient.value_or(0),
               wanted = std::hypot(along, across / lateral_friction_share(spec)) * load,
               available = spec.drive.friction_coefficient * normal;
  if (wanted == 0 || wanted < available) return;
  const std::string sideways = across == 0 ? "" : fmt::format(" along and {:g} across the rail", across);
  throw CaseError(fmt::format("a traction coefficient of {:g}{} needs {:.0f} N of friction; a friction coefficient of "
                              "{:g} provides at most {:.0f} N",
                              along, sideways, wanted, spec.drive.friction_coefficient, available),
                  "lower drive.traction_coefficient or raise drive.friction_coefficient",
                  across == 0 ? "drive.traction_coefficient" : "drive.lateral_traction_coefficient");
}

void fill_field(const CasePatch& patch, const RollingSolution& s, const RigidContact& contact, double speed,
                ContactField& field) {
  const PatchGrid& g = patch.grid;
  field.resize(g.ny, g.nx);
  field.slip_is_distance = patch.contact.kind == RollingKind::shift;
  const double over_time = field.slip_is_distance ? 1.0 : speed;
  field.bound = s.tangential.bound;
  const Vec2 tangent{std::cos(contact.angle), std::sin(contact.angle)}, normal{-tangent.z, tangent.y};
  for (std::size_t k = 0; k < g.size(); ++k) {
    const Vec2 point = contact.point + g.y_of(k) * tangent + patch.profile.rail_height[k] * normal;
    field.x[k] = g.x_of(k);
    field.y[k] = point.y;
    field.z[k] = point.z;
    field.area[k] = g.cell_area();
    field.p[k] = s.normal.pressure[k];
    field.q_x[k] = s.tangential.q_x[k];
    field.q_y[k] = s.tangential.q_y[k];
    field.slip_x[k] = over_time * s.tangential.cell_slip.x[k];
    field.slip_y[k] = over_time * s.tangential.cell_slip.y[k];
    field.state[k] = s.tangential.state[k];
  }
}

/// The one column of a line contact as three, each in the middle of a third of the line.
void spread_over_line(double length, ContactField& f) {
  constexpr int kColumns = 3;
  const auto thrice = [](auto& values) {
    auto all = values;
    all.clear();
    for (const auto& v : values) all.insert(all.end(), kColumns, v);
    values = std::move(all);
  };
  for (auto* values : {&f.x, &f.y, &f.z, &f.area, &f.p, &f.q_x, &f.q_y, &f.slip_x, &f.slip_y, &f.bound})
    thrice(*values);
  thrice(f.state);
  f.columns = kColumns;
  f.line_length = length;
  for (std::size_t k = 0; k < f.y.size(); ++k) {
    const int column = static_cast<int>(k) % kColumns;
    f.y[k] += length * (column - 1) / kColumns;
    f.area[k] /= kColumns;
  }
}

/// One value per cell, from the values of its points.
Plane of_cells(const BemPatch& r, const Plane& of_points) {
  if (r.field.line_length == 0) return of_points;
  Plane out;
  for (std::size_t k = 0; k < of_points.size(); k += static_cast<std::size_t>(r.field.columns))
    out.push_back(of_points[k]);
  return out;
}

void fill_totals(const RollingSolution& s, double speed, BemPatch& r) {
  const TangentialSolution& t = s.tangential;
  const double c = std::cos(r.contact.angle), sn = std::sin(r.contact.angle);
  const double normal = s.normal.load;
  r.force = {t.force_x, normal * sn + t.force_y * c, -normal * c + t.force_y * sn, normal, t.force_y, t.moment};
  r.approach = r.grid.line ? std::numeric_limits<double>::quiet_NaN() : s.normal.approach;
  r.rigid_slip.x = t.creepage_x;
  r.rigid_slip.y = t.creepage_y;
  r.dissipation = t.dissipation * (r.field.slip_is_distance ? 1.0 : speed);
  r.patch.slip_area = t.slip_area;
  for (std::size_t k = 0; k < r.field.p.size(); ++k) {
    r.patch.largest_pressure = std::max(r.patch.largest_pressure, r.field.p[k]);
    r.patch.largest_traction = std::max(r.patch.largest_traction, std::hypot(r.field.q_x[k], r.field.q_y[k]));
    if (r.field.p[k] > 0) {
      r.patch.area += r.field.area[k];
      if (r.field.state[k] == ContactState::separated)
        r.field.state[k] = ContactState::slip;  // contact without friction
    }
  }
}

double motion_power(const PatchOnWheel& p, double speed) {
  const PatchGrid& g = p.patch.grid;
  const RollingContact& c = p.patch.contact;
  const TangentialSolution& t = p.solution.tangential;
  const auto further = [](const Plane& plane, std::size_t k) { return plane.empty() ? 0.0 : plane[k]; };
  double sum = 0;
  for (std::size_t k = 0; k < g.size(); ++k) {
    const double spin = c.spin + further(c.local_spin, k % static_cast<std::size_t>(g.ny));
    const double x = t.creepage_x - c.spin * g.y_of(k) + further(c.extra_slip.x, k),
                 y = t.creepage_y + spin * g.x_of(k) + further(c.extra_slip.y, k);
    sum += t.q_x[k] * x + t.q_y[k] * y;
  }
  return sum * g.cell_area() * speed;
}

/// from: of the place in the plane, m.
SolvedPatch solved_patch(const PatchGrid& grid, const NormalSolution& s, double from) {
  PatchGrid g = grid;
  g.y0 -= from;
  SolvedPatch out{g.y(g.ny - 1), g.y(0), g.y(0) - 0.5 * g.dy, g.y(g.ny - 1) + 0.5 * g.dy, s.load, s.approach};
  for (std::size_t k = 0; k < s.pressure.size(); ++k) {
    if (!(s.pressure[k] > 0)) continue;
    const double y = g.y_of(k);
    out.low = std::min(out.low, y - 0.5 * g.dy);
    out.high = std::max(out.high, y + 0.5 * g.dy);
  }
  return out;
}

/// Pressure beside a cell where a profile has ended or turned away, or beyond the block.
bool cut_off(const CaseSpec& spec, const PatchOnWheel& p, const PatchSurroundings& around) {
  if (spec.geometry.rail_shape == RailShape::block && around.rail_reach > 0.5 * spec.geometry.block_width) return true;
  const PatchGrid& g = p.patch.grid;
  for (int i = 0; i < g.nx; ++i)
    for (int j = 1; j < g.ny; ++j) {
      const std::size_t one = g.index(i, j - 1), other = g.index(i, j);
      const auto ends = [&](std::size_t at, std::size_t beside) {
        return p.solution.normal.pressure[at] > 0 && p.patch.profile.gap[beside] == ProfileGap::kNoSurface;
      };
      if (ends(one, other) || ends(other, one)) return true;
    }
  return false;
}

/// Turns moment, creepages, spin and approach of the plane into those of a place `from` [m] beside its own.
void move_to_place(const PatchOnWheel& p, double from, BemPatch& r) {
  r.force.moment -= (r.place.x - r.contact.x) * r.force.tangential - from * r.force.x;
  RollingContact there;
  there.x.creepage = r.rigid_slip.x;
  there.y.creepage = r.rigid_slip.y;
  const double turn = (r.rigid_slip.spin - wheel_spin(r.contact)) / std::cos(r.contact.angle);
  carry_creepages(turn, r.contact, r.place, there);
  r.rigid_slip = {there.x.creepage, there.y.creepage, there.spin};
  double least = ProfileGap::kNoSurface;
  for (std::size_t k = 0; k < r.field.p.size(); ++k)
    if (r.field.p[k] > 0) least = std::min(least, p.patch.profile.gap[k]);
  r.approach -= least;
}

BemPatch patch_result(const CaseSpec& spec, const Placement& placement, const PatchOnWheel& p,
                      const RigidContact& place) {
  BemPatch r;
  r.contact = p.contact;
  r.place = place;
  r.grid = p.patch.grid;
  r.rigid_slip.spin = p.patch.contact.spin;
  fill_field(p.patch, p.solution, r.contact, spec.drive.speed, r.field);
  if (r.grid.line) spread_over_line(r.grid.dy, r.field);
  fill_totals(p.solution, spec.drive.speed, r);
  if (p.patch.contact.kind == RollingKind::steady) r.motion_power = motion_power(p, spec.drive.speed);
  const bool beside = place.rail_s != p.contact.rail_s;
  const double from = beside ? along_plane(p.contact, place.point) : 0.0;
  if (beside) move_to_place(p, from, r);
  Placement own = placement;
  own.contact = place;
  r.surroundings = patch_surroundings(spec, own, solved_patch(r.grid, p.solution.normal, from));
  r.surroundings.cut_off = cut_off(spec, p, r.surroundings);
  if (r.grid.line) r.surroundings.edges = {};  // its theory knows none
  return r;
}

/// One contact under the whole load.
struct OnePatch {
  Placement placement;  ///< its contact is the plane
  PatchRoom room;
  const RigidContact& first;  ///< that the creepages are of
  bool common() const { return placement.contact.rail_s != first.rail_s; }
  /// Of the plane, where that of `first` is given [m].
  double approach(double of_first) const {
    const RigidContact& plane = placement.contact;
    if (!common()) return of_first;
    return (of_first / std::cos(first.angle) + plane.wheel_offset_z - first.wheel_offset_z) * std::cos(plane.angle);
  }
};

/// Creepages or forces of the case, of the contact that touches first, in the patch's plane.
void drive_patch(const CaseSpec& spec, const OnePatch& one, double weight, RollingContact& problem) {
  drive_contact(spec, one.first, weight, problem);
  if (one.common()) carry_creepages(turn_about_vertical(spec, one.first), one.first, one.placement.contact, problem);
}

struct LoadedPatch : PatchOnWheel {
  int load_iterations = 1;
  bool wedged = false;  ///< the solution is that of the last normal load tried
};

bool holds(const PatchGrid& g, const PatchRoom& room) {
  return g.y(0) <= room.held_low && g.y(g.ny - 1) >= room.held_high;
}

bool starts_from_neighbour(const CaseSpec& spec, const OnePatch& one, const BemOptions& options) {
  const PatchRoom whole;
  return options.neighbour && !options.neighbour->empty() && options.neighbour->common == one.common() &&
         one.room.low == whole.low && one.room.high == whole.high && holds(options.neighbour->grid, one.room) &&
         suits(options.neighbour->grid, spec, one.placement, options);
}

/// Solves under a normal load [N]: from a neighbour, on the grid of the load before, on a new one if there is none or
/// the patch reached its edge.
void solve_under(double normal, double weight, const CaseSpec& spec, const OnePatch& one, const BemOptions& options,
                 LoadedPatch& out) {
  const auto solve = [&](const RollingSolution* start) {
    out.patch.contact.target.load = normal;
    out.solution = solve_rolling(*out.patch.influence, out.patch.grid, out.patch.contact, options.rolling, start);
  };
  if (out.patch.influence) {
    solve(&out.solution);
    if (!out.solution.normal.touches_edge) return;
  } else if (starts_from_neighbour(spec, one, options)) {
    out.patch = case_patch_on(options.neighbour->grid, spec, one.placement, options, {.load = normal});
    drive_patch(spec, one, weight, out.patch.contact);
    solve(&options.neighbour->solution);
    if (!reaches_edge(out.patch.grid, out.solution.normal.pressure)) return;
  }
  out.patch = make_case_patch(spec, one.placement, options, {.load = normal}, one.room);
  drive_patch(spec, one, weight, out.patch.contact);
  solve(nullptr);
}

/// Finds the normal force N with N cos(delta) - T_y(N) sin(delta) = G by secants (case_patch.hpp): lateral friction T_y
/// carries a share of the weight that grows with the contact angle, and itself depends on N. Where that share grows as
/// fast as N does, the slope of the left side is zero and no N is large enough: the wheel is wedged. Where it carries
/// so much that a secant would take away half of N or more, the next N is on the chord from N = 0, which keeps it
/// positive.
LoadedPatch balance_vertical_load(const CaseSpec& spec, const OnePatch& one, const BemOptions& options, double weight) {
  constexpr double kWedged = 0.02;
  constexpr int kMostIterations = 20;
  const RigidContact& contact = one.placement.contact;
  const double cosine = std::cos(contact.angle), sine = std::sin(contact.angle);
  const bool near = starts_from_neighbour(spec, one, options);
  const double lateral = near ? options.neighbour->solution.tangential.force_y : 0.0;
  double normal = normal_load(weight, lateral, contact), slope = cosine, previous_normal = 0, previous_excess = 0;
  LoadedPatch out;
  out.contact = contact;
  for (;; ++out.load_iterations) {
    solve_under(normal, weight, spec, one, options, out);
    const double excess = normal * cosine - out.solution.tangential.force_y * sine - weight;
    if (std::abs(excess) <= options.balance * weight) return out;
    if (out.load_iterations > 1) slope = (excess - previous_excess) / (normal - previous_normal);
    out.wedged = !(slope > kWedged * cosine) || out.load_iterations == kMostIterations;
    if (out.wedged) return out;
    previous_normal = normal;
    previous_excess = excess;
    normal = excess > 0.5 * slope * normal ? normal * weight / (weight + excess) : normal - excess / slope;
  }
}

SharedLoad bear_weight(const CaseSpec& spec, const Placement& placement, const BemOptions& options) {
  const double load = spec.vehicle.load();
  check_friction(spec, load, normal_load(load, 0, placement.contact));
  LoadedPatch alone = balance_vertical_load(spec, {placement, {}, placement.contact}, options, load);
  SharedLoad shared;
  if (!alone.patch.grid.line) shared = share_load(spec, placement, alone.solution.normal.approach, options);
  if (!shared.patches.empty()) return shared;
  if (shared.contacts.size() > 1) {
    OnePatch one{placement, shared.room, placement.contact};
    one.placement.contact = shared.plane;
    alone = balance_vertical_load(spec, one, options, load);
    alone.contacts = std::move(shared.contacts);
  }
  if (alone.wedged) refuse_wedged("weight", alone.contact);
  shared.load_iterations = alone.load_iterations;
  shared.patches.push_back(std::move(alone));
  return shared;
}

/// Whether the drive has forces, which count over the load.
bool forces_wanted(const CaseSpec& spec) {
  return spec.drive.friction_coefficient > 0 &&
         (spec.drive.traction().value_or(0) != 0 || spec.drive.lateral_traction_coefficient.value_or(0) != 0);
}

/// Under a given approach the vertical force F_z is a result. Forces of the drive count over it: F_z and they are found
/// in turn, from the frictionless contact on.
SharedLoad press_to_approach(const CaseSpec& spec, const Placement& placement, const BemOptions& options) {
  constexpr int kMostIterations = 40;
  OnePatch one{placement, {}, placement.contact};
  SharedLoad out{{PatchOnWheel{}}, {}, {}, {}, 1};
  if (!forces_wanted(spec)) {
    SharedLoad shared = share_load(spec, placement, *spec.vehicle.approach, options);
    if (!shared.patches.empty()) return shared;
    one.room = shared.room;
    one.placement.contact = shared.plane;
    if (one.common()) out.patches.front().contacts = std::move(shared.contacts);
  } else {
    require_one_plane(
        placement, *spec.vehicle.approach, "vehicle.approach",
        "give creepages instead of forces, or a load instead of vehicle.approach: the contacts share the force");
  }
  const RigidContact& contact = out.patches.front().contact = one.placement.contact;
  const NormalTarget target{{}, one.approach(*spec.vehicle.approach)};
  CasePatch& patch = out.patches.front().patch;
  RollingSolution& solution = out.patches.front().solution;
  if (!forces_wanted(spec) && starts_from_neighbour(spec, one, options)) {
    patch = case_patch_on(options.neighbour->grid, spec, one.placement, options, target);
    drive_patch(spec, one, 0, patch.contact);
    solution =
        solve_rolling(*patch.influence, patch.grid, patch.contact, options.rolling, &options.neighbour->solution);
    if (!reaches_edge(patch.grid, solution.normal.pressure)) return out;
  }
  patch = make_case_patch(spec, one.placement, options, target, one.room);
  double vertical = std::cos(contact.angle) * patch.frictionless.load;
  for (;; ++out.load_iterations) {
    drive_patch(spec, one, vertical, patch.contact);
    solution = solve_rolling(*patch.influence, patch.grid, patch.contact, options.rolling,
                             out.load_iterations > 1 ? &solution : nullptr);
    const double before = vertical;
    vertical = std::cos(contact.angle) * solution.normal.load - std::sin(contact.angle) * solution.tangential.force_y;
    const bool driven = patch.contact.x.force.value_or(0) != 0 || patch.contact.y.force.value_or(0) != 0;
    if (!driven || std::abs(vertical - before) <= options.balance * std::abs(vertical)) return out;
    if (out.load_iterations == kMostIterations)
      throw CaseError("the ratio of forces to the resulting load does not converge with a given approach",
                      "lower the traction coefficients, or give a load instead of vehicle.approach",
                      "vehicle.approach");
  }
}

/// The parts of a patch, each at its place.
std::vector<BemPatch> parts_of(const CaseSpec& spec, const Placement& placement, const PatchOnWheel& p, bool apart) {
  if (!apart || p.contacts.size() < 2) return {patch_result(spec, placement, p, p.contact)};
  const std::vector<PatchPiece> pieces = pieces_of(p);
  std::vector<BemPatch> out;
  std::shared_ptr<const ContactField> together;
  if (pieces.size() > 1) together = std::make_shared<ContactField>(patch_result(spec, placement, p, p.contact).field);
  for (const PatchPiece& piece : pieces) {
    out.push_back(patch_result(spec, placement, piece.patch, piece.place));
    out.back().together = together;
  }
  return out;
}

BemResult result_of(const CaseSpec& spec, const Placement& placement, const std::vector<PatchOnWheel>& patches,
                    bool apart) {
  BemResult r;
  r.wheel = patches.front().patch.wheel;
  r.rail = patches.front().patch.rail;
  r.effort.outer_iterations = 0;
  for (const PatchOnWheel& p : patches) {
    std::vector<BemPatch> parts = parts_of(spec, placement, p, apart);
    const double bent = bending_by_others(spec, patches, p), rail_y = parts.front().surroundings.rail_y;
    for (BemPatch& part : parts) {
      part.surroundings.bent_by_others = bent;
      r.further.push_back(std::move(part));
    }
    for (const std::string& note : p.patch.notes)
      r.notes.push_back(patches.size() < 2 ? note
                                           : fmt::format("patch at y = {:.1f} mm of the rail: {}", 1e3 * rail_y, note));
    r.effort.outer_iterations = std::max(r.effort.outer_iterations, p.solution.outer_iterations);
    r.effort.iterations += p.solution.normal.iterations + p.solution.tangential.iterations;
  }
  std::sort(r.further.begin(), r.further.end(),
            [](const BemPatch& a, const BemPatch& b) { return a.patch.largest_pressure > b.patch.largest_pressure; });
  static_cast<BemPatch&>(r) = std::move(r.further.front());
  r.further.erase(r.further.begin());
  return r;
}

/// sign: of the friction on this body, over that on the rail.
Subsurface interior(const LayeredHalfSpace& body, const BemPatch& patch, double sign) {
  const ContactField& f = patch.together ? *patch.together : patch.field;
  Plane q_x = of_cells(patch, f.q_x), q_y = of_cells(patch, f.q_y);
  for (Plane* q : {&q_x, &q_y}) scale_by(*q, sign);
  return {body, patch.grid, of_cells(patch, f.p), std::move(q_x), std::move(q_y)};
}

}  // namespace

std::vector<const BemPatch*> patches_of(const BemResult& r) {
  std::vector<const BemPatch*> out{&r};
  for (const BemPatch& p : r.further) out.push_back(&p);
  return out;
}

Vec3 force_on_rail(const BemResult& result) {
  Vec3 sum{result.force.x, result.force.y, result.force.z};
  for (const BemPatch& p : result.further) sum = sum + Vec3{p.force.x, p.force.y, p.force.z};
  return sum;
}

double dissipation(const BemResult& result) {
  double sum = result.dissipation;
  for (const BemPatch& p : result.further) sum += p.dissipation;
  return sum;
}

BemResult bem_result(const CaseSpec& spec, const Placement& placement, const PatchOnWheel& patch) {
  return result_of(spec, placement, {patch}, true);
}

BemResult solve_bem(const CaseSpec& spec, const Placement& placement, const BemOptions& options) {
  const auto begin = std::chrono::steady_clock::now();
  if (spec.drive.creepage_of == CreepageOf::wheel)
    return solve_bem(with_drive_at_contact(spec, placement.contact), placement, options);
  require_support(spec.run.rolling ? uses::kSteadyRolling : uses::kHalfSpaces, spec);
  SharedLoad shared =
      spec.vehicle.approach ? press_to_approach(spec, placement, options) : bear_weight(spec, placement, options);
  if (shared.patches.size() > 1 && !spec.irregularities.empty())
    throw CaseError("irregularity: a wheel that touches at several places needs a rail and a wheel without heights",
                    "take it out, or move the wheel (geometry.lateral_shift) until it touches at one place",
                    "irregularity");
  BemResult r = result_of(spec, placement, shared.patches, options.apart);
  if (options.neighbour) {
    *options.neighbour = {};
    if (shared.patches.size() == 1)
      *options.neighbour = {shared.patches.front().patch.grid, std::move(shared.patches.front().solution),
                            shared.patches.front().contacts.size() > 1};
  }
  r.effort.load_iterations = shared.load_iterations;
  r.effort.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return r;
}

Subsurface rail_interior(const LayeredHalfSpace& rail, const BemPatch& patch) { return interior(rail, patch, 1); }
Subsurface wheel_interior(const LayeredHalfSpace& wheel, const BemPatch& patch) { return interior(wheel, patch, -1); }
Subsurface rail_interior(const BemResult& r) { return rail_interior(r.rail, r); }
Subsurface wheel_interior(const BemResult& r) { return wheel_interior(r.wheel, r); }

}  // namespace railstrata
