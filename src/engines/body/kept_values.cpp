#include "body/kept_values.hpp"

#include <cassert>

namespace railstrata {
namespace {

std::vector<StationRun> runs_of(const std::vector<char>& kept) {
  std::vector<StationRun> out;
  for (int j = 0; j < static_cast<int>(kept.size()); ++j) {
    if (!kept[j]) continue;
    if (out.empty() || out.back().end != j) out.push_back({j, j});
    out.back().end = j + 1;
  }
  return out;
}

}  // namespace

StationRun own_stations(const Body& body, int tile) {
  const Tile& t = body.tiling.tiles[tile];
  const BlockLayout& l = body.layout.blocks[t.block];
  return {t.first, t.end == l.elements ? l.stations : t.end};
}

KeptValues kept_values(const Body& body, const TileCut& cut, std::vector<std::vector<char>> lines) {
  assert(lines.size() == body.layout.blocks.size());
  std::vector<std::vector<char>> kept;
  for (const BlockLayout& l : body.layout.blocks) kept.emplace_back(l.stations, 0);
  for (int t = 0; t < static_cast<int>(body.tiling.tiles.size()); ++t) {
    if (!cut.is_own(t)) continue;
    const StationRun own = own_stations(body, t);
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
