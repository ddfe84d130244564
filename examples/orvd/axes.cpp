#include "axes.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace railstrata_in_orvd {

using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Vector3d;

RailAxes rail_axes(const orvd_contact::RailProfileFrame& rail, orvd_contact::WheelSide side, double cant) {
  const Matrix3d half_turn = Vector3d(1, -1, -1).asDiagonal();
  const double roll = side == orvd_contact::WheelSide::kRight ? -cant : cant;
  const Matrix3d upright = AngleAxisd(-roll, Vector3d::UnitX()).toRotationMatrix();
  return {rail.origin_track_meters, rail.rotation_track_from_profile * upright * half_turn};
}

AxleMotion axle_motion(const orvd_contact::WheelProfileRigidMotion& wheel, const RailAxes& axes, double arm) {
  const Vector3d right_there = wheel.rotation_track_from_profile.col(1);
  const Vector3d axle = -(axes.to_track.transpose() * right_there);  // to the left
  const Vector3d spin = axes.to_track.transpose() * wheel.angular_velocity_track_radians_per_second;
  AxleMotion out;
  out.yaw = std::atan2(-axle.x(), axle.y());
  out.roll = std::asin(axle.z());
  out.centre = axes.here(wheel.origin_track_meters) - arm * axle;
  out.velocity = axes.to_track.transpose() * wheel.origin_velocity_track_meters_per_second - spin.cross(arm * axle);
  const Vector3d turned = AngleAxisd(-out.yaw, Vector3d::UnitZ()) * spin;  // roll', w cos(roll), yaw' + w sin(roll)
  out.roll_rate = turned.x();
  out.rotation = turned.y() / std::cos(out.roll);
  out.yaw_rate = turned.z() - out.rotation * std::sin(out.roll);
  return out;
}

}  // namespace railstrata_in_orvd
