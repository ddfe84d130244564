#include "fem/lateral_start.hpp"

#include <cmath>

#include "halfspace/creep_theories.hpp"

namespace railstrata {
namespace {

RollingEllipse ellipse_of(const Model& m) {
  const auto half_space = [](const MaterialSpec& s) { return HalfSpaceMaterial{s.young, s.poisson}; };
  return rolling_ellipse(m.hertz, m.spec.drive.friction_coefficient, half_space(m.spec.wheel_material),
                         half_space(m.spec.rail_material));
}

/// The longitudinal creepage at which the force along the rail is `wanted`, between the bounds of what a run may start
/// with; it falls short where friction does.
double longitudinal_creepage(const RollingEllipse& e, Creepage c, double wanted) {
  double low = -0.1, high = 0.1;
  for (int i = 0; i < 60; ++i) {
    c.x = 0.5 * (low + high);
    (vermeulen_johnson(e, c).x < wanted ? low : high) = c.x;
  }
  return c.x;
}

}  // namespace

LateralStart lateral_start(const Model& m) {
  const DriveSpec& drive = m.spec.drive;
  const RigidContact& contact = m.placement.contact;
  if (!m.spec.run.rolling || !(drive.friction_coefficient > 0)) return {};
  const double along = -drive.traction().value_or(0) * m.load, spin = -std::sin(contact.angle) / contact.rolling_radius;
  if (drive.lateral_traction_coefficient) {
    const double across = -*drive.lateral_traction_coefficient * m.load;
    return {lateral_creepage_of_force(ellipse_of(m), {along, across}, spin), across};
  }
  LateralStart out{drive.lateral_creepage.value_or(0.0 - std::tan(contact.yaw) / std::cos(contact.angle)), 0};
  if (out.creepage == 0) return out;
  const RollingEllipse e = ellipse_of(m);
  Creepage c{drive.creepage.value_or(0), out.creepage, spin};
  if (!drive.creepage) c.x = longitudinal_creepage(e, c, along);
  out.friction = vermeulen_johnson(e, c).y;
  return out;
}

}  // namespace railstrata
