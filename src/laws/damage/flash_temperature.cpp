#include "damage/flash_temperature.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>

namespace railstrata {
namespace {

void check(const ThermalMaterial& m) {
  if (!(m.conductivity > 0 && m.density > 0 && m.heat_capacity > 0))
    throw std::invalid_argument("conductivity, density and heat capacity must be positive");
}

void check(const HeatedLine& line, const ThermalBody& rail, const ThermalBody& wheel) {
  if (!(line.dx > 0 && line.speed > 0)) throw std::invalid_argument("a heated line needs dx > 0 and a speed > 0");
  for (const ThermalBody* body : {&rail, &wheel}) {
    check(body->base);
    if (!(body->layer_thickness >= 0)) throw std::invalid_argument("a layer's thickness must not be negative");
    if (body->layer_thickness > 0) check(body->layer);
    for (const ThermalMaterial& layer : body->deeper) check(layer);
  }
}

/// Rise of the surface temperature under a unit of flux that has lasted for the time t, K m²/W.
double step_response(const ThermalBody& body, double t) {
  if (t <= 0) return 0;
  const bool layered = body.layer_thickness > 0;
  const ThermalMaterial& surface = layered ? body.layer : body.base;
  double sum = std::sqrt(t);
  if (layered) {
    const double e = surface.effusivity(), e_base = body.base.effusivity(), alpha = (e - e_base) / (e + e_base);
    double weight = alpha;
    for (int n = 1; std::abs(weight) > 1e-17; ++n, weight *= alpha) {
      const double reach = n * body.layer_thickness / std::sqrt(surface.diffusivity() * t);
      if (reach > 6.2) break;  // exp(-38)
      sum += 2 * weight * std::sqrt(t) *
             (std::exp(-reach * reach) - std::sqrt(std::numbers::pi) * reach * std::erfc(reach));
    }
  }
  return 2 * sum / (surface.effusivity() * std::sqrt(std::numbers::pi));
}

/// Rise at the end of cell i by a unit of flux in cell i - lag, by lag.
std::vector<double> kernel(const ThermalBody& body, std::size_t cells, double cell_time) {
  std::vector<double> out(cells);
  double before = 0;
  for (std::size_t lag = 0; lag < cells; ++lag) {
    const double now = step_response(body, static_cast<double>(lag + 1) * cell_time);
    out[lag] = now - before;
    before = now;
  }
  return out;
}

/// The body as a half-space of its less (or more) effusive material.
ThermalBody half_space(const ThermalBody& body, bool less_effusive) {
  if (!(body.layer_thickness > 0)) return {.base = body.base, .layer = {}};
  const ThermalMaterial* taken = &body.base;
  const auto offer = [&](const ThermalMaterial& layer) {
    if ((layer.effusivity() < taken->effusivity()) == less_effusive) taken = &layer;
  };
  offer(body.layer);
  for (const ThermalMaterial& layer : body.deeper) offer(layer);
  return {.base = *taken, .layer = {}};
}

}  // namespace

double ThermalMaterial::effusivity() const { return std::sqrt(conductivity * density * heat_capacity); }
double ThermalMaterial::diffusivity() const { return conductivity / (density * heat_capacity); }

FlashTemperature flash_temperature(const HeatedLine& line, const ThermalBody& rail, const ThermalBody& wheel) {
  check(line, rail, wheel);
  const std::size_t cells = line.flux.size();
  const double cell_time = line.dx / line.speed;
  const std::vector<double> of_rail = kernel(rail, cells, cell_time), of_wheel = kernel(wheel, cells, cell_time);
  FlashTemperature out;
  out.rise.resize(cells);
  std::vector<double> into_rail(cells);
  for (std::size_t i = 0; i < cells; ++i) {
    double rail_rise = 0, wheel_rise = of_wheel[0] * line.flux[i];  // the latter with all of this cell's heat
    for (std::size_t j = 0; j < i; ++j) {
      rail_rise += of_rail[i - j] * into_rail[j];
      wheel_rise += of_wheel[i - j] * (line.flux[j] - into_rail[j]);
    }
    into_rail[i] = (wheel_rise - rail_rise) / (of_rail[0] + of_wheel[0]);
    out.rise[i] = rail_rise + of_rail[0] * into_rail[i];
    out.max = std::max(out.max, out.rise[i]);
  }
  return out;
}

FlashBounds flash_bounds(const HeatedLine& line, const ThermalBody& rail, const ThermalBody& wheel) {
  check(line, rail, wheel);
  const auto rise = [&](bool less_effusive) {
    return flash_temperature(line, half_space(rail, less_effusive), half_space(wheel, less_effusive)).max;
  };
  return {rise(false), rise(true)};
}

}  // namespace railstrata
