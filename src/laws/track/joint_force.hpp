#pragma once
// Jenkins' estimates of the two peaks of the wheel's force at a dipped joint: P1 of the wheel on its contact against
// the rail's mass, P2 of the unsprung mass on the track. [JenkinsStephenson1974]
//
//   P1 = P0 + a V sqrt(k_H m_T1/(1 + m_T1/m_u))
//   P2 = P0 + a V sqrt(m_u/(m_u + m_T2)) (1 - pi c_T2/(4 sqrt(k_T2 (m_u + m_T2)))) sqrt(k_T2 m_u)
// a the angle between both ramps. Of the rail as a beam on the foundation k' (pad and ballast in series over the
// spacing), b = (k'/(4 E I))^(1/4): k_T2 = 2 k'/b, m_T2 = 1.5 m'/b with rail and sleepers, c_T2 = 1.5 c'/b with the
// ballast's damping. m_T1 is 0.4 to 1.0 m of rail.
#include "track/beam_receptance.hpp"

namespace railstrata {

struct DippedJoint {
  double load = 0;               ///< P0, N
  double angle = 0;              ///< a, rad
  double speed = 0;              ///< V, m/s
  double unsprung_mass = 0;      ///< m_u, kg
  double contact_stiffness = 0;  ///< k_H, N/m
};

/// N. They know neither pads nor the place of the sleepers: beside six computed tracks P1 was off by -21 to +32 %, P2
/// by kJenkinsLow to kJenkinsHigh of what came.
struct JointForces {
  double P1_low = 0, P1_high = 0;  ///< by m_T1
  double P2_low = 0, P2_high = 0;  ///< what P2 may be, by those errors of the formula
};
inline constexpr double kJenkinsLow = 0.96, kJenkinsHigh = 1.20;

JointForces joint_forces(const DippedJoint& joint, const RailBeam& rail, const SleeperTrack& track);

}  // namespace railstrata
