#include "passes/rail_passes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/faults.hpp"
#include "fatigue/row_strength.hpp"
#include "fft/fft.hpp"
#include "material/elastic.hpp"
#include "material/material_path.hpp"
#include "material/strain_claim.hpp"
#include "model/material_strength.hpp"
#include "model/zone.hpp"
#include "passes/pass_plan.hpp"
#include "record/column.hpp"
#include "result/patch.hpp"
#include "result/stress_of_half_space.hpp"

namespace railstrata {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kNearYield = 0.8;  // of the yield strength: rows follow plastic flow as deep as the contact comes near
                                    // it, residual stress included
constexpr double kDeepest = 4;      // shorter half-axes
constexpr int kPathSteps = 4;       // of the law from station to station
constexpr double kFarthest = 12;    // half-axes across that wheels may wander: another place of the profile else

struct Extent {
  double first = kInfinite, last = -kInfinite;
  void add(double v, double half_cell) {
    first = std::min(first, v - half_cell);
    last = std::max(last, v + half_cell);
  }
  double middle() const { return 0.5 * (first + last); }
  double half() const { return 0.5 * (last - first); }
};

/// Where a patch carries pressure.
struct Footprint {
  Extent x, y;
  bool line = false;
  double shorter() const { return line ? x.half() : std::min(x.half(), y.half()); }
};

Footprint footprint_of(const BemPatch& patch) {
  Footprint f;
  f.line = patch.grid.line;
  const ContactField& field = patch.field;
  for (int i = 0; i < patch.grid.nx; ++i)
    for (int j = 0; j < patch.grid.ny; ++j) {
      if (!(field.p[static_cast<std::size_t>(i) * field.columns + j] > 0)) continue;
      f.x.add(patch.grid.x(i), 0.5 * patch.grid.dx);
      f.y.add(patch.grid.y(j), 0.5 * patch.grid.dy);
    }
  return f;
}

/// Rows from a depth on that grow by a quarter each from `first` at the surface to `apart`, and fill `thick`.
std::vector<double> growing_rows(double top, double thick, double first, double apart) {
  constexpr double kGrowth = 0.25;
  std::vector<double> out;
  double sum = 0;
  while (sum < thick * (1 - 1e-6)) {
    out.push_back(std::min(apart, first + kGrowth * (top + sum)));
    sum += out.back();
  }
  for (double& row : out) row *= thick / sum;
  return out;
}

/// Thicknesses of the rows: as deep as wanted, `apart` thick or a little less, borders at the interfaces.
std::vector<double> thicknesses(const LayeredHalfSpace& body, double deepest, double apart, double first) {
  std::vector<double> borders{0};
  for (const LayerExtent& layer : layer_extents(body))
    if (layer.bottom < deepest) borders.push_back(layer.bottom);
  borders.push_back(std::max(deepest, borders.back() + apart));
  std::vector<double> out;
  for (std::size_t n = 1; n < borders.size(); ++n) {
    const double thick = borders[n] - borders[n - 1];
    if (first > 0 && first < apart) {
      const std::vector<double> rows = growing_rows(borders[n - 1], thick, first, apart);
      out.insert(out.end(), rows.begin(), rows.end());
      continue;
    }
    const int rows = std::max(1, static_cast<int>(std::ceil(thick / apart - 1e-6)));
    for (int r = 0; r < rows; ++r) out.push_back(thick / rows);
  }
  return out;
}

/// Half-lengths: fields of a line die away as 1/distance.
double usual_window(bool line) { return line ? 6 : 4; }

SteadyGrid plan_grid(const Footprint& f, const PassesSpec& passes, double window) {
  const double a = f.x.half();
  SteadyGrid g;
  g.dx = a / passes.patch_cells;
  g.steps = kPathSteps;
  g.nx = static_cast<int>(std::lround(((f.line ? 42 : 8) + window) * passes.patch_cells));
  g.front = (f.line ? 10 : 3) * a;
  g.active = window * a;
  g.hold = (f.line ? 6 : 2) * a;
  if (f.line) return g;
  g.dy = f.y.half() / passes.patch_cells;
  g.ny = 12 * passes.patch_cells + 2 * static_cast<int>(std::ceil(farthest_pass(passes) / g.dy));
  g.y0 = f.y.middle() - 0.5 * (g.ny - 1) * g.dy;
  return g;
}

/// The columns nearest around the patch, so many that a Fourier transform likes them.
void take_columns(const PassLattice& lattice, const Footprint& f, SteadyGrid& g) {
  constexpr double kHalfAxes = 5;
  constexpr int kFewest = 16;
  g.dy = lattice.apart;
  g.ny = good_fft_length(std::max(kFewest, static_cast<int>(std::ceil(kHalfAxes * f.y.half() / g.dy))));
  const double first = f.y.middle() - 0.5 * (g.ny - 1) * g.dy;
  g.y0 = lattice.line + g.dy * std::round((first - lattice.line) / g.dy);
}

/// As many of the rows as reach so deep.
std::vector<double> rows_to(const std::vector<double>& thickness, double deepest) {
  std::vector<double> out;
  double top = 0;
  for (const double row : thickness) {
    if (top >= deepest) break;
    out.push_back(row);
    top += row;
  }
  return out;
}

int zone_at(const LayeredHalfSpace& body, double depth) {
  int zone = 0;
  for (const LayerExtent& layer : layer_extents(body)) {
    ++zone;
    if (depth < layer.bottom) return zone;
  }
  return 0;
}

RowModuli moduli_of(const HalfSpaceMaterial& m) {
  const Elastic e = elastic(m.young, m.poisson, 1);
  return {e.lambda, e.mu};
}

/// Rows with their material from the case.
class Rows {
 public:
  Rows(const CaseSpec& spec, const LayeredHalfSpace& body) : body_(body) {
    const int layers = static_cast<int>(layer_extents(body).size());
    for (int zone = 0; zone <= layers; ++zone) {
      const MaterialSpec& material = zone_material(spec, BodyId::rail, zone);
      const std::string name = zone_name(spec, BodyId::rail, zone), key = zone_key(spec, BodyId::rail, zone);
      laws_.push_back(plastic_law(material, name, key));
      if (!laws_.back()) {
        if (!material.strength.elastic)
          notes_.push_back(fmt::format(
              "{}: the case gives no strength, so it stays elastic: give {}.yield_strength, or {}.elastic = true", name,
              key, key));
        continue;
      }
      for (const std::string& note : laws_.back()->notes) notes_.push_back(note);
    }
  }
  bool any() const {
    return std::any_of(laws_.begin(), laws_.end(), [](const auto& law) { return law.has_value(); });
  }
  const std::vector<std::string>& notes() const { return notes_; }

  SteadyRow at(const HalfSpaceMaterial& material, int zone, double depth) const {
    SteadyRow row{moduli_of(material), {}};
    row.law.yield = kInfinite;
    if (const auto& law = laws_.at(static_cast<std::size_t>(zone))) {
      const auto extents = layer_extents(body_);
      row.law = law->at(zone == 0 ? depth : depth - extents[static_cast<std::size_t>(zone - 1)].top).plastic;
    }
    row.law.mu = row.moduli.mu;
    return row;
  }

 private:
  const LayeredHalfSpace& body_;
  std::vector<std::optional<PlasticLaw>> laws_;
  std::vector<std::string> notes_;
};

/// Stress of the contact on a path (SteadyGrid::path()), row by row from the surface down.
class ContactStress {
 public:
  ContactStress(const BemResult& result, double middle_x, const SteadyGrid& grid, InteriorKernels* kernels)
      : middle_x_(middle_x), grid_(grid.path()), stress_(interior(result, middle_x, grid_, kernels)) {
    // in steps of the contact's own cells tractions lose their edges, and so a fifth of what a wheel leaves
    constexpr double kCells = 21;  // of half the patch's length, at least
    constexpr int kLeast = 2;
    constexpr double kSkin = 1;  // cells: farther below steps do not show
    const double cells = footprint_of(result).x.half() / result.grid.dx;
    stress_.refine(sharing(result, kernels).refined(std::max(kLeast, static_cast<int>(std::ceil(kCells / cells)))),
                   kSkin * result.grid.dx);
  }

  std::vector<Sym3> row(double depth) {
    std::vector<Vec3> points;
    for (int i = 0; i < grid_.active_stations(); ++i)
      for (int j = 0; j < grid_.ny; ++j)
        points.push_back({middle_x_ + grid_.x(i), grid_.ny > 1 ? grid_.y(j) : 0, depth});
    return stress_(points, false);
  }

 private:
  static Subsurface sharing(const BemResult& result, InteriorKernels* kernels) {
    Subsurface out = rail_interior(result);
    out.share(kernels);
    return out;
  }
  static StressOfHalfSpace interior(const BemResult& result, double middle_x, const SteadyGrid& g,
                                    InteriorKernels* kernels) {
    std::vector<double> interfaces;
    for (const LayerExtent& layer : layer_extents(result.rail)) interfaces.push_back(layer.bottom);
    return {sharing(result, kernels), interfaces, std::max(g.front, g.active) + std::abs(middle_x) + g.dx,
            g.ny > 1 ? 0.5 * g.ny * g.dy + std::abs(g.y(0) + 0.5 * (g.ny - 1) * g.dy) : 0};
  }
  double middle_x_;
  SteadyGrid grid_;
  StressOfHalfSpace stress_;
};

/// No stress in equilibrium bears a friction above what the surface's material can take in shear.
void require_surface_bears(const ContactField& field, const SteadyRow& surface) {
  if (!std::isfinite(surface.law.yield)) return;
  double most = 0;
  for (int i = 0; i < field.size(); ++i) most = std::max(most, std::hypot(field.q_x[i], field.q_y[i]));
  const double bears = largest_stress(surface.law) / std::numbers::sqrt3;
  if (most < bears) return;
  throw CaseError(
      fmt::format("friction on the surface reaches {:.0f} MPa, but its material carries {:.0f} MPa in shear: passes "
                  "use the friction of elastic bodies, which has no equilibrium there",
                  1e-6 * most, 1e-6 * bears),
      "lower drive.friction_coefficient or the traction, or give the surface hardening or a higher strength");
}

void require_known(const CaseSpec& spec, const std::vector<BemResult>& solutions, const Rows& rows,
                   const Footprint& f) {
  for (const BemResult& result : solutions)
    if (!result.further.empty())
      throw CaseError("the wheel touches the rail at several places, but passes follow one patch",
                      "move the wheel (geometry.lateral_shift) until it touches at one place");
  if (!rows.any())
    throw CaseError(
        "nothing can yield: the case gives no strength of the rail or its layers, or sets elastic = true wherever it "
        "gives one",
        "give yield_strength = \"500 MPa\", or grade = \"R260\", in [material.rail] or a [[layer]]");
  if (const double most = kFarthest * f.y.half(); !f.line && farthest_pass(spec.passes) > most)
    throw CaseError(fmt::format("wheels shifted by {:.1f} mm touch another part of the profile; passes move the same "
                                "patch, by up to {:.1f} mm",
                                1e3 * farthest_pass(spec.passes), 1e3 * most),
                    "bring passes.lateral_positions closer together, or lower passes.lateral_deviation");
}

/// Stresses on the path, a vector a row, as a field of a grid with these rows or fewer.
Field as_field(const SteadyGrid& grid, const std::vector<std::vector<Sym3>>& rows) {
  const SteadyGrid g = grid.path();
  Field out(g.active_size());
  for (int r = 0; r < g.rows(); ++r)
    for (int i = 0; i < g.active_stations(); ++i)
      for (int j = 0; j < g.ny; ++j) {
        const Sym3& s = rows[static_cast<std::size_t>(r)][static_cast<std::size_t>(i * g.ny + j)];
        for (int c = 0; c < 6; ++c) out[g.active_index(c, r, i, j)] = component(s, c);
      }
  return out;
}

double largest_magnitude(const std::vector<double>& values) {
  return *std::max_element(values.begin(), values.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
}

/// Sums over a row of the section.
void add_balance(const SteadyGrid& g, const PassResult& result, PassRow& row) {
  double worst = 0, scale = 0, all = 0;
  const double width = g.ny > 1 ? g.dy : 1;
  for (int r = 0; r < g.rows(); ++r) {
    double along = 0, magnitude = 0, across[3] = {};
    for (int j = 0; j < g.ny; ++j) {
      const auto& s = result.residual_stress[g.point(r, j)];
      along += s[0];
      magnitude += std::abs(s[0]);
      for (int c = 0; c < 3; ++c) across[c] += s[c == 0 ? 2 : 3 + c];
    }
    row.force += along * width * g.thickness[static_cast<std::size_t>(r)];
    all += magnitude * width * g.thickness[static_cast<std::size_t>(r)];
    scale = std::max(scale, magnitude);
    for (const double sum : across) worst = std::max(worst, std::abs(sum));
  }
  row.balance = scale > 0 ? worst / scale : 0;
  row.force_share = all > 0 ? row.force / all : 0;
}

double sinking_at(const SteadyGrid& grid, const PassResult& last, double y) {
  const double place = (y - grid.y0) / grid.dy;
  if (!(place >= 0 && place < grid.ny - 1)) return 0;
  const auto left = static_cast<std::size_t>(place);
  const double right = place - static_cast<double>(left);
  return (1 - right) * last.sinking[left] + right * last.sinking[left + 1];
}

}  // namespace

RailPasses rail_passes(const CaseSpec& spec, const std::vector<BemResult>& solutions, const PassLattice* lattice) {
  const BemResult& result = solutions.front();
  const Rows rows(spec, result.rail);
  const Footprint f = footprint_of(result);
  require_known(spec, solutions, rows, f);
  RailPasses out;
  out.notes = rows.notes();
  out.middle_x = f.x.middle();
  out.window = spec.passes.window.value_or(usual_window(f.line));
  out.grid = plan_grid(f, spec.passes, out.window);
  if (lattice) take_columns(*lattice, f, out.grid);
  const std::vector<double> all =
      lattice ? rows_to(lattice->thickness, kDeepest * f.shorter())
              : thicknesses(result.rail, kDeepest * f.shorter(), f.shorter() / spec.passes.patch_rows,
                            spec.passes.first_row.value_or(0));
  std::vector<ContactStress> contacts;
  for (const BemResult& one : solutions)
    contacts.emplace_back(one, out.middle_x, out.grid, lattice ? lattice->kernels : nullptr);
  std::vector<std::vector<std::vector<Sym3>>> stresses(solutions.size());  // row by row
  const Subsurface interior = rail_interior(result);
  StressHistory section;  // rows alone, for what the process left in them
  std::size_t keep = 0;
  double top = 0;
  for (std::size_t r = 0; r < all.size(); ++r) {
    const double depth = top + 0.5 * all[r];
    top += all[r];
    const int zone = zone_at(result.rail, depth);
    out.zone.push_back(zone);
    out.rows.push_back(rows.at(interior.material_at(depth), zone, depth));
    section.depth.push_back(depth);
    section.zone.push_back(zone);
    double most = 0;
    for (std::size_t k = 0; k < contacts.size(); ++k) {
      stresses[k].push_back(contacts[k].row(depth));
      for (const Sym3& s : stresses[k].back()) most = std::max(most, von_mises(s));
    }
    if (top <= f.shorter() || most > kNearYield * out.rows.back().law.yield) keep = r + 1;
  }
  keep = std::min(keep + 1, all.size());
  out.grid.thickness.assign(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(keep));
  out.zone.resize(keep);
  out.rows.resize(keep);
  section.depth.resize(keep);
  section.zone.resize(keep);
  out.below = moduli_of(interior.material_at(keep < all.size() ? top : top + all.back()));
  const RowStrength process = row_strength(spec, BodyId::rail, section);
  for (std::size_t r = 0; r < keep; ++r) out.initial_stress.push_back({process.residual_x[r], process.residual_y[r]});
  for (const BemResult& one : solutions) require_surface_bears(one.field, out.rows.front());
  for (const auto& rows_of_one : stresses) out.contact_stress.push_back(as_field(out.grid, rows_of_one));
  return out;
}

std::optional<double> longer_window(const PassesSpec& passes, const RailPasses& rail, double late_flow) {
  constexpr double kGrowth = 1.5, kMost = 4;
  if (passes.window || late_flow <= kLateFlow) return {};
  const double longest = kMost * usual_window(rail.grid.ny == 1);
  if (rail.window >= longest) return {};
  return std::min(kGrowth * rail.window, longest);
}

int columns_to(const SteadyGrid& g, double lateral) {
  return g.ny > 1 ? static_cast<int>(std::lround(lateral / g.dy)) : 0;
}

Field contact_stress(const RailPasses& passes, const BemResult& contact) {
  const SteadyGrid& g = passes.grid;
  ContactStress stress(contact, passes.middle_x, g, nullptr);
  std::vector<std::vector<Sym3>> rows;
  for (int r = 0; r < g.rows(); ++r) rows.push_back(stress.row(g.depth(r)));
  return as_field(g, rows);
}

Field contact_strain(const RailPasses& passes, const SteadyBody& body, const Field& stress, int columns) {
  const SteadyGrid g = passes.grid.path();
  Field strain(g.active_size());
  for (int r = 0; r < g.rows(); ++r)
    for (int i = 0; i < g.active_stations(); ++i)
      for (int j = std::max(0, columns); j < std::min(g.ny, g.ny + columns); ++j) {
        std::array<double, 6> s{};
        for (int c = 0; c < 6; ++c) s[c] = stress[g.active_index(c, r, i, j - columns)];
        const std::array<double, 6> e = body.strain_of(r, s);
        for (int c = 0; c < 6; ++c) strain[g.active_index(c, r, i, j)] = e[c];
      }
  return strain;
}

void add_extremes(const PassPoint& p, PassRow& row) {
  row.largest.accumulated = std::max(row.largest.accumulated, p.strain.accumulated);
  row.strain = std::max(row.strain, equivalent_strain(p.plastic.data()));
  if (p.strain.net > row.largest.net) {
    row.largest.net = p.strain.net;
    row.net_y = p.y;
    row.net_depth = p.depth;
  }
  for (std::size_t c = 0; c < 2; ++c)
    if (p.stress[c] < row.stress[c]) {
      row.stress[c] = p.stress[c];
      row.stress_depth[c] = p.depth;
    }
}

PassRow pass_row(const SteadyGrid& g, int pass, const PassResult& result) {
  PassRow row;
  row.pass = pass;
  row.iterations = result.iterations;
  row.error = result.error;
  row.converged = result.converged;
  for (int r = 0; r < g.rows(); ++r)
    for (int j = 0; j < g.ny; ++j) {
      const std::size_t n = g.point(r, j);
      add_extremes({.y = g.y(j),
                    .depth = g.depth(r),
                    .strain = {result.accumulated[n], result.net[n]},
                    .stress = result.residual_stress[n],
                    .plastic = result.plastic_strain[n]},
                   row);
    }
  row.forward = largest_magnitude(result.forward);
  row.lateral = largest_magnitude(result.lateral);
  row.sinking = largest_magnitude(result.sinking);
  row.late_flow = result.late_flow;
  add_balance(g, result, row);
  return row;
}

std::vector<Vec2> pressed_profile(const Placement& placement, const SteadyGrid& grid, const PassResult& last) {
  constexpr double kStep = 0.25e-3;  // m
  const Profile& rail = placement.rail;
  const double length = rail.s_max() - rail.s_min();
  const int steps = static_cast<int>(std::ceil(length / kStep));
  std::vector<Vec2> out;
  for (int i = 0; i <= steps; ++i) {
    const double s = rail.s_min() + length * i / steps;
    const ProfilePoint at = rail.at(s);
    out.push_back(at.position - sinking_at(grid, last, s - placement.contact.rail_s) * at.outward);
  }
  return out;
}

}  // namespace railstrata
