#pragma once
// A rolling contact small enough for a test: a disc with a crowned tread on a flat block, 4 mm elements.
#include "fem/rolling_run.hpp"

namespace railstrata::fem_checks {

inline CaseSpec small_case() {
  CaseSpec s;
  s.geometry.rail_profile = "flat";
  s.geometry.wheel_profile = "arc:R=430 mm";
  s.geometry.rail_shape = RailShape::block;
  s.geometry.wheel_shape = WheelShape::disc;
  s.geometry.cant = 0;
  s.geometry.wheel_section.bore_radius = 0.25;
  s.vehicle.wheel_mass = 1500;
  s.vehicle.sprung_mass = 7000;
  s.mesh.element_size = 4e-3;
  s.mesh.fine_width = 32e-3;
  s.mesh.fine_depth = 8e-3;
  s.mesh.coarse_ratio = 2;
  s.mesh.largest = 20e-3;
  s.mesh.end_length = 0.06;
  s.run.positions = {0.03};
  s.run.start = RunStart::rest;
  s.run.window = 8e-3;
  s.run.run_up = 0;
  s.run.run_up_damping = 0;
  return s;
}

inline constexpr double kBallFriction = 0.5;

/// A ball of a wheel on a plane: its contact does not know a yaw, and its contact plane lies level.
inline CaseSpec ball_case() {
  CaseSpec s = small_case();
  s.drive.friction_coefficient = kBallFriction;
  s.drive.traction_coefficient = 0;
  s.drive.torque_ramp = 0.5e-3;
  s.run.positions = {0.06};
  s.run.window = 9e-3;
  s.run.run_up = 0.03;
  s.run.run_up_damping = 3000;
  return s;
}

/// With a layer of a millimetre on 4 mm elements.
inline CaseSpec thinly_layered(CaseSpec s) {
  s.layers.emplace_back();
  s.layers.back().thickness = 1e-3;
  s.layers.back().width = 0.02;
  return s;
}

/// With a stiff layer that ends under the wheel's path, and a softer stretch behind its end.
inline CaseSpec ending_layer(CaseSpec s) {
  s.layers.emplace_back();
  s.layers.back().thickness = 4e-3;
  s.layers.back().width = 0.04;
  s.layers.back().material.young = 420e9;
  s.layers.back().to = 0.004;
  s.stretches.push_back({BodyId::rail, {{0.002, 1, 1}, {0.02, 0.8, 1}}, {}});
  s.run.window = 0;
  return s;
}

/// On three sleepers, with hard ballast: a bar of 60 mm by 60 mm is no rail.
inline CaseSpec on_track(CaseSpec s) {
  s.track.preset = TrackSet::medium;
  s.track.support.spacing = 0.2;
  s.track.support.phase = 0;
  s.track.support.pad_length = 0.06;
  s.track.support.ballast_stiffness = 80e6;
  s.track.support.bays = 3;
  return s;
}

inline RollingSystem small_system(const CaseSpec& spec) { return RollingSystem(build_model(spec, ".")); }

}  // namespace railstrata::fem_checks
