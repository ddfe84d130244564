#include "bem/film_capacity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bem/case_patch.hpp"
#include "bem/load_history.hpp"
#include "core/faults.hpp"

namespace railstrata {

namespace {

/// N, at most, of friction and film in series.
double capacity(const CasePatch& patch, const NormalOptions& options, double normal) {
  const NormalTarget target{.load = normal, .approach = {}};
  const Plane pressure = solve_normal(*patch.influence, patch.grid, patch.contact.gap, target, options).pressure;
  double sum = 0;
  for (const double p : pressure)
    sum += std::min(patch.contact.friction * p, patch.contact.third_body.under(p, 1).yield_shear);
  return sum * patch.grid.cell_area();
}

/// A row's place; of two rows at one place, a jump, just behind it.
double place_of(const std::vector<double>& places, std::size_t row) {
  return row > 0 && places[row] == places[row - 1] ? std::nextafter(places[row], HUGE_VAL) : places[row];
}

}  // namespace

void require_film_carries(const CaseSpec& spec, const Placement& placement, const BemOptions& options) {
  const ThirdBody film = third_body(spec);
  if (spec.transient.kind == TransientKind::none || !film.yields() || film.hardening > 0) return;
  const LoadHistory history(spec, placement.contact);
  const auto normal = [&](const LoadedMoment& m) {
    return normal_load(m.load, m.y.force.value_or(0), placement.contact);
  };
  const double largest = normal_load(history.largest_load(), 0, placement.contact);
  std::vector<double> places = history.places();
  if (places.empty()) places.push_back(0);
  const CasePatch patch = make_case_patch(spec, placement, options, {.load = largest, .approach = {}});
  for (std::size_t row = 0; row < places.size(); ++row) {
    const LoadedMoment m = history.at(place_of(places, row));
    const double wanted = std::hypot(m.x.force.value_or(0), m.y.force.value_or(0));
    if (wanted == 0) continue;
    const double available = capacity(patch, options.rolling.normal, normal(m));
    if (wanted < available) continue;
    throw CaseError(fmt::format("row {} of the transient wants {:.4g} kN of friction; a film that yields at {:.4g} MPa "
                                "carries at most {:.4g} kN under its load",
                                row + 1, 1e-3 * wanted, 1e-6 * film.yield_shear, 1e-3 * available),
                    "lower the force, raise third_body.yield_shear, or give creepages or displacements, which also "
                    "allow full sliding",
                    "third_body.yield_shear");
  }
}

}  // namespace railstrata
