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

namespace railstrata {

namespace {

constexpr int kNewtonSteps = 6;        // strains change by up to some 1e-3 from place to place
constexpr double kMostBetween = 1.25;  // sum of the weights' magnitudes between stations, at most

int terms_of(const PlasticParameters<double>& law) {
  int terms = 0;
  for (int k = 0; k < kMostBackstresses; ++k)
    if (law.modulus[k] > 0) terms = k + 1;
  return terms;
}

/// One place of neighbouring streamlines.
void advance(const PlasticParameters<double>& law, int terms, const Pack (&strain)[6], Pack* history) {
  switch (terms) {
    case 0:
      return advance_plastic<0, kNewtonSteps>(law, strain, history);
    case 1:
      return advance_plastic<1, kNewtonSteps>(law, strain, history);
    case 2:
      return advance_plastic<2, kNewtonSteps>(law, strain, history);
    case 3:
      return advance_plastic<3, kNewtonSteps>(law, strain, history);
    default:
      return advance_plastic<4, kNewtonSteps>(law, strain, history);
  }
}

Pack take_lanes(const double* p, int count) {
  if (count == kLanes) return load(p);
  Pack out{};
  for (int l = 0; l < count; ++l) out[l] = p[l];
  return out;
}

void give_lanes(double* p, int count, const Pack& v) {
  if (count == kLanes) return store(p, v);
  for (int l = 0; l < count; ++l) p[l] = v[l];
}

/// Catmull and Rom's cubic, the end's value beyond the ends.
std::vector<Between> between_stations(const SteadyGrid& g) {
  const int active = g.active_stations();
  std::vector<Between> out;
  for (int k = 0; k < active * g.steps; ++k) {
    const double place = (k + 0.5) / g.steps - 0.5;
    const int left = static_cast<int>(std::floor(place));
    const double t = place - left, s = 1 - t;
    Between& at = out.emplace_back();
    for (int n = 0; n < 4; ++n) at.station[n] = std::clamp(left - 1 + n, 0, active - 1);
    at.weight[0] = -0.5 * t * s * s;
    at.weight[1] = s * s * (1 + 2 * t) + 0.5 * t * t * s;
    at.weight[2] = t * t * (1 + 2 * s) + 0.5 * t * s * s;
    at.weight[3] = -0.5 * t * t * s;
  }
  return out;
}

void take_deviator(double (&e)[6]) {
  const double mean = (e[0] + e[1] + e[2]) / 3;
  for (int c = 0; c < 3; ++c) e[c] -= mean;
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

/// Arrays of one pass.
struct SteadyBody::Work {
  Field before;                   // strain of the earlier passes, per component and point of the section
  std::vector<StrainBall> balls;  // of the contact's strain, per point of the section
  std::vector<bool> rows;         // that are followed; empty: all
  Field field;                    // plastic strain of this pass everywhere, then the strain it causes
  Field guess, residual;          // at active stations
  std::vector<double> after;      // histories behind the load
  std::vector<double> late;       // p of each point in the last quarter of the stations behind the load

  bool follows(int row) const { return rows.empty() || rows[static_cast<std::size_t>(row)]; }
};

/// Neighbouring columns of a row, as many as a pack has lanes or fewer.
struct SteadyBody::Columns {
  int row = 0, first = 0, count = 0;

  static int blocks_of(const SteadyGrid& g) { return (g.ny + kLanes - 1) / kLanes; }
  Columns(const SteadyGrid& g, std::ptrdiff_t block)
      : row(static_cast<int>(block / blocks_of(g))),
        first(kLanes * static_cast<int>(block % blocks_of(g))),
        count(std::min(kLanes, g.ny - first)) {}
};

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

std::vector<StrainBall> SteadyBody::balls_of(const Field& contact_strain) const {
  const SteadyGrid g = grid().path();
  std::vector<StrainBall> out(g.points());
  for_each(static_cast<std::ptrdiff_t>(g.points()), [&](std::ptrdiff_t n) {
    const int r = static_cast<int>(n / g.ny), j = static_cast<int>(n % g.ny);
    std::array<double, 6> least, most;
    least.fill(std::numeric_limits<double>::infinity());
    most.fill(-std::numeric_limits<double>::infinity());
    const auto deviator = [&](int i, double(&e)[6]) {
      for (int c = 0; c < 6; ++c) e[c] = contact_strain[g.active_index(c, r, i, j)];
      take_deviator(e);
    };
    double e[6];
    for (int i = 0; i < g.active_stations(); ++i) {
      deviator(i, e);
      for (std::size_t c = 0; c < 6; ++c) {
        least[c] = std::min(least[c], e[c]);
        most[c] = std::max(most[c], e[c]);
      }
    }
    StrainBall& ball = out[static_cast<std::size_t>(n)];
    for (std::size_t c = 0; c < 6; ++c) ball.middle[c] = 0.5 * (least[c] + most[c]);
    for (int i = 0; i < g.active_stations(); ++i) {
      deviator(i, e);
      for (std::size_t c = 0; c < 6; ++c) e[c] -= ball.middle[c];
      const double size = equivalent_strain(e);
      if (!(size <= ball.radius)) ball.radius = size;  // NaN too
    }
  });
  return out;
}

/// An upper bound of the yield condition f over the strength, all along the columns, as long as nothing flows.
double SteadyBody::largest_excess(const Columns& columns, const std::vector<StrainBall>& balls, const Field& before,
                                  const Field& guess, const std::vector<double>& history) const {
  const SteadyGrid& g = grid();
  const auto [r, first, count] = columns;
  const PlasticParameters<double>& law = rows_[static_cast<std::size_t>(r)].law;
  Pack largest{};
  for (int i = 0; i < g.active_stations(); ++i) {
    Pack e[6];
    for (int c = 0; c < 6; ++c) e[c] = take_lanes(guess.data() + g.active_index(c, r, i, first), count);
    const Pack size = double_contraction(e, e);
    largest = size > largest ? size : largest;
  }
  double out = -std::numeric_limits<double>::infinity();
  for (int l = 0; l < count; ++l) {
    const std::size_t point = g.point(r, first + l);
    const double* h = history.data() + point * kStreamlineHistory;
    double e[6];
    for (std::size_t c = 0; c < 6; ++c) e[c] = before[c * g.points() + point] + initial_strain_[r][c];
    take_deviator(e);
    for (std::size_t c = 0; c < 6; ++c) {
      e[c] += balls[point].middle[c] - h[c];
      for (int k = 0; k < terms_[r]; ++k) e[c] -= h[7 + 6 * k + static_cast<int>(c)] / (2 * law.mu);
    }
    const double strength = law.yield + law.saturation * saturated_share(law.rate * h[6]);
    const double size = equivalent_strain(e) + balls[point].radius + kMostBetween * std::sqrt(2.0 / 3 * largest[l]);
    const double excess = 3 * law.mu * size / strength - 1;
    if (!(excess <= out)) out = excess;  // NaN too
  }
  return out;
}

/// visit(k, strain): after place k of the path.
template <class Visit>
void SteadyBody::take_law(const Columns& columns, const Field& contact_strain, const Field& before, const Field& guess,
                          Pack* history, Visit&& visit) const {
  const SteadyGrid &g = grid(), path = g.path();
  const auto [r, first, count] = columns;
  const SteadyRow& row = rows_[static_cast<std::size_t>(r)];
  const bool flows = std::isfinite(row.law.yield);
  Pack always[6];
  for (int c = 0; c < 6; ++c)
    always[c] = take_lanes(before.data() + c * g.points() + g.point(r, first), count) + initial_strain_[r][c];
  for (int k = 0; k < path.active_stations(); ++k) {
    const Between& at = between_[static_cast<std::size_t>(k)];
    Pack e[6];
    for (int c = 0; c < 6; ++c) {
      e[c] = always[c] + take_lanes(contact_strain.data() + path.active_index(c, r, k, first), count);
      for (int n = 0; n < 4; ++n)
        e[c] += at.weight[n] * take_lanes(guess.data() + g.active_index(c, r, at.station[n], first), count);
    }
    if (flows) advance(row.law, terms_[r], e, history);
    visit(k, e);
  }
}

void SteadyBody::follow(const Field& contact_strain, const PassState& state, Work& work) const {
  const SteadyGrid& g = grid();
  const int active = g.active_stations();
  std::vector<double> share(static_cast<std::size_t>(g.nx));
  for (int i = 0; i < g.nx; ++i) share[i] = g.share(i);
  const bool with_field = !work.field.empty();
  const int late = std::max(0, active - static_cast<int>(std::lround(0.25 * g.active / g.dx)));
  for_each(
      static_cast<std::ptrdiff_t>(g.rows() * Columns::blocks_of(g)),
      [&](std::ptrdiff_t n) {
        const Columns columns(g, n);
        const auto [r, first, count] = columns;
        const std::size_t point = g.point(r, first);
        const auto begin = state.history.begin() + static_cast<std::ptrdiff_t>(point * kStreamlineHistory);
        std::copy_n(begin, count * kStreamlineHistory, work.after.data() + point * kStreamlineHistory);
        if (!work.follows(r)) return;
        const bool yields = std::isfinite(rows_[static_cast<std::size_t>(r)].law.yield) &&
                            !(largest_excess(columns, work.balls, work.before, work.guess, state.history) <= 0);
        if (!yields && !with_field) return;
        Pack h[kStreamlineHistory]{}, before[6], sum[6]{}, early{};
        for (int l = 0; l < count; ++l)
          for (int k = 0; k < kStreamlineHistory; ++k) h[k][l] = *(begin + l * kStreamlineHistory + k);
        std::copy_n(h, 6, before);
        early = h[6];
        const auto give = [&](int i, int c, const Pack& strain) {
          if (with_field) give_lanes(work.field.data() + g.index(c, r, i, first), count, share[i] * strain);
        };
        if (yields)
          take_law(columns, contact_strain, work.before, work.guess, h, [&](int k, const Pack(&)[6]) {
            for (int c = 0; c < 6; ++c) sum[c] += h[c] - before[c];
            if ((k + 1) % g.steps != 0) return;
            for (int c = 0; c < 6; ++c) {
              give(k / g.steps, c, sum[c] / g.steps);
              sum[c] = Pack{};
            }
            if ((k + 1) / g.steps == late) early = h[6];
          });
        for (int i = yields ? active : 0; i < g.nx; ++i)
          for (int c = 0; c < 6; ++c) give(i, c, h[c] - before[c]);
        give_lanes(work.late.data() + point, count, h[6] - early);
        for (int l = 0; yields && l < count; ++l)
          for (int k = 0; k < kStreamlineHistory; ++k)
            work.after[(point + static_cast<std::size_t>(l)) * kStreamlineHistory + static_cast<std::size_t>(k)] =
                h[k][l];
      },
      true);
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
    for (int c = 0; c < 6; ++c)
      for (int j = 0; j < g.ny; ++j) {
        const std::size_t at = g.active_index(c, r, i, j);
        work.residual[at] = work.field[g.index(c, r, i, j)] - work.guess[at];
        const double error = scale * std::abs(work.residual[at]);
        if (!(error <= worst[n])) worst[n] = error;  // NaN too
      }
  });
  double error = 0;
  for (const double w : worst)
    if (!(w <= error)) error = w;
  return error;
}

void SteadyBody::iterate(const Field& contact_strain, PassState& state, const PassLimits& limits, Work& work,
                         PassResult& out) const {
  assert(contact_strain.size() == grid().path().active_size());
  assert(state.residual_strain.size() == grid().active_size());
  const SteadyGrid& g = grid();
  work.guess = state.residual_strain;
  if (limits.iterations > 0) {
    work.field.resize(g.size());
    work.residual.resize(work.guess.size());
  }
  work.after.resize(state.history.size());
  work.late.resize(g.points());
  Anderson anderson;
  for (;;) {
    if (asked_to_stop(limits.control)) throw Interrupted("stopped in a pass");
    follow(contact_strain, state, work);
    if (limits.iterations == 0) break;
    response_.apply(work.field, &out.surface, work.rows);
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
  work.balls = balls_of(contact_strain);
  PassResult out;
  iterate(contact_strain, state, limits, work, out);
  add_section(surface_before, out.surface);
  conclude(out.before, uniform_strain(state.history), state, out);
  const double most = *std::max_element(out.accumulated.begin(), out.accumulated.end());
  if (most > 0) out.late_flow = *std::max_element(work.late.begin(), work.late.end()) / most;
  return out;
}

PassResult SteadyBody::run_pass_within(const Field& before, const Field& contact_strain,
                                       const std::vector<StrainBall>& balls, PassState& state,
                                       const PassLimits& limits) const {
  constexpr double kNear = 0.05;  // of the strength, beside what neighbours that flow in this pass have added so far
  Work work;
  work.before = before;
  work.balls = balls;
  work.rows.assign(rows_.size(), state.passes == 0);
  double added = 0;
  for (const double e : state.residual_strain) added = std::max(added, std::abs(e));
  for (int n = 0; n < grid().rows() * Columns::blocks_of(grid()) && state.passes > 0; ++n) {
    const Columns columns(grid(), n);
    const auto r = static_cast<std::size_t>(columns.row);
    if (work.rows[r] || !std::isfinite(rows_[r].law.yield)) continue;
    const double near = kNear + 3 * rows_[r].law.mu * added / rows_[r].law.yield;
    work.rows[r] = !(largest_excess(columns, balls, before, state.residual_strain, state.history) <= -near);
  }
  PassResult out;
  if (std::find(work.rows.begin(), work.rows.end(), true) == work.rows.end()) {
    out.before = state.history;
    ++state.passes;
    return out;
  }
  iterate(contact_strain, state, limits, work, out);
  for (std::size_t n = 0; n < work.residual.size(); ++n) state.residual_strain[n] += work.residual[n];
  return out;
}

std::vector<std::vector<StationState>> SteadyBody::streamlines(const Field& contact_strain, const PassResult& result,
                                                               const PassState& state,
                                                               const std::vector<std::size_t>& points) const {
  assert(contact_strain.size() == grid().path().active_size());
  assert(std::all_of(points.begin(), points.end(), [&](std::size_t n) { return n < grid().points(); }));
  const SteadyGrid& g = grid();
  const Field before = uniform_strain(result.before);
  std::vector<std::vector<StationState>> out(points.size(), std::vector<StationState>(between_.size()));
  for (std::size_t p = 0; p < points.size(); ++p) {
    const int r = static_cast<int>(points[p]) / g.ny, j = static_cast<int>(points[p]) % g.ny, lane = j % kLanes;
    const Columns columns(g, r * Columns::blocks_of(g) + j / kLanes);
    const RowModuli& moduli = rows_[static_cast<std::size_t>(r)].moduli;
    Pack h[kStreamlineHistory]{};
    for (int l = 0; l < columns.count; ++l)
      for (int k = 0; k < kStreamlineHistory; ++k)
        h[k][l] = result.before[g.point(r, columns.first + l) * kStreamlineHistory + static_cast<std::size_t>(k)];
    take_law(columns, contact_strain, before, state.residual_strain, h, [&](int k, const Pack(&strain)[6]) {
      StationState& at = out[p][static_cast<std::size_t>(k)];
      Pack stress[6];
      plastic_stress(moduli.lambda, moduli.mu, strain, h, stress);
      for (std::size_t c = 0; c < 6; ++c) {
        at.strain[c] = strain[c][lane];
        at.stress[c] = stress[c][lane];
      }
      at.accumulated = h[6][lane];
    });
  }
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
