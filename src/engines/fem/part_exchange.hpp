#pragma once
// Shared by the exchanges of several ranks: parts from many places of memory are packed into one array, gathered
// (core/ranks.hpp) and written to their places.
#include <algorithm>
#include <numeric>
#include <vector>

#include "body/tile_cut.hpp"
#include "core/ranks.hpp"

namespace railstrata {

class PartExchange {
 public:
  explicit PartExchange(const Ranks& ranks) : ranks_(ranks), sizes_(static_cast<std::size_t>(ranks.count)) {}

  /// each_part(rank, visit) calls visit(first number, how many) for all that a rank gives, in the same order on all
  /// ranks.
  template <class EachPart>
  void operator()(EachPart&& each_part) {
    std::ptrdiff_t total = 0;
    for (int r = 0; r < ranks_.count; ++r) {
      std::ptrdiff_t& size = sizes_[r] = 0;
      each_part(r, [&](const double*, std::ptrdiff_t count) { size += count; });
      total += size;
    }
    if (buffer_.size() < static_cast<std::size_t>(total)) buffer_.resize(static_cast<std::size_t>(total));
    double* at = buffer_.data() + std::accumulate(sizes_.begin(), sizes_.begin() + ranks_.rank, std::ptrdiff_t{0});
    each_part(ranks_.rank, [&](const double* values, std::ptrdiff_t count) { at = std::copy_n(values, count, at); });
    ranks_.gather(buffer_.data(), sizes_.data());
    const double* from = buffer_.data();
    for (int r = 0; r < ranks_.count; ++r) {
      if (r == ranks_.rank) {
        from += sizes_[r];
        continue;
      }
      each_part(r, [&](double* values, std::ptrdiff_t count) {
        std::copy_n(from, count, values);
        from += count;
      });
    }
  }

 private:
  Ranks ranks_;
  std::vector<std::ptrdiff_t> sizes_;
  std::vector<double> buffer_;
};

/// Consecutive tiles of one block that one rank has.
struct Stretch : OwnedChain {
  std::size_t body;
  int block;
  int first, end;  ///< stations within it, without the border plane in front of it
};

/// The stretches of all bodies, in the order of the bodies.
std::vector<Stretch> all_stretches(const std::vector<const Body*>& bodies, const std::vector<TileCut>& cuts);

/// numbers: so many of each rank, one rank behind the other. Throws EnvironmentError where those of a rank differ in
/// any bit from this rank's.
void require_same_bits(const Ranks& ranks, const std::vector<double>& numbers);

}  // namespace railstrata
