#include "clock/worn_profile.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "collective/worn_points.hpp"

namespace railstrata {
namespace {

/// Linear between points that increase, the end's value beyond them.
double between(const std::vector<double>& x, const std::vector<double>& values, double at) {
  if (at <= x.front()) return values.front();
  if (at >= x.back()) return values.back();
  const auto i = static_cast<std::size_t>(std::upper_bound(x.begin(), x.end(), at) - x.begin());
  const double share = (at - x[i - 1]) / (x[i] - x[i - 1]);
  return (1 - share) * values[i - 1] + share * values[i];
}

}  // namespace

WornProfile::WornProfile(const Placement& unworn, double cell) : unworn_(unworn), profile_(unworn.rail) {
  const Profile& rail = unworn_.rail;
  const double length = rail.s_max() - rail.s_min();
  const int n = static_cast<int>(std::ceil(length / cell));
  for (int i = 0; i <= n; ++i) {
    const double s = i < n ? rail.s_min() + length * i / n : rail.s_max();
    unworn_s_.push_back(s);
    now_.points.push_back(rail.at(s).position);
  }
  now_.day_s = unworn_s_;
  now_.removed.assign(now_.points.size(), 0.0);
}

double WornProfile::day_s(double unworn_s) const { return between(unworn_s_, now_.day_s, unworn_s); }
double WornProfile::unworn_s_of(double day_s) const { return between(now_.day_s, unworn_s_, day_s); }
double WornProfile::removed_at(double unworn_s) const { return between(unworn_s_, now_.removed, unworn_s); }

void WornProfile::wear(const ProfileWear& cells, const std::vector<double>& depth) {
  std::vector<double> of_points;
  for (const double s : now_.day_s) of_points.push_back(between(cells.s, depth, s));
  of_points.front() = of_points.back() = 0;  // the ends stay
  move(of_points);
}

void WornProfile::grind(double depth) { move(std::vector<double>(now_.points.size(), depth)); }

/// Makes the profile through the points; they, in its frame.
std::vector<Vec2> WornProfile::shape() {
  std::vector<Vec2> own = in_own_frame(now_.points);
  profile_ = worn_profile(own);
  return own;
}

void WornProfile::stand(WornSurface before) {
  now_ = std::move(before);
  if (now_.moved) shape();
}

void WornProfile::move(const std::vector<double>& depth) {
  for (std::size_t i = 0; i < now_.points.size(); ++i) {
    now_.points[i] = now_.points[i] - depth[i] * profile_.at(now_.day_s[i]).outward;
    now_.removed[i] += depth[i];
  }
  now_.moved = true;
  const std::vector<Vec2> own = shape();
  for (std::size_t i = 0; i < own.size(); ++i) now_.day_s[i] = nearest_on(profile_, own[i], now_.day_s[i]);
  if (has_gauge(unworn_)) now_.gauge_widening = ::railstrata::gauge_widening(profile_, unworn_);
}

}  // namespace railstrata
