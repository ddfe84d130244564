#include "fem/suspension.hpp"

#include "spec/case_spec.hpp"

namespace railstrata {

SuspensionLaw suspension_law(const VehicleSpec& v) {
  return {v.sprung_mass, v.suspension_stiffness, v.suspension_damping};
}

SuspensionForce step_suspension(const VehicleSpec& v, double axle_z, double axle_vz, double dt,
                                std::vector<MassGroup>& groups) {
  return step_suspension(suspension_law(v), axle_z, axle_vz, dt, groups);
}

}  // namespace railstrata
