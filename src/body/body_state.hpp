#pragma once
// What changes of a body: named arrays, listed once. Checkpoints go through this list; so shall whatever else moves a
// state (halos between ranks, copies on a device, views from Python).
#include <array>

#include "body/body.hpp"

namespace railstrata {

struct BodyState {
  BodyState() = default;
  /// Zero everywhere. history_entries: numbers that the elements keep (kHistory of their class).
  explicit BodyState(const Body& body, int history_entries = ElasticHex::kHistory);

  Field u;        ///< m, displacements
  Field v;        ///< m/s, velocities at the half step before
  Field f;        ///< N, internal forces and what is added to them in a step; nothing of it survives the step
  Field history;  ///< of the elements, as committed: [block][quadrilateral][entry][element]
};

struct StateArray {
  const char* name;
  const char* unit;
  Field BodyState::*values;
  bool restart;  ///< needed to go on
};

inline constexpr std::array<StateArray, 4> kStateArrays{{{"u", "m", &BodyState::u, true},
                                                         {"v", "m/s", &BodyState::v, true},
                                                         {"f", "N", &BodyState::f, false},
                                                         {"history", "", &BodyState::history, true}}};

/// Numbers in an array of a body's state.
std::size_t array_size(const Body& body, const StateArray& array, int history_entries = ElasticHex::kHistory);

/// Where an element's history stands: entry k of the elements of a quadrilateral at first + k * stride, + element.
struct HistoryLayout {
  HistoryLayout(const BodyLayout& layout, const SweptBody& mesh, int entries);
  std::ptrdiff_t first(int block, int quad) const {
    return offset[block] + static_cast<std::ptrdiff_t>(quad) * entries * stride[block];
  }
  int entries = 0;
  std::vector<std::ptrdiff_t> offset;  ///< per block
  std::vector<int> stride;
  std::ptrdiff_t size = 0;
};

}  // namespace railstrata
