#include "bem/rolling_contact.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bem/leading_edge.hpp"
#include "core/faults.hpp"
#include "steady/anderson.hpp"

namespace railstrata {

namespace {

/// Adds the part of the state before that pressure has made, of each cell or of the one ahead of it.
void add_history_by_pressure(const InfluenceOperator& influence, const PatchGrid& grid, const Plane& pressure,
                             std::size_t ahead, PlanePair& before) {
  const PlanePair u = influence.tangential_from_pressure(pressure, grid.nx + 1);
  for_cells(grid.size(), [&](std::size_t i) {
    before.x[i] += u.x[i + ahead];
    before.y[i] += u.y[i + ahead];
  });
}

/// Adds the tangential displacement by pressure: as rigid slip in steady rolling, else to the displacements of the step
/// before.
void add_displacement_by_pressure(const InfluenceOperator& influence, const PatchGrid& grid, const Plane& pressure,
                                  TangentialProblem& t) {
  const PlanePair u = influence.tangential_from_pressure(pressure, grid.nx + 1);
  const std::size_t n = grid.size(), row = static_cast<std::size_t>(grid.ny);
  const bool steady = t.kind == RollingKind::steady;
  auto& [x, y] = steady ? t.extra_slip : t.before;
  x.resize(n, 0.0);
  y.resize(n, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    x[i] += steady ? (u.x[i + row] - u.x[i]) / grid.dx : -u.x[i];
    y[i] += steady ? (u.y[i + row] - u.y[i]) / grid.dx : -u.y[i];
  }
}

/// Adds half the stretch of the wheel at the end and, a cell ahead, the beginning of a step: mean over the step.
void add_half_stretch(const InfluenceOperator& influence, const PatchGrid& grid, const Plane& pressure,
                      std::initializer_list<std::size_t> places_ahead, PlanePair& slip) {
  if (!influence.stretches()) return;
  const Plane stretch = influence.stretch_of_wheel(pressure, grid.nx + 1);
  slip.x.resize(grid.size(), 0.0);
  slip.y.resize(grid.size(), 0.0);
  for (const std::size_t ahead : places_ahead)
    for (std::size_t i = 0; i < grid.size(); ++i) slip.x[i] += 0.5 * stretch[i + ahead];
}

/// Flexibility of the film beyond the operator's, mean over the first cells of the rows [m/Pa].
double film_at_edge(const PatchGrid& grid, const TangentialProblem& t) {
  double sum = 0;
  int cells = 0;
  const auto ahead = static_cast<std::size_t>(grid.ny);
  for (std::size_t k = 0; k + ahead < t.film.size(); ++k) {
    if (!(t.traction_bound[k] > 0) || t.traction_bound[k + ahead] > 0) continue;
    sum += t.film[k].flexibility() - t.third_body.flexibility();
    ++cells;
  }
  return cells > 0 ? sum / cells : 0;
}

/// Steps of one cell alone, and no shifts, have first cells that lambda fits.
void cut_leading_cells(const InfluenceOperator& influence, const PatchGrid& grid, const NormalSolution& normal,
                       TangentialProblem& t) {
  if (t.kind == RollingKind::shift || (t.kind == RollingKind::transient && t.step != grid.dx)) return;
  t.leading_weight = leading_weights(grid, normal, film_share(influence, film_at_edge(grid, t)));
  if (!influence.couples()) return;
  const PlanePair ahead = leading_slip_by_pressure(influence, grid, normal, t.leading_weight);
  t.extra_slip.x.resize(grid.size(), 0.0);
  t.extra_slip.y.resize(grid.size(), 0.0);
  add_scaled(t.extra_slip.x, -1 / grid.dx, ahead.x);
  add_scaled(t.extra_slip.y, -1 / grid.dx, ahead.y);
}

double factor_at(const RollingContact& contact, std::vector<TablePoint> ContactHeat::*table, std::size_t cell) {
  if (!contact.heat) return 1;
  return over_table((*contact.heat).*table,
                    contact.temperature.empty() ? contact.heat->before_sliding() : contact.temperature[cell]);
}

/// The film of each cell; none where it is the same everywhere.
std::vector<ThirdBody> films(const RollingContact& contact, const Plane& pressure) {
  std::vector<ThirdBody> out;
  const ThirdBody& film = contact.third_body;
  const bool by_pressure = film.yield_by_pressure != 0 || film.modulus_by_pressure != 0,
             by_heat = contact.heat && !contact.heat->film.empty();
  if (!(film.thickness > 0) || !(by_pressure || by_heat)) return out;
  for (std::size_t i = 0; i < pressure.size(); ++i)
    out.push_back(film.under(pressure[i], factor_at(contact, &ContactHeat::film, i)));
  return out;
}

}  // namespace

Plane traction_bound(const RollingContact& contact, const Plane& pressure) {
  Plane bound = pressure;
  for (std::size_t i = 0; i < bound.size(); ++i)
    bound[i] *= (contact.local_friction.empty() ? contact.friction : contact.local_friction[i]) *
                factor_at(contact, &ContactHeat::friction, i);
  return bound;
}

TangentialProblem tangential_part(const InfluenceOperator& influence, const PatchGrid& grid,
                                  const RollingContact& contact, const NormalSolution& normal) {
  TangentialProblem t{contact, traction_bound(contact, normal.pressure), films(contact, normal.pressure), {}};
  const auto row = static_cast<std::size_t>(grid.ny);
  if (influence.couples()) add_displacement_by_pressure(influence, grid, normal.pressure, t);
  if (t.kind == RollingKind::steady) add_half_stretch(influence, grid, normal.pressure, {0, row}, t.extra_slip);
  if (t.kind == RollingKind::transient) add_half_stretch(influence, grid, normal.pressure, {0}, t.extra_slip);
  if (contact.leading_edge == LeadingEdge::sub_cell) cut_leading_cells(influence, grid, normal, t);
  return t;
}

namespace {

Plane gap_with_displacement_by_traction(const InfluenceOperator& influence, const Plane& gap,
                                        const TangentialSolution& q) {
  Plane out = influence.normal_from_traction(q.q_x, q.q_y);
  add_scaled(out, 1, gap);
  return out;
}

double largest_difference(const Plane& a, const Plane& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
  return most;
}

/// Over the maximum before.
double relative_change(const Plane& pressure, const Plane& before) {
  return largest_difference(pressure, before) / largest_of(before);
}

bool without_traction(const RollingSolution& s) { return s.tangential.state.empty(); }

/// What traction across bears of the load, less what it adds to it, N: of rows that turn.
double load_on_traction(const PatchGrid& grid, const Plane& turn, const Plane& q_y) {
  double sum = 0;
  for (std::size_t k = 0; k < q_y.size() && !turn.empty(); ++k) sum += q_y[k] * std::sin(turn[k % turn.size()]);
  return sum * grid.cell_area();
}

/// The forces of rows that turn, along the axes of the contact plane.
void set_resultants(const PatchGrid& grid, const Plane& turn, RollingSolution& s) {
  double across = 0;
  for (std::size_t k = 0; k < grid.size(); ++k) {
    const double angle = turn[k % turn.size()];
    across += s.tangential.q_y[k] * std::cos(angle) + s.normal.pressure[k] * std::sin(angle);
  }
  s.tangential.force_y = across * grid.cell_area();
  s.normal.load -= load_on_traction(grid, turn, s.tangential.q_y);
}

/// Takes the next solution of one of the two problems; its iterations are added to those before.
template <class Solution>
void replace(Solution& old, Solution next) {
  next.iterations += old.iterations;
  old = std::move(next);
}

/// To a tolerance, from tractions that are known by one Newton step.
TangentialOptions roughly(TangentialOptions options, double tolerance, bool one_step) {
  options.tolerance = std::max(options.tolerance, tolerance);
  if (one_step) {
    options.max_outer = 1;
    options.partial = true;
  }
  return options;
}

/// Sections couple little: after the first turn the tangential problem is solved to its end, and the change of pressure
/// by that of the gap shows whether another turn would bring anything.
RollingSolution solve_coupled(const InfluenceOperator& influence, const PatchGrid& grid, const RollingContact& contact,
                              const RollingOptions& options, const RollingSolution* start) {
  // A third of the tangential solution is enough to see the pressure move.
  constexpr double kFirst = 0.3;
  // Over the last change of the pressure: how well the next pressure is known.
  constexpr double kSharper = 0.03;
  // A small deviation of the gap, over its range, is a hundredfold one of the pressure in single cells.
  constexpr double kGapPerPressure = 0.01;
  // After these outer iterations the tangential problem is solved to its end each time.
  constexpr int kOneStepIterations = 30;
  RollingSolution s;
  if (start) {
    s.tangential = start->tangential;
    s.tangential.iterations = 0;
  }
  double change = kFirst, by_gap = 0;  // by_gap: of sections, of the pressure by that of the gap
  Plane gap =
      without_traction(s) ? contact.gap : gap_with_displacement_by_traction(influence, contact.gap, s.tangential);
  const auto pressure = [&](const Plane& from) {
    NormalTarget target = contact.target;
    if (target.load && !without_traction(s)) *target.load += load_on_traction(grid, contact.turn, s.tangential.q_y);
    NormalOptions close_enough = options.normal;
    close_enough.tolerance = std::max(close_enough.tolerance, kGapPerPressure * kSharper * change);
    return solve_normal(influence, grid, gap, target, close_enough, from, contact.turn);
  };
  s.normal = pressure(start ? start->normal.pressure : Plane{});
  const double most_left =
      start ? std::min(options.coupling_tolerance,
                       options.normal.share_of_first * relative_change(s.normal.pressure, start->normal.pressure))
            : options.coupling_tolerance;
  for (s.outer_iterations = 1; s.outer_iterations <= options.max_outer; ++s.outer_iterations) {
    const bool settled = change < options.coupling_tolerance, first = without_traction(s);
    const bool to_its_end = settled || by_gap > 0, one_step = !first && s.outer_iterations < kOneStepIterations;
    replace(s.tangential,
            solve_tangential(influence, grid, tangential_part(influence, grid, contact, s.normal),
                             to_its_end ? options.tangential : roughly(options.tangential, change, one_step),
                             first ? nullptr : &s.tangential));
    const Plane before = gap;
    if (!settled) gap = gap_with_displacement_by_traction(influence, contact.gap, s.tangential);
    const double moved = largest_difference(gap, before);
    if (settled || (by_gap > 0 && by_gap * moved < most_left)) {
      if (!contact.turn.empty()) set_resultants(grid, contact.turn, s);
      return s;
    }
    NormalSolution next = pressure(s.normal.pressure);
    const double now = relative_change(next.pressure, s.normal.pressure);
    if (influence.stretches() && moved > 0) by_gap = std::max(by_gap, now / moved);
    change = std::max(kSharper * change, now);
    replace(s.normal, std::move(next));
  }
  throw NumericalError("the iteration between normal and tangential contact did not converge");
}

/// At the temperature of `contact`.
RollingSolution solve_as_warm(const InfluenceOperator& influence, const PatchGrid& grid, const RollingContact& contact,
                              const RollingOptions& options, const RollingSolution* start) {
  if (influence.couples() || !contact.turn.empty()) return solve_coupled(influence, grid, contact, options, start);
  RollingSolution s;
  s.normal = solve_normal(influence, grid, contact.gap, contact.target, options.normal,
                          start ? start->normal.pressure : Plane{});
  s.tangential =
      solve_tangential(influence, grid, tangential_part(influence, grid, contact, s.normal), options.tangential,
                       start && !without_traction(*start) ? &start->tangential : nullptr);
  return s;
}

/// Of a step that follows, as contact.flux_before; of a steady state its rows are the way of the particles.
std::vector<Plane> flux_before(const PatchGrid& grid, const RollingSolution& s) {
  std::vector<Plane> out;
  const auto most = static_cast<std::size_t>(grid.nx);
  Plane last = s.flux.empty() ? Plane(grid.size(), 0.0) : s.flux.front();
  for (std::size_t k = 0; k < most; ++k) {
    const bool known = k < s.flux.size();
    last = rolled_on(grid, known ? s.flux[k] : last);
    out.push_back(last);
  }
  return out;
}

RollingSolution settle_temperature(const InfluenceOperator& influence, const PatchGrid& grid,
                                   const RollingContact& contact, const RollingOptions& options,
                                   const RollingSolution* start) {
  constexpr double kTolerance = 1e-4;  // of a factor
  constexpr int kMost = 60;
  RollingContact warm = contact;
  Plane& now = warm.temperature;
  now = start && start->temperature.size() == grid.size() ? start->temperature
                                                          : Plane(grid.size(), contact.heat->before_sliding());
  const bool steady = contact.kind == RollingKind::steady;
  RollingSolution s;
  Anderson anderson;
  for (int k = 0; k < kMost; ++k) {
    s = solve_as_warm(influence, grid, warm, options, k > 0 ? &s : start);
    const Plane flux = friction_flux(s.tangential, contact.speed);
    Plane next = contact_temperature(*contact.heat, grid, flux, now, contact.flux_before, steady,
                                     steady ? grid.dx : contact.step, contact.speed);
    double change = 0;
    for (std::size_t i = 0; i < next.size(); ++i)
      for (const auto table : {&ContactHeat::friction, &ContactHeat::film})
        change = std::max(
            change, std::abs(over_table((*contact.heat).*table, next[i]) - over_table((*contact.heat).*table, now[i])));
    if (change <= kTolerance) {
      s.temperature = std::move(next);
      s.flux.push_back(flux);
      s.flux.insert(s.flux.end(), contact.flux_before.begin(), contact.flux_before.end());
      if (s.tangential.bound.empty()) s.tangential.bound = traction_bound(warm, s.normal.pressure);
      return s;
    }
    Field y(now.begin(), now.end()), residual(now.size());
    for (std::size_t i = 0; i < next.size(); ++i) residual[i] = next[i] - now[i];
    anderson.step(y, residual);
    std::copy(y.begin(), y.end(), now.begin());
  }
  throw CaseError("temperature-dependent friction did not converge: friction and heat amplify each other",
                  "give creepages instead of forces, a flatter temperature_table, or a smaller slip",
                  "friction.temperature_table");
}

}  // namespace

RollingSolution solve_rolling(const InfluenceOperator& influence, const PatchGrid& grid, const RollingContact& contact,
                              const RollingOptions& options, const RollingSolution* start) {
  if (contact.heat && contact.kind != RollingKind::shift)
    return settle_temperature(influence, grid, contact, options, start);
  RollingSolution s = solve_as_warm(influence, grid, contact, options, start);
  if (s.tangential.bound.empty() && !contact.local_friction.empty())
    s.tangential.bound = traction_bound(contact, s.normal.pressure);
  return s;
}

void roll_on_one_cell(const InfluenceOperator& influence, const PatchGrid& grid, const RollingSolution& before,
                      RollingContact& contact) {
  roll_on_one_cell(influence, grid, before.tangential, contact);
  add_history_by_pressure(influence, grid, before.normal.pressure, static_cast<std::size_t>(grid.ny), contact.before);
  add_half_stretch(influence, grid, before.normal.pressure, {static_cast<std::size_t>(grid.ny)}, contact.extra_slip);
  if (contact.heat) contact.flux_before = flux_before(grid, before);
}

void shift_on(const InfluenceOperator& influence, const PatchGrid& grid, const RollingSolution& before,
              RollingContact& contact) {
  shift_on(influence, grid, before.tangential, contact);
  add_history_by_pressure(influence, grid, before.normal.pressure, 0, contact.before);
}

}  // namespace railstrata
