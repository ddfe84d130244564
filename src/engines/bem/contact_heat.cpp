#include "bem/contact_heat.hpp"

#include <algorithm>

namespace railstrata {

namespace {

double surface_effusivity(const ThermalBody& body) {
  return (body.layer_thickness > 0 ? body.layer : body.base).effusivity();
}

/// Rise in the middle of a step by a unit of flux so many steps before: both bodies together are linear and the same at
/// all times, so that any flux is a sum of such pulses.
std::vector<double> pulse_response(const ContactHeat& heat, std::size_t steps, double step, double speed) {
  std::vector<double> pulse(steps, 0.0);
  pulse.front() = 1;
  std::vector<double> rise = flash_temperature({pulse, step, speed}, heat.rail, heat.wheel).rise;
  for (std::size_t lag = steps; lag-- > 1;) rise[lag] = 0.5 * (rise[lag] + rise[lag - 1]);
  rise[0] *= 0.5;
  return rise;
}

/// T = before + own F(T), F the factor of friction over temperature: the cell heats itself by what it carries.
double own_temperature(const std::vector<TablePoint>& factor, double before, double own) {
  if (factor.empty() || !(own > 0)) return before + own;
  constexpr int kHalvings = 50;
  const auto [least, most] =
      std::minmax_element(factor.begin(), factor.end(), [](auto& a, auto& b) { return a.value < b.value; });
  double low = before + own * least->value, high = before + own * most->value;
  for (int i = 0; i < kHalvings && high > low; ++i) {
    const double middle = 0.5 * (low + high);
    (before + own * over_table(factor, middle) > middle ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

double ContactHeat::before_sliding() const {
  const double of_rail = surface_effusivity(rail), of_wheel = surface_effusivity(wheel);
  return (of_rail * rail_temperature + of_wheel * wheel_temperature) / (of_rail + of_wheel);
}

Plane friction_flux(const TangentialSolution& s, double speed) {
  Plane flux(s.q_x.size());
  for (std::size_t k = 0; k < flux.size(); ++k)
    flux[k] = std::max(0.0, s.q_x[k] * s.cell_slip.x[k] + s.q_y[k] * s.cell_slip.y[k]) * speed;
  return flux;
}

Plane contact_temperature(const ContactHeat& heat, const PatchGrid& grid, const Plane& flux, const Plane& made_at,
                          const std::vector<Plane>& before, bool steady, double step, double speed) {
  const auto columns = static_cast<std::size_t>(grid.ny);
  const std::size_t steps = steady ? static_cast<std::size_t>(grid.nx) : before.size() + 1;
  const std::vector<double> response = pulse_response(heat, steps, step, speed);
  const double cold = heat.before_sliding();
  Plane out(grid.size()), now = flux;
  for (std::size_t k = grid.size(); k-- > 0;) {  // from the leading edge on
    double rise = 0;
    for (std::size_t lag = 1; lag < steps; ++lag) {
      const std::size_t ahead = k + lag * columns;
      if (steady && ahead >= now.size()) break;
      rise += response[lag] * (steady ? now[ahead] : before[lag - 1][k]);
    }
    const double factor = over_table(heat.friction, made_at[k]);
    const double own = factor > 0 ? response[0] * now[k] / factor : 0.0;
    out[k] = own_temperature(heat.friction, cold + rise, own);
    if (factor > 0) now[k] *= over_table(heat.friction, out[k]) / factor;
  }
  return out;
}

}  // namespace railstrata
