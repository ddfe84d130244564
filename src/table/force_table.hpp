#pragma once
// Numbers of contacts over a grid of axes: a creep-force table.
//
// Between its points a table is multilinear: linear along every axis while the others rest. It passes through the
// points, stays within the values around a place, and rises where they rise.
#include <cstddef>
#include <string>
#include <vector>

namespace railstrata {

struct TableAxis {
  std::string name, unit;  ///< SI; "": a plain number
  std::vector<double> at;  ///< ascending, two or more
};

struct TableNumber {
  std::string name, unit;
  std::vector<double> values;  ///< of every point, the last axis changing fastest; NaN: there is no answer
};

struct ForceTable {
  std::vector<TableAxis> axes;
  std::vector<TableNumber> numbers;
  std::size_t points() const;
};

inline constexpr std::size_t kMostAxes = 8;

/// Throws CaseError: no axis or more than kMostAxes, an axis that does not ascend, values that are not as many as the
/// points.
void check(const ForceTable& table);

/// Interpolation in a table that lives longer; some ten nanoseconds for every corner of a cell.
class TableInterpolation {
 public:
  /// Throws as check.
  explicit TableInterpolation(const ForceTable& table);

  /// out[k]: the table's number k at a point with a value for each axis; NaN where a corner with weight has no answer.
  /// Values beyond an axis are taken at its end; returns how many were.
  int at(const double* point, double* out) const;

 private:
  const ForceTable* table_;
  std::vector<std::size_t> stride_;
};

}  // namespace railstrata
