#include "model/sliding_waves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "friction/friction_memory.hpp"

namespace railstrata {

namespace {

double shear_modulus(const MaterialSpec& m) { return m.young / (2 * (1 + m.poisson)); }

}  // namespace

double stable_memory_distance(const CaseSpec& spec, double p0, double longer_axis) {
  const MaterialSpec& m = spec.rail_material;
  return stable_memory_distance(falling_friction(spec), spec.drive.friction_coefficient * p0,
                                {shear_modulus(m), m.density, 2 * longer_axis});
}

std::string note_of_instability(const CaseSpec& spec, const HertzContact& patch) {
  const MaterialSpec& m = spec.rail_material;
  const double carried = 0.5 * std::sqrt(shear_modulus(m) * m.density),
               fall = -friction_share(falling_friction(spec), {}).by_slip_velocity * spec.drive.friction_coefficient *
                      patch.p0;
  if (fall <= carried) return {};
  const double needed = stable_memory_distance(spec, patch.p0, 2 * std::max(patch.a, patch.b));
  if (spec.friction.memory_distance >= needed) return {};
  return fmt::format(
      "friction falls with slip by {:.3g} MPa s/m, more than the {:.3g} MPa s/m that waves carry away: "
      "the steady state may break up into vibration (squeal); with a friction.memory_distance of {:.3g} um it would "
      "not",
      1e-6 * fall, 1e-6 * carried, 1e6 * needed);
}

}  // namespace railstrata
