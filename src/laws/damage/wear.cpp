#include "damage/wear.hpp"

#include <cmath>
#include <cstddef>
#include <stdexcept>

#include "damage/positive.hpp"

namespace railstrata {
namespace {

void check(const Streamline& line) {
  const std::size_t n = line.p.size();
  for (const auto* values : {&line.q_x, &line.q_y, &line.slip_x, &line.slip_y})
    if (values->size() != n) throw std::invalid_argument("the rows of a streamline differ in length");
  for (const auto* values : {&line.power, &line.pressed})
    if (!values->empty() && values->size() != n)
      throw std::invalid_argument("the rows of a streamline differ in length");
  if (!(line.dx > 0 && line.speed > 0)) throw std::invalid_argument("a streamline needs dx > 0 and a speed > 0");
}

double power(const Streamline& line, std::size_t i) {
  if (!line.power.empty()) return line.power[i];
  return line.q_x[i] * line.slip_x[i] + line.q_y[i] * line.slip_y[i];
}
double slip(const Streamline& line, std::size_t i) { return std::hypot(line.slip_x[i], line.slip_y[i]); }
double pressed_slip(const Streamline& line, std::size_t i) {
  if (!line.pressed.empty()) return line.pressed[i];
  return line.p[i] > 0 ? line.p[i] * slip(line, i) : 0;
}

/// Calls with every cell that wears and k p |s| dx/V of it.
template <class Use>
void for_worn(const Streamline& line, const ArchardMap& map, double hardness, const Use& use) {
  check(line);
  positive(hardness, "hardness");
  for (std::size_t i = 0; i < line.p.size(); ++i) {
    const double work = pressed_slip(line, i);
    if (!(work > 0)) continue;
    use(i, archard_coefficient(map, line.p[i], slip(line, i), hardness) * work * line.dx / line.speed);
  }
}

}  // namespace

std::vector<double> friction_power(const Streamline& line) {
  check(line);
  std::vector<double> out(line.p.size());
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = power(line, i);
  return out;
}

double friction_energy(const Streamline& line) {
  double energy = 0;
  for (const double w : friction_power(line)) energy += w * line.dx / line.speed;
  return energy;
}

double usfd_rate(double t_gamma_per_area) {
  constexpr double pascal = 1e6, rate = 1e-3;  // N/mm², µg/(m mm²)
  constexpr double severe = 55.0, slope = 61.9, offset = slope * (kUsfdCatastrophicFrom / pascal) - severe;
  const double x = std::abs(t_gamma_per_area) / pascal;
  if (x > kUsfdCatastrophicFrom / pascal) return rate * (slope * x - offset);
  return rate * (x < kUsfdSevereFrom / pascal ? 5.3 * x : severe);
}

double usfd_depth(const Streamline& line, double density) {
  check(line);
  positive(density, "density");
  double mass = 0;  // kg/m²
  for (std::size_t i = 0; i < line.p.size(); ++i) mass += usfd_rate(std::abs(power(line, i)) / line.speed) * line.dx;
  return mass / density;
}

ArchardMap laboratory_dry_archard() { return {.slow = 5e-4, .middle = 35e-4, .fast = 5e-4, .seizure = 350e-4}; }

double archard_coefficient(const ArchardMap& map, double p, double slip_velocity, double hardness) {
  constexpr double kMiddleFrom = 0.2, kFastFrom = 0.7;  // m/s
  if (p > kSeizurePressure * hardness) return map.seizure;
  if (slip_velocity < kMiddleFrom) return map.slow;
  return slip_velocity <= kFastFrom ? map.middle : map.fast;
}

double archard_depth(const Streamline& line, const ArchardMap& map, double hardness, double scale) {
  double depth = 0;
  for_worn(line, map, hardness, [&](std::size_t, double worn) { depth += worn; });
  return scale * depth / hardness;
}

OutsideMap archard_outside(const Streamline& line, const ArchardMap& map, double hardness, double scale) {
  OutsideMap out;
  for_worn(line, map, hardness, [&](std::size_t i, double worn) {
    if (line.p[i] > kSeizurePressure * hardness)
      out.seized += scale * worn / hardness;
    else if (slip(line, i) > kFastestOfMap)
      out.fast += scale * worn / hardness;
  });
  return out;
}

std::optional<double> local_fatigue(const Streamline& line, double cyclic_shear_yield) {
  check(line);
  std::optional<double> worst;
  for (std::size_t i = 0; i < line.p.size(); ++i) {
    if (!(line.p[i] > 0)) continue;
    const double index = (std::hypot(line.q_x[i], line.q_y[i]) - cyclic_shear_yield) / line.p[i];
    if (!worst || index > *worst) worst = index;
  }
  return worst;
}

}  // namespace railstrata
