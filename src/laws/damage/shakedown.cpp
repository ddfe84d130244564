#include "damage/shakedown.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>
#include <string>

#include "core/faults.hpp"
#include "core/parallel.hpp"
#include "damage/deviator.hpp"
#include "damage/enclosing_ball.hpp"

namespace railstrata {
namespace {

constexpr FreeDirections kResidualOfDepth = free_directions(0, 1), kResidualAtSurface = free_directions(0, 1, 3);

/// The strength that a row asks for, and the point that asks for most.
struct Need {
  double strength = 0;
  int column = -1;
  void take(double s, int c) {
    if (s > strength || column < 0) *this = {s, c};
  }
};

struct RowNeeds {
  Need first_yield, wandering, upper, kinematic;
  Need soonest;  ///< `strength` is the least factor to first yield
};

/// The factor at which |factor u + r| reaches k: 0 where |r| does so by itself.
double factor_to_yield(const Vec5& u, const Vec5& r, double k) {
  const double uu = norm_squared(u), ur = dot(u, r), left = k * k - norm_squared(r);
  if (left <= 0) return 0;
  if (uu == 0) return std::numeric_limits<double>::infinity();
  const double root = std::sqrt(ur * ur + uu * left);
  return ur > 0 ? left / (root + ur) : (root - ur) / uu;
}

void take_ball(const EnclosingBall& ball, int column, int samples, Need& need) {
  need.take(ball.radius, column < 0 ? ball.support[ball.heaviest()] / samples : column);
}

RowNeeds needs_of_row(const ShakedownInput& in, int row, double* pointwise) {
  const StressHistory& h = in.elastic;
  const int samples = std::max(1, h.samples());  // check() has seen that there are some
  const double k = in.shear_strength[row];
  const Vec5 process = deviator(
      {.xx = in.residual_x.empty() ? 0 : in.residual_x[row], .yy = in.residual_y.empty() ? 0 : in.residual_y[row]});
  std::vector<Vec5> path(static_cast<std::size_t>(h.columns()) * h.samples());
  RowNeeds needs;
  needs.soonest.strength = std::numeric_limits<double>::infinity();
  for (int column = 0; column < h.columns(); ++column)
    for (int i = 0; i < samples; ++i) {
      const Vec5 u = deviator(h.cycle(row, column)[i]);
      path[static_cast<std::size_t>(column) * samples + i] = u;
      needs.first_yield.take(std::sqrt(norm_squared(u + process)), column);
      if (const double factor = factor_to_yield(u, process, k);
          factor < needs.soonest.strength || needs.soonest.column < 0)
        needs.soonest = {factor, column};
    }
  take_ball(enclosing_ball(path, kResidualOfDepth), -1, samples, needs.wandering);
  for (int column = 0; column < h.columns(); ++column) {
    const std::span<const Vec5> here(path.data() + static_cast<std::size_t>(column) * samples,
                                     static_cast<std::size_t>(samples));
    const EnclosingBall free = enclosing_ball(here);
    take_ball(free, column, samples, needs.kinematic);
    const EnclosingBall held = h.depth[row] > 0 ? free : enclosing_ball(here, kResidualAtSurface);
    take_ball(held, column, samples, needs.upper);
    pointwise[column] = held.radius;
  }
  return needs;
}

void check(const ShakedownInput& in) {
  const StressHistory& h = in.elastic;
  const std::size_t rows = h.depth.size();
  if (h.x.empty() || h.y.empty() || rows == 0 || h.zone.size() != rows ||
      h.stress.size() != rows * h.y.size() * h.x.size())
    throw std::invalid_argument("shakedown: the stress history is empty or its arrays do not fit each other");
  const auto fits = [rows](const std::vector<double>& v) { return v.empty() || v.size() == rows; };
  if (in.shear_strength.size() != rows || !fits(in.residual_x) || !fits(in.residual_y))
    throw std::invalid_argument("shakedown: strengths and residual stresses are one for each row of the history");
  for (const double k : in.shear_strength)
    if (k <= 0) throw std::invalid_argument("shakedown: shear strength " + std::to_string(k) + " Pa is not positive");
  for (const Sym3& s : h.stress)
    if (!std::isfinite(norm_squared(deviator(s)))) throw NumericalError("shakedown: a stress is not a number");
}

LoadFactor at(const StressHistory& h, double value, int row, const Need& need) {
  return {value, h.y[need.column], h.depth[row], h.zone[row]};
}

void keep_smaller(LoadFactor& kept, const LoadFactor& other) {
  if (other.value < kept.value) kept = other;
}

ZoneFactors& zone_of(std::vector<ZoneFactors>& zones, int zone) {
  for (ZoneFactors& z : zones)
    if (z.zone == zone) return z;
  zones.emplace_back().zone = zone;
  return zones.back();
}

}  // namespace

Shakedown shakedown(const ShakedownInput& in) {
  check(in);
  const StressHistory& h = in.elastic;
  Shakedown out;
  out.pointwise.resize(static_cast<std::size_t>(h.rows()) * h.y.size());
  std::vector<RowNeeds> rows(h.depth.size());
  for_each(
      h.rows(),
      [&](std::ptrdiff_t row) {
        rows[row] = needs_of_row(in, static_cast<int>(row), out.pointwise.data() + row * h.columns());
      },
      true);
  for (int row = 0; row < h.rows(); ++row) {
    const RowNeeds& needs = rows[row];
    out.required.first_yield.push_back(needs.first_yield.strength);
    out.required.wandering.push_back(needs.wandering.strength);
    out.required.upper.push_back(needs.upper.strength);
    out.required.kinematic.push_back(needs.kinematic.strength);
    ZoneFactors& zone = zone_of(out.zones, h.zone[row]);
    const double k = in.shear_strength[row];
    if (!std::isfinite(k)) continue;
    keep_smaller(zone.first_yield, at(h, needs.soonest.strength, row, needs.soonest));
    keep_smaller(zone.wandering, at(h, k / needs.wandering.strength, row, needs.wandering));
    keep_smaller(zone.upper, at(h, k / needs.upper.strength, row, needs.upper));
    keep_smaller(zone.kinematic, at(h, k / needs.kinematic.strength, row, needs.kinematic));
  }
  for (const ZoneFactors& zone : out.zones) {
    keep_smaller(out.first_yield, zone.first_yield);
    keep_smaller(out.wandering, zone.wandering);
    keep_smaller(out.upper, zone.upper);
    keep_smaller(out.kinematic, zone.kinematic);
  }
  return out;
}

}  // namespace railstrata
