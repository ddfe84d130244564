#include "damage/wear_indices.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>
#include <string>

#include "core/faults.hpp"

namespace railstrata {
namespace {

/// p0 of Hertz's ellipse, Pa.
double largest_pressure(const EllipticPatch& patch) {
  if (!(patch.a > 0 && patch.b > 0 && patch.load > 0))
    throw std::invalid_argument("a fatigue index of the patch needs positive semi-axes and load");
  return 1.5 * patch.load / (std::numbers::pi * patch.a * patch.b);
}

}  // namespace

TGamma t_gamma(const PatchCreep& patch) {
  const double x = patch.force_x * patch.creepage_x, y = patch.force_y * patch.creepage_y,
               z = patch.moment_z * patch.spin;
  const double without = std::abs(x) + std::abs(y);
  return {without, without + std::abs(z), -(x + y + z)};
}

RcfDamageFunction rcf_damage_15() { return {{{15, 0}, {65, 1e-5}, {175, 0}}, true}; }
RcfDamageFunction rcf_damage_15_clipped() { return {{{15, 0}, {65, 1e-5}, {175, 0}}, false}; }
RcfDamageFunction rcf_damage_20() { return {{{20, 0}, {65, 1e-5}, {175, 0}}, false}; }

void check(const RcfDamageFunction& function) {
  const auto& points = function.points;
  if (points.size() < 2)
    throw CaseError("a damage function needs at least two break points", "give rows of T-gamma [N] and damage");
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::string row = "row " + std::to_string(i + 1) + " of the damage function: ";
    if (!std::isfinite(points[i].t_gamma) || !std::isfinite(points[i].damage))
      throw CaseError(row + "not a number", "give T-gamma in N and the damage of one axle passage");
    if (points[i].t_gamma < 0)
      throw CaseError(row + "T-gamma is negative", "T-gamma is an energy and must be 0 or more");
    if (i > 0 && !(points[i].t_gamma > points[i - 1].t_gamma))
      throw CaseError(row + "T-gamma must be in ascending order", "sort the rows by T-gamma, each value once");
  }
}

double rcf_damage(const RcfDamageFunction& function, double t_gamma) {
  check(function);
  const auto& points = function.points;
  if (t_gamma <= points.front().t_gamma) return points.front().damage;
  if (t_gamma >= points.back().t_gamma && !function.wear_removes) return points.back().damage;
  std::size_t right = 1;
  while (right + 1 < points.size() && points[right].t_gamma < t_gamma) ++right;
  const DamagePoint &from = points[right - 1], &to = points[right];
  return from.damage + (to.damage - from.damage) * (t_gamma - from.t_gamma) / (to.t_gamma - from.t_gamma);
}

double brr_wear(double t_gamma, double wheel_diameter) {
  if (!(wheel_diameter > 0)) throw std::invalid_argument("the wheel's diameter must be positive");
  const double square_mm_per_km = 1e-9, diameter_mm = 1e3 * wheel_diameter;
  const double rate = t_gamma < 100 ? 0.25 * t_gamma : t_gamma <= 200 ? 25 : 1.19 * t_gamma - 154;
  return square_mm_per_km * rate / diameter_mm;
}

double surface_fatigue_index(const EllipticPatch& patch, double cyclic_shear_yield) {
  return patch.utilised_friction - cyclic_shear_yield / largest_pressure(patch);
}

double subsurface_fatigue_index(const EllipticPatch& patch, double dang_van_constant, double residual_hydrostatic) {
  const double friction = patch.utilised_friction;
  return largest_pressure(patch) * (1 + friction * friction) / 6 + dang_van_constant * residual_hydrostatic;
}

}  // namespace railstrata
