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

Plane contact_temperature(const ContactHeat& heat, const PatchGrid& grid, const Plane& flux,
                          const std::vector<Plane>& before, bool steady, double step, double speed) {
  const auto columns = static_cast<std::size_t>(grid.ny);
  const std::size_t steps = steady ? static_cast<std::size_t>(grid.nx) : before.size() + 1;
  const std::vector<double> response = pulse_response(heat, steps, step, speed);
  const auto flux_of = [&](std::size_t k, std::size_t lag) {
    if (!steady) return lag == 0 ? flux[k] : before[lag - 1][k];
    const std::size_t ahead = k + lag * columns;
    return ahead < flux.size() ? flux[ahead] : 0.0;
  };
  Plane out(grid.size(), heat.before_sliding());
  for_cells(
      grid.size(),
      [&](std::size_t k) {
        for (std::size_t lag = 0; lag < steps; ++lag) out[k] += response[lag] * flux_of(k, lag);
      },
      steps);
  return out;
}

}  // namespace railstrata
