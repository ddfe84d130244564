#pragma once
// What a history has of elements that may yield.
#include <optional>

#include "body/body.hpp"

namespace railstrata::fem_checks {

struct PlasticState {
  std::array<double, 6> mean{};      ///< plastic strain, mean of the points; element's frame
  double accumulated = 0, most = 0;  ///< p, mean of the points and the largest
};

/// Nothing for elements that stay elastic.
inline std::optional<PlasticState> plastic_state(const Body& body, const PlasticHistory& history, int block, int quad,
                                                 int station) {
  const int tile = body.tiling.first_tile[block] + station / kTile;
  const double* rows = body.plastic.rows(history, tile, quad);
  if (!rows) return std::nullopt;
  rows += station % kTile;
  const GaussShape<double>& gauss = body.plastic.gauss_at(tile, quad);
  PlasticState out;
  for (int point = 0; point < kGaussPairs; ++point) {
    const double* at = rows + (PlasticEntries::kPoints + point * body.plastic.point_entries()) * kTile;
    const double weight = gauss.pair[point].weight;
    for (int i = 0; i < 6; ++i) out.mean[i] += weight * at[i * kTile];
    out.accumulated += weight * at[6 * kTile];
    out.most = std::max(out.most, at[6 * kTile]);
  }
  return out;
}

/// How many elements are hot.
inline long hot_elements(const Body& body, const PlasticHistory& history) {
  long count = 0;
  for (int slot = 0; slot < body.plastic.hot_places(history); ++slot) {
    const Tile& tile = body.tiling.tiles[body.plastic.hot(history, slot).tile];
    count += tile.end - tile.first;
  }
  return count;
}

}  // namespace railstrata::fem_checks
