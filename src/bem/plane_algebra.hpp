#pragma once
// Loops and sums over planes: threads only where they pay, sums in a fixed order whatever their number.
#include <cstddef>
#include <vector>

namespace railstrata {

using Plane = std::vector<double>;
using Mask = std::vector<unsigned char>;

/// Below these sizes waking other threads costs more than the work: of a transform, and of one sweep over a vector.
inline bool threads_pay_for(std::size_t cells) { return cells >= 12000; }
inline bool threads_pay_for_sweep(std::size_t values) { return values >= 60000; }

template <class Kernel>
void for_each_if(bool threads, std::ptrdiff_t n, Kernel&& kernel) {
#pragma omp parallel for schedule(static) if (threads)
  for (std::ptrdiff_t i = 0; i < n; ++i) kernel(static_cast<int>(i));
}

/// Sum of term(i) over [0, n).
template <class Term>
double ordered_sum_of(std::size_t n, Term&& term) {
  constexpr std::size_t piece = 4096;
  const std::size_t pieces = (n + piece - 1) / piece;
  std::vector<double> part(pieces);
  for_each_if(threads_pay_for_sweep(n), static_cast<std::ptrdiff_t>(pieces), [&](int k) {
    const std::size_t begin = static_cast<std::size_t>(k) * piece, end = begin + piece < n ? begin + piece : n;
    double s[4] = {0, 0, 0, 0};
    std::size_t i = begin;
    for (; i + 4 <= end; i += 4)
      for (std::size_t l = 0; l < 4; ++l) s[l] += term(i + l);
    for (; i < end; ++i) s[0] += term(i);
    part[static_cast<std::size_t>(k)] = (s[0] + s[1]) + (s[2] + s[3]);
  });
  double total = 0;
  for (double p : part) total += p;
  return total;
}

inline double dot(const Plane& a, const Plane& b) {
  return ordered_sum_of(a.size(), [&](std::size_t i) { return a[i] * b[i]; });
}
inline double sum(const Plane& a) {
  return ordered_sum_of(a.size(), [&](std::size_t i) { return a[i]; });
}

/// kernel(i) for i in [0, n), in pieces shared between threads.
template <class Kernel>
void for_cells(std::size_t n, Kernel&& kernel) {
  constexpr std::size_t piece = 4096;
  for_each_if(threads_pay_for_sweep(n), static_cast<std::ptrdiff_t>((n + piece - 1) / piece), [&](int k) {
    const std::size_t begin = static_cast<std::size_t>(k) * piece, end = begin + piece < n ? begin + piece : n;
    for (std::size_t i = begin; i < end; ++i) kernel(i);
  });
}

/// y += s x
inline void add_scaled(Plane& y, double s, const Plane& x) {
  for_cells(y.size(), [&](std::size_t i) { y[i] += s * x[i]; });
}

/// y *= s
inline void scale_by(Plane& y, double s) {
  for_cells(y.size(), [&](std::size_t i) { y[i] *= s; });
}

}  // namespace railstrata
