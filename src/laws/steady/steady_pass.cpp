#include "steady/steady_pass.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "core/faults.hpp"
#include "core/parallel.hpp"
#include "material/strain_claim.hpp"
#include "steady/anderson.hpp"
#include "steady/pass_class.hpp"
#include "steady/steady_work.hpp"

namespace railstrata {

namespace {

int terms_of(const PlasticParameters<double>& law) {
  int terms = 0;
  for (int k = 0; k < kMostBackstresses; ++k)
    if (law.modulus[k] > 0) terms = k + 1;
  return terms;
}

SteadyGrid section_of(SteadyGrid grid) {
  grid.dx *= grid.nx;
  grid.nx = 1;
  return grid;
}

std::vector<RowModuli> moduli_of(const std::vector<SteadyRow>& rows) {
  std::vector<RowModuli> moduli;
  for (const SteadyRow& row : rows) moduli.push_back(row.moduli);
  return moduli;
}

}  // namespace

SteadyBody::SteadyBody(const SteadyGrid& grid, std::vector<SteadyRow> rows, RowModuli below,
                       std::vector<std::array<double, 2>> initial_stress)
    : response_(grid, moduli_of(rows), below),
      section_(section_of(grid), moduli_of(rows), below),
      rows_(std::move(rows)) {
  assert(static_cast<int>(rows_.size()) == grid.rows() &&
         (initial_stress.empty() || initial_stress.size() == rows_.size()));
  for (const SteadyRow& row : rows_) terms_.push_back(terms_of(row.law));
  between_ = between_stations(grid);
  initial_strain_.resize(rows_.size());
  for (std::size_t r = 0; r < initial_stress.size(); ++r)
    initial_strain_[r] = strain_of(static_cast<int>(r), {initial_stress[r][0], initial_stress[r][1], 0, 0, 0, 0});
}

void move_guess(const SteadyGrid& g, int columns, PassState& state) {
  if (columns == 0) return;
  for (Field* field : {&state.residual_strain, &state.rise}) {
    Field moved(field->size());
    const int by = std::clamp(columns, -g.ny, g.ny), from = std::max(0, -by);
    for (std::size_t line = 0; line < field->size(); line += static_cast<std::size_t>(g.ny)) {
      const auto begin = static_cast<std::ptrdiff_t>(line) + from;
      std::copy_n(field->begin() + begin, g.ny - std::abs(by), moved.begin() + begin + by);
    }
    *field = std::move(moved);
  }
}

PassState SteadyBody::virgin() const {
  PassState state;
  state.history.assign(grid().points() * kStreamlineHistory, 0.0);
  state.residual_strain.assign(grid().active_size(), 0.0);
  state.rise.assign(3 * grid().plane(), 0.0);
  return state;
}

void SteadyBody::add_section(const Field& section, Field& surface) const {
  const std::size_t plane = grid().plane(), ny = static_cast<std::size_t>(grid().ny);
  for (std::size_t n = 0; n < surface.size(); ++n) surface[n] += section[n / plane * ny + n % ny];
}

Field SteadyBody::surface_expected(const PassState& state) const {
  Field section, surface = state.rise;
  uniform_strain(state.history, &section);
  add_section(section, surface);
  return surface;
}

std::array<double, 6> SteadyBody::strain_of(int row, const std::array<double, 6>& s) const {
  const auto [lambda, mu] = rows_[static_cast<std::size_t>(row)].moduli;
  const double mean = lambda / (3 * lambda + 2 * mu) * (s[0] + s[1] + s[2]);
  std::array<double, 6> e{};
  for (int c = 0; c < 6; ++c) e[c] = (s[c] - (c < 3 ? mean : 0)) / (2 * mu);
  return e;
}

std::array<double, 6> SteadyBody::stress_of(int row, const std::array<double, 6>& strain) const {
  const auto [lambda, mu] = rows_[static_cast<std::size_t>(row)].moduli;
  const double pressure = lambda * (strain[0] + strain[1] + strain[2]);
  std::array<double, 6> s{};
  for (int c = 0; c < 6; ++c) s[c] = 2 * mu * strain[c] + (c < 3 ? pressure : 0);
  return s;
}

Field SteadyBody::uniform_strain(const std::vector<double>& history, Field* surface) const {
  assert(history.size() == section_.grid().points() * kStreamlineHistory);
  const SteadyGrid& g = section_.grid();
  Field section(g.size());
  for (int c = 0; c < 6; ++c)
    for (std::size_t n = 0; n < g.points(); ++n)
      section[c * g.points() + n] = history[n * kStreamlineHistory + static_cast<std::size_t>(c)];
  section_.apply(section, surface);
  return section;
}

double SteadyBody::compare(Work& work) const {
  const SteadyGrid& g = grid();
  const int active = g.active_stations();
  std::vector<double> worst(static_cast<std::size_t>(g.rows() * active));
  for_each(static_cast<std::ptrdiff_t>(worst.size()), [&](std::ptrdiff_t n) {
    const int r = static_cast<int>(n) / active, i = static_cast<int>(n) % active;
    if (!work.follows(r)) return;
    const SteadyRow& row = rows_[static_cast<std::size_t>(r)];
    const double scale = 2 * row.moduli.mu / (row.law.yield / std::numbers::sqrt3);
    for (int c = 0; c < 6; ++c) {
      const std::size_t to = g.active_index(c, r, i, 0), from = g.index(c, r, i, 0);
      for (std::size_t j = 0; j < static_cast<std::size_t>(g.ny); ++j) {
        work.residual[to + j] = work.field[from + j] - work.guess[to + j];
        const double error = scale * std::abs(work.residual[to + j]);
        if (!(error <= worst[n])) worst[n] = error;  // NaN too
      }
    }
  });
  double error = 0;
  for (const double w : worst)
    if (!(w <= error)) error = w;
  return error;
}

void SteadyBody::iterate(const ContactPath& contact, PassState& state, const PassLimits& limits, Work& work,
                         PassResult& out) const {
  assert(state.residual_strain.size() == grid().active_size());
  const SteadyGrid& g = grid();
  work.guess = limits.iterations > 0 ? state.residual_strain : std::move(state.residual_strain);
  if (limits.iterations > 0) {
    work.field.resize(g.size());
    work.residual.resize(work.guess.size());
  }
  work.after.resize(state.history.size());
  work.late.resize(g.points());
  Anderson anderson;
  for (;;) {
    if (asked_to_stop(limits.control)) throw Interrupted("stopped in a pass");
    follow(contact, state, work);
    if (limits.iterations == 0) break;
    response_.apply(work.field, &out.surface, work.rows);
    work.clean = false;
    out.error = compare(work);
    ++out.iterations;
    if (!std::isfinite(out.error))
      throw NumericalError("a pass of the stationary solution gave a strain that is not a number");
    out.converged = out.error <= limits.tolerance;
    if (out.converged || out.iterations >= limits.iterations) break;
    anderson.step(work.guess, work.residual);
  }
  state.rise = out.surface;
  out.before = std::move(state.history);
  state.history = std::move(work.after);
  state.residual_strain = std::move(work.guess);
  ++state.passes;
}

PassResult SteadyBody::run_pass(const Field& contact_strain, PassState& state, const PassLimits& limits) const {
  Work work;
  Field surface_before;
  work.before = uniform_strain(state.history, &surface_before);
  PassResult out;
  iterate(path_of(contact_strain), state, limits, work, out);
  add_section(surface_before, out.surface);
  conclude(out.before, uniform_strain(state.history), state, out);
  const double most = *std::max_element(out.accumulated.begin(), out.accumulated.end());
  if (most > 0) out.late_flow = *std::max_element(work.late.begin(), work.late.end()) / most;
  return out;
}

PassResult SteadyBody::run_pass_within(const Field& before, const ContactPath& contact, PassState& state,
                                       const PassLimits& limits) const {
  constexpr double kNear = 0.05;  // of the strength, beside what neighbours that flow in this pass have added so far
  Work work;
  work.before = before;
  work.rows.assign(rows_.size(), state.passes == 0);
  double added = 0;
  for (const double e : state.residual_strain) added = std::max(added, std::abs(e));
  for (int n = 0; n < grid().rows() * Columns::blocks_of(grid()) && state.passes > 0; ++n) {
    const Columns columns(grid(), n);
    const auto r = static_cast<std::size_t>(columns.row);
    if (work.rows[r] || !std::isfinite(rows_[r].law.yield)) continue;
    const double near = kNear + 3 * rows_[r].law.mu * added / rows_[r].law.yield;
    const Surroundings around(*this, columns, before, state.residual_strain);
    work.rows[r] = !(largest_excess(columns, contact.balls, around, state.history) <= -near);
  }
  PassResult out;
  if (std::find(work.rows.begin(), work.rows.end(), true) == work.rows.end()) {
    out.before = state.history;
    ++state.passes;
    return out;
  }
  iterate(contact, state, limits, work, out);
  for (std::size_t n = 0; n < work.residual.size(); ++n) state.residual_strain[n] += work.residual[n];
  return out;
}

void SteadyBody::conclude(const std::vector<double>& before, const Field& strain, const PassState& state,
                          PassResult& out) const {
  const SteadyGrid& g = grid();
  out.accumulated.resize(g.points());
  out.net.resize(g.points());
  out.residual_stress.resize(g.points());
  out.plastic_strain.resize(g.points());
  out.forward.assign(static_cast<std::size_t>(g.ny), 0.0);
  out.lateral = out.sinking = out.forward;
  for (std::size_t n = 0; n < g.points(); ++n) {
    const int r = static_cast<int>(n) / g.ny, j = static_cast<int>(n) % g.ny;
    const double *was = before.data() + n * kStreamlineHistory, *is = state.history.data() + n * kStreamlineHistory;
    double e[6];
    for (int c = 0; c < 6; ++c) {
      out.plastic_strain[n][c] = is[c];
      e[c] = strain[c * g.points() + n];
    }
    out.accumulated[n] = is[6] - was[6];
    out.net[n] = net_strain(was, is);
    const SteadyRow& row = rows_[static_cast<std::size_t>(r)];
    // u vanishes at the foot and z points down: u(0) = - sum of du/dz; the strain is the same along x
    const double h = g.thickness[static_cast<std::size_t>(r)];
    out.forward[j] -= 2 * e[5] * h;
    out.lateral[j] -= 2 * e[4] * h;
    out.sinking[j] -= e[2] * h;
    for (int c = 0; c < 6; ++c) e[c] += initial_strain_[r][c];
    double stress[6];
    plastic_stress(row.moduli.lambda, row.moduli.mu, e, is, stress);
    std::copy(stress, stress + 6, out.residual_stress[n].begin());
  }
}

}  // namespace railstrata
