#include "fem/lateral_start.hpp"

#include <cmath>

#include "case/engine_scope.hpp"
#include "halfspace/creep_theories.hpp"

namespace railstrata {
namespace {

RollingEllipse ellipse_of(const Model& m) {
  const auto half_space = [](const MaterialSpec& s) { return HalfSpaceMaterial{s.young, s.poisson}; };
  return rolling_ellipse(m.hertz, m.spec.drive.friction_coefficient, half_space(m.spec.wheel_material),
                         half_space(m.spec.rail_material));
}

/// Where a force that grows with the creepage is `wanted`; the end of the range where friction falls short of it.
template <class Force>
double creepage_at(double wanted, Force&& force) {
  constexpr int kHalvings = 24;  // to 1e-8
  double low = -kLargestRunCreepage, high = kLargestRunCreepage;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (force(middle) < wanted ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// Lateral force on the rail at a lateral creepage and spin, while the drive along the rail is that of the case.
double lateral_force(const RollingEllipse& e, const DriveSpec& drive, double along, double creepage, double spin) {
  const auto at = [&](double x) { return fastsim(e, {x, creepage, spin}); };
  return at(drive.creepage ? *drive.creepage : creepage_at(along, [&](double x) { return at(x).x; })).y;
}

}  // namespace

LateralStart lateral_start(const Model& m) {
  const DriveSpec& drive = m.spec.drive;
  const RigidContact& contact = m.placement.contact;
  if (!m.spec.run.rolling) return {};
  const double along = -drive.traction().value_or(0) * m.load, spin = wheel_spin(contact);
  if (drive.lateral_traction_coefficient) {
    const RollingEllipse e = ellipse_of(m);
    const double across = -*drive.lateral_traction_coefficient * m.load;
    return {creepage_at(across, [&](double y) { return lateral_force(e, drive, along, y, spin); }), across};
  }
  const double creepage = drive.lateral_creepage.value_or(yaw_creepage(contact));
  if (creepage == 0 || !(drive.friction_coefficient > 0)) return {creepage, 0};
  return {creepage, lateral_force(ellipse_of(m), drive, along, creepage, spin)};
}

}  // namespace railstrata
