#include "fem/axle_step.hpp"

namespace railstrata {

AxleLoads bore_loads(const std::vector<BoreNode>& nodes, const Field& f, Rotation<double> drift, double tie_moment,
                     const ReferenceFrame& frame) {
  Vec3 bore{};
  double moment = -tie_moment;
  for (const BoreNode& n : nodes) {
    const double fx = -f[n.index], fz = -f[n.index + 2 * n.stride];
    bore.y -= f[n.index + n.stride];
    const auto [rx, rz] = drift.forward(n.arm.x, n.arm.z);
    bore.x += fx;
    bore.z += fz;
    moment += rz * fx - rx * fz;
  }
  bore = frame.to_model(bore);
  return {bore.x, bore.y, bore.z, moment};
}

SuspensionLaw suspension_law(const VehicleSpec& v) {
  return {v.sprung_mass, v.suspension_stiffness, v.suspension_damping};
}

AxleLaw axle_law(const RollingSystem& system, double rest_z) {
  const Axle& axle = system.axle;
  const ExplicitOptions& o = system.options;
  return {axle.mass_x,     axle.mass_z,     axle.inertia, suspension_law(system.spec().vehicle),
          system.gravity,  o.lateral_speed, rest_z,       o.keeps_pace,
          o.free_sideways, system.on_ring()};
}

}  // namespace railstrata
