#include "damage/brittle.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <numbers>
#include <span>
#include <stdexcept>

#include "core/parallel.hpp"
#include "material/elastic.hpp"

namespace railstrata {
namespace {

double largest_principal(const StressHistory& history, const Sym3& residual, int row) {
  double most = -std::numeric_limits<double>::infinity();
  const Sym3* first = history.cycle(row, 0);
  for (const Sym3& stress : std::span(first, history.y.size() * history.x.size()))
    most = std::max(most, principal_stresses(stress + residual).x);
  return most;
}

}  // namespace

std::vector<BrittleZone> principal_peaks(const StressHistory& history, ResidualRows residual) {
  check_residual(history, residual);
  std::vector<double> largest(history.depth.size());
  for_each(history.rows(), [&](std::ptrdiff_t row) {
    largest[row] = largest_principal(history, residual_of(residual, static_cast<int>(row)), static_cast<int>(row));
  });
  std::vector<BrittleZone> zones;
  double top = 0;
  for (int row = 0; row < history.rows(); ++row) {
    if (zones.empty() || zones.back().zone != history.zone[row]) {
      zones.push_back({.zone = history.zone[row], .stress = largest[row], .row = row});
      top = history.depth[row];
    }
    BrittleZone& zone = zones.back();
    zone.thickness = history.depth[row] - top;
    if (largest[row] > zone.stress) {
      zone.stress = largest[row];
      zone.row = row;
    }
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
