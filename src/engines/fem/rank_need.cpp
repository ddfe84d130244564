#include "fem/rank_need.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "fem/line_reach.hpp"

namespace railstrata {
namespace {

// Shares of the time of a step of cases/paper/base.toml (bench/rank_steps.cpp). Contact: by the share of nodes on
// lines; lines, planes and copies: by the share that a rank keeps.
constexpr double kContact = 0.055 / 0.229, kOwnLines = 0.13 / 0.141;

// Section nodes on lines that the axle does not carry.
NodesOfBlocks lines_of(const SweptBody& body) {
  NodeMask on_line = nodes_on_lines(body);
  for (const SectionNode& n : body.on_pads) on_line[n.block][n.node] = 1;
  for (const SectionNode& n : body.prescribed) on_line[n.block][n.node] = 0;
  for (const Tie& t : body.ties) on_line[t.slave_block][t.slave_node] = 1;
  return chosen_nodes(on_line);
}

// A body as far as its elements are not needed.
struct Skeleton {
  explicit Skeleton(const SweptBody& body)
      : mesh(body),
        layout(layout_of(body)),
        tiling(tiling_of(body, layout)),
        ties(body, layout),
        lines(lines_of(body)) {}
  const SweptBody& mesh;
  BodyLayout layout;
  Tiling tiling;
  Ties ties;
  NodesOfBlocks lines;
};

double line_nodes(const Skeleton& b) {
  double out = 0;
  for (std::size_t k = 0; k < b.lines.size(); ++k)
    out += static_cast<double>(b.lines[k].size()) * b.layout.blocks[k].stations;
  return out;
}

// Adds one body's numbers that each rank sends in a step, and its nodes on lines that the rank keeps.
void add_lines(const Skeleton& b, const TileCut& cut, double contact, double half_width, std::vector<double>& given,
               std::vector<double>& kept) {
  const NodesOfBlocks bores = nodes_on_axle(b.mesh, b.lines);
  const SharedLines shared{b.mesh, b.layout, b.tiling, b.ties, cut, b.lines, {}, contact, half_width};
  const std::vector<LineReach> reaches = line_reaches(shared, static_cast<int>(given.size()));
  const std::vector<SentRanges> gifts = sent_ranges(shared, reaches);
  const std::vector<OwnedChain> all = stretches(b.tiling, cut);
  const bool gives_moments = b.mesh.kind == SweepKind::revolve && moments_of_tiles(b.mesh, b.ties);
  for (std::size_t k = 0; k < all.size(); ++k) {
    const auto block = static_cast<std::size_t>(b.tiling.block(all[k]));
    const long nodes = b.layout.blocks[block].nodes, bore = static_cast<long>(bores[block].size()),
               inner = b.tiling.tiles[all[k].end_tile - 1].end - b.tiling.border_plane(all[k]) - 1;
    const auto in_block = [&](const Tie& t) { return t.slave_block == static_cast<int>(block); };
    const long slaves = std::count_if(b.mesh.ties.begin(), b.mesh.ties.end(), in_block),
               moments = gives_moments ? slaves * moment_numbers(all[k]) : 0;
    given[all[k].owner] += static_cast<double>(6 * nodes + 3 * bore * inner + sent_numbers(gifts[k]) + moments);
  }
  for (std::size_t r = 0; r < kept.size(); ++r)
    for (std::size_t block = 0; block < b.lines.size(); ++block)
      for (int n : b.lines[block])
        for (const StationRange& at : reaches[r].values[block][n]) kept[r] += at.end - at.begin;
}

}  // namespace

RankNeed rank_need(const Model& model, int ranks) {
  RankNeed need;
  const Skeleton bodies[] = {Skeleton(model.rail), Skeleton(model.wheel)};
  std::vector<long> work;
  for (const Skeleton& b : bodies) {
    const std::vector<long> of_body = tile_work(b.mesh, b.tiling);
    work.insert(work.end(), of_body.begin(), of_body.end());
  }
  need.tiles = static_cast<int>(work.size());
  need.ranks = std::min(ranks, need.tiles);
  const double nodes = static_cast<double>(model.rail.nodes() + model.wheel.nodes());
  for (const Skeleton& b : bodies) need.lines += line_nodes(b) / nodes;
  need.kept = need.lines;
  if (need.ranks == 1) return need;
  const std::vector<int> owner = cut_evenly(work, need.ranks);
  std::vector<double> share(static_cast<std::size_t>(need.ranks)), given(share.size(), 2), kept(share.size());
  for (std::size_t p = 0; p < work.size(); ++p) share[owner[p]] += static_cast<double>(work[p]);
  const ContactWindow window(model, model.rail, model.wheel);
  const double half_width = window.half_length + window.stride;
  const auto rail_tiles = static_cast<std::ptrdiff_t>(bodies[0].tiling.tiles.size());
  const TileCut rail{0, {owner.begin(), owner.begin() + rail_tiles}},
      wheel{0, {owner.begin() + rail_tiles, owner.end()}};
  add_lines(bodies[0], rail, window.rail_start, half_width, given, kept);
  add_lines(bodies[1], wheel, 0, half_width / window.radius, given, kept);
  const auto largest = [](const std::vector<double>& of) { return *std::max_element(of.begin(), of.end()); };
  const auto sum = [](const std::vector<double>& of) { return std::accumulate(of.begin(), of.end(), 0.0); };
  need.largest_share = largest(share) / sum(share);
  need.kept = largest(kept) / nodes;
  need.bytes = 8 * (sum(given) - *std::min_element(given.begin(), given.end()));
  return need;
}

double relative_step_time(const RankNeed& need, double step, const RankNetwork& network) {
  if (need.ranks == 1) return 1;
  const double own = std::min(1.0, kContact * need.lines + kOwnLines * need.kept);
  const double network_time = network.latency * std::ceil(std::log2(need.ranks)) + need.bytes / network.bandwidth;
  return own + (1 - own) * need.largest_share + network_time / step;
}

}  // namespace railstrata
