#pragma once
// Which values of nodal fields one of several ranks keeps up to date, where it does not keep them all: those at the
// stations of its own tiles, those on the planes between stretches, and some lines at all stations.
#include <vector>

#include "body/tile_cut.hpp"

namespace railstrata {

/// Stations begin <= j < end.
struct StationRun {
  int begin, end;
};

/// Values that a rank keeps, by block of a body.
struct KeptValues {
  std::vector<std::vector<char>> line;        ///< per section node: kept at all stations
  std::vector<std::vector<StationRun>> runs;  ///< of the other nodes, in their order
};

/// lines: per block and section node. Of a body that is not cut: all values.
KeptValues kept_values(const Body& body, const TileCut& cut, std::vector<std::vector<char>> lines);

/// Stations that a tile has for itself, with the last plane of an open block.
StationRun own_stations(const Body& body, int tile);

}  // namespace railstrata
