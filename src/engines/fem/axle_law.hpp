#pragma once
// The step of axle and suspension, pointwise: compiled for the stepper and for a thread of a device. Groups: the masses
// on their springs, anything with size() and [].
#include <cmath>

#include "contact/mortar_law.hpp"
#include "core/simd.hpp"
#include "fem/energy.hpp"

namespace railstrata {

/// Spring and dashpot groups around the axle. They move alike: their number is one of round-off.
inline constexpr int kSuspensionGroups = 8;

struct MassGroup {
  double z = 0, vz = 0;  ///< m, displacement; m/s, half-step velocity of a share of the sprung mass
};

struct SuspensionForce {
  double on_masses = 0;      ///< N, upwards on all groups together; the axle gets the opposite
  double dashpot_power = 0;  ///< W
};

/// Primary suspension, all groups together: kg, N/m, N s/m.
struct SuspensionLaw {
  double sprung_mass = 0, stiffness = 0, damping = 0;
};

/// Model frame.
struct AxleMotion {
  double x = 0, y = 0, z = 0,
         psi = 0;  ///< displacement from the start of the rolling's reference (rigid contact position), spin angle
  double vx = 0, vy = 0, vz = 0, spin = 0;  ///< half-step velocities
  RAILSTRATA_POINTWISE AxlePose pose() const { return {x, y, z, psi}; }
};

/// Forces on the axle from the bore and about it from the ties' offsets, model frame.
struct AxleLoads {
  double fx = 0, fy = 0, fz = 0;  ///< N
  double moment = 0;              ///< N m, positive rolling forward
};

/// Forces that drive the axle.
struct AxleDrive {
  double torque = 0;   ///< N m
  double lateral = 0;  ///< N, to the field side; of an axle that is free sideways
};

/// Constants of the axle.
struct AxleLaw {
  double mass_x = 0, mass_z = 0, inertia = 0;  ///< kg, kg m² (fem/rolling_system.hpp)
  SuspensionLaw suspension;
  double gravity = 0, lateral_speed = 0;           ///< m/s², m/s
  double rest_z = 0;                               ///< m, height in static equilibrium
  bool keeps_pace = false, free_sideways = false;  ///< as ExplicitOptions
  bool stays = false;                              ///< does not travel: the rail is a ring and turns below it
};

/// Smooth rise from 0 to 1 over [0, 1] with zero slope at both ends.
RAILSTRATA_POINTWISE double smooth_rise(double t) { return t <= 0 ? 0 : t >= 1 ? 1 : t * t * (3 - 2 * t); }

/// Groups of a spring and a dashpot, each carrying its share of the sprung mass, vertical, on the axle's non-rotating
/// box:
///   m z'' = k (z_axle - z) + c (z_axle' - z'),   shares of the whole: m / n, k / n, c / n
/// z is counted from static equilibrium, where the springs carry the weight. One central-difference step; axle_z from
/// static equilibrium [m], axle_vz its half-step velocity [m/s].
template <class Groups>
RAILSTRATA_POINTWISE SuspensionForce step_suspension(const SuspensionLaw& law, double axle_z, double axle_vz, double dt,
                                                     Groups&& groups) {
  const double share = 1.0 / static_cast<double>(groups.size()), k = law.stiffness * share, c = law.damping * share;
  SuspensionForce out;
  for (int n = 0; n < static_cast<int>(groups.size()); ++n) {
    MassGroup& m = groups[n];
    const double closing = axle_vz - m.vz, force = k * (axle_z - m.z) + c * closing;
    out.on_masses += force;
    out.dashpot_power += c * closing * closing;
    m.vz += law.sprung_mass > 0 ? dt * force / (law.sprung_mass * share) : 0.0;
    m.z += dt * m.vz;
  }
  return out;
}

/// One central-difference step of dt [s] with the run-up damping `rate` [1/s]. Where the creepage is given, speed and
/// spin stay as they are; where the axle is not free sideways, its lateral speed does. Adds the work of torque and
/// guides and the losses to the book and returns the kinetic energy of axle and sprung mass, v(n-1/2) v(n+1/2)/2 [J].
template <class Groups>
RAILSTRATA_POINTWISE double advance_axle(const AxleLaw& law, const AxleLoads& loads, const AxleDrive& drive, double dt,
                                         double rate, AxleMotion& a, Groups&& groups, EnergyBalance& book) {
  const SuspensionForce spring = step_suspension(law.suspension, a.z - law.rest_z, a.vz, dt, groups);
  const double suspension = -law.suspension.sprung_mass * law.gravity - spring.on_masses;
  const double vx = a.vx, vy = a.vy, vz = a.vz, spin = a.spin;
  const double torque = law.keeps_pace ? -loads.moment : drive.torque;
  if (!law.keeps_pace && !law.stays) a.vx += dt * loads.fx / law.mass_x;
  const double drift = law.free_sideways ? vy - law.lateral_speed : 0.0;
  if (law.free_sideways) a.vy += dt * ((loads.fy + drive.lateral) / law.mass_z - rate * drift);
  a.vz += dt * ((loads.fz + suspension) / law.mass_z - law.gravity - rate * a.vz);
  a.spin += dt * (loads.moment + torque) / law.inertia;
  a.x += dt * a.vx;
  a.y += dt * a.vy;
  a.z += dt * a.vz;
  a.psi += dt * a.spin;
  book.dashpot = std::fma(dt, spring.dashpot_power, book.dashpot);
  book.torque_work = std::fma(dt * torque * 0.5, spin + a.spin, book.torque_work);
  const double pull = law.keeps_pace ? -loads.fx : 0.0, side = law.free_sideways ? drive.lateral : -loads.fy;
  book.guide_work += dt * (pull * a.vx + side * 0.5 * (vy + a.vy));
  book.damping += dt * rate * law.mass_z * drift * 0.5 * (vy + a.vy);
  book.damping = std::fma(dt * rate * law.mass_z * vz * 0.5, vz + a.vz, book.damping);
  double kinetic = 0.5 * (law.mass_x * vx * a.vx + law.mass_z * vz * a.vz + law.inertia * spin * a.spin);
  kinetic += 0.5 * law.mass_z * vy * a.vy;
  const double share = law.suspension.sprung_mass / static_cast<double>(groups.size());
  for (int n = 0; n < static_cast<int>(groups.size()); ++n) kinetic += 0.5 * share * groups[n].vz * groups[n].vz;
  return kinetic;
}

/// J, of the suspension's springs with their static force, at the axle's height z.
template <class Groups>
RAILSTRATA_POINTWISE double spring_energy(const AxleLaw& law, double z, Groups&& groups) {
  const double k = law.suspension.stiffness / static_cast<double>(groups.size());
  double sum = law.suspension.sprung_mass * law.gravity * z;
  for (int n = 0; n < static_cast<int>(groups.size()); ++n) {
    const double squeeze = z - law.rest_z - groups[n].z;
    sum += 0.5 * k * squeeze * squeeze;
  }
  return sum;
}

}  // namespace railstrata
