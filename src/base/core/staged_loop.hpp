#pragma once
// A parallel loop in stages, with the rules of core/parallel.hpp.
#include <cstddef>

namespace railstrata {

/// Calls kernel(stage, i) for 0 <= i < count(stage), one stage after the other in one parallel region: all calls of a
/// stage have returned before the next one begins. Indices are dealt out in turn, so that neighbours of like length
/// give all threads the same work. The kernel may read what no other call of its stage writes; it must not throw.
template <class Count, class Kernel>
void for_each_in_stages(int stages, Count&& count, Kernel&& kernel) {
#pragma omp parallel
  for (int stage = 0; stage < stages; ++stage) {
    const std::ptrdiff_t n = count(stage);
#pragma omp for schedule(static, 1)
    for (std::ptrdiff_t i = 0; i < n; ++i) kernel(stage, i);
  }
}

}  // namespace railstrata
