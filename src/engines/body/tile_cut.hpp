#pragma once
// Which tiles of the bodies each of several ranks evaluates.
//
// The tiles of all bodies stand in one row, body by body, block by block, station by station, and the row is cut into
// stretches, one a rank, so that the largest has as little work as can be. Forces of a tile do not depend on who
// evaluates it, and planes between tiles are summed in one order (body/tiling.hpp), so neither do the bits.
#include <vector>

#include "body/body.hpp"

namespace railstrata {

/// The tiles of one body that a rank computes.
struct TileCut {
  int rank = 0;            ///< of this process
  std::vector<int> owner;  ///< per tile, the rank that evaluates it; empty: all tiles are this process's
  bool whole() const { return owner.empty(); }
  bool is_own(int tile) const { return owner.empty() || owner[static_cast<std::size_t>(tile)] == rank; }
};

/// The work of each tile, of its elements and of the nodes on its lines (at ties, on the running surface), in
/// hundredths of that of an extruded element.
std::vector<long> tile_work(const SweptBody& mesh, const Tiling& tiling);

/// Consecutive stretches of a row of pieces of work, at most `parts`, so that the largest sum is least: per piece the
/// number of its stretch, from 0.
std::vector<int> cut_evenly(const std::vector<long>& work, int parts);

/// The cuts of the bodies, in their order. Throws CaseError if there are more ranks than tiles.
std::vector<TileCut> cut_tiles(const std::vector<const Body*>& bodies, int ranks, int rank);

/// Consecutive tiles of one block with one owner, in their order; of a body that is not cut, its blocks.
struct OwnedChain : Chain {
  int owner = 0;
};
std::vector<OwnedChain> stretches(const Tiling& tiling, const TileCut& cut);

/// Chains of a cut body in the order of their tiles, in the memory of `reuse`: at least so many of this rank's own if
/// it has as many tiles, or its single tiles; of the others their stretches.
std::vector<Chain> cut_chains(const Tiling& tiling, const TileCut& cut, int at_least, bool single_tiles,
                              std::vector<Chain> reuse = {});

}  // namespace railstrata
