#pragma once
#include "spec/case_spec.hpp"

namespace railstrata::post_checks {

/// A disc on a rail of the same lateral radius: a circular Hertzian contact.
inline CaseSpec crossed_cylinders() {
  CaseSpec spec;
  spec.geometry.rail_profile = "arc:R=420 mm";
  spec.geometry.wheel_profile = "flat";
  spec.geometry.rail_shape = RailShape::block;
  spec.geometry.wheel_shape = WheelShape::disc;
  spec.geometry.wheel_radius = 0.420;
  spec.geometry.cant = 0;
  spec.drive.traction_coefficient = spec.drive.friction_coefficient = 0;
  return spec;
}

}  // namespace railstrata::post_checks
