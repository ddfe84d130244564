#pragma once
// The motion of a wheel and the creepages of its contacts, without products of creepages.
//
// The wheel turns by omega about its axle and by Omega about the vertical, moves at V along the rail and slips sideways
// by eta_0 V, level. With the tape circle's radius r_0 and place y_0, a contact at y with the rolling radius r and the
// angle delta has
//   xi = 1 - (1 - xi_0) r/r_0 - (y - y_0) Omega/V,   eta = eta_0 / cos(delta),   xi_0 = (V - omega r_0)/V,
// for its surface cannot move into the rail.
#include "geometry/placement.hpp"
#include "spec/case_spec.hpp"

namespace railstrata {

/// Omega/V, 1/m, of the wheel beside its rail: that of a given spin (1/cos(delta) of what it has beyond wheel_spin),
/// else of the curve.
double turn_about_vertical(const CaseSpec& spec, const RigidContact& contact);

/// Spin of a contact, 1/m: given, or wheel_spin and cos(delta) Omega/V of a curve (centre on the field side: R > 0).
double spin_at(const CaseSpec& spec, const RigidContact& contact);

/// The case's drive with creepages of the contact where those given are the wheel's (drive.creepage_of).
DriveSpec drive_at_contact(const CaseSpec& spec, const RigidContact& contact);

}  // namespace railstrata
