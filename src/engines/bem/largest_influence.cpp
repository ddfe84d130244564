#include "bem/largest_influence.hpp"

#include <cassert>
#include <cmath>

namespace railstrata {

double largest_tangential_influence(const InfluenceOperator& influence, const Plane& inside) {
  assert(inside.size() == static_cast<std::size_t>(influence.nx()) * static_cast<std::size_t>(influence.ny()));
  constexpr int kPowers = 10;
  const std::size_t n = inside.size();
  Plane q_x(n), q_y(n), u_x(n), u_y(n);
  for (std::size_t i = 0; i < n; ++i) q_x[i] = q_y[i] = inside[i] > 0 ? 1.0 : 0.0;
  double largest = 0;
  for (int power = 0; power < kPowers; ++power) {
    const double size = std::sqrt(dot(q_x, q_x) + dot(q_y, q_y));
    if (!(size > 0)) return 0;
    scale_by(q_x, 1 / size);
    scale_by(q_y, 1 / size);
    influence.tangential(q_x.data(), q_y.data(), u_x.data(), u_y.data(), influence.nx());
    largest = dot(q_x, u_x) + dot(q_y, u_y);
    for (std::size_t i = 0; i < n; ++i) {
      q_x[i] = inside[i] > 0 ? u_x[i] : 0.0;
      q_y[i] = inside[i] > 0 ? u_y[i] : 0.0;
    }
  }
  return largest;
}

}  // namespace railstrata
