#pragma once
// History of the elements of a body that may yield (body/plastic_elements.hpp): a slot of numbers for each
// place that is hot, in the order in which the places became hot.
#include <vector>

#include "core/array.hpp"

namespace railstrata {

struct PlasticHistory {
  static constexpr int kCold = -1;

  std::vector<int> places;   ///< candidate of each slot
  std::vector<int> slot_of;  ///< of each candidate, or kCold; follows from `places`
  Field numbers;             ///< slot by slot: entry k of a place's elements at + k * kTile

  bool empty() const { return places.empty(); }
  friend bool operator==(const PlasticHistory&, const PlasticHistory&) = default;
};

}  // namespace railstrata
