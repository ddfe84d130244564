#pragma once
// Work of several ranks on one run (fem/rank_exchange.hpp), counted from the meshes alone, and the time that a step of
// theirs takes by a model of it:
//
//   T(n)/T(1) = r_n + (1 - r_n) s_n + (l ceil(log2 n) + B_n/b)/T(1),   r_n = c L + o K_n
//
// s_n: share of the work of the rank that has most; B_n: bytes that a rank receives; l, b: latency and bandwidth of the
// network; r_n: share of T(1) that a rank spends on what others do too: the contact, in proportion to the share L of
// the nodes that are on lines, and the lines that it keeps, in proportion to their share K_n, with copies into and out
// of messages. c and o are measured for one mesh (extras/mpi/README.md).
#include "model/model.hpp"

namespace railstrata {

struct RankNeed {
  int ranks = 1;
  int tiles = 0;             ///< pieces that the mesh can be cut into: the most ranks
  double largest_share = 1;  ///< of the work (body/tile_cut.hpp)
  double lines = 0;          ///< share of the nodes that are on lines
  double kept = 0;           ///< share of the nodes that are on lines and kept by the rank that keeps most of them
  double bytes = 0;          ///< that a rank receives in a usual step, the most of all ranks
};

/// Without what mass scaling adds to the lines.
RankNeed rank_need(const Model& model, int ranks);

struct RankNetwork {
  double latency = 2e-6;     ///< s
  double bandwidth = 4.6e9;  ///< B/s
};

/// T(n)/T(1); step: T(1), s.
double relative_step_time(const RankNeed& need, double step, const RankNetwork& network = {});

}  // namespace railstrata
