#pragma once
// A vector of the static problem: displacements (or forces) of both bodies and of the axle's height. Constrained
// entries and padding are zero wherever sums are taken.
#include <array>

#include "core/array.hpp"
#include "core/parallel.hpp"

namespace railstrata {

struct StaticVector {
  std::array<Field, 2> body;  ///< by BodyId
  double axle = 0;            ///< m or N
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
  return dot(a.body[0], b.body[0]) + dot(a.body[1], b.body[1]) + a.axle * b.axle;
}

/// y += s x
inline void add(Field& y, double s, const Field& x) {
  for_each(static_cast<std::ptrdiff_t>(y.size()), [&](std::ptrdiff_t i) { y[i] += s * x[i]; });
}
inline void add(StaticVector& y, double s, const StaticVector& x) {
  for (std::size_t k = 0; k < y.body.size(); ++k) add(y.body[k], s, x.body[k]);
  y.axle += s * x.axle;
}

/// y = x + s y
inline void scale_and_add(Field& y, double s, const Field& x) {
  for_each(static_cast<std::ptrdiff_t>(y.size()), [&](std::ptrdiff_t i) { y[i] = x[i] + s * y[i]; });
}
inline void scale_and_add(StaticVector& y, double s, const StaticVector& x) {
  for (std::size_t k = 0; k < y.body.size(); ++k) scale_and_add(y.body[k], s, x.body[k]);
  y.axle = x.axle + s * y.axle;
}

}  // namespace railstrata
