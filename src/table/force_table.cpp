#include "table/force_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/faults.hpp"

namespace railstrata {
namespace {

/// A value's place on an axis: between `below` and the point above it.
struct Place {
  std::size_t below = 0;
  double share = 0;  ///< of the point above
};

Place place_on(const std::vector<double>& at, double value) {
  const auto above = std::upper_bound(at.begin() + 1, at.end() - 1, value);
  const std::size_t below = static_cast<std::size_t>(above - at.begin()) - 1;
  return {below, (value - at[below]) / (at[below + 1] - at[below])};
}

bool ascends(const std::vector<double>& at) {
  if (!std::all_of(at.begin(), at.end(), [](double v) { return std::isfinite(v); })) return false;
  return std::adjacent_find(at.begin(), at.end(), [](double a, double b) { return !(a < b); }) == at.end();
}

}  // namespace

std::size_t ForceTable::points() const {
  std::size_t n = 1;
  for (const TableAxis& axis : axes) n *= axis.at.size();
  return n;
}

void check(const ForceTable& table) {
  if (table.axes.empty() || table.axes.size() > kMostAxes)
    throw CaseError(fmt::format("a table of {} axes", table.axes.size()), fmt::format("give 1 to {}", kMostAxes));
  for (const TableAxis& axis : table.axes)
    if (axis.at.size() < 2 || !ascends(axis.at))
      throw CaseError(fmt::format("the axis {} does not ascend", axis.name), "give two values or more, each once");
  for (const TableNumber& number : table.numbers)
    if (number.values.size() != table.points())
      throw CaseError(fmt::format("{} has {} values for {} points", number.name, number.values.size(), table.points()),
                      "give one for each point");
}

TableInterpolation::TableInterpolation(const ForceTable& table) : table_(&table), stride_(table.axes.size()) {
  check(table);
  std::size_t stride = 1;
  for (std::size_t k = table.axes.size(); k-- > 0;) {
    stride_[k] = stride;
    stride *= table.axes[k].at.size();
  }
}

int TableInterpolation::at(const double* point, double* out) const {
  const std::size_t axes = table_->axes.size();
  std::array<Place, kMostAxes> places;
  std::size_t first = 0;
  int beyond = 0;
  for (std::size_t k = 0; k < axes; ++k) {
    const std::vector<double>& at = table_->axes[k].at;
    const double value = std::clamp(point[k], at.front(), at.back());
    beyond += value != point[k];
    places[k] = place_on(at, value);
    first += places[k].below * stride_[k];
  }
  std::fill_n(out, table_->numbers.size(), 0.0);
  for (std::size_t corner = 0; corner < (std::size_t{1} << axes); ++corner) {
    double weight = 1;
    std::size_t index = first;
    for (std::size_t k = 0; k < axes; ++k) {
      const bool above = (corner >> k) & 1;
      weight *= above ? places[k].share : 1 - places[k].share;
      index += above ? stride_[k] : 0;
    }
    if (weight == 0) continue;
    for (std::size_t n = 0; n < table_->numbers.size(); ++n) out[n] += weight * table_->numbers[n].values[index];
  }
  return beyond;
}

}  // namespace railstrata
