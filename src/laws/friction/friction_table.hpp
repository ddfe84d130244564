#pragma once
// A number that depends on a place or a temperature: rows in order, linear between them, beyond them as at their ends.
#include <algorithm>
#include <vector>

namespace railstrata {

struct TablePoint {
  double at = 0, value = 0;
  friend bool operator==(const TablePoint&, const TablePoint&) = default;
};

/// Without rows `none`.
inline double over_table(const std::vector<TablePoint>& rows, double at, double none = 1) {
  if (rows.empty()) return none;
  const auto next = std::find_if(rows.begin(), rows.end(), [&](const TablePoint& row) { return row.at > at; });
  if (next == rows.begin()) return rows.front().value;
  if (next == rows.end()) return rows.back().value;
  const TablePoint& low = *std::prev(next);
  return low.value + (next->value - low.value) * (at - low.at) / (next->at - low.at);
}

inline double largest_value(const std::vector<TablePoint>& rows) {
  return std::max_element(rows.begin(), rows.end(), [](auto& a, auto& b) { return a.value < b.value; })->value;
}

}  // namespace railstrata
