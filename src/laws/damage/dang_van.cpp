#include "damage/dang_van.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>

#include "core/parallel.hpp"
#include "damage/deviator.hpp"
#include "damage/enclosing_ball.hpp"
#include "material/elastic.hpp"

namespace railstrata {
namespace {

double hydrostatic(const Sym3& s) { return (s.xx + s.yy + s.zz) / 3; }

/// Largest shear stress of a deviator given as five numbers.
double tresca_shear(const Vec5& u) {
  const double mean = u[1] / std::sqrt(3.0);  // (2 s_x - s_y - s_z)/6, so that s_x = 2 mean
  const Vec3 s = principal_stresses({2 * mean, -mean + u[0], -mean - u[0], u[3], u[4], u[2]});
  return 0.5 * (s.x - s.z);
}

void check(const StressHistory& history, ResidualRows residual, std::span<const DangVanLimit> limits) {
  check_residual(history, residual);
  check_rows(history, limits.size(), "Dang Van's constants");
  for (const DangVanLimit& l : limits)
    if (!(l.limit > 0 && l.c >= 0)) throw std::invalid_argument("Dang Van's limit must be positive, c not negative");
}

}  // namespace

DangVanStress dang_van_stress(std::span<const Sym3> cycle, const Sym3& residual, double c) {
  std::vector<Vec5> path(cycle.size());
  std::transform(cycle.begin(), cycle.end(), path.begin(), deviator);
  const Vec5 centre = enclosing_ball(path).centre;
  const double constant = hydrostatic(residual);
  DangVanStress worst;
  for (std::size_t i = 0; i < path.size(); ++i) {
    Vec5 u = path[i];
    for (std::size_t d = 0; d < u.size(); ++d) u[d] -= centre[d];
    const double amplitude = tresca_shear(u), mean = hydrostatic(cycle[i]) + constant, stress = amplitude + c * mean;
    if (i == 0 || stress > worst.stress) worst = {stress, amplitude, mean, static_cast<int>(i)};
  }
  return worst;
}

DangVanSection dang_van(const StressHistory& history, ResidualRows residual, std::span<const DangVanLimit> limits) {
  check(history, residual, limits);
  const int columns = history.columns();
  const std::size_t samples = history.x.size();
  DangVanSection section;
  section.point.resize(history.depth.size() * history.y.size());
  for_each(
      static_cast<std::ptrdiff_t>(section.point.size()),
      [&](std::ptrdiff_t p) {
        const int row = static_cast<int>(p) / columns, column = static_cast<int>(p) % columns;
        section.point[p] =
            dang_van_stress({history.cycle(row, column), samples}, residual_of(residual, row), limits[row].c);
      },
      true);
  for (int row = 0; row < history.rows(); ++row) {
    if (columns == 0 || std::isinf(limits[row].limit)) continue;
    const auto first = section.point.begin() + static_cast<std::ptrdiff_t>(row) * columns;
    const auto worst = std::max_element(
        first, first + columns, [](const DangVanStress& a, const DangVanStress& b) { return a.stress < b.stress; });
    const double utilisation = worst->stress / limits[row].limit;
    if (!section.row || utilisation > section.utilisation) {
      section.row = row;
      section.column = static_cast<int>(worst - first);
      section.utilisation = utilisation;
    }
  }
  return section;
}

}  // namespace railstrata
