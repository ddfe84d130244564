#include "table/creep_scaling.hpp"

#include <cmath>

namespace railstrata {
namespace {

constexpr double kThird = 1.0 / 3;
constexpr double kMiddle = 1.25;  // c

struct Growth {
  std::string_view number;
  double friction, load, radius;  // exponents
};
constexpr Growth kGrowths[] = {{"force_x", 1, 1, 0},
                               {"lateral_force", 1, 1, 0},
                               {"normal_force", 0, 1, 0},
                               {"spin_moment", 1, 4 * kThird, 0},
                               {"approach", 0, 2 * kThird, 0},
                               {"p_max", 0, kThird, 0},
                               {"patch_area", 0, 2 * kThird, 0},
                               {"dissipation", 2, 4 * kThird, 1}};

double rho_of(const ScaledPlace& place) { return kMiddle * place.size / std::sqrt(1 - place.size * place.size); }

}  // namespace

CreepUnits creep_units(const CreepStiffness& stiffness, double load, double friction) {
  const double translation = 1 / (3 * friction * std::cbrt(load));
  return {std::sqrt(stiffness[0] * stiffness[1]) * translation, stiffness[2] / friction};
}

ScaledPlace scaled_place(const Creepages& creepages, const CreepUnits& units) {
  const double rho = units.plane * std::hypot(creepages[0], creepages[1]);
  return {std::atan2(creepages[1], creepages[0]), std::asinh(units.spin * creepages[2]),
          rho / std::hypot(kMiddle, rho)};
}

Creepages creepages_at(const ScaledPlace& place, const CreepUnits& units) {
  const double size = rho_of(place) / units.plane;
  return {size * std::cos(place.angle), size * std::sin(place.angle), std::sinh(place.spin) / units.spin};
}

double creep_radius(const ScaledPlace& place) { return std::hypot(rho_of(place), std::sinh(place.spin)); }

double growth_of(std::string_view number, double friction, double load, double radius) {
  for (const Growth& g : kGrowths)
    if (g.number == number) return std::pow(friction, g.friction) * std::pow(load, g.load) * std::pow(radius, g.radius);
  return 1;
}

}  // namespace railstrata
