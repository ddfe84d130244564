#pragma once
// How the elements of a body are cut into pieces of work.
//
// A tile is a run of at most kTile elements along the sweep, over the whole section of its block. It owns the node
// planes first <= j < end; the plane `end` belongs to the next tile (or is the last of an open block).
//
//        station   0        64       128       192        256
//                  |--tile 0--|--tile 1--|--tile 2--|--tile 3--|     elements between the planes
//                  ^          :          ^          :          ^
//        chains    [----- chain 0 ------][------ chain 1 ------]
//
// A chain is a run of tiles that one thread works through one after the other: the second tile completes the plane
// between them (:). The planes in front of chains (^) are border planes: both neighbours leave their part there, and
// the parts are added up when all chains are done. There are no races, and the sums have the same bits however the
// tiles are chained.
#include <array>
#include <cstddef>
#include <vector>

#include "mesh/layout.hpp"

namespace railstrata {

inline constexpr int kTile = 64;  ///< elements along the sweep; whole packs of any number type

struct Tile {
  int block, first, end;  ///< owns the stations first <= j < end
};

/// Tiles first_tile <= t < end_tile of one block.
struct Chain {
  int first_tile, end_tile;
};

/// In which order a tile of a block goes through its quadrilaterals (mesh/sweep_order.hpp), and which scratch rows a
/// section node has from the first quadrilateral that touches it to the last.
struct SweepPlan {
  std::vector<int> order;
  std::vector<int> slot;                   ///< per node
  std::vector<std::array<char, 4>> first;  ///< per quadrilateral: corners that it touches for the first time
  std::vector<std::array<char, 4>> last;   ///< for the last time
  int slots = 0;
};

struct Tiling {
  std::vector<Tile> tiles;
  std::vector<int> first_tile;         ///< per block, and one past the end
  std::vector<std::ptrdiff_t> border;  ///< per tile, start in the buffers of border planes
  std::ptrdiff_t border_size = 0;
  std::vector<SweepPlan> plans;  ///< per block

  int border_plane(const Chain& c) const { return tiles[c.first_tile].first; }
  int block(const Chain& c) const { return tiles[c.first_tile].block; }
};

Tiling tiling_of(const SweptBody& body, const BodyLayout& layout);

}  // namespace railstrata
