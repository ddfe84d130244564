#include "bem/solve_bem.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <utility>

#include "bem/one_patch.hpp"
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
  place_cells(patch, contact, field);
  field.slip_is_distance = patch.contact.kind == RollingKind::shift;
  const double over_time = field.slip_is_distance ? 1.0 : speed;
  field.bound = s.tangential.bound;
  for (std::size_t k = 0; k < patch.grid.size(); ++k) {
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

/// Whether the drive has forces, which count over the load.
bool forces_wanted(const CaseSpec& spec) {
  return spec.drive.friction_coefficient > 0 &&
         (spec.drive.traction().value_or(0) != 0 || spec.drive.lateral_traction_coefficient.value_or(0) != 0);
}

constexpr double kWedged = 0.02;  // of the slope without friction
constexpr int kMostIterations = 20;

struct LoadedPatch : PatchOnWheel {
  int load_iterations = 1;
  double power = kPowerOfHertz;  ///< of the descent in the vertical force
  bool wedged = false;           ///< the solution is that of the last normal load tried
};

/// Solves under a normal load or approach from the solution before, else from a neighbour, else on a new grid; and on a
/// new one where the patch reaches the edge of the other.
void solve_under(const NormalTarget& target, double weight, const OnePatch& one, const BemOptions& options,
                 LoadedPatch& out) {
  const auto solve = [&](const RollingSolution* start) {
    one.drive(weight, out.patch.contact);
    out.patch.contact.target = target;
    out.solution = solve_rolling(*out.patch.influence, out.patch.grid, out.patch.contact, options.rolling, start);
  };
  const bool laid = out.patch.influence && out.solution.normal.pressure.empty();
  if (!out.solution.normal.pressure.empty()) {
    solve(&out.solution);
    if (!out.solution.normal.touches_edge) return;
  } else if (!laid && one.starts_from_neighbour(options)) {
    out.patch = one.lay_on(options.neighbour->alone()->grid, target, options);
    solve(&options.neighbour->alone()->solution);
    if (!reaches_edge(out.patch.grid, out.solution.normal.pressure)) return;
  }
  if (!laid) out.patch = one.lay(target, options);
  solve(nullptr);
}

/// The patch on its grid in the plane as it stands now, with what was noted when the grid was laid.
CasePatch laid_again(const OnePatch& one, const NormalTarget& target, const BemOptions& options,
                     const CasePatch& before) {
  CasePatch out = one.lay_on(before.grid, target, options);
  out.notes = before.notes;
  return out;
}

/// The normal force to begin with [N]: with the lateral friction of a neighbour where that is the start.
double first_normal_load(const OnePatch& one, const CasePatch& laid, const BemOptions& options, double weight) {
  const bool near = !laid.influence && one.starts_from_neighbour(options);
  return normal_load(weight, near ? options.neighbour->alone()->solution.tangential.force_y : 0.0, one.plane());
}

/// Finds the normal force N with N cos(delta) - T_y(N) sin(delta) = G by secants (case_patch.hpp), in a plane that
/// stays: lateral friction T_y carries a share of the weight that grows with the contact angle, and itself depends on
/// N. Where that share grows as fast as N does, the slope of the left side is zero and no N is large enough: the wheel
/// is wedged. Where it carries so much that a secant would take away half of N or more, the next N is on the chord from
/// N = 0, which keeps it positive.
LoadedPatch balance_in_plane(const OnePatch& one, CasePatch laid, const BemOptions& options, double weight) {
  const double cosine = std::cos(one.plane().angle), sine = std::sin(one.plane().angle);
  double normal = first_normal_load(one, laid, options, weight), slope = cosine, previous_normal = 0,
         previous_excess = 0;
  LoadedPatch out;
  out.contact = one.plane();
  out.patch = std::move(laid);
  for (;; ++out.load_iterations) {
    solve_under({.load = normal}, weight, one, options, out);
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

double vertical_force(const LoadedPatch& p) {
  return p.solution.normal.load * std::cos(p.contact.angle) - p.solution.tangential.force_y * std::sin(p.contact.angle);
}

/// The same where the plane turns with the descent d of the wheel: by secants of V(d) = N cos(delta) - T_y sin(delta),
/// the plane and the approach those of d. It begins under the normal force that a plane nearby asks for, with Hertz's
/// slope, 1.5 V/d. Several contacts in one plane, which turns much with d, begin at a neighbour's descent with its
/// slope, but for forces of the drive, which may be more than friction bears at another d.
LoadedPatch balance_by_descent(OnePatch& one, CasePatch laid, const BemOptions& options, double weight, bool driven) {
  constexpr double kShareOfBalance = 0.1, kFinest = 1e-11;  // rad, of a plane that is kept
  const bool near = one.place().contacts.size() > 1 && !driven && !laid.influence && one.starts_from_neighbour(options);
  const double normal = first_normal_load(one, laid, options, weight);
  LoadedPatch out;
  out.patch = std::move(laid);
  out.contact = one.plane();
  if (near) out.power = options.neighbour->power;
  solve_under(near ? NormalTarget{{}, one.own_approach()} : NormalTarget{.load = normal}, weight, one, options, out);
  double excess = vertical_force(out) - weight,
         descent = near ? one.descent() : one.descent_at(out.solution.normal.approach),
         slope = out.power * (near ? weight + excess : weight) / descent;
  const double settled = std::max(kShareOfBalance * options.balance, kFinest);
  if (std::abs(excess) <= options.balance * weight) {
    one.lower(descent);
    if (std::abs(one.plane().angle - out.contact.angle) <= settled) return out;
  }
  for (;;) {
    const double previous_descent = descent, previous_excess = excess;
    descent -= std::clamp(excess / slope, -descent, 0.5 * descent);
    one.lower(descent);
    out.patch = laid_again(one, {{}, one.own_approach()}, options, out.patch);
    out.contact = one.plane();
    solve_under({{}, one.own_approach()}, weight, one, options, out);
    excess = vertical_force(out) - weight;
    if (++out.load_iterations > 2) slope = (excess - previous_excess) / (descent - previous_descent);
    if (std::abs(excess) <= options.balance * weight) {
      out.power = std::clamp(slope * descent / weight, 1.0, 3.0);
      return out;
    }
    const double usual = kPowerOfHertz * out.solution.normal.load * std::cos(out.contact.angle) / descent;
    out.wedged = !(slope > kWedged * usual) || out.load_iterations == kMostIterations;
    if (out.wedged) return out;
  }
}

SharedLoad bear_weight(const CaseSpec& spec, const Placement& placement, const BemOptions& options) {
  constexpr int kMostRounds = 5;
  const double load = spec.vehicle.load();
  check_friction(spec, load, normal_load(load, 0, placement.contact));
  std::optional<FirstPatch> first;
  if (!options.neighbour || options.neighbour->empty()) first.emplace(press_first(spec, placement, options));
  double descent = first ? first->one.descent_at(first->laid.frictionless.approach) : options.neighbour->descent;
  for (int round = 1;; ++round) {
    SharedLoad shared = share_load(spec, placement, descent, options);
    if (!shared.patches.empty()) return shared;
    const bool as_laid = first && first->one.place().same_as(shared.alone);
    OnePatch one = as_laid ? first->one : OnePatch(spec, placement, shared.alone);
    if (!as_laid) one.lower(descent);
    CasePatch laid = as_laid ? std::move(first->laid) : CasePatch{};
    LoadedPatch alone = one.level() ? balance_in_plane(one, std::move(laid), options, load)
                                    : balance_by_descent(one, std::move(laid), options, load, forces_wanted(spec));
    if (alone.wedged) refuse_wedged("weight", alone.contact);
    first.reset();
    descent = one.level() ? one.descent_at(alone.solution.normal.approach) : one.descent();
    if (round < kMostRounds && places_of(spec, placement, descent).size() != shared.places) continue;
    shared.load_iterations = alone.load_iterations;
    shared.descent = descent;
    shared.power = alone.power;
    alone.contacts = std::move(shared.alone.contacts);
    alone.stretch = shared.alone.stretch;
    shared.patches.push_back(std::move(alone));
    return shared;
  }
}

/// Under a given approach the vertical force F_z is a result. Forces of the drive count over it: F_z and they are found
/// in turn, from the frictionless contact on.
SharedLoad press_to_approach(const CaseSpec& spec, const Placement& placement, const BemOptions& options) {
  constexpr int kMostRounds = 40;
  const double descent = options.descent > 0 ? options.descent : descent_of(placement, *spec.vehicle.approach);
  SharedLoad out;
  if (!forces_wanted(spec)) {
    out = share_load(spec, placement, descent, options);
    if (!out.patches.empty()) return out;
  } else {
    require_one_plane(
        placement, *spec.vehicle.approach, "vehicle.approach",
        "give creepages instead of forces, or a load instead of vehicle.approach: the contacts share the force");
    out.alone = first_place(spec, placement, descent);
  }
  OnePatch one(spec, placement, out.alone);
  one.lower(descent);
  out.descent = descent;
  out.load_iterations = 1;
  out.patches.push_back({one.plane(), {}, {}, std::move(out.alone.contacts), out.alone.stretch});
  const NormalTarget target{{}, one.approach()};
  CasePatch& patch = out.patches.front().patch;
  RollingSolution& solution = out.patches.front().solution;
  if (!forces_wanted(spec) && one.starts_from_neighbour(options)) {
    patch = one.lay_on(options.neighbour->alone()->grid, target, options);
    one.drive(0, patch.contact);
    solution = solve_rolling(*patch.influence, patch.grid, patch.contact, options.rolling,
                             &options.neighbour->alone()->solution);
    if (!reaches_edge(patch.grid, solution.normal.pressure)) return out;
  }
  patch = one.lay(target, options);
  const double cosine = std::cos(one.plane().angle), sine = std::sin(one.plane().angle);
  double vertical = cosine * patch.frictionless.load;
  for (;; ++out.load_iterations) {
    one.drive(vertical, patch.contact);
    solution = solve_rolling(*patch.influence, patch.grid, patch.contact, options.rolling,
                             out.load_iterations > 1 ? &solution : nullptr);
    const double before = vertical;
    vertical = cosine * solution.normal.load - sine * solution.tangential.force_y;
    const bool driven = patch.contact.x.force.value_or(0) != 0 || patch.contact.y.force.value_or(0) != 0;
    if (!driven || std::abs(vertical - before) <= options.balance * std::abs(vertical)) return out;
    if (out.load_iterations == kMostRounds)
      throw CaseError("the ratio of forces to the resulting load does not converge with a given approach",
                      "lower the traction coefficients, or give a load instead of vehicle.approach",
                      "vehicle.approach");
  }
}

/// The parts of a patch, each at its place.
std::vector<BemPatch> parts_of(const CaseSpec& spec, const Placement& placement, const PatchOnWheel& p, double descent,
                               bool apart) {
  if (!apart || p.contacts.size() < 2) return {patch_result(spec, placement, p, p.contact)};
  const std::vector<PatchPiece> pieces = pieces_of(p, placement, descent);
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
                    double descent, bool apart) {
  BemResult r;
  r.wheel = patches.front().patch.wheel;
  r.rail = patches.front().patch.rail;
  r.effort.outer_iterations = 0;
  for (const PatchOnWheel& p : patches) {
    std::vector<BemPatch> parts = parts_of(spec, placement, p, descent, apart);
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
  return result_of(spec, placement, {patch}, 0, true);
}

BemResult solve_bem(const CaseSpec& spec, const Placement& placement, const BemOptions& options) {
  const auto begin = std::chrono::steady_clock::now();
  require_support(spec.run.rolling ? uses::kSteadyRolling : uses::kHalfSpaces, spec);
  SharedLoad shared =
      spec.vehicle.approach ? press_to_approach(spec, placement, options) : bear_weight(spec, placement, options);
  if (shared.patches.size() > 1 && !spec.irregularities.empty())
    throw CaseError("irregularity: a wheel that touches at several places needs a rail and a wheel without heights",
                    "take it out, or move the wheel (geometry.lateral_shift) until it touches at one place",
                    "irregularity");
  BemResult r = result_of(spec, placement, shared.patches, shared.descent, options.apart);
  if (options.neighbour) {
    *options.neighbour = {{}, shared.descent, shared.power, shared.along, shared.across, std::move(shared.smooth)};
    for (PatchOnWheel& p : shared.patches)
      options.neighbour->patches.push_back({p.patch.grid, std::move(p.solution), p.contact.rail_s});
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
