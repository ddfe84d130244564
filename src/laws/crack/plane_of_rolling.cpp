#include "crack/plane_of_rolling.hpp"

#include <algorithm>
#include <cmath>

namespace railstrata {
namespace {

PlaneStress plane_of(const Sym3& s) { return {s.xx, s.zz, s.xz}; }
PlaneStress mixed(const PlaneStress& a, const PlaneStress& b, double share) {
  return {a.xx + share * (b.xx - a.xx), a.zz + share * (b.zz - a.zz), a.xz + share * (b.xz - a.xz)};
}

/// The interval of ascending values that holds one, and how far in it; ends stand for what is beyond.
struct Between {
  std::size_t low = 0;
  double share = 0;
};
Between between(const std::vector<double>& of, double value) {
  if (of.size() < 2 || value <= of.front()) return {};
  const auto high = std::min<std::size_t>(
      static_cast<std::size_t>(std::upper_bound(of.begin(), of.end(), value) - of.begin()), of.size() - 1);
  const double width = of[high] - of[high - 1];
  return {high - 1, width > 0 ? std::min(1.0, (value - of[high - 1]) / width) : 1};
}

}  // namespace

LineTraction traction_on(const PlaneStress& s, double angle) {
  const double c = std::cos(2 * angle), d = std::sin(2 * angle), mean = 0.5 * (s.xx + s.zz), half = 0.5 * (s.zz - s.xx);
  return {mean + half * c - s.xz * d, half * d + s.xz * c};
}

PlaneOfRolling::PlaneOfRolling(const StressHistory& history, double y, ResidualRows residual)
    : x_(history.x), depth_(history.depth) {
  check_residual(history, residual);
  const Between column = between(history.y, y);
  const int first = static_cast<int>(column.low), second = std::min(first + 1, history.columns() - 1);
  for (int r = 0; r < history.rows(); ++r) {
    residual_.push_back(plane_of(residual_of(residual, r)));
    const Sym3 *a = history.cycle(r, first), *b = history.cycle(r, second);
    for (int s = 0; s < history.samples(); ++s) stress_.push_back(mixed(plane_of(a[s]), plane_of(b[s]), column.share));
  }
}

PlaneStress PlaneOfRolling::in_row(std::size_t row, double x) const {
  const PlaneStress* of = stress_.data() + row * x_.size();
  const Between at = between(x_, x);
  PlaneStress out = mixed(of[at.low], of[std::min(at.low + 1, x_.size() - 1)], at.share);
  const double middle = 0.5 * (x_.front() + x_.back()), half = 0.5 * (x_.back() - x_.front());
  const double away = std::abs(x - middle);
  const double fall = away > half ? half * half / (away * away) : 1;
  out = {fall * out.xx, fall * out.zz, fall * out.xz};
  return {out.xx + residual_[row].xx, out.zz + residual_[row].zz, out.xz + residual_[row].xz};
}

PlaneStress PlaneOfRolling::at(double x, double depth) const {
  const Between row = between(depth_, depth);
  return mixed(in_row(row.low, x), in_row(std::min(row.low + 1, depth_.size() - 1), x), row.share);
}

}  // namespace railstrata
