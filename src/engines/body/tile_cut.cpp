#include "body/tile_cut.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <numeric>

#include "core/faults.hpp"

namespace railstrata {
namespace {

// Stretches of at most `most` each, filled one after the other.
std::vector<int> filled(const std::vector<long>& work, long most) {
  std::vector<int> out;
  long sum = 0;
  int part = 0;
  for (long w : work) {
    if (!out.empty() && sum + w > most) {
      ++part;
      sum = 0;
    }
    sum += w;
    out.push_back(part);
  }
  return out;
}

}  // namespace

std::vector<long> tile_work(const SweptBody& mesh, const Tiling& tiling) {
  // measured by bench/rank_steps.cpp: 21.2 and 23.1 ns an element, 9 a node on a line
  const long of_element = mesh.kind == SweepKind::revolve ? 109 : 100, of_line_node = 43;
  std::vector<std::vector<char>> on_line;
  for (const Block& b : mesh.blocks) on_line.emplace_back(b.section.nodes.size(), 0);
  for (int c = 0; c <= mesh.contact.columns; ++c) on_line[mesh.contact.block][c] = 1;
  for (const Tie& t : mesh.ties) {
    on_line[t.slave_block][t.slave_node] = 1;
    on_line[t.master_block][t.master_node0] = on_line[t.master_block][t.master_node1] = 1;
  }
  std::vector<long> of_station;  // by block
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b)
    of_station.push_back(of_element * static_cast<long>(mesh.blocks[b].section.quads.size()) +
                         of_line_node * std::count(on_line[b].begin(), on_line[b].end(), 1));
  std::vector<long> out;
  for (const Tile& t : tiling.tiles) out.push_back(of_station[t.block] * (t.end - t.first));
  return out;
}

std::vector<int> cut_evenly(const std::vector<long>& work, int parts) {
  assert(parts > 0);
  if (work.empty()) return {};
  long low = *std::max_element(work.begin(), work.end()), high = std::accumulate(work.begin(), work.end(), 0L);
  while (low < high) {
    const long middle = low + (high - low) / 2;
    if (filled(work, middle).back() < parts)
      high = middle;
    else
      low = middle + 1;
  }
  return filled(work, low);
}

std::vector<TileCut> cut_tiles(const std::vector<const Body*>& bodies, int ranks, int rank) {
  assert(0 <= rank && rank < ranks);
  std::vector<TileCut> out(bodies.size());
  if (ranks == 1) return out;
  std::vector<long> work;
  for (const Body* body : bodies) {
    const std::vector<long> of_body = tile_work(body->mesh, body->tiling);
    work.insert(work.end(), of_body.begin(), of_body.end());
  }
  if (static_cast<std::size_t>(ranks) > work.size())
    throw CaseError(
        fmt::format("{} ranks cannot share this mesh: it has {} pieces of {} stations", ranks, work.size(), kTile),
        "start fewer ranks, with more threads each");
  const std::vector<int> owner = cut_evenly(work, ranks);
  auto next = owner.begin();
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const auto count = static_cast<std::ptrdiff_t>(bodies[k]->tiling.tiles.size());
    out[k].rank = rank;
    out[k].owner.assign(next, next + count);
    next += count;
  }
  return out;
}

std::vector<OwnedChain> stretches(const Tiling& tiling, const TileCut& cut) {
  std::vector<OwnedChain> out;
  for (int t = 0; t < static_cast<int>(tiling.tiles.size()); ++t) {
    const int owner = cut.whole() ? cut.rank : cut.owner[t];
    const bool anew = out.empty() || tiling.tiles[t].block != tiling.tiles[t - 1].block || owner != out.back().owner;
    if (anew) out.push_back({{t, t}, owner});
    out.back().end_tile = t + 1;
  }
  return out;
}

std::vector<Chain> cut_chains(const Tiling& tiling, const TileCut& cut, int at_least, bool single_tiles,
                              std::vector<Chain> reuse) {
  const auto own = static_cast<int>(std::count(cut.owner.begin(), cut.owner.end(), cut.rank));
  const int length = single_tiles ? 1 : std::max(1, own / std::max(at_least, 1));
  std::vector<Chain> out = std::move(reuse);
  out.clear();
  for (const OwnedChain& s : stretches(tiling, cut)) {
    const int tiles = s.end_tile - s.first_tile;
    const int pieces = s.owner == cut.rank ? (tiles + length - 1) / length : 1;
    for (int k = 0; k < pieces; ++k)
      out.push_back({s.first_tile + k * tiles / pieces, s.first_tile + (k + 1) * tiles / pieces});
  }
  return out;
}

}  // namespace railstrata
