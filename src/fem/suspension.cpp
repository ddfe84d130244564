#include "fem/suspension.hpp"

namespace railstrata {

SuspensionForce step_suspension(const VehicleSpec& v, double axle_z, double axle_vz, double dt,
                                std::vector<MassGroup>& groups) {
  const double share = 1.0 / static_cast<double>(groups.size()), k = v.suspension_stiffness * share,
               c = v.suspension_damping * share;
  SuspensionForce out;
  for (MassGroup& m : groups) {
    const double closing = axle_vz - m.vz, force = k * (axle_z - m.z) + c * closing;
    out.on_masses += force;
    out.dashpot_power += c * closing * closing;
    m.vz += v.sprung_mass > 0 ? dt * force / (v.sprung_mass * share) : 0.0;
    m.z += dt * m.vz;
  }
  return out;
}

}  // namespace railstrata
