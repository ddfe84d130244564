#include "passes/metal.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/parallel.hpp"
#include "material/strain_claim.hpp"

namespace railstrata {
namespace {

constexpr std::size_t kHistory = kStreamlineHistory;
// The answer of the body around a pass takes most of its time and hardly changes from call to call.
constexpr int kFirst = 4;  // its iterations in a kind's first pass
constexpr int kEvery = 4;  // then one in each fourth pass, whose guess goes on

SteadyGrid section_grid(const MetalGrid& g) {
  SteadyGrid out;
  out.nx = 1;
  out.ny = g.columns;
  out.dx = out.dy = g.apart;
  out.y0 = g.from;
  out.thickness = g.thickness;
  return out;
}

double norm_weight(std::size_t component) { return component < 3 ? 1 : std::numbers::sqrt2; }

}  // namespace

/// A patch of a kind of wheels with what it needs for its passes.
struct Metal::Kind {
  explicit Kind(MetalWheel w)
      : wheel(std::move(w)),
        body(wheel.rail.grid, wheel.rail.rows, wheel.rail.below, wheel.rail.initial_stress),
        contact(body.path_of(contact_strain(wheel.rail, body, wheel.rail.contact_stress.at(0)))),
        state(body.virgin()) {
    wheel.rail.contact_stress.clear();
  }
  /// The metal's point of its own; none beside the metal.
  std::optional<std::size_t> of_metal(std::size_t own, int columns) const {
    const auto ny = static_cast<std::size_t>(wheel.rail.grid.ny);
    const std::ptrdiff_t column = wheel.column + static_cast<std::ptrdiff_t>(own % ny);
    if (column < 0 || column >= columns) return {};
    return own / ny * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
  }

  MetalWheel wheel;
  SteadyBody body;
  ContactPath contact;
  PassState state;              ///< its guess goes on from call to call
  std::vector<double> changes;  ///< of the history, at its own points
};

std::size_t MetalGrid::nearest(double s) const {
  return static_cast<std::size_t>(std::lround(std::clamp((s - from) / apart, 0.0, columns - 1.0)));
}

std::vector<double> MetalGrid::depths() const {
  std::vector<double> out;
  double top = 0;
  for (const double t : thickness) {
    out.push_back(top + 0.5 * t);
    top += t;
  }
  return out;
}

MetalGrid metal_grid(double from, double to, double apart, double first, double deepest) {
  constexpr double kGrowth = 0.25, kThickest = 1e-3;  // m
  constexpr int kMultiple = 8;
  MetalGrid out;
  out.apart = apart;
  out.columns = kMultiple * static_cast<int>(std::ceil((to - from) / apart / kMultiple));
  out.from = 0.5 * (from + to - (out.columns - 1) * apart);
  for (double top = 0; top < deepest; top += out.thickness.back())
    out.thickness.push_back(std::min(kThickest, first + kGrowth * top));
  return out;
}

Metal::Metal(MetalGrid grid, double ductility)
    : grid_(std::move(grid)), ductility_(ductility), state_(grid_.points() * kHistory, 0.0) {}
Metal::~Metal() = default;
Metal::Metal(Metal&&) noexcept = default;
Metal& Metal::operator=(Metal&&) noexcept = default;

double Metal::two_mu(std::size_t point) const {
  return 2 * rows_[point / static_cast<std::size_t>(grid_.columns)].moduli.mu;
}

void Metal::put(std::vector<MetalWheel> wheels) {
  kinds_.clear();
  rows_.clear();
  section_.reset();
  kinds_.resize(wheels.size());
  for_each_that_throws(wheels.size(), [&](std::size_t k) { kinds_[k] = std::make_unique<Kind>(std::move(wheels[k])); });
  if (!kinds_.empty()) {
    const auto deepest = std::max_element(kinds_.begin(), kinds_.end(), [](const auto& a, const auto& b) {
      return a->wheel.rail.rows.size() < b->wheel.rail.rows.size();
    });
    rows_ = (*deepest)->wheel.rail.rows;
    rows_.resize(grid_.thickness.size(), rows_.back());
    std::vector<RowModuli> moduli;
    for (const SteadyRow& row : rows_) moduli.push_back(row.moduli);
    section_ = std::make_unique<PlasticStrainResponse>(section_grid(grid_), moduli, (*deepest)->wheel.rail.below);
  }
  first_ = change(state_);
  pace_.clear();
}

/// Of the plastic strain of a state: what is compatible, six components by point.
std::vector<double> Metal::compatible(const std::vector<double>& state) const {
  const std::size_t points = grid_.points();
  Field strain(6 * points);
  for (std::size_t n = 0; n < points; ++n)
    for (std::size_t c = 0; c < 6; ++c) strain[c * points + n] = state[n * kHistory + c];
  section_->apply(strain);
  return {strain.begin(), strain.end()};
}

void Metal::strip(std::vector<double>& state) const {
  const std::size_t points = grid_.points();
  const std::vector<double> strain = compatible(state);
  for (std::size_t n = 0; n < points; ++n)
    for (std::size_t c = 0; c < 6; ++c) state[n * kHistory + c] -= strain[c * points + n];
}

void Metal::pass(Kind& kind, const std::vector<double>& state, const std::vector<double>& strain) const {
  PassState& own = kind.state;
  const std::size_t points = kind.body.grid().points();
  std::fill(own.history.begin(), own.history.end(), 0.0);
  Field before(6 * points, 0.0);
  for (std::size_t n = 0; n < points; ++n) {
    const std::optional<std::size_t> at = kind.of_metal(n, grid_.columns);
    if (!at) continue;
    std::copy_n(state.begin() + static_cast<std::ptrdiff_t>(*at * kHistory), kHistory,
                own.history.begin() + static_cast<std::ptrdiff_t>(n * kHistory));
    for (std::size_t c = 0; c < 6; ++c) before[c * points + n] = strain[c * grid_.points() + *at];
  }
  const PassResult result = kind.body.run_pass_within(before, kind.contact, own,
                                                      {.iterations = own.passes == 0            ? kFirst
                                                                     : own.passes % kEvery == 0 ? 1
                                                                                                : 0});
  kind.changes.resize(own.history.size());
  for (std::size_t i = 0; i < own.history.size(); ++i) kind.changes[i] = own.history[i] - result.before[i];
}

void Metal::add_pace(const std::vector<double>& state, const std::vector<double>& flowing, StateChange& change) const {
  // one pace for all plastic strain, else a step would tear what is compatible
  const double fastest = *std::max_element(flowing.begin(), flowing.end());
  for (std::size_t n = 0; n < flowing.size(); ++n) {
    const SteadyRow& row = rows_[n / static_cast<std::size_t>(grid_.columns)];
    const auto terms =
        std::count_if(row.law.modulus, row.law.modulus + kMostBackstresses, [](double c) { return c > 0; });
    double* pace = change.pace.data() + n * kHistory;
    std::fill_n(pace, 6, fastest);
    if (!(flowing[n] > 0)) continue;
    const double flow = change.mean[n * kHistory + 6] / flowing[n];
    for (int k = 0; k < kMostBackstresses; ++k) {
      const double slow = static_cast<double>(terms + 1) * row.law.modulus[k] / (3 * row.moduli.mu);
      const double recalled = most_recalled(row.law, k, state.data() + n * kHistory + 7 + 6 * k, flow);
      std::fill_n(pace + 7 + 6 * k, 6, flowing[n] * (std::min(1.0, slow) + recalled));
    }
  }
}

StateChange Metal::change(const std::vector<double>& given) {
  StateChange out{.mean = std::vector<double>(given.size(), 0.0), .pace = std::vector<double>(given.size(), 0.0)};
  const std::size_t points = grid_.points();
  flow_ = {std::vector<double>(points, 0.0), std::vector<std::array<double, 3>>(points), {}};
  if (kinds_.empty()) return out;
  const std::vector<double> strain = compatible(given);
  for_each_that_throws(kinds_.size(), [&](std::size_t k) { pass(*kinds_[k], given, strain); });
  std::vector<double> flowing(points, 0.0);  // share of the wheels
  for (const auto& kind : kinds_) {
    std::vector<double>& flowed = flow_.flowed.emplace_back(points, 0.0);
    for (std::size_t own = 0; own < kind->body.grid().points(); ++own) {
      const std::optional<std::size_t> n = kind->of_metal(own, grid_.columns);
      const double* changes = kind->changes.data() + own * kHistory;
      if (!n || changes[6] == 0) continue;
      for (std::size_t c = 0; c < kHistory; ++c) out.mean[*n * kHistory + c] += kind->wheel.share * changes[c];
      flowed[*n] = changes[6];
      flowing[*n] += kind->wheel.share;
      if (changes[6] < kNoFlow || !(ductility_ > 0)) continue;
      for (std::size_t v = 0; v < kLowCycleExponents.size(); ++v)
        flow_.cycles[*n][v] +=
            kind->wheel.share / std::max(low_cycle_life(changes[6], ductility_, kLowCycleExponents[v]), 1.0);
    }
  }
  add_pace(given, flowing, out);
  double sum = 0;
  for (std::size_t n = 0; n < points; ++n) {
    flow_.net[n] = equivalent_strain(out.mean.data() + n * kHistory);
    for (std::size_t c = 0; c < 6; ++c) sum += std::pow(two_mu(n) * norm_weight(c) * out.mean[n * kHistory + c], 2);
  }
  out.flow = std::sqrt(sum);
  strip(out.mean);
  return out;
}

std::vector<Sym3> Metal::residual(std::size_t column) const {
  std::vector<Sym3> out(grid_.thickness.size());
  if (!section_) return out;
  const std::vector<double> strain = compatible(state_);
  const std::size_t points = grid_.points();
  const std::size_t columns = static_cast<std::size_t>(grid_.columns);
  const auto add = [&](std::size_t at, double weight) {
    for (std::size_t r = 0; r < out.size(); ++r) {
      const std::size_t n = r * columns + at;
      const auto [lambda, mu] = rows_[r].moduli;
      const double mean = lambda * (strain[n] + strain[points + n] + strain[2 * points + n]);
      std::array<double, 6> stress{};
      for (std::size_t c = 0; c < 6; ++c)
        stress[c] = (c < 3 ? mean : 0) + 2 * mu * (strain[c * points + n] - state_[n * kHistory + c]);
      out[r] = out[r] + weight * Sym3{stress[0], stress[1], stress[2], stress[3], stress[4], stress[5]};
    }
  };
  add((column + columns - 1) % columns, 0.25);
  add(column, 0.5);
  add((column + 1) % columns, 0.25);
  return out;
}

SettledState Metal::roll(double wheels, const SettleLimits& limits) {
  if (kinds_.empty() || first_.flow == 0) return {.state = state_, .change = first_};
  const std::size_t points = grid_.points();
  std::vector<double> scale(state_.size(), 0.0);
  for (std::size_t n = 0; n < points; ++n)
    for (std::size_t c = 0; c < 6; ++c) {
      scale[n * kHistory + c] = two_mu(n) * norm_weight(c);
      for (std::size_t k = 0; k < kMostBackstresses; ++k) scale[n * kHistory + 7 + 6 * k + c] = norm_weight(c);
    }
  if (!pace_.empty())  // points that flowed on the way before count from the first change on
    std::transform(pace_.begin(), pace_.end(), first_.pace.begin(), first_.pace.begin(),
                   [](double a, double b) { return std::max(a, b); });
  SettledState out = settle(
      state_, first_, wheels, scale, [&](const std::vector<double>& state) { return change(state); }, limits);
  state_ = out.state;
  first_ = out.change;
  pace_ = out.pace;
  return out;
}

void Metal::sink(const std::vector<double>& removed) {
  const std::vector<double> depths = grid_.depths();
  const auto columns = static_cast<std::size_t>(grid_.columns);
  std::vector<double> sunk(state_.size(), 0.0);
  for (std::size_t r = 0; r < depths.size(); ++r)
    for (std::size_t c = 0; c < columns; ++c) {
      const double z = depths[r] + removed[c];
      const auto next = std::upper_bound(depths.begin(), depths.end(), z);
      if (next == depths.end()) continue;
      const auto below = static_cast<std::size_t>(std::max<std::ptrdiff_t>(next - depths.begin(), 1)),
                 above = below - 1;
      const double share = (z - depths[above]) / (depths[below] - depths[above]);
      for (std::size_t i = 0; i < kHistory; ++i)
        sunk[(r * columns + c) * kHistory + i] = (1 - share) * state_[(above * columns + c) * kHistory + i] +
                                                 share * state_[(below * columns + c) * kHistory + i];
    }
  state_ = std::move(sunk);
  kinds_.clear();
}

}  // namespace railstrata
