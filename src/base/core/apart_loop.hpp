#pragma once
// A parallel loop over neighbours that touch the same lines of memory, with the rules of core/parallel.hpp.
#include <omp.h>

#include <array>
#include <atomic>
#include <cstddef>

namespace railstrata {

/// Calls kernel(i) once for each i in [0, n), calls that take different times, such that threads work far from one
/// another: each goes through a range of its own, then helps with those of the others. Where two of them work side by
/// side, lines of memory that both touch wander to and fro: a step of two bodies took a fifth longer.
template <class Kernel>
void for_each_apart(std::ptrdiff_t n, Kernel&& kernel) {
  constexpr std::ptrdiff_t kMostRanges = 64;
  struct alignas(64) Range {
    std::atomic<std::ptrdiff_t> next;
    std::ptrdiff_t end;
  };
  std::array<Range, kMostRanges> ranges;
  const std::ptrdiff_t threads = omp_get_max_threads(), count = threads < kMostRanges ? threads : kMostRanges;
  for (std::ptrdiff_t r = 0; r < count; ++r) {
    ranges[static_cast<std::size_t>(r)].next = r * n / count;
    ranges[static_cast<std::size_t>(r)].end = (r + 1) * n / count;
  }
#pragma omp parallel
  for (std::ptrdiff_t r = 0; r < count; ++r) {
    Range& range = ranges[static_cast<std::size_t>((omp_get_thread_num() + r) % count)];
    for (std::ptrdiff_t i = range.next++; i < range.end; i = range.next++) kernel(i);
  }
}

}  // namespace railstrata
