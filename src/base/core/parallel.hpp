#pragma once
// Parallel loops and sums whose results do not depend on the number of threads: a loop body writes only what belongs to
// its index, and sums have fixed pieces. Loops do not nest: inside another one a loop runs on the calling thread alone.
#include <omp.h>

#include <array>
#include <atomic>
#include <cstddef>
#include <exception>
#include <vector>

namespace railstrata {

/// Calls kernel(i) once for each i in [0, n), in any order and possibly in parallel. The kernel may read what no other
/// call writes; it must not throw. `uneven`: calls take different times, so threads fetch them one by one (an atomic
/// operation each: for calls of microseconds and more); else every thread has one range of consecutive indices.
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

/// The same for calls that take different times and may throw; what the first of them throws, by its index, is thrown
/// at the end.
template <class Kernel>
void for_each_that_throws(std::size_t n, Kernel&& kernel) {
  std::vector<std::exception_ptr> thrown(n);
  for_each(
      static_cast<std::ptrdiff_t>(n),
      [&](std::ptrdiff_t i) {
        try {
          kernel(static_cast<std::size_t>(i));
        } catch (...) {
          thrown[static_cast<std::size_t>(i)] = std::current_exception();
        }
      },
      true);
  for (const std::exception_ptr& fault : thrown)
    if (fault) std::rethrow_exception(fault);
}

/// Calls kernel(i) once for each i in [0, n), calls that take different times, such that threads work far from one
/// another: each goes through a range of its own, then helps with those of the others. Where two of them work side by
/// side, lines of memory that both touch wander to and fro: a step of two bodies took a fifth longer.
template <class Kernel>
void for_each_apart(std::ptrdiff_t n, Kernel&& kernel) {
  constexpr std::ptrdiff_t kMostRanges = 64;
  struct alignas(64) ThreadRange {
    std::atomic<std::ptrdiff_t> next;
    std::ptrdiff_t end;
  };
  std::array<ThreadRange, kMostRanges> ranges;
  const std::ptrdiff_t threads = omp_get_max_threads(), count = threads < kMostRanges ? threads : kMostRanges;
  for (std::ptrdiff_t r = 0; r < count; ++r) {
    ranges[static_cast<std::size_t>(r)].next = r * n / count;
    ranges[static_cast<std::size_t>(r)].end = (r + 1) * n / count;
  }
#pragma omp parallel
  for (std::ptrdiff_t r = 0; r < count; ++r) {
    ThreadRange& range = ranges[static_cast<std::size_t>((omp_get_thread_num() + r) % count)];
    for (std::ptrdiff_t i = range.next++; i < range.end; i = range.next++) kernel(i);
  }
}

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

/// Sum of kernel(begin, end) over pieces of [0, n), where the kernel returns the sum of its own piece. The pieces have
/// a fixed length and are added in their order: the same bits for any number of threads, but other bits than one
/// running sum. Allocates one double for each piece, so it does not belong into the time loop.
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
