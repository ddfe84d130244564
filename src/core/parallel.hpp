#pragma once
// Executors. Every loop body writes only what belongs to its index, so results do not depend on the number of threads.
#include <omp.h>

#include <cstddef>
#include <vector>

namespace railstrata {

/// Calls kernel(i) for i in [0, n), possibly in parallel. uneven: the work differs from index to index (dynamic
/// scheduling).
template <class Kernel>
void for_each(std::ptrdiff_t n, Kernel&& kernel, bool uneven = false) {
  if (uneven) {
#pragma omp parallel for schedule(dynamic, 1)
    for (std::ptrdiff_t i = 0; i < n; ++i) kernel(i);
  } else {
#pragma omp parallel for schedule(static)
    for (std::ptrdiff_t i = 0; i < n; ++i) kernel(i);
  }
}

/// Sum of kernel(begin, end) over fixed pieces of [0, n), added in the order of the pieces: the same bits for any
/// number of threads.
template <class Kernel>
double ordered_sum(std::ptrdiff_t n, Kernel&& kernel) {
  constexpr std::ptrdiff_t piece = 8192;
  const std::ptrdiff_t pieces = (n + piece - 1) / piece;
  std::vector<double> part(static_cast<std::size_t>(pieces));
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t i = 0; i < pieces; ++i) {
    const std::ptrdiff_t begin = i * piece, end = begin + piece < n ? begin + piece : n;
    part[static_cast<std::size_t>(i)] = kernel(begin, end);
  }
  double sum = 0;
  for (double p : part) sum += p;
  return sum;
}

inline void set_threads(int n) { omp_set_num_threads(n); }
inline int max_threads() { return omp_get_max_threads(); }

}  // namespace railstrata
