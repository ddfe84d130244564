#pragma once
// Sums and products of nodal fields, of all entries: constrained ones and padding are zero there.
#include "core/array.hpp"
#include "core/parallel.hpp"

namespace railstrata {

/// Fixed order of summation: the same bits for any number of threads.
inline double dot(const Field& a, const Field& b) {
  return ordered_sum(static_cast<std::ptrdiff_t>(a.size()), [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
    double sum = 0;
    for (std::ptrdiff_t i = begin; i < end; ++i) sum += a[i] * b[i];
    return sum;
  });
}

/// y += s x
inline void add(Field& y, double s, const Field& x) {
  for_each(static_cast<std::ptrdiff_t>(y.size()), [&](std::ptrdiff_t i) { y[i] += s * x[i]; });
}

/// y = x + s y
inline void scale_and_add(Field& y, double s, const Field& x) {
  for_each(static_cast<std::ptrdiff_t>(y.size()), [&](std::ptrdiff_t i) { y[i] = x[i] + s * y[i]; });
}

}  // namespace railstrata
