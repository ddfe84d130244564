#include "fem/part_exchange.hpp"

#include <fmt/format.h>

#include <cstring>

#include "core/faults.hpp"

namespace railstrata {

std::vector<Stretch> all_stretches(const std::vector<const Body*>& bodies, const std::vector<TileCut>& cuts) {
  std::vector<Stretch> out;
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const Tiling& tiling = bodies[k]->tiling;
    for (const OwnedChain& s : stretches(tiling, cuts[k]))
      out.push_back({s, k, tiling.block(s), tiling.tiles[s.first_tile].first + 1, tiling.tiles[s.end_tile - 1].end});
  }
  return out;
}

void require_same_bits(const Ranks& ranks, const std::vector<double>& numbers) {
  const std::size_t each = numbers.size() / static_cast<std::size_t>(ranks.count);
  const double* own = numbers.data() + each * static_cast<std::size_t>(ranks.rank);
  for (int r = 0; r < ranks.count; ++r)
    if (std::memcmp(numbers.data() + each * static_cast<std::size_t>(r), own, each * sizeof(double)) != 0)
      throw EnvironmentError(
          fmt::format("rank {} computes other numbers than rank {}: their machines or programs differ", r, ranks.rank),
          "run all ranks with the same program on machines of one kind");
}

}  // namespace railstrata
