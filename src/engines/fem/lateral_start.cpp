#include "fem/lateral_start.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "halfspace/creep_theories.hpp"
#include "rules/support.hpp"

namespace railstrata {
namespace {

/// The elastic shear of a film is in series with the theory's three flexibilities, 8a/(3 C11 G), 8a/(3 C22 G) and
/// pi a²/(4 C23 G c).
RollingEllipse ellipse_of(const Model& m) {
  const auto half_space = [](const MaterialSpec& s) { return HalfSpaceMaterial{s.young, s.poisson}; };
  RollingEllipse e = rolling_ellipse(m.hertz, m.spec.drive.friction_coefficient, half_space(m.spec.wheel_material),
                                     half_space(m.spec.rail_material));
  const double film = third_body(m.spec).flexibility() * e.shear, a = m.hertz.a, c = std::sqrt(a * m.hertz.b);
  const auto in_series = [](double& coefficient, double flexibility) {
    if (flexibility > 0) coefficient = 1 / (1 / coefficient + flexibility);
  };
  in_series(e.coefficient.c11, 3 * film / (8 * a));
  in_series(e.coefficient.c22, 3 * film / (8 * a));
  in_series(e.coefficient.c23, 4 * film * c / (std::numbers::pi * a * a));
  return e;
}

/// A film bears its yield shear all over the patch.
double most_across(const Model& m) {
  const ThirdBody film = third_body(m.spec);
  const double slides = m.spec.friction.lateral_coefficient.value_or(m.spec.drive.friction_coefficient) * m.load;
  return film.yields() ? std::min(slides, std::numbers::pi * m.hertz.a * m.hertz.b * film.yield_shear) : slides;
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
  const RigidContact& contact = m.reference;
  if (!m.spec.run.rolling) return {};
  const double along = -drive.traction().value_or(0) * m.load, spin = wheel_spin(contact);
  if (drive.lateral_traction_coefficient) {
    const RollingEllipse e = ellipse_of(m);
    const double across = -*drive.lateral_traction_coefficient * m.load;
    return {creepage_at(across, [&](double y) { return lateral_force(e, drive, along, y, spin); }), across};
  }
  const double creepage = drive.lateral_creepage.value_or(yaw_creepage(contact));
  if ((creepage == 0 && spin == 0) || !(drive.friction_coefficient > 0)) return {creepage, 0};
  const double most = most_across(m);
  return {creepage, std::clamp(lateral_force(ellipse_of(m), drive, along, creepage, spin), -most, most)};
}

double estimated_creepage(const Model& m, double traction) {
  const DriveSpec& drive = m.spec.drive;
  if (!(drive.friction_coefficient > 0)) return 0;
  const RigidContact& contact = m.reference;
  const RollingEllipse e = ellipse_of(m);
  const double across = drive.lateral_creepage.value_or(yaw_creepage(contact)), spin = wheel_spin(contact);
  return creepage_at(-traction * m.load, [&](double x) { return fastsim(e, {x, across, spin}).x; });
}

}  // namespace railstrata
