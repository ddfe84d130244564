#include "creep/table_error.hpp"

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

/// Even between the ends; with `dense`, of a creepage to both sides of 0 the logarithm of its size is.
double place_on(const TableAxis& axis, double share, bool dense) {
  constexpr int kSteps = 1'000'000;
  const double low = axis.at.front(), high = axis.at.back();
  const bool both_sides = (axis.name == "spin" || axis.name.starts_with("creepage")) && low < 0 && high > 0;
  if (!dense || !both_sides) return low + share * (high - low);
  return (share < 0.5 ? low : high) * decade_share(static_cast<int>(kSteps * std::fmod(2 * share, 1.0)), kSteps);
}

std::vector<double> place(const ForceTable& table, std::size_t n) {
  constexpr int kPrimes[kMostAxes] = {2, 3, 5, 7, 11, 13, 17, 19};
  std::vector<double> out;
  for (std::size_t k = 0; k < table.axes.size(); ++k)
    out.push_back(place_on(table.asked(k), spread(n / 2, kPrimes[k]), n % 2 == 0));
  return out;
}

struct Place {
  std::vector<double> at;
  std::optional<CreepNumbers> direct;  ///< none: there is no answer, or no number of the table
  CreepNumbers difference{};
  double creep_force = 0;  ///< TableError::CreepForce's
};

/// The first two numbers are the forces, the last one is their size over friction times normal force.
double creep_force_error(const CreepNumbers& difference, const CreepNumbers& direct) {
  const double wrong = std::hypot(difference[0], difference[1]);
  return wrong > 0 ? wrong / std::hypot(direct[0], direct[1]) * direct.back() : 0;
}

TableError::CreepForce creep_force_of(std::vector<Place> places) {
  TableError::CreepForce out;
  if (places.empty()) return out;
  std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) { return a.creep_force < b.creep_force; });
  out.half = places[places.size() / 2].creep_force;
  out.most = places[places.size() * 95 / 100].creep_force;
  out.largest = places.back().creep_force;
  out.where = places.back().at;
  return out;
}

}  // namespace

TableError interpolation_error(const CreepTable& creep_table, int places, const CreepTableOptions& options) {
  const ForceTable& table = creep_table.table();
  const TableInterpolation between(table);
  std::vector<Place> found(static_cast<std::size_t>(places));
  InfluenceCache cache;
  for_each(
      places,
      [&](std::ptrdiff_t i) {
        if (asked_to_stop(options.control)) return;
        Place& here = found[static_cast<std::size_t>(i)];
        here.at = place(table, static_cast<std::size_t>(i));
        BemOptions bem = options.bem;
        bem.cache = &cache;
        const std::optional<CreepNumbers> direct = creep_table.direct(here.at, bem);
        CreepNumbers out{};
        between.at(here.at.data(), out.data());
        if (!direct || std::isnan(out.front())) return;
        for (std::size_t k = 0; k < out.size(); ++k) out[k] = std::abs(out[k] - (*direct)[k]);
        here.direct = direct;
        here.difference = out;
        here.creep_force = creep_force_error(out, *direct);
      },
      true);
  std::erase_if(found, [](const Place& p) { return !p.direct; });
  TableError error;
  error.places = static_cast<int>(found.size());
  for (std::size_t k = 0; k < table.numbers.size(); ++k) {
    TableError::Number n{table.numbers[k].name, table.numbers[k].unit};
    for (const Place& p : found) {
      n.largest = std::max(n.largest, p.difference[k]);
      n.mean += p.difference[k] / error.places;
      n.scale = std::max(n.scale, std::abs((*p.direct)[k]));
    }
    error.numbers.push_back(n);
  }
  error.creep_force = creep_force_of(std::move(found));
  return error;
}

}  // namespace railstrata
