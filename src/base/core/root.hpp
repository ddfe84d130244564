#pragma once
// Roots of a function of one number.
#include <cmath>

namespace railstrata {

/// Narrows [a, b] about a root of a function with values of two signs there: by the secant, kept between two sides
/// (Illinois). value(c) was called last at the place that is found; true once |value| <= close or the sides are less
/// than `narrow` apart, false after `most` calls.
template <class Function>
bool narrow_root(double a, double at_a, double b, double at_b, double close, double narrow, int most,
                 Function&& value) {
  for (int i = 0; i < most; ++i) {
    const double c = (a * at_b - b * at_a) / (at_b - at_a), at_c = value(c);
    if (std::abs(at_c) <= close || std::abs(b - a) < narrow) return true;
    if (at_c * at_b < 0) {
      a = b;
      at_a = at_b;
    } else {
      at_a *= 0.5;
    }
    b = c;
    at_b = at_c;
  }
  return false;
}

}  // namespace railstrata
