#include "table/creep_scaling.hpp"

#include <cmath>

namespace railstrata {
namespace {

constexpr double kThird = 1.0 / 3;

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

}  // namespace

CreepUnits creep_units(const CreepStiffness& stiffness, double load, double friction) {
  const double translation = 1 / (3 * friction * std::cbrt(load));
  return {stiffness[0] * translation, stiffness[1] * translation, stiffness[2] / friction};
}

ScaledPlace scaled_place(const Creepages& creepages, const CreepUnits& units) {
  const double xi = units.x * creepages[0], eta = units.y * creepages[1], psi = units.spin * creepages[2];
  const double r = std::hypot(xi, eta, psi);
  return {std::atan2(eta, xi), std::atan2(psi, std::hypot(xi, eta)), r / (1 + r)};
}

Creepages creepages_at(const ScaledPlace& place, const CreepUnits& units) {
  const double r = creep_radius(place.size), in_plane = r * std::cos(place.spin_angle);
  return {in_plane * std::cos(place.angle) / units.x, in_plane * std::sin(place.angle) / units.y,
          r * std::sin(place.spin_angle) / units.spin};
}

double growth_of(std::string_view number, double friction, double load, double radius) {
  for (const Growth& g : kGrowths)
    if (g.number == number) return std::pow(friction, g.friction) * std::pow(load, g.load) * std::pow(radius, g.radius);
  return 1;
}

}  // namespace railstrata
