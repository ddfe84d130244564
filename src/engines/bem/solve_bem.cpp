#include "bem/solve_bem.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <utility>

#include "bem/interface_slip.hpp"
#include "bem/loaded_wheel.hpp"
#include "bem/section_below.hpp"
#include "core/faults.hpp"
#include "rules/support.hpp"

namespace railstrata {

namespace {

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

/// Its field, and the sums over it.
BemPatch patch_totals(const CaseSpec& spec, const PatchOnWheel& p) {
  BemPatch r;
  r.contact = p.contact;
  r.grid = p.patch.grid;
  fill_field(p.patch, p.solution, r.contact, spec.drive.speed, r.field);
  if (r.grid.line) spread_over_line(r.grid.dy, r.field);
  fill_totals(p.solution, spec.drive.speed, r);
  if (const double bent = p.patch.influence->stretch_by_load(); bent != 0) r.bending_stretch = -r.force.z * bent;
  return r;
}

BemPatch patch_result(const CaseSpec& spec, const Placement& placement, const PatchOnWheel& p,
                      const RigidContact& place) {
  BemPatch r = patch_totals(spec, p);
  r.place = place;
  r.rigid_slip.spin = p.patch.contact.spin;
  if (p.patch.contact.kind == RollingKind::steady) r.motion_power = motion_power(p, spec.drive.speed);
  const bool beside = place.rail_s != p.contact.rail_s;
  const double from = beside ? along_plane(p.contact, place.point) : 0.0;
  if (beside) move_to_place(p, from, r);
  Placement own = placement;
  own.contact = place;
  r.surroundings = patch_surroundings(spec, own, solved_patch(r.grid, p.solution.normal, from));
  r.surroundings.cut_off = cut_off(spec, p, r.surroundings);
  if (r.grid.line) r.surroundings.edges = {};  // its theory knows none
  own.contact = p.contact;
  if (p.patch.sections)
    r.sections = std::make_shared<const SectionsBelowPatch>(SectionsBelowPatch{p.patch.sections, spec, std::move(own)});
  return r;
}

/// The parts of a patch, each at its place.
std::vector<BemPatch> parts_of(const CaseSpec& spec, const Placement& placement, const PatchOnWheel& p, double descent,
                               bool apart) {
  if (!apart || p.contacts.size() < 2) return {patch_result(spec, placement, p, p.contact)};
  const std::vector<PatchPiece> pieces = pieces_of(p, placement, descent);
  std::vector<BemPatch> out;
  std::shared_ptr<const ContactField> together;
  if (pieces.size() > 1) together = std::make_shared<ContactField>(patch_totals(spec, p).field);
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

/// Of several solutions that with the largest share, and the others beside it.
BemResult mean_result(const CaseSpec& spec, const Placement& placement, const std::vector<SharedLoad>& solved,
                      bool apart) {
  const auto most = std::max_element(solved.begin(), solved.end(),
                                     [](const SharedLoad& a, const SharedLoad& b) { return a.share < b.share; });
  BemResult out = result_of(spec, placement, most->patches, most->descent, apart);
  out.effort.load_iterations = most->load_iterations;
  for (const SharedLoad& one : solved) {
    if (&one == &*most || one.share == 0) continue;
    BemResult other = result_of(spec, placement, one.patches, one.descent, apart);
    out.effort.outer_iterations = std::max(out.effort.outer_iterations, other.effort.outer_iterations);
    out.effort.iterations += other.effort.iterations;
    BemShare& beside = out.others.emplace_back(BemShare{one.share, {}});
    std::vector<BemPatch> further = std::move(other.further);
    beside.patches.push_back(std::move(other));
    std::move(further.begin(), further.end(), std::back_inserter(beside.patches));
  }
  if (out.others.empty()) return out;
  out.share = most->share;
  out.notes.push_back(
      fmt::format("two places are on the way into one plane: forces are means of the solution with "
                  "these patches, by {:.0f} %, and of that with the others",
                  100 * out.share));
  return out;
}

Subsurface interior(BodyId id, const LayeredHalfSpace& body, const BemPatch& patch) {
  const double sign = id == BodyId::rail ? 1 : -1;  // of the friction over that on the rail
  const ContactField& f = patch.together ? *patch.together : patch.field;
  Plane q_x = of_cells(patch, f.q_x), q_y = of_cells(patch, f.q_y);
  for (Plane* q : {&q_x, &q_y}) scale_by(*q, sign);
  PlaneLoads loads{of_cells(patch, f.p), std::move(q_x), std::move(q_y)};
  Subsurface out(body, patch.grid, loads.p, loads.q_x, loads.q_y);
  if (!patch.sections) return out;
  const auto& [store, spec, placement] = *patch.sections;
  const auto section = std::make_shared<const LoadedSection>(
      LoadedSection{store->below(spec, placement, id, body, patch.grid), section_plane(spec, placement, id), patch.grid,
                    std::move(loads)});
  out.stand_on(std::make_unique<const SectionBelow>(section, patch.grid));
  return out;
}

}  // namespace

BemResult alone(const BemResult& result, const BemPatch& patch) {
  BemResult out;
  static_cast<BemPatch&>(out) = patch;
  out.wheel = result.wheel;
  out.rail = result.rail;
  return out;
}

std::vector<const BemPatch*> patches_of(const BemResult& r) {
  std::vector<const BemPatch*> out{&r};
  for (const BemPatch& p : r.further) out.push_back(&p);
  return out;
}

Vec3 force_on_rail(const BemResult& result) {
  return mean_of_solutions(result, [](const std::vector<const BemPatch*>& patches) {
    Vec3 sum;
    for (const BemPatch* p : patches) sum = sum + Vec3{p->force.x, p->force.y, p->force.z};
    return sum;
  });
}

double dissipation(const BemResult& result) {
  return mean_of_solutions(result, [](const std::vector<const BemPatch*>& patches) {
    double sum = 0;
    for (const BemPatch* p : patches) sum += p->dissipation;
    return sum;
  });
}

namespace {

/// Above interfaces that do not slide.
BemResult solve_elastic(const CaseSpec& spec, const Placement& placement, const BemOptions& options) {
  std::vector<SharedLoad> solved = loaded_wheel(spec, placement, options);
  for (const SharedLoad& one : solved) {
    if (one.patches.size() > 1 && spec.bem.normals == ContactNormals::local)
      throw CaseError("bem.normals: the wheel touches at several places, which rows of one plane each do not join",
                      "move the wheel (geometry.lateral_shift), or give bem.normals = \"plane\"", "bem.normals");
    if (one.patches.size() > 1 && !spec.irregularities.empty())
      throw CaseError("irregularity: a wheel that touches at several places needs a rail and a wheel without heights",
                      "take it out, or move the wheel (geometry.lateral_shift) until it touches at one place",
                      "irregularity");
  }
  BemResult r = mean_result(spec, placement, solved, options.apart);
  if (options.neighbour) *options.neighbour = neighbour_of(std::move(solved));
  return r;
}

}  // namespace

BemResult bem_result(const CaseSpec& spec, const Placement& placement, const PatchOnWheel& patch) {
  return result_of(spec, placement, {patch}, 0, true);
}

BemResult solve_bem(const CaseSpec& spec, const Placement& placement, const BemOptions& options) {
  const auto begin = std::chrono::steady_clock::now();
  require_support(spec.run.rolling ? uses::kSteadyRolling : uses::kHalfSpaces, spec);
  InfluenceCache own;
  BemOptions kept = options;
  if (!kept.cache) kept.cache = &own;
  const auto elastic = [&](const BemOptions& how) { return solve_elastic(spec, placement, how); };
  const std::optional<SlidingInterface> sliding = sliding_interface(spec);
  BemResult r;
  if (sliding) {
    ContactOverInterface over = solve_over_interface(*sliding, kept, elastic);
    r = std::move(over.contact);
    r.interface_slip = std::make_shared<const InterfaceSlip>(std::move(over.slip));
  } else {
    r = elastic(kept);
  }
  r.effort.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return r;
}

Subsurface rail_interior(const LayeredHalfSpace& rail, const BemPatch& patch) {
  return interior(BodyId::rail, rail, patch);
}
Subsurface wheel_interior(const LayeredHalfSpace& wheel, const BemPatch& patch) {
  return interior(BodyId::wheel, wheel, patch);
}
Subsurface rail_interior(const BemResult& r) { return rail_interior(r.rail, r); }
Subsurface wheel_interior(const BemResult& r) { return wheel_interior(r.wheel, r); }

}  // namespace railstrata
