#include "fem/rank_need.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "body/tile_cut.hpp"

namespace railstrata {
namespace {

// Of a step of cases/paper/base.toml (bench/rank_pairs.cpp), and the share of its nodes that are on lines.
constexpr double kMeasuredOwn = 0.31, kMeasuredLines = 0.233;

// Section nodes of a block whose forces all ranks read.
std::vector<int> line_counts(const SweptBody& body) {
  std::vector<std::vector<char>> wanted;
  for (const Block& b : body.blocks) wanted.emplace_back(b.section.nodes.size(), 0);
  for (int c = 0; c <= body.contact.columns; ++c) wanted[body.contact.block][c] = 1;
  for (const Tie& t : body.ties) {
    wanted[t.slave_block][t.slave_node] = 1;
    wanted[t.master_block][t.master_node0] = wanted[t.master_block][t.master_node1] = 1;
  }
  if (body.kind == SweepKind::revolve)
    for (const SectionNode& n : body.prescribed) wanted[n.block][n.node] = 1;
  std::vector<int> out;
  for (const std::vector<char>& w : wanted) out.push_back(static_cast<int>(std::count(w.begin(), w.end(), 1)));
  return out;
}

struct Piece {
  const Tile tile;
  std::size_t body;
  long nodes, lines;  // of its block's section
};

}  // namespace

RankNeed rank_need(const Model& model, int ranks) {
  RankNeed need;
  std::vector<Piece> pieces;
  std::vector<long> work;
  double all_lines = 0;
  const SweptBody* const bodies[] = {&model.rail, &model.wheel};
  for (std::size_t k = 0; k < 2; ++k) {
    const std::vector<int> lines = line_counts(*bodies[k]);
    const Tiling tiling = tiling_of(*bodies[k], layout_of(*bodies[k]));
    for (const Tile& t : tiling.tiles) {
      const Section& section = bodies[k]->blocks[t.block].section;
      pieces.push_back({t, k, static_cast<long>(section.nodes.size()), lines[t.block]});
      work.push_back(static_cast<long>(section.quads.size()) * (t.end - t.first));
    }
    for (std::size_t b = 0; b < lines.size(); ++b) all_lines += lines[b] * bodies[k]->blocks[b].stations.nodes();
  }
  need.tiles = static_cast<int>(pieces.size());
  need.ranks = std::min(ranks, need.tiles);
  need.lines = all_lines / static_cast<double>(model.rail.nodes() + model.wheel.nodes());
  const std::vector<int> owner = cut_evenly(work, need.ranks);
  std::vector<double> elements(static_cast<std::size_t>(need.ranks)), given(elements.size(), 2);
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    const Piece& at = pieces[p];
    const bool anew = p == 0 || owner[p] != owner[p - 1] || at.body != pieces[p - 1].body ||
                      at.tile.block != pieces[p - 1].tile.block;
    const auto r = static_cast<std::size_t>(owner[p]);
    elements[r] += static_cast<double>(work[p]);
    // lines without the plane in front of a stretch, and the forces on either side of its two border planes
    given[r] += 3.0 * static_cast<double>(at.lines * (at.tile.end - at.tile.first - (anew ? 1 : 0)) +
                                          (anew ? 2 * at.nodes : 0));
  }
  need.largest_share =
      *std::max_element(elements.begin(), elements.end()) / std::accumulate(elements.begin(), elements.end(), 0.0);
  if (need.ranks > 1)
    need.bytes = 8 * (std::accumulate(given.begin(), given.end(), 0.0) - *std::min_element(given.begin(), given.end()));
  return need;
}

double relative_step_time(const RankNeed& need, double step, const RankNetwork& network) {
  if (need.ranks == 1) return 1;
  const double own = std::min(1.0, kMeasuredOwn * need.lines / kMeasuredLines);
  const double network_time = network.latency * std::ceil(std::log2(need.ranks)) + need.bytes / network.bandwidth;
  return own + (1 - own) * need.largest_share + network_time / step;
}

}  // namespace railstrata
