#pragma once
// A vector of the static problem: displacements (or forces) of both bodies and of the axle's height. Constrained
// entries and padding are zero wherever sums are taken.
#include "core/array.hpp"
#include "core/parallel.hpp"

namespace railstrata {

struct StaticVector {
  Field rail, wheel;
  double axle = 0;  ///< m or N
};

/// Fixed order of summation: the same bits for any number of threads.
inline double dot(const Field& a, const Field& b) {
  return ordered_sum(static_cast<std::ptrdiff_t>(a.size()), [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
    double sum = 0;
    for (std::ptrdiff_t i = begin; i < end; ++i) sum += a[i] * b[i];
    return sum;
  });
}
inline double dot(const StaticVector& a, const StaticVector& b) {
  return dot(a.rail, b.rail) + dot(a.wheel, b.wheel) + a.axle * b.axle;
}

/// y += s x
inline void add(Field& y, double s, const Field& x) {
  for_each(static_cast<std::ptrdiff_t>(y.size()), [&](std::ptrdiff_t i) { y[i] += s * x[i]; });
}
inline void add(StaticVector& y, double s, const StaticVector& x) {
  add(y.rail, s, x.rail);
  add(y.wheel, s, x.wheel);
  y.axle += s * x.axle;
}

/// y = x + s y
inline void scale_and_add(Field& y, double s, const Field& x) {
  for_each(static_cast<std::ptrdiff_t>(y.size()), [&](std::ptrdiff_t i) { y[i] = x[i] + s * y[i]; });
}
inline void scale_and_add(StaticVector& y, double s, const StaticVector& x) {
  scale_and_add(y.rail, s, x.rail);
  scale_and_add(y.wheel, s, x.wheel);
  y.axle = x.axle + s * y.axle;
}

}  // namespace railstrata
