#pragma once
// The pressure of a patch in the space around it.
#include <cmath>
#include <numbers>

#include "bem/patch_grid.hpp"
#include "bem/plane_algebra.hpp"
#include "core/vec.hpp"
#include "geometry/placement.hpp"

namespace railstrata {

/// The pressure of a patch, in space; of one that has not been solved yet a force at the rigid contact point.
struct PressureOnRail {
  const RigidContact& contact;
  const PatchGrid& grid;
  const Plane& pressure;
  double force;

  Vec3 point(double x, double t) const {
    return {contact.x + x, contact.point.y + t * std::cos(contact.angle),
            contact.point.z + t * std::sin(contact.angle)};
  }
  /// Calls share(force, place) for every cell that bears.
  template <class Share>
  void for_each_share(Share&& share) const {
    if (pressure.empty()) return share(force, point(0, 0));
    for (std::size_t k = 0; k < pressure.size(); ++k)
      if (pressure[k] > 0) share(pressure[k] * grid.cell_area(), point(grid.x_of(k), grid.y_of(k)));
  }
  Vec3 centre() const {
    Vec3 sum;
    double total = 0;
    for_each_share([&](double f, Vec3 place) {
      sum += f * place;
      total += f;
    });
    return total > 0 ? (1 / total) * sum : point(0, 0);
  }
  /// The sum of force/distance^power at a place, over pi E*.
  double at(Vec3 place, int power, double modulus) const {
    double sum = 0;
    for_each_share([&](double f, Vec3 from) {
      const Vec3 d = place - from;
      sum += f / std::pow(std::hypot(d.x, d.y, d.z), power);
    });
    return sum / (std::numbers::pi * modulus);
  }
};

}  // namespace railstrata
