#pragma once
// The case of the paper that whole steps are measured on.
#include "spec/case_spec.hpp"

namespace railstrata {

/// The paper's base case without run-up, elements of so many millimetres.
inline CaseSpec base_case(double millimetres, ArithmeticPrecision precision) {
  CaseSpec s;
  s.geometry.wheel_profile = "LMA";
  s.geometry.rail_profile = "CN60";
  s.geometry.cant = 1.0 / 40;
  s.geometry.lateral_shift = 1.5e-3;
  s.drive.speed = 27.78;
  s.drive.traction_coefficient = 0.2;
  s.drive.friction_coefficient = 0.5;
  s.mesh.element_size = 1e-3 * millimetres;
  s.run.positions = {0.3};
  s.run.start = RunStart::rest;
  s.run.run_up = 0;
  s.run.precision = precision;
  return s;
}

}  // namespace railstrata
