#pragma once
// Sums over planes, in a fixed order whatever the number of threads.
#include <cstddef>
#include <vector>

#include "core/parallel.hpp"

namespace railstrata {

using Plane = std::vector<double>;
using Mask = std::vector<unsigned char>;

inline double dot(const Plane& a, const Plane& b) {
  return ordered_sum(static_cast<std::ptrdiff_t>(a.size()), [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
    double s = 0;
    for (std::ptrdiff_t i = begin; i < end; ++i) s += a[static_cast<std::size_t>(i)] * b[static_cast<std::size_t>(i)];
    return s;
  });
}

inline double sum(const Plane& a) {
  return ordered_sum(static_cast<std::ptrdiff_t>(a.size()), [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
    double s = 0;
    for (std::ptrdiff_t i = begin; i < end; ++i) s += a[static_cast<std::size_t>(i)];
    return s;
  });
}

}  // namespace railstrata
