#pragma once
// What the parts of one pass share: its arrays, and columns that go through the law together.
#include <algorithm>
#include <cstddef>
#include <vector>

#include "core/simd.hpp"
#include "steady/steady_pass.hpp"

namespace railstrata {

/// Arrays of one pass.
struct SteadyBody::Work {
  Field before;               // strain of the earlier passes, per component and point of the section
  std::vector<bool> rows;     // that are followed; empty: all
  Field field;                // plastic strain of this pass everywhere, then the strain it causes
  bool clean = true;          // `field` holds zeros
  Field guess, residual;      // at active stations
  std::vector<double> after;  // histories behind the load
  std::vector<double> late;   // p of each point in the last quarter of the stations behind the load

  bool follows(int row) const { return rows.empty() || rows[static_cast<std::size_t>(row)]; }
};

/// Of all places of a grid's path: Catmull and Rom's cubic, the end's value beyond the ends.
std::vector<Between> between_stations(const SteadyGrid& grid);

/// Neighbouring columns of a row, as many as a pack has lanes or fewer.
struct SteadyBody::Columns {
  int row = 0, first = 0, count = 0;

  static int blocks_of(const SteadyGrid& g) { return (g.ny + kLanes - 1) / kLanes; }
  Columns(const SteadyGrid& g, std::ptrdiff_t block)
      : row(static_cast<int>(block / blocks_of(g))),
        first(kLanes * static_cast<int>(block % blocks_of(g))),
        count(std::min(kLanes, g.ny - first)) {}
  /// Of ContactPath::strain, where place k of so many begins.
  std::size_t place(const SteadyGrid& g, std::size_t places, std::size_t k) const {
    return (static_cast<std::size_t>(row * blocks_of(g) + first / kLanes) * places + k) * 6 * kLanes;
  }
};

/// Strain at some columns beside that of the contact.
struct SteadyBody::Surroundings {
  Surroundings(const SteadyBody& body, const Columns& columns, const Field& before, const Field& guess);

  Pack always[6];      ///< of earlier passes and of the process
  const Field& guess;  ///< of this pass, at stations
  Pack most;           ///< size of it at any place of the path, at most
};

}  // namespace railstrata
