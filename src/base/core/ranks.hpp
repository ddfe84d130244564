#pragma once
// Processes that compute one run together, and the one thing that they do with one another: each gives a part of a list
// of numbers and gets the whole. There is one such operation only, it is blocking, and all ranks call it the same
// number of times in the same order. This room does not know the implementation (extras/mpi/plug_in.cpp; threads, in
// tests).
#include <algorithm>
#include <cstddef>
#include <vector>

namespace railstrata {

struct Ranks {
  int count = 1;
  int rank = 0;             ///< of this process, 0 to count - 1
  void* context = nullptr;  ///< of the provider
  /// all: the parts of the ranks one behind the other, sizes[r] numbers from rank r. This rank's part stands in its
  /// place before, those of the others do so after. Throws EnvironmentError when another rank is gone.
  void (*gather_parts)(void* context, double* all, const std::ptrdiff_t* sizes) = nullptr;

  bool alone() const { return count == 1; }
  /// Rank 0 writes files and messages for all.
  bool is_root() const { return rank == 0; }
  void gather(double* all, const std::ptrdiff_t* sizes) const { gather_parts(context, all, sizes); }
};

/// The largest of the ranks' values; all get it.
inline double largest_of_all(const Ranks& ranks, double own) {
  if (ranks.alone()) return own;
  std::vector<double> of_each(static_cast<std::size_t>(ranks.count));
  of_each[static_cast<std::size_t>(ranks.rank)] = own;
  ranks.gather(of_each.data(), std::vector<std::ptrdiff_t>(of_each.size(), 1).data());
  return *std::max_element(of_each.begin(), of_each.end());
}

}  // namespace railstrata
