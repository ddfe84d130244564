#include "result/front_of_slip.hpp"

#include <algorithm>
#include <cmath>

#include "core/parabola.hpp"

namespace railstrata {
namespace {

/// Mean of sqrt(t) over the cell whose middle is at t = b; nothing is left where t < 0.
double mean_root(double b) {
  const auto integral = [](double t) { return t > 0 ? 2.0 / 3.0 * t * std::sqrt(t) : 0.0; };
  return integral(b + 0.5) - integral(b - 0.5);
}

}  // namespace

double front_behind_point(const StickMargins& m) {
  const double rise = square(m.next) - square(m.near);
  return rise > 0 ? std::min(square(m.near) / rise, 1.0) : 1.0;
}

double front_behind_cell(const StickMargins& m) {
  constexpr double kLeast = -0.5, kMost = 1;
  constexpr int kHalvings = 40;
  const double rise = m.after ? square(*m.after) - square(m.next) : 0;
  if (!(rise > 0)) return front_behind_point(m);
  const double wanted = m.near / std::sqrt(rise);
  double low = kLeast, high = kMost;
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = 0.5 * (low + high);
    (mean_root(middle) < wanted ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace railstrata
