#include "damage/life.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace railstrata {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

/// Damage at depth j in a unit of traffic.
double rate_at(const DamagedPlace& place, std::size_t j) {
  double out = 0;
  for (const KindDamage& kind : place.kinds) out += kind.wheels * kind.rate[j];
  return out;
}

/// A table of the depths at z.
double at_depth(const std::vector<double>& depth, const std::vector<double>& values, double z) {
  if (z <= depth.front()) return values.front();
  if (z >= depth.back()) return z > depth.back() ? 0 : values.back();
  const auto above = static_cast<std::size_t>(std::upper_bound(depth.begin(), depth.end(), z) - depth.begin());
  const double share = (z - depth[above - 1]) / (depth[above] - depth[above - 1]);
  return (1 - share) * values[above - 1] + share * values[above];
}

/// Points of the zone to follow: those that come to the surface until so much is removed, and below them.
std::vector<double> points_of(const DamagedPlace& place, double removed) {
  constexpr int kPoints = 300;
  std::vector<double> all;
  for (int p = 0; p <= kPoints; ++p) all.push_back(removed * p / kPoints);
  for (const double z : place.depth) all.insert(all.end(), {z, removed + z});
  std::vector<double> out{place.top};
  for (const double z : all)
    if (z > place.top && z <= place.bottom) out.push_back(z);
  return out;
}

/// Follows points of the zone until `end`, in steps that are short in the beginning. failed(depth below the new
/// surface, when, depth at that time) of every point that has failed, in each step that it is there; true: a last step.
template <class Failed>
void follow(const DamagedPlace& place, const Removal& removal, double end, Failed&& failed) {
  constexpr int kSteps = 300;
  const std::vector<double> z0 = points_of(place, removal.after(end));
  std::vector<double> damage(z0.size(), 0.0);
  std::vector<double> rate(place.depth.size());
  for (std::size_t j = 0; j < rate.size(); ++j) rate[j] = rate_at(place, j);
  double since = 0, removed = 0;
  for (int k = 1; k <= kSteps; ++k) {
    const double t = end * k * k / (kSteps * kSteps), then = removal.after(t);
    bool enough = false;
    for (std::size_t p = 0; p < z0.size(); ++p) {
      if (z0[p] < removed || (z0[p] == removed && then > removed)) continue;
      const double gone = std::min(then, z0[p]);  // what is removed of the point's way to the surface in this step
      const double there = then > removed ? (gone - removed) / (then - removed) : 1, was = damage[p],
                   depth = z0[p] - gone;
      const double more = there * (t - since) * at_depth(place.depth, rate, z0[p] - 0.5 * (removed + gone));
      damage[p] += more;
      if (damage[p] < 1) continue;
      const double when = since + (t - since) * there * std::clamp((1 - was) / more, 0.0, 1.0);
      enough = failed(z0[p], when, depth) || enough;
    }
    if (enough) return;
    since = t;
    removed = then;
  }
}

/// The first of the depths that fails with nothing removed.
Failure unworn_failure(const DamagedPlace& place, double from_depth, double to_depth) {
  Failure out;
  const std::vector<double> when = failures_by_depth(place);
  for (std::size_t j = 0; j < when.size(); ++j)
    if (place.depth[j] >= from_depth && place.depth[j] <= to_depth && when[j] < out.traffic)
      out = {when[j], place.depth[j]};
  return out;
}

}  // namespace

double cycles_to_failure(double used, const SigmaN& line, BelowLimit below) {
  if (!(used > 0)) return kNever;
  const double exponent = used >= 1 || below == BelowLimit::as_above ? line.exponent
                          : below == BelowLimit::flatter             ? 2 * line.exponent - 1
                                                                     : kNever;
  return exponent == kNever ? kNever : line.cycles * std::pow(used, -exponent);
}

double fatigue_rate(double used, const SigmaN& line, std::size_t variant) {
  constexpr std::array kBelow{BelowLimit::as_above, BelowLimit::flatter, BelowLimit::endures};
  constexpr std::array kSums{1.0 / 3, 1.0, 3.0};
  return 1 / cycles_to_failure(used, line, kBelow[variant]) / kSums[variant];
}

double Removal::after(double t) const { return wear * t + (every > 0 ? depth * std::floor(t / every) : 0); }

double Removal::until(double removed) const {
  if (!(mean() > 0)) return kNever;
  if (every <= 0 || depth <= 0) return removed / wear;
  // In the period in which it is reached, by wear or by the grinding at its end.
  const double a_period = wear * every + depth, periods = std::floor(removed / a_period);
  const double left = removed - periods * a_period;
  if (left <= 0) return periods * every;
  return periods * every + (wear > 0 ? std::min(left / wear, every) : every);
}

std::vector<double> failures_by_depth(const DamagedPlace& place) {
  std::vector<double> out;
  for (std::size_t j = 0; j < place.depth.size(); ++j) out.push_back(1 / rate_at(place, j));
  return out;
}

Failure first_failure(const DamagedPlace& place, const Removal& removal, double from_depth, double to_depth) {
  const Failure unworn = unworn_failure(place, 0, kNever);
  if (!(removal.mean() > 0)) return unworn_failure(place, from_depth, to_depth);
  if (!(unworn.traffic < kNever)) return {};
  // Beyond this every point of the zone, or all that is damaged, has come to the surface and gone.
  const double last = removal.until(std::min(place.bottom, 2 * place.depth.back())) + removal.every;
  for (double end = std::min(2 * unworn.traffic, last);; end = std::min(3 * end, last)) {
    Failure found;
    follow(place, removal, end, [&](double, double when, double depth) {
      if (depth < from_depth || depth > to_depth) return false;
      if (when < found.traffic) found = {when, depth};
      return true;
    });
    if (found.traffic < kNever || end >= last) return found;
  }
}

std::map<double, double> failures_until(const DamagedPlace& place, const Removal& removal, double end) {
  std::map<double, double> out;
  follow(place, removal, end, [&](double below_new, double when, double) {
    out.emplace(below_new, when);
    return false;
  });
  return out;
}

}  // namespace railstrata
