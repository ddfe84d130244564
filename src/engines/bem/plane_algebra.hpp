#pragma once
// Loops and sums over planes: threads only where they pay, sums in a fixed order whatever their number.
#include <algorithm>
#include <cassert>
#include <cstddef>
#include <vector>

namespace railstrata {

using Plane = std::vector<double>;
using Mask = std::vector<unsigned char>;

/// The two components of a tangential quantity in every cell: x rolling direction, y lateral. Empty: none.
struct PlanePair {
  Plane x, y;
};

/// Below these sizes waking other threads costs more than the work: of a transform, and of one sweep over a vector.
inline bool threads_pay_for(std::size_t cells) { return cells >= 12000; }
inline bool threads_pay_for_sweep(std::size_t values) { return values >= 60000; }

/// Without threads no parallel region is opened: even that of a single thread costs 0.3 us.
template <class Kernel>
void for_each_if(bool threads, std::ptrdiff_t n, Kernel&& kernel) {
  if (!threads) {
    for (std::ptrdiff_t i = 0; i < n; ++i) kernel(static_cast<int>(i));
    return;
  }
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t i = 0; i < n; ++i) kernel(static_cast<int>(i));
}

/// kernel(piece, begin, end) for fixed pieces of [0, n), shared between threads; an index stands for so many values of
/// work.
constexpr std::size_t kPiece = 4096;
inline std::size_t pieces_of(std::size_t n) { return (n + kPiece - 1) / kPiece; }
template <class Kernel>
void for_pieces(std::size_t n, std::size_t values_per_index, Kernel&& kernel) {
  for_each_if(threads_pay_for_sweep(n * values_per_index), static_cast<std::ptrdiff_t>(pieces_of(n)), [&](int k) {
    const std::size_t begin = static_cast<std::size_t>(k) * kPiece;
    kernel(static_cast<std::size_t>(k), begin, std::min(begin + kPiece, n));
  });
}

/// Sum of term(i) over [begin, end), in four interleaved parts: of four scalars in place of the vector g++ 12 makes
/// sums in order, which take three times as long.
template <class Term>
double sum_of(std::size_t begin, std::size_t end, Term&& term) {
  using Four = double __attribute__((vector_size(32)));
  Four s{0, 0, 0, 0};
  std::size_t i = begin;
  for (; i + 4 <= end; i += 4) s += Four{term(i), term(i + 1), term(i + 2), term(i + 3)};
  for (; i < end; ++i) s[0] += term(i);
  return (s[0] + s[1]) + (s[2] + s[3]);
}

/// Sum of term(i) over [0, n).
template <class Term>
double ordered_sum_of(std::size_t n, Term&& term) {
  std::vector<double> part(pieces_of(n));
  for_pieces(n, 1, [&](std::size_t k, std::size_t begin, std::size_t end) { part[k] = sum_of(begin, end, term); });
  double total = 0;
  for (double p : part) total += p;
  return total;
}

inline double dot(const Plane& a, const Plane& b) {
  assert(a.size() == b.size());
  return ordered_sum_of(a.size(), [&](std::size_t i) { return a[i] * b[i]; });
}
inline double sum(const Plane& a) {
  return ordered_sum_of(a.size(), [&](std::size_t i) { return a[i]; });
}

/// kernel(i) for i in [0, n), in pieces shared between threads.
template <class Kernel>
void for_cells(std::size_t n, std::size_t values_per_index, Kernel&& kernel) {
  for_pieces(n, values_per_index, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) kernel(i);
  });
}
template <class Kernel>
void for_cells(std::size_t n, Kernel&& kernel) {
  for_cells(n, 1, kernel);
}

/// y += s x
inline void add_scaled(Plane& y, double s, const Plane& x) {
  assert(x.size() >= y.size());
  for_cells(y.size(), [&](std::size_t i) { y[i] += s * x[i]; });
}

/// y *= s
inline void scale_by(Plane& y, double s) {
  for_cells(y.size(), [&](std::size_t i) { y[i] *= s; });
}

}  // namespace railstrata
