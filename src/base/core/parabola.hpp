#pragma once
// Squares, and the top of a parabola through three points: where a largest value between samples lies, and how much it
// exceeds the middle one.
#include <algorithm>

namespace railstrata {

inline double square(double v) { return v * v; }

struct ParabolaTop {
  double at = 0;     ///< abscissa
  double above = 0;  ///< value at the top - value of the middle point
};

/// Through (t0, f0), (t1, f1), (t2, f2), t0 < t1 < t2, f1 the largest: with slope b at t1 and half the curvature a,
/// at = t1 - b/2a, not beyond the neighbours; (t1, 0) where the three points are not curved downwards.
inline ParabolaTop parabola_top(double t0, double f0, double t1, double f1, double t2, double f2) {
  const double a = ((f2 - f1) / (t2 - t1) - (f1 - f0) / (t1 - t0)) / (t2 - t0);
  if (a >= 0) return {t1, 0};
  const double b = (f1 - f0) / (t1 - t0) + a * (t1 - t0);
  const double d = std::clamp(-b / (2 * a), t0 - t1, t2 - t1);
  return {t1 + d, b * d + a * d * d};
}

/// The same at equal distances, t = -1, 0, 1: `at` lies in [-1/2, 1/2], where the top of three points with the largest
/// in the middle always is.
inline ParabolaTop parabola_top(double f0, double f1, double f2) {
  const double curvature = f0 - 2 * f1 + f2;
  if (!(curvature < 0)) return {0, 0};
  const double t = std::clamp(0.5 * (f0 - f2) / curvature, -0.5, 0.5);
  return {t, -0.25 * (f0 - f2) * t};
}

}  // namespace railstrata
