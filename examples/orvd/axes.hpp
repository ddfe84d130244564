#pragma once
// One wheel of OpenRailVehicleDynamics over its rail, in the axes of RailStrata.
//
// There y points to the right and z down, and the rail stands anywhere in the track's frame. Here x runs along the rail
// as it lies, y to the left, z up, from the origin of the rail's profile; the rail's cant is the only turn that is left
// of it. Turns of the rail by irregularities and by the curve are thus none of the wheel's.
#include <Eigen/Core>

#include "orvd/wheel_rail_contact/wheel_rail_contact_model.h"

namespace railstrata_in_orvd {

namespace orvd_contact = orvd::wheel_rail_contact;

/// Turns vectors of these axes into those of the track's frame there.
struct RailAxes {
  Eigen::Vector3d origin;  ///< m, in the track's frame
  Eigen::Matrix3d to_track;
  Eigen::Vector3d here(const Eigen::Vector3d& point) const { return to_track.transpose() * (point - origin); }
  Eigen::Vector3d there(const Eigen::Vector3d& point) const { return origin + to_track * point; }
};

/// cant: rad, towards the middle of the track.
RailAxes rail_axes(const orvd_contact::RailProfileFrame& rail, orvd_contact::WheelSide side, double cant);

/// Motion of a wheelset that has the wheel at `arm` along its axle (m, to the left) and turns with it as one body.
struct AxleMotion {
  Eigen::Vector3d centre, velocity;  ///< m, m/s
  double yaw = 0, roll = 0;          ///< rad, as of rs_wheelset_state
  double yaw_rate = 0, roll_rate = 0;
  double rotation = 0;  ///< rad/s, about the axle; > 0 rolls forward
};
AxleMotion axle_motion(const orvd_contact::WheelProfileRigidMotion& wheel, const RailAxes& axes, double arm);

}  // namespace railstrata_in_orvd
