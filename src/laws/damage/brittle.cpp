#include "damage/brittle.hpp"

#include <cstddef>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "core/parallel.hpp"
#include "material/elastic.hpp"

namespace railstrata {
namespace {

PrincipalPeak peak_of_row(const StressHistory& history, const Sym3& residual, int row) {
  std::optional<PrincipalPeak> peak;
  for (int column = 0; column < history.columns(); ++column) {
    const Sym3* cycle = history.cycle(row, column);
    for (int i = 0; i < history.samples(); ++i) {
      const double sigma = principal_stresses(cycle[i] + residual).x;
      if (!peak || sigma > peak->stress) peak = {sigma, row, column, i};
    }
  }
  return peak.value_or(PrincipalPeak{});
}

}  // namespace

std::vector<BrittleZone> principal_peaks(const StressHistory& history, ResidualRows residual) {
  check_residual(history, residual);
  std::vector<PrincipalPeak> rows(history.depth.size());
  for_each(static_cast<std::ptrdiff_t>(rows.size()), [&](std::ptrdiff_t row) {
    rows[row] = peak_of_row(history, residual_of(residual, static_cast<int>(row)), static_cast<int>(row));
  });
  std::vector<BrittleZone> zones;
  double top = 0;
  for (int row = 0; row < history.rows(); ++row) {
    if (zones.empty() || zones.back().zone != history.zone[row]) {
      zones.push_back({.zone = history.zone[row], .inside = rows[row], .surface = {}});
      top = history.depth[row];
    }
    BrittleZone& zone = zones.back();
    zone.thickness = history.depth[row] - top;
    if (rows[row].stress > zone.inside.stress) zone.inside = rows[row];
    if (history.depth[row] == 0) zone.surface = rows[row];
  }
  return zones;
}

double critical_flaw(double toughness, double sigma_1) {
  if (!(toughness > 0)) throw std::invalid_argument("fracture toughness must be positive");
  if (!(sigma_1 > 0)) return std::numeric_limits<double>::infinity();
  const double root = toughness / (1.12 * sigma_1);
  return root * root / std::numbers::pi;
}

}  // namespace railstrata
