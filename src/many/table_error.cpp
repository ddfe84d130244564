#include "many/table_error.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/parallel.hpp"

namespace railstrata {
namespace {

/// The digits of n + 1 in a prime base, behind the point: fills [0, 1) evenly. [Halton1960]
double spread(std::size_t n, int base) {
  double out = 0, part = 1;
  for (std::size_t rest = n + 1; rest > 0; rest /= static_cast<std::size_t>(base)) {
    part /= base;
    out += part * static_cast<double>(rest % static_cast<std::size_t>(base));
  }
  return out;
}

/// Even among the axis' cells: where points are dense, places are.
double place_among(const std::vector<double>& at, double share) {
  const double cells = share * static_cast<double>(at.size() - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(cells), at.size() - 2);
  return at[below] + (cells - static_cast<double>(below)) * (at[below + 1] - at[below]);
}

std::vector<double> place(const ForceTable& table, std::size_t n) {
  constexpr int kPrimes[kMostAxes] = {2, 3, 5, 7, 11, 13, 17, 19};
  std::vector<double> out;
  for (std::size_t k = 0; k < table.axes.size(); ++k)
    out.push_back(place_among(table.axes[k].at, spread(n, kPrimes[k])));
  return out;
}

}  // namespace

TableError interpolation_error(const CreepTable& creep_table, int places, const CreepTableOptions& options) {
  const ForceTable& table = creep_table.table();
  const TableInterpolation between(table);
  std::vector<std::optional<CreepNumbers>> differences(static_cast<std::size_t>(places));
  InfluenceCache cache;
  for_each(
      places,
      [&](std::ptrdiff_t i) {
        if (asked_to_stop(options.control)) return;
        const auto n = static_cast<std::size_t>(i);
        const std::vector<double> point = place(table, n);
        BemOptions bem = options.bem;
        bem.cache = &cache;
        const std::optional<CreepNumbers> direct = creep_table.direct(point, bem);
        if (!direct) return;
        CreepNumbers& out = differences[n].emplace();
        between.at(point.data(), out.data());
        for (std::size_t k = 0; k < out.size(); ++k) out[k] = std::abs(out[k] - (*direct)[k]);
      },
      true);
  TableError error;
  for (const TableNumber& number : table.numbers) {
    error.numbers.push_back({number.name, number.unit});
    for (const double v : number.values)
      if (std::isfinite(v)) error.numbers.back().scale = std::max(error.numbers.back().scale, std::abs(v));
  }
  for (const std::optional<CreepNumbers>& d : differences) {
    if (!d || std::isnan(d->front())) continue;
    ++error.places;
    for (std::size_t k = 0; k < d->size(); ++k) {
      error.numbers[k].largest = std::max(error.numbers[k].largest, (*d)[k]);
      error.numbers[k].mean += (*d)[k];
    }
  }
  for (TableError::Number& n : error.numbers) n.mean /= std::max(error.places, 1);
  return error;
}

}  // namespace railstrata
