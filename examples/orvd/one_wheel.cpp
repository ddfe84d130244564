// Wheels of GZ18 on UIC60 through both contacts, at places and motions of a wheelset on a straight track.
//
// usage: one_wheel DATA_ROOT CASE   DATA_ROOT: the checkout of OpenRailVehicleDynamics
//
// Checks forces of the adapter by symmetry, by turning the whole track, by their moments; prints a table of both
// contacts under the same vertical force and, on a line that begins with "raise", by how much the rail has to be higher
// for RailStrata's contact to bear it. Exit code 1: a check has failed.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <functional>

#include "orvd/configuration/gz18_wheel_rail_contact.h"
#include "rail_wheel.hpp"

namespace {

using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using namespace railstrata_in_orvd;
using orvd_contact::WheelRailContactInput;
using orvd_contact::WheelRailContactResult;
using orvd_contact::WheelSide;

constexpr double kLoad = 68296;      // N
constexpr double kOffset = -0.0003;  // m, of the rail, downwards
constexpr double kStart = -0.42;     // m, of the axle, downwards
constexpr double kSpeed = 60 / 3.6;

/// A wheelset on a straight track: y to the right, z down.
struct Pose {
  double lateral = 0, down = kStart, yaw = 0, creepage = 0;
};

int failures = 0;

void check(bool holds, const char* what) {
  if (!holds) std::printf("FAILED: %s\n", what);
  failures += !holds;
}

WheelRailContactInput input_of(const orvd_contact::WheelRailPoseConstants& at, const Pose& pose) {
  orvd_contact::WheelRailPoseInput placed;
  placed.placement = {pose.lateral, pose.down, 0, pose.yaw};
  placed.track_station_rate_meters_per_second = kSpeed;
  WheelRailContactInput input;
  input.pose = orvd_contact::BuildContactPoseScalars(at, placed);
  const Vector3d centre(0, pose.lateral, pose.down);
  const Matrix3d turn = AngleAxisd(pose.yaw, Vector3d::UnitZ()).toRotationMatrix();
  const Vector3d arm = turn * Vector3d(0, at.wheel_lateral_datum_meters, 0);
  const double rotation = -kSpeed * (1 - pose.creepage) / at.nominal_rolling_radius_meters;
  input.rail_frame.rotation_track_from_profile = AngleAxisd(at.rail_roll_radians, Vector3d::UnitX()).toRotationMatrix();
  input.rail_frame.origin_track_meters = orvd_contact::PlaceRailProfileLongitudinalOrigin(
      orvd_contact::RailProfileOriginMode::kProfileCoordinate,
      Vector3d(0, at.rail_lateral_datum_meters, at.rail_vertical_datum_meters),
      input.rail_frame.rotation_track_from_profile, centre, arm.x());
  input.wheel.origin_track_meters = centre + arm;
  input.wheel.rotation_track_from_profile = turn;
  input.wheel.angular_velocity_track_radians_per_second = turn * Vector3d(0, rotation, 0);
  input.wheel.origin_velocity_track_meters_per_second =
      Vector3d(kSpeed, 0, 0) + input.wheel.angular_velocity_track_radians_per_second.cross(arm);
  input.wheel.arc_rate_meters_per_second = kSpeed;
  input.wheel.wheel_pitch_rate_radians_per_second = rotation;
  return input;
}

Vector3d force_of(const WheelRailContactResult& result) {
  Vector3d sum = Vector3d::Zero();
  for (std::size_t k = 0; k < result.count; ++k) sum += result.patches[k].wrench.rail_on_wheel.force_newtons;
  return sum;
}

Vector3d moment_about(const WheelRailContactResult& result, const Vector3d& centre) {
  Vector3d sum = Vector3d::Zero();
  for (std::size_t k = 0; k < result.count; ++k) {
    const auto& wrench = result.patches[k].wrench;
    sum +=
        orvd_contact::TransportWrench(wrench.rail_on_wheel, wrench.contact_point_meters, centre).moment_newton_meters;
  }
  return sum;
}

using Contact = std::function<WheelRailContactResult(const WheelRailContactInput&)>;

/// Lowers the wheel until it bears the load.
WheelRailContactResult pressed(const Contact& contact, const orvd_contact::WheelRailPoseConstants& at, Pose& pose) {
  WheelRailContactResult result;
  double step = 1e-5;
  for (int k = 0; k < 80; ++k) {
    result = contact(input_of(at, pose));
    const double borne = -force_of(result).z();
    if (std::abs(borne - kLoad) < 1e-6 * kLoad) break;
    if (borne > 0) {
      Pose lower = pose;
      lower.down += 1e-8;
      step = 1e-8 * (kLoad - borne) / (-force_of(contact(input_of(at, lower))).z() - borne);
    }
    pose.down += std::clamp(step, -3e-5, 3e-5);
  }
  return result;
}

WheelRailContactInput turned(WheelRailContactInput input, const Matrix3d& turn) {
  input.rail_frame.origin_track_meters = turn * input.rail_frame.origin_track_meters;
  input.rail_frame.rotation_track_from_profile = turn * input.rail_frame.rotation_track_from_profile;
  input.wheel.origin_track_meters = turn * input.wheel.origin_track_meters;
  input.wheel.rotation_track_from_profile = turn * input.wheel.rotation_track_from_profile;
  input.wheel.origin_velocity_track_meters_per_second = turn * input.wheel.origin_velocity_track_meters_per_second;
  input.wheel.angular_velocity_track_radians_per_second = turn * input.wheel.angular_velocity_track_radians_per_second;
  return input;
}

/// Forces of one wheel: those of the mirror, of a track that is turned, of another call, of the whole wheelset's
/// moment.
void check_adapter(RailWheel& right, RailWheel& left, const orvd_contact::WheelRailPoseConstants& at_right,
                   const orvd_contact::WheelRailPoseConstants& at_left, const Pose& pose) {
  const WheelRailContactInput input = input_of(at_right, pose);
  const WheelRailContactResult one = right.evaluate(input);
  const Vector3d force = force_of(one), centre(0, pose.lateral, pose.down), mirror(1, -1, 1);
  const Vector3d wanted =
      right.last_axes().to_track * Vector3d(right.last().moment[0], right.last().moment[1], right.last().moment[2]);
  check((moment_about(one, centre) - wanted).norm() < 1e-3 * wanted.norm(), "the moment about the axle's middle");
  const Pose seen{-pose.lateral, pose.down, -pose.yaw, pose.creepage};
  const Vector3d mirrored = force_of(left.evaluate(input_of(at_left, seen)));
  check((mirror.cwiseProduct(mirrored) - force).norm() < 1e-6 * kLoad, "forces seen in a mirror");
  const Matrix3d turn = (AngleAxisd(5e-3, Vector3d::UnitZ()) * AngleAxisd(-3e-3, Vector3d::UnitY())).matrix();
  check((force_of(right.evaluate(turned(input, turn))) - turn * force).norm() < 1e-6 * kLoad, "a turned track");
  check(force_of(right.evaluate(input)) == force, "the same bits of the same input");
  check(one.count == 0 || force.z() < 0, "the rail pushes upwards");
}

void print_row(const Pose& pose, const char* who, const WheelRailContactResult& result) {
  const Vector3d force = force_of(result);
  const auto& first = result.patches[0];
  std::printf("%6.1f %6.1f %6.2f  %-6s %7zu %8.0f %8.0f %8.0f %8.2f\n", 1e3 * pose.lateral, 1e3 * pose.yaw,
              1e3 * pose.creepage, who, result.count, force.x(), force.y(), -force.z(),
              180 / M_PI * first.contact_frame_angle_radians);
}

int run(const char* root, const char* case_file) {
  const auto theirs = orvd::configuration::AssembleGz18WheelRailContact(
      root, {"gz18_reference_wheel_profile", "uic60_rail_profile", "gz18_reference_wheel_rail_contact"}, kOffset);
  const auto& model = theirs->model(WheelSide::kRight);
  const double cant = model.geometry().configuration().rail_cant_radians;
  RailWheel right({case_file}, WheelSide::kRight, cant), left({case_file}, WheelSide::kLeft, cant);
  const auto& at = theirs->pose_constants(WheelSide::kRight);
  const auto& at_left = theirs->pose_constants(WheelSide::kLeft);
  orvd_contact::WheelRailContactWorkspace workspace;
  const Contact their_contact = [&](const WheelRailContactInput& input) { return model.Evaluate(input, workspace); };
  const Contact our_contact = [&](const WheelRailContactInput& input) { return right.evaluate(input); };
  std::printf("%6s %6s %6s  %-6s %7s %8s %8s %8s %8s\n%6s %6s %6s  %-6s %7s %8s %8s %8s %8s\n", "right", "yaw", "xi",
              "", "", "forward", "right", "up", "angle", "mm", "mrad", "1e-3", "", "patches", "N", "N", "N", "deg");
  double raise = 0;
  for (const Pose& start : {Pose{}, Pose{0, kStart, 2e-3}, Pose{0, kStart, 0, 1e-3}, Pose{3e-3, kStart, 3e-3},
                            Pose{-6e-3, kStart, 5e-3}, Pose{6e-3, kStart, 5e-3}, Pose{8e-3, kStart, 7.5e-3, -3e-3}}) {
    Pose his = start, mine = start;
    print_row(start, "theirs", pressed(their_contact, at, his));
    print_row(start, "ours", pressed(our_contact, at, mine));
    check_adapter(right, left, at, at_left, mine);
    if (start.lateral == 0 && start.yaw == 0 && start.creepage == 0) raise = mine.down - his.down;
  }
  std::printf("raise %.9f m\n", raise);
  return failures == 0 ? 0 : 1;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 3) {
    std::fprintf(stderr, "usage: one_wheel DATA_ROOT CASE\n");
    return 2;
  }
  try {
    return run(arguments[1], arguments[2]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
