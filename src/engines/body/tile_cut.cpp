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

// The end of the stretch that tile `first` is in.
int stretch_end(const Tiling& tiling, const TileCut& cut, int first) {
  const int block_end = tiling.first_tile[tiling.tiles[first].block + 1];
  int t = first;
  while (t < block_end && cut.owner_of(t) == cut.owner_of(first)) ++t;
  return t;
}

std::vector<StationRange> runs_of(const std::vector<char>& kept) {
  std::vector<StationRange> out;
  for (int j = 0; j < static_cast<int>(kept.size()); ++j) {
    if (!kept[j]) continue;
    if (out.empty() || out.back().end != j) out.push_back({j, j});
    out.back().end = j + 1;
  }
  return out;
}

}  // namespace

NodeMask no_nodes(const SweptBody& mesh) {
  NodeMask out;
  for (const Block& b : mesh.blocks) out.emplace_back(b.section.nodes.size(), 0);
  return out;
}

NodeMask nodes_on_lines(const SweptBody& mesh) {
  NodeMask out = no_nodes(mesh);
  for (int c = 0; c <= mesh.contact.columns; ++c) out[mesh.contact.block][c] = 1;
  for (const Tie& t : mesh.ties) {
    out[t.slave_block][t.slave_node] = 1;
    out[t.master_block][t.master_node0] = out[t.master_block][t.master_node1] = 1;
  }
  return out;
}

std::vector<long> tile_work(const SweptBody& mesh, const Tiling& tiling) {
  // measured by bench/rank_steps.cpp: 21.2 and 23.1 ns an element, 9 a node on a line
  const long of_element = mesh.kind == SweepKind::revolve ? 109 : 100, of_line_node = 43;
  const NodeMask on_line = nodes_on_lines(mesh);
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
  for (int t = 0; t < static_cast<int>(tiling.tiles.size()); t = out.back().end_tile)
    out.push_back({{t, stretch_end(tiling, cut, t)}, cut.owner_of(t)});
  return out;
}

std::vector<Chain> chains(const Tiling& tiling, int at_least, const TileCut& cut, std::vector<Chain> reuse) {
  const int tiles = static_cast<int>(tiling.tiles.size());
  const auto own = cut.whole() ? tiles : static_cast<int>(std::count(cut.owner.begin(), cut.owner.end(), cut.rank));
  const int length = std::max(1, own / at_least);
  std::vector<Chain> out = std::move(reuse);
  out.clear();
  for (int t = 0, end = 0; t < tiles; t = end) {
    end = stretch_end(tiling, cut, t);
    const int count = end - t, pieces = cut.is_own(t) ? (count + length - 1) / length : 1;
    for (int k = 0; k < pieces; ++k) out.push_back({t + k * count / pieces, t + (k + 1) * count / pieces});
  }
  return out;
}

StationRange own_stations(const Body& body, int tile) {
  const Tile& t = body.tiling.tiles[tile];
  const BlockLayout& l = body.layout.blocks[t.block];
  return {t.first, t.end == l.elements ? l.stations : t.end};
}

KeptValues kept_values(const Body& body, const TileCut& cut, NodeMask lines) {
  assert(lines.size() == body.layout.blocks.size());
  std::vector<std::vector<char>> kept;
  for (const BlockLayout& l : body.layout.blocks) kept.emplace_back(l.stations, 0);
  for (int t = 0; t < static_cast<int>(body.tiling.tiles.size()); ++t) {
    if (!cut.is_own(t)) continue;
    const StationRange own = own_stations(body, t);
    for (int j = own.begin; j < own.end; ++j) kept[body.tiling.tiles[t].block][j] = 1;
  }
  for (const OwnedChain& s : stretches(body.tiling, cut)) {
    std::vector<char>& of_block = kept[body.tiling.block(s)];
    of_block[body.tiling.border_plane(s)] = 1;
    if (!body.layout.blocks[body.tiling.block(s)].closed) of_block.back() = 1;
  }
  KeptValues out{std::move(lines), {}};
  for (const std::vector<char>& of_block : kept) out.runs.push_back(runs_of(of_block));
  return out;
}

}  // namespace railstrata
