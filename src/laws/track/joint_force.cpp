#include "track/joint_force.hpp"

#include <cmath>
#include <numbers>

namespace railstrata {

JointForces joint_forces(const DippedJoint& j, const RailBeam& rail, const SleeperTrack& track) {
  const double kick = j.angle * j.speed, m_u = j.unsprung_mass;
  const auto P1 = [&](double metres) {
    const double m_T1 = metres * rail.mass;
    return j.load + kick * std::sqrt(j.contact_stiffness * m_T1 / (1 + m_T1 / m_u));
  };
  const double k = 1 / (1 / track.pad_stiffness + 1 / track.ballast_stiffness) / track.spacing;
  const double b = std::pow(k / (4 * rail.bending), 0.25);
  const double k_T2 = 2 * k / b, m_T2 = 1.5 * (rail.mass + track.sleeper_mass / track.spacing) / b,
               c_T2 = 1.5 * track.ballast_damping / track.spacing / b;
  const double damped = 1 - std::numbers::pi * c_T2 / (4 * std::sqrt(k_T2 * (m_u + m_T2)));
  const double P2 = j.load + kick * std::sqrt(m_u / (m_u + m_T2)) * damped * std::sqrt(k_T2 * m_u);
  return {P1(0.4), P1(1.0), P2 / kJenkinsHigh, P2 / kJenkinsLow};
}

}  // namespace railstrata
