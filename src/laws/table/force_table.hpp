#pragma once
// Numbers of contacts over a grid of axes: a creep-force table.
//
// A plain table is multilinear between its points: linear along every axis while the others rest. It passes through the
// points, stays within the values around a place, and rises where they rise.
//
// The first three axes of a scaled table are a place of table/creep_scaling.hpp. Its numbers are divided by what they
// grow with, its forces are turned into the direction of the creepage. What is left is a sum of waves around the angles
// and cubic along the other two, by the four points around; it is linear along further axes. Whoever asks gives plain
// creepages, spin, load and so on, and has plain numbers.
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "table/creep_scaling.hpp"

namespace railstrata {

struct TableAxis {
  std::string name, unit;  ///< SI; "": a plain number
  std::vector<double> at;  ///< ascending, two or more
};

struct TableNumber {
  std::string name, unit;
  std::vector<double> values;  ///< of every point, the last axis changing fastest; NaN: there is no answer
};

inline constexpr std::size_t kScaledAxes = 3;

struct TableScaling {
  std::array<TableAxis, kScaledAxes> asked;        ///< creepage_x, creepage_y, spin: what may be asked for, two ends
  std::array<TableNumber, kScaledAxes> stiffness;  ///< a CreepStiffness, over the axes after the third
  double largest_size = 0;                         ///< size is the third axis' value, in [0, 1], times this
  double spin_low = 0, spin_high = 0;              ///< ScaledPlace::spin at 0 and 1 of the second axis
  double load = 0, friction = 0;                   ///< N, where they are no axes of the table
};

struct ForceTable {
  std::vector<TableAxis> axes;
  std::vector<TableNumber> numbers;
  std::optional<TableScaling> scaling{};
  std::size_t points() const;
  /// An axis as the caller states it.
  const TableAxis& asked(std::size_t axis) const;
};

inline constexpr std::size_t kMostAxes = 8;

/// The three axes of a scaled table: `angles` around, `spins` and `sizes` from 0 to 1; four of each or more.
std::vector<TableAxis> scaled_axes(int angles, int spins, int sizes);

/// Throws CaseError: no axis or more than kMostAxes, an axis that does not ascend, values that are not as many as the
/// points, a scaled table without its axes, load or friction.
void check(const ForceTable& table);

/// A point's values along the axes, and as whoever asks gives it.
std::vector<double> grid_place(const ForceTable& table, std::size_t point);
std::vector<double> asked_place(const ForceTable& table, std::size_t point);

/// Load (N) and friction of a scaled table at a place, whose values after the third count.
struct ScaledLoad {
  double load = 0, friction = 0;
};
ScaledLoad load_at(const ForceTable& table, const double* place);

/// Interpolation in a table that lives longer and does not change; some ten nanoseconds for every corner of a cell.
class TableInterpolation {
 public:
  /// Throws as check.
  explicit TableInterpolation(const ForceTable& table);

  /// out[k]: the table's number k at a point with a value for each asked axis; NaN where a corner with weight has no
  /// answer. Values beyond an axis are taken at its end; returns how many were,
  /// by more than 1e-9 of the axis.
  int at(const double* point, double* out) const;

 private:
  /// Corners along an axis and their weights.
  struct Place {
    std::array<std::size_t, 4> index{};  ///< of the point times the axis' stride
    std::array<double, 4> weight{};
    std::size_t corners = 0;
  };
  using Places = std::array<Place, kMostAxes>;
  static Place linear(const std::vector<double>& at, double value, std::size_t stride);
  static Place cubic(const std::vector<double>& at, double value, std::size_t stride);
  Place around(double value) const;
  void divide();
  void refine_angles();
  void scaled(const double* point, Places& places, double* out) const;
  template <class Numbers>
  void add_corners(const Numbers& numbers, const Places& places, std::size_t axis, std::size_t index, double weight,
                   double* out) const;

  const ForceTable* table_;
  std::vector<std::size_t> stride_;
  std::vector<TableNumber> divided_;  ///< the numbers of a scaled table by what they grow with, forces turned
  std::size_t angles_ = 0;            ///< of these
  std::array<std::optional<std::size_t>, 2> force_;  ///< which numbers are force_x and lateral_force, if both are there
  std::optional<std::size_t> normal_, bound_;        ///< and normal_force and bound
};

}  // namespace railstrata
