#include "rail_wheel.hpp"

#include <cmath>
#include <stdexcept>

namespace railstrata_in_orvd {

using Eigen::Vector3d;
using orvd_contact::WheelRailContactPatchResult;
using orvd_contact::WheelRailContactResult;
using orvd_contact::WheelSide;

namespace {

[[noreturn]] void refuse(const rs_error& error) {
  throw std::runtime_error(std::string("RailStrata: ") + error.message);
}

constexpr double kLifted = -20e-3;  // m, the rail of the wheel that does not count

}  // namespace

RailWheel::RailWheel(const Settings& settings, WheelSide side, double cant)
    : side_(side == WheelSide::kLeft ? RS_LEFT : RS_RIGHT), their_side_(side), cant_(cant) {
  rs_error error{};
  wheelset_.reset(rs_wheelset_new(settings.case_file.c_str(), nullptr, 0, nullptr, 0, &error));
  if (!wheelset_) refuse(error);
  rs_contact* contact = rs_wheelset_contact(wheelset_.get(), side_);
  if (rs_set_cell(contact, settings.cell, &error) != RS_OK) refuse(error);
  if (rs_set_tolerance(contact, settings.tolerance, &error) != RS_OK) refuse(error);
  forces_.size = sizeof forces_;
  measure();
}

/// Where wheel and rail stand in the wheelset, which the library does not give: from where a centred one touches.
void RailWheel::measure() {
  rs_wheelset_state state{};
  state.size = sizeof state;
  state.given = RS_WHEELSET_LOAD | RS_WHEELSET_ROLL;
  state.load = 1e3;
  state.speed = 1;
  solve(state);
  const rs_wheel& wheel = last();
  arm_ = wheel.point[1] - left(wheel.on_wheel[0]);
  radius_ = wheel.rolling_radius + wheel.on_wheel[1];
  const double on_rail = std::cos(cant_) * wheel.on_rail[0] - std::sin(cant_) * wheel.on_rail[1];
  rail_ = wheel.point[1] - left(on_rail);
}

void RailWheel::solve(const rs_wheelset_state& state) {
  rs_error error{};
  rs_wheelset_forget(wheelset_.get());
  if (rs_wheelset_solve(wheelset_.get(), &state, &forces_, &error) != RS_OK) refuse(error);
}

rs_wheelset_state RailWheel::state_of(const AxleMotion& motion) const {
  rs_wheelset_state state{};
  state.size = sizeof state;
  state.given = RS_WHEELSET_Z | RS_WHEELSET_ROLL;
  state.y = motion.centre.y() + rail_;
  state.z = motion.centre.z() - radius_;
  state.yaw = motion.yaw;
  state.roll = motion.roll;
  state.speed = motion.velocity.x();
  state.y_rate = motion.velocity.y();
  state.z_rate = motion.velocity.z();
  state.yaw_rate = motion.yaw_rate;
  state.roll_rate = motion.roll_rate;
  state.pitch_rate = motion.rotation - motion.velocity.x() / radius_;
  const int other = side_ == RS_LEFT ? RS_RIGHT : RS_LEFT;
  state.rail_y[other] = state.y;
  state.rail_z[other] = state.z + kLifted;
  return state;
}

WheelRailContactResult RailWheel::evaluate(const orvd_contact::WheelRailContactInput& input) {
  axes_ = rail_axes(input.rail_frame, their_side_, cant_);
  motion_ = axle_motion(input.wheel, axes_, arm_);
  solve(state_of(motion_));
  WheelRailContactResult result;
  result.count = static_cast<std::size_t>(last().patches);
  result.geometric_patch_count = result.count;
  if (result.count > result.patches.size()) throw std::runtime_error("RailStrata: more patches than there is room for");
  for (int patch = 0; patch < last().patches; ++patch)
    result.patches[static_cast<std::size_t>(patch)] = patch_result(patch);
  return result;
}

/// With the moment about the point where the bodies touch.
rs_patch RailWheel::patch_forces(int patch) const {
  const rs_contact* contact = rs_wheelset_contact(wheelset_.get(), side_);
  rs_error error{};
  rs_patch out{};
  out.size = sizeof out;
  if (rs_patch_forces(contact, patch, nullptr, &out, &error) != RS_OK) refuse(error);
  const double about[3] = {out.point[0], out.point[1], out.point[2]};
  if (rs_patch_forces(contact, patch, about, &out, &error) != RS_OK) refuse(error);
  return out;
}

WheelRailContactPatchResult RailWheel::patch_result(int index) const {
  const rs_patch patch = patch_forces(index);
  const rs_wheel& wheel = last();
  const double tread_x =
      motion_.centre.x() - std::sin(motion_.yaw) * (arm_ * std::cos(motion_.roll) + radius_ * std::sin(motion_.roll));
  const Vector3d point(tread_x + patch.point[0], left(patch.point[1]), patch.point[2]);
  const Vector3d force(patch.force[0], left(patch.force[1]), patch.force[2]);
  const Vector3d moment(left(patch.moment[0]), patch.moment[1], left(patch.moment[2]));
  WheelRailContactPatchResult out;
  out.wrench =
      orvd_contact::MakePairedContactWrench(axes_.there(point), axes_.to_track * force, axes_.to_track * moment);
  out.geometry.rolling_radius_meters = patch.rolling_radius;
  out.geometry.wheel_station_meters = -left(patch.on_wheel[0]);
  out.geometry.rail_slope_angle_radians = left(patch.contact_angle);
  out.contact_frame_angle_radians = left(patch.contact_angle);
  out.normal.in_contact = true;
  out.normal.normal_force_newtons = patch.normal_force;
  out.normal.elastic_force_newtons = patch.normal_force;
  out.normal.equivalent_penetration_meters = patch.approach;
  out.normal.maximum_pressure_pascals = patch.p_max;
  out.creepages.longitudinal = wheel.creepage_x;
  out.creepages.lateral = -wheel.creepage_y;
  out.creepages.spin_per_meter = -wheel.spin;
  out.creepages.reference_speed_meters_per_second = motion_.velocity.x();
  out.tangential.longitudinal_force_newtons = patch.force[0];
  out.tangential.lateral_force_newtons = -left(patch.lateral_force);
  return out;
}

}  // namespace railstrata_in_orvd
