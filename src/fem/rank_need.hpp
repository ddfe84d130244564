#pragma once
// What several ranks would do of one run (fem/rank_exchange.hpp), counted from the meshes alone, and the time that a
// step of theirs takes by a model of it:
//
//   T(n)/T(1) = r + (1 - r) s_n + (l ceil(log2 n) + B_n/b)/T(1)
//
// s_n: share of the elements that the rank with most of them evaluates; B_n: bytes that a rank receives; l, b: latency
// and bandwidth of the network; r: share of T(1) that every rank spends for itself, with copies into and out of
// messages, measured for one mesh (docs/ranks.md) and taken in proportion to the lines' share of the nodes.
#include "model/model.hpp"

namespace railstrata {

struct RankNeed {
  int ranks = 1;
  int tiles = 0;             ///< pieces that the mesh can be cut into: the most ranks
  double largest_share = 1;  ///< of the elements
  double lines = 0;          ///< share of the nodes that every rank updates
  double bytes = 0;          ///< that a rank receives in a usual step, the most of all ranks
};

/// Without what mass scaling and local steps add to the lines.
RankNeed rank_need(const Model& model, int ranks);

struct RankNetwork {
  double latency = 2e-6;     ///< s
  double bandwidth = 4.6e9;  ///< B/s
};

/// T(n)/T(1); step: T(1), s.
double relative_step_time(const RankNeed& need, double step, const RankNetwork& network = {});

}  // namespace railstrata
