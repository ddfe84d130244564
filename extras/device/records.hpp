#pragma once
// A body's mesh as kernels read it: a record for every quadrilateral and for every section node, and the pieces of
// work that threads are dealt. Indices into arrays of the same body.
#include <cstddef>

namespace railstrata::device {

inline constexpr int kLanes = 32;       ///< neighbours along the sweep that work side by side: a warp
inline constexpr int kCornerRows = 24;  ///< of a quadrilateral: sum and difference by component, of four corners

/// Stations first <= j < first + count of a record, at most kLanes of them.
struct Piece {
  int record, first, count;
};

/// A block's values by station or element stand at `stations_at` + station in the arrays of StationTables.
struct QuadRecord {
  std::ptrdiff_t corner[4];    ///< of component x of the corner at station 0, in u
  std::ptrdiff_t rows;         ///< corner rows: (6 corner + 3 difference? + component) * row_stride + element
  std::ptrdiff_t eigenstress;  ///< 18 numbers, -1: none
  int reference, hourglass, hourglass_step;  ///< of hourglass class c: table hourglass + c * hourglass_step
  int stations_at, groups_at;                ///< groups: the hourglass classes of groups of elements
  int stride, row_stride, elements, stations;
};

struct NodeRecord {
  std::ptrdiff_t x;           ///< of component x at station 0, in u, v, f and the masses
  int first_corner, corners;  ///< its rows in the list of corners, in the order in which they are added
  int stations_at;
  int stride, row_stride, elements, stations;
  int closed;   ///< the last element ends at station 0
  int at_once;  ///< updated when its forces are complete, but for the ends of an open block
  double radius;
};

/// A line of tied nodes. Stations of the slave's block stand at `between` in the arrays of interpolations, those of its
/// masters' at `share_first`; offsets at `delta`.
struct TieRecord {
  std::ptrdiff_t slave, master0, master1;  ///< of component x at station 0
  std::ptrdiff_t between, share_first, delta;
  int slave_stride, slave_stations, master_stride, master_stations;
  double weight1;
};

/// A line of masters and what it gets from the slaves of one level.
struct MasterRecord {
  std::ptrdiff_t x;
  int stride, stations;
  int first_share, shares;
};
struct TieShare {
  int tie;
  double weight;
};

/// A chain of added mass (body/mass_scaling.hpp).
struct ChainRecord {
  std::ptrdiff_t factor;  ///< [node][station]
  int first_node, nodes;  ///< in the list of chain nodes
  int stride, stations, stations_at;
};

/// A node of a chain: its line and how far from the axle it turns.
struct ChainNode {
  std::ptrdiff_t x;  ///< of component x at station 0
  double radius;
};

/// A node in the wheel's bore.
struct BoreRecord {
  std::ptrdiff_t x;
  int stride;
  double arm_x, arm_z;  ///< m
};

struct EndDashpotRecord {
  std::ptrdiff_t index;
  double coefficient;  ///< N s/m
};
struct EndLoadRecord {
  std::ptrdiff_t index;
  double force;  ///< N
};

}  // namespace railstrata::device
