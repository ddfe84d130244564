#pragma once
// Which tiles of the bodies each of several ranks evaluates, and which values of nodal fields it keeps up to date,
// where it does not keep them all: those at the stations of its own tiles, those on the planes between stretches, and
// some lines at all stations.
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
  int owner_of(int tile) const { return whole() ? rank : owner[static_cast<std::size_t>(tile)]; }
  bool is_own(int tile) const { return owner_of(tile) == rank; }
};

/// Section nodes by block, 1 for those that are meant.
using NodeMask = std::vector<std::vector<char>>;
NodeMask no_nodes(const SweptBody& mesh);
/// On the running surface and at ties.
NodeMask nodes_on_lines(const SweptBody& mesh);

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

/// Chains of a body in the order of their tiles, in the memory of `reuse`: at least so many of this rank's own if it
/// has as many tiles; of the others their stretches.
std::vector<Chain> chains(const Tiling& tiling, int at_least, const TileCut& cut = {}, std::vector<Chain> reuse = {});

/// Values that a rank keeps, by block of a body.
struct KeptValues {
  NodeMask line;                                ///< kept at all stations
  std::vector<std::vector<StationRange>> runs;  ///< of the other nodes, in their order
};

/// Of a body that is not cut: all values.
KeptValues kept_values(const Body& body, const TileCut& cut, NodeMask lines);

/// Stations that a tile has for itself, with the last plane of an open block.
StationRange own_stations(const Body& body, int tile);

}  // namespace railstrata
