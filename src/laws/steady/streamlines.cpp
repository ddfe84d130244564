// The law along streamlines, for the passes of steady_pass.cpp.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "core/parallel.hpp"
#include "material/strain_claim.hpp"
#include "steady/steady_work.hpp"

namespace railstrata {

namespace {

constexpr int kNewtonSteps = 6;        // strains change by up to some 1e-3 from place to place
constexpr double kFar = 0.25;          // of the yield strength: less is far below it
constexpr double kMostBetween = 1.25;  // sum of the weights' magnitudes between stations, at most

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

/// Histories of neighbouring columns.
void take_histories(const double* from, int count, Pack* h) {
  for (int l = 0; l < count; ++l)
    for (int k = 0; k < kStreamlineHistory; ++k) h[k][l] = from[l * kStreamlineHistory + k];
}

void give_histories(const Pack* h, int count, double* to) {
  for (int l = 0; l < count; ++l)
    for (int k = 0; k < kStreamlineHistory; ++k) to[l * kStreamlineHistory + k] = h[k][l];
}

/// Stations between which the contact of some of these points is not far.
struct NearStations {
  int from = 0, to = 0;
  NearStations(const StrainBall* balls, int count, int steps) : from(balls->first / steps) {
    for (const StrainBall* ball = balls; ball != balls + count; ++ball) {
      from = std::min(from, ball->first / steps);
      to = std::max(to, (ball->last + steps - 1) / steps);
    }
  }
};

void take_deviator(double (&e)[6]) {
  const double mean = (e[0] + e[1] + e[2]) / 3;
  for (int c = 0; c < 3; ++c) e[c] -= mean;
}

/// Some columns of a row of a field at active stations (SteadyGrid::active_index), of a grid or its path.
class AlongColumns {
 public:
  AlongColumns(const SteadyGrid& g, const Field& field, int row, int first, int count)
      : component_(field.size() / 6),
        station_(static_cast<std::size_t>(g.ny)),
        begin_(field.data() + component_ / g.thickness.size() * static_cast<std::size_t>(row) + first),
        end_(field.data() + field.size()),
        count_(count) {
    for (int l = 0; l < count; ++l) mask_[l] = 1;
  }
  Pack operator()(int component, int station) const {
    const double* p =
        begin_ + static_cast<std::size_t>(component) * component_ + static_cast<std::size_t>(station) * station_;
    return end_ - p < kLanes ? take_lanes(p, count_) : load(p) * mask_;
  }

 private:
  std::size_t component_, station_;
  const double *begin_, *end_;
  int count_;
  Pack mask_{};
};

}  // namespace

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

ContactPath SteadyBody::path_of(const Field& contact_strain) const {
  assert(contact_strain.size() == grid().path().active_size());
  ContactPath out{balls_of(contact_strain), {}};
  const SteadyGrid g = grid().path();
  const std::size_t places = between_.size();
  const int blocks = g.rows() * Columns::blocks_of(g);
  out.strain.resize(places * static_cast<std::size_t>(blocks) * 6 * kLanes);
  for_each(blocks, [&](std::ptrdiff_t n) {
    const Columns columns(g, n);
    for (std::size_t k = 0; k < places; ++k)
      for (int c = 0; c < 6; ++c)
        store(out.strain.data() + columns.place(g, places, k) + c * kLanes,
              take_lanes(contact_strain.data() + g.active_index(c, columns.row, static_cast<int>(k), columns.first),
                         columns.count));
  });
  return out;
}

std::vector<StrainBall> SteadyBody::balls_of(const Field& contact_strain) const {
  const SteadyGrid g = grid().path();
  const int active = g.active_stations();
  const auto columns = static_cast<std::size_t>(g.ny);
  std::vector<StrainBall> out(g.points());
  for_each(static_cast<std::ptrdiff_t>(g.points()), [&](std::ptrdiff_t n) {
    const int r = static_cast<int>(n / g.ny), j = static_cast<int>(n % g.ny);
    std::array<double, 6> least, most;
    least.fill(std::numeric_limits<double>::infinity());
    most.fill(-std::numeric_limits<double>::infinity());
    const auto deviator = [&](int i, double(&e)[6]) {
      for (int c = 0; c < 6; ++c)
        e[c] = contact_strain[static_cast<std::size_t>((c * g.rows() + r) * active + i) * columns + j];
      take_deviator(e);
    };
    double e[6];
    for (int i = 0; i < active; ++i) {
      deviator(i, e);
      for (std::size_t c = 0; c < 6; ++c) {
        least[c] = std::min(least[c], e[c]);
        most[c] = std::max(most[c], e[c]);
      }
    }
    StrainBall& ball = out[static_cast<std::size_t>(n)];
    for (std::size_t c = 0; c < 6; ++c) ball.middle[c] = 0.5 * (least[c] + most[c]);
    for (int i = 0; i < active; ++i) {
      deviator(i, e);
      for (std::size_t c = 0; c < 6; ++c) e[c] -= ball.middle[c];
      const double size = equivalent_strain(e);
      if (!(size <= ball.radius)) ball.radius = size;  // NaN too
    }
    const PlasticParameters<double>& law = rows_[static_cast<std::size_t>(r)].law;
    const auto far = [&](int i) {
      deviator(i, e);
      return 3 * law.mu * equivalent_strain(e) < kFar * law.yield;
    };
    ball.last = active;
    while (ball.first < active && far(ball.first)) ++ball.first;
    while (ball.last > ball.first && far(ball.last - 1)) --ball.last;
  });
  return out;
}

SteadyBody::Surroundings::Surroundings(const SteadyBody& body, const Columns& columns, const Field& before,
                                       const Field& guess_of_pass)
    : guess(guess_of_pass) {
  const SteadyGrid& g = body.grid();
  const auto [r, first, count] = columns;
  for (std::size_t c = 0; c < 6; ++c)
    always[c] = take_lanes(before.data() + c * g.points() + g.point(r, first), count) + body.initial_strain_[r][c];
  const AlongColumns along(g, guess, r, first, count);
  Pack largest{};
  for (int i = 0, active = g.active_stations(); i < active; ++i) {
    Pack e[6];
    for (int c = 0; c < 6; ++c) e[c] = along(c, i);
    const Pack square = double_contraction(e, e);
    largest = square > largest ? square : largest;
  }
  most = kMostBetween * square_root(2.0 / 3 * largest);
}

/// An upper bound of the yield condition f over the strength, all along the columns, as long as nothing flows.
double SteadyBody::largest_excess(const Columns& columns, const std::vector<StrainBall>& balls,
                                  const Surroundings& around, const std::vector<double>& history) const {
  const auto [r, first, count] = columns;
  const PlasticParameters<double>& law = rows_[static_cast<std::size_t>(r)].law;
  double out = -std::numeric_limits<double>::infinity();
  for (int l = 0; l < count; ++l) {
    const std::size_t point = grid().point(r, first + l);
    const double* h = history.data() + point * kStreamlineHistory;
    double e[6];
    for (int c = 0; c < 6; ++c) e[c] = around.always[c][l];
    take_deviator(e);
    for (std::size_t c = 0; c < 6; ++c) {
      e[c] += balls[point].middle[c] - h[c];
      for (int k = 0; k < terms_[r]; ++k) e[c] -= h[7 + 6 * k + static_cast<int>(c)] / (2 * law.mu);
    }
    const double strength = law.yield + law.saturation * saturated_share(law.rate * h[6]);
    const double size = equivalent_strain(e) + balls[point].radius + around.most[l];
    const double excess = 3 * law.mu * size / strength - 1;
    if (!(excess <= out)) out = excess;  // NaN too
  }
  return out;
}

/// Whether nothing flows where the contact is far (StrainBall::first, last).
bool SteadyBody::rests(const Columns& columns, const Surroundings& around, const Pack* history) const {
  const PlasticParameters<double>& law = rows_[static_cast<std::size_t>(columns.row)].law;
  Pack e[6];
  const Pack mean = (around.always[0] + around.always[1] + around.always[2]) / 3.0;
  for (int c = 0; c < 6; ++c) {
    e[c] = around.always[c] - history[c];
    if (c < 3) e[c] -= mean;
    for (int k = 0; k < terms_[columns.row]; ++k) e[c] -= history[7 + 6 * k + c] / (2 * law.mu);
  }
  const Pack size = square_root(2.0 / 3 * double_contraction(e, e)) + around.most;
  const Pack strength = law.yield + law.saturation * saturated_share(law.rate * history[6]);
  return !any_positive(3 * law.mu * size + kFar * law.yield - strength);
}

/// visit(k, strain): after place k of the path, of those from `from` to `to`.
template <class Visit>
void SteadyBody::take_law(const Columns& columns, const ContactPath& contact, const Surroundings& around, int from,
                          int to, Pack* history, Visit&& visit) const {
  const SteadyGrid& g = grid();
  const auto [r, first, count] = columns;
  const AlongColumns residual(g, around.guess, r, first, count);
  const SteadyRow& row = rows_[static_cast<std::size_t>(r)];
  const bool flows = std::isfinite(row.law.yield);
  Pack beside[4][6];  // strain at the four stations around
  for (int k = from; k < to; ++k) {
    const Between& at = between_[static_cast<std::size_t>(k)];
    if (k == from || at.station[3] != between_[static_cast<std::size_t>(k - 1)].station[3] ||
        at.station[0] != between_[static_cast<std::size_t>(k - 1)].station[0])
      for (int n = 0; n < 4; ++n)
        for (int c = 0; c < 6; ++c) beside[n][c] = residual(c, at.station[n]);
    const double* there = contact.strain.data() + columns.place(g, between_.size(), static_cast<std::size_t>(k));
    Pack e[6];
    for (int c = 0; c < 6; ++c) {
      e[c] = around.always[c] + load(there + c * kLanes);
      for (int n = 0; n < 4; ++n) e[c] += at.weight[n] * beside[n][c];
    }
    if (flows) advance(row.law, terms_[r], e, history);
    visit(k, e);
  }
}

void SteadyBody::follow(const ContactPath& contact, const PassState& state, Work& work) const {
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
        const int r = columns.row, first = columns.first, count = columns.count;
        const std::size_t point = g.point(r, first);
        const double* begin = state.history.data() + point * kStreamlineHistory;
        double* end = work.after.data() + point * kStreamlineHistory;
        std::copy_n(begin, count * kStreamlineHistory, end);
        if (!work.follows(r)) return;
        const Surroundings around(*this, columns, work.before, work.guess);
        const bool yields = std::isfinite(rows_[static_cast<std::size_t>(r)].law.yield) &&
                            !(largest_excess(columns, contact.balls, around, state.history) <= 0);
        if (!yields && (!with_field || work.clean)) return;
        Pack h[kStreamlineHistory]{}, before[6], sum[6]{}, early{};
        take_histories(begin, count, h);
        std::copy_n(h, 6, before);
        early = h[6];
        const auto give = [&](int from, int to) {
          for (int c = 0; with_field && c < 6; ++c)
            for (int i = from; i < to; ++i)
              give_lanes(work.field.data() + g.index(c, r, i, first), count, share[i] * (h[c] - before[c]));
        };
        const auto follow_places = [&](int from, int to) {
          take_law(columns, contact, around, from, to, h, [&](int k, const Pack(&)[6]) {
            for (int c = 0; with_field && c < 6; ++c) sum[c] += h[c] - before[c];
            if ((k + 1) % g.steps != 0) return;
            for (int c = 0; with_field && c < 6; ++c) {
              give_lanes(work.field.data() + g.index(c, r, k / g.steps, first), count,
                         share[k / g.steps] / g.steps * sum[c]);
              sum[c] = Pack{};
            }
            if ((k + 1) / g.steps == late) early = h[6];
          });
        };
        auto [from, to] = NearStations(contact.balls.data() + point, count, g.steps);
        if (yields) {
          if (!rests(columns, around, h)) from = 0;
          if (!work.clean) give(0, from);
          follow_places(from * g.steps, to * g.steps);
          if (to <= late) early = h[6];
          if (to < active && !rests(columns, around, h)) {
            follow_places(to * g.steps, active * g.steps);
            to = active;
          }
        }
        give(yields ? to : 0, g.nx);
        give_lanes(work.late.data() + point, count, h[6] - early);
        if (yields) give_histories(h, count, end);
      },
      true);
}

std::vector<std::vector<StationState>> SteadyBody::streamlines(const Field& contact_strain, const PassResult& result,
                                                               const PassState& state,
                                                               const std::vector<std::size_t>& points) const {
  assert(contact_strain.size() == grid().path().active_size());
  assert(std::all_of(points.begin(), points.end(), [&](std::size_t n) { return n < grid().points(); }));
  const SteadyGrid& g = grid();
  const Field before = uniform_strain(result.before);
  const ContactPath contact = path_of(contact_strain);
  std::vector<std::vector<StationState>> out(points.size(), std::vector<StationState>(between_.size()));
  for (std::size_t p = 0; p < points.size(); ++p) {
    const int r = static_cast<int>(points[p]) / g.ny, j = static_cast<int>(points[p]) % g.ny, lane = j % kLanes;
    const Columns columns(g, r * Columns::blocks_of(g) + j / kLanes);
    const RowModuli& moduli = rows_[static_cast<std::size_t>(r)].moduli;
    Pack h[kStreamlineHistory]{};
    take_histories(result.before.data() + g.point(r, columns.first) * kStreamlineHistory, columns.count, h);
    const Surroundings around(*this, columns, before, state.residual_strain);
    const int places = static_cast<int>(between_.size());
    take_law(columns, contact, around, 0, places, h, [&](int k, const Pack(&strain)[6]) {
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

}  // namespace railstrata
