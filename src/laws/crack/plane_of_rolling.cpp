#include "crack/plane_of_rolling.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "crack/interval.hpp"

namespace railstrata {

Interval interval_of(const std::vector<double>& of, double value) {
  if (of.size() < 2 || value <= of.front()) return {};
  const auto above = std::upper_bound(of.begin(), of.end(), value) - of.begin();
  const int high = static_cast<int>(std::min<std::ptrdiff_t>(above, static_cast<std::ptrdiff_t>(of.size()) - 1));
  const double from = of[static_cast<std::size_t>(high) - 1], width = of[static_cast<std::size_t>(high)] - from;
  return {high - 1, high, width > 0 ? std::min(1.0, (value - from) / width) : 1};
}

LineTraction traction_on(const PlaneStress& s, double angle) {
  const double c = std::cos(2 * angle), d = std::sin(2 * angle), mean = 0.5 * (s.xx + s.zz), half = 0.5 * (s.zz - s.xx);
  return {mean + half * c - s.xz * d, half * d + s.xz * c};
}

PlaneOfRolling::PlaneOfRolling(StressHistory history, double y, double azimuth, std::vector<Sym3> residual)
    : history_(std::move(history)), y_(y), azimuth_(azimuth), residual_(std::move(residual)) {
  check_residual(history_, residual_);
}

Sym3 PlaneOfRolling::in_row(int row, double x, double y) const {
  const Interval column = interval_of(history_.y, y), sample = interval_of(history_.x, x);
  const Sym3 *a = history_.cycle(row, column.low), *b = history_.cycle(row, column.high);
  const Sym3 found = column.of(sample.of(a[sample.low], a[sample.high]), sample.of(b[sample.low], b[sample.high]));
  const double middle = 0.5 * (behind() + ahead()), half = 0.5 * (ahead() - behind()), away = std::abs(x - middle);
  return (away > half ? half * half / (away * away) : 1) * found + residual_of(residual_, row);
}

double PlaneOfRolling::along(double h) const { return h * std::cos(azimuth_); }

PlaneStress PlaneOfRolling::at(double h, double depth, double wheel) const {
  const double c = std::cos(azimuth_), s = std::sin(azimuth_), x = h * c - wheel, y = y_ + h * s;
  const Interval row = interval_of(history_.depth, depth);
  const Sym3 t = row.of(in_row(row.low, x, y), in_row(row.high, x, y));
  return {c * c * t.xx + 2 * c * s * t.xy + s * s * t.yy, t.zz, c * t.xz + s * t.yz};
}

}  // namespace railstrata
