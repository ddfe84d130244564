#include "clock/worn_profile.hpp"

#include <algorithm>
#include <cmath>

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

WornProfile::WornProfile(const Placement& unworn, double cell)
    : unworn_(unworn.rail),
      profile_(unworn.rail),
      track_(unworn.track),
      has_gauge_(!unworn.wheel.primitive() && !unworn.rail.primitive()) {
  const double length = unworn_.s_max() - unworn_.s_min();
  const int n = static_cast<int>(std::ceil(length / cell));
  for (int i = 0; i <= n; ++i) {
    const double s = i < n ? unworn_.s_min() + length * i / n : unworn_.s_max();
    unworn_s_.push_back(s);
    points_.push_back(unworn_.at(s).position);
  }
  day_s_ = unworn_s_;
  removed_.assign(points_.size(), 0.0);
}

double WornProfile::day_s(double unworn_s) const { return between(unworn_s_, day_s_, unworn_s); }
double WornProfile::unworn_s_of(double day_s) const { return between(day_s_, unworn_s_, day_s); }
double WornProfile::removed_at(double unworn_s) const { return between(unworn_s_, removed_, unworn_s); }

void WornProfile::wear(const ProfileWear& cells, const std::vector<double>& depth) {
  std::vector<double> of_points;
  for (const double s : day_s_) of_points.push_back(between(cells.s, depth, s));
  of_points.front() = of_points.back() = 0;  // the ends stay
  move(of_points);
}

void WornProfile::grind(double depth) { move(std::vector<double>(points_.size(), depth)); }

void WornProfile::move(const std::vector<double>& depth) {
  for (std::size_t i = 0; i < points_.size(); ++i) {
    points_[i] = points_[i] - depth[i] * profile_.at(day_s_[i]).outward;
    removed_[i] += depth[i];
  }
  // a profile's frame has z = 0 at y = 0
  const double crown = Profile::from_points(ProfileKind::rail, "worn", points_).height(0);
  std::vector<Vec2> own = points_;
  for (Vec2& p : own) p.z -= crown;
  profile_ = Profile::from_points(ProfileKind::rail, "worn", own);
  for (std::size_t i = 0; i < own.size(); ++i) day_s_[i] = nearest_on(profile_, own[i], day_s_[i]);
  if (has_gauge_) widening_ = 2 * (gauge_face_y(profile_, track_) - gauge_face_y(unworn_, track_));
}

}  // namespace railstrata
