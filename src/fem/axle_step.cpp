#include "fem/axle_step.hpp"

#include <cmath>

namespace railstrata {

AxleLoads bore_loads(const Axle& axle, const Field& f_wheel, Rotation<double> drift, double tie_moment,
                     const ReferenceFrame& frame) {
  Vec3 bore{};
  double moment = -tie_moment;
  for (const BoreNode& n : axle.bore) {
    const double fx = -f_wheel[n.index], fz = -f_wheel[n.index + 2 * n.stride];
    bore.y -= f_wheel[n.index + n.stride];
    const auto [rx, rz] = drift.forward(n.arm.x, n.arm.z);
    bore.x += fx;
    bore.z += fz;
    moment += rz * fx - rx * fz;
  }
  bore = frame.to_model(bore);
  return {bore.x, bore.y, bore.z, moment};
}

double advance_axle(const RollingSystem& system, const AxleLoads& loads, const AxleDrive& drive, double rest_z,
                    const StepScope& scope, AxleMotion& a, std::vector<MassGroup>& groups, EnergyBalance& book) {
  const VehicleSpec& v = system.options.vehicle;
  const Axle& axle = system.axle;
  const double dt = scope.dt, rate = scope.damping_rate;
  const SuspensionForce spring = step_suspension(v, a.z - rest_z, a.vz, dt, groups);
  const double suspension = -v.sprung_mass * system.gravity - spring.on_masses;
  const double vx = a.vx, vy = a.vy, vz = a.vz, spin = a.spin;
  const bool keeps_pace = system.options.keeps_pace, free_sideways = system.options.free_sideways;
  const double torque = keeps_pace ? -loads.moment : drive.torque;
  if (!keeps_pace) a.vx += dt * loads.fx / axle.mass_x;
  const double drift = free_sideways ? vy - system.options.lateral_speed : 0.0;
  if (free_sideways) a.vy += dt * ((loads.fy + drive.lateral) / axle.mass_z - rate * drift);
  a.vz += dt * ((loads.fz + suspension) / axle.mass_z - system.gravity - rate * a.vz);
  a.spin += dt * (loads.moment + torque) / axle.inertia;
  a.x += dt * a.vx;
  a.y += dt * a.vy;
  a.z += dt * a.vz;
  a.psi += dt * a.spin;
  book.dashpot = std::fma(dt, spring.dashpot_power, book.dashpot);
  book.torque_work = std::fma(dt * torque * 0.5, spin + a.spin, book.torque_work);
  const double pull = keeps_pace ? -loads.fx : 0.0, side = free_sideways ? drive.lateral : -loads.fy;
  book.guide_work += dt * (pull * a.vx + side * 0.5 * (vy + a.vy));
  book.damping += dt * rate * axle.mass_z * drift * 0.5 * (vy + a.vy);
  book.damping = std::fma(dt * rate * axle.mass_z * vz * 0.5, vz + a.vz, book.damping);
  double kinetic = 0.5 * (axle.mass_x * vx * a.vx + axle.mass_z * vz * a.vz + axle.inertia * spin * a.spin);
  kinetic += 0.5 * axle.mass_z * vy * a.vy;
  const double share = v.sprung_mass / static_cast<double>(groups.size());
  for (const MassGroup& m : groups) kinetic += 0.5 * share * m.vz * m.vz;
  return kinetic;
}

double spring_energy(const RollingSystem& system, const AxleMotion& axle, double rest_z,
                     const std::vector<MassGroup>& groups) {
  const VehicleSpec& v = system.options.vehicle;
  const double k = v.suspension_stiffness / static_cast<double>(groups.size());
  double sum = v.sprung_mass * system.gravity * axle.z;
  for (const MassGroup& m : groups) {
    const double squeeze = axle.z - rest_z - m.z;
    sum += 0.5 * k * squeeze * squeeze;
  }
  return sum;
}

}  // namespace railstrata
