#pragma once
// Half-space results in the files of CONTACT (user guide of version 25, module 3; file format 2410): a case file with
// the same undeformed distance, the contact's table (.mat) and stresses in the rail (.subs).
//
// CONTACT's frame: x rolling, y to the right, z down into body 1, which is the rail; tractions act on body 1. So y and
// what points along it change sign; rigid slip is of the rail over the wheel: CKSI = -xi, CETA = eta, CPHI = phi. Units
// mm, N, MPa, rad/mm. Cells count from 1, x fastest.
#include <string>

#include "bem/solve_bem.hpp"

namespace railstrata {

/// One patch as CONTACT's columns: i, state, undeformed distance, friction coefficient, p_n, p_x, p_y, displacement
/// differences (0: not kept), relative slip velocity. `placement` gives the undeformed distance.
std::string contact_mat(const CaseSpec& spec, const Placement& placement, const BemPatch& patch);

/// The case of one patch: normal force and creepages given, undeformed distance cell by cell; what the rigid slip has
/// besides, as an extra term of every cell (E = 9): rolling radius, local angle of spin. Throws CaseError for what
/// CONTACT's homogeneous half-spaces with Coulomb friction are not.
std::string contact_input(const CaseSpec& spec, const Placement& placement, const BemPatch& patch);

/// Displacements and stresses in the rail below every cell, at depths down to the patch's length.
std::string contact_stresses(const LayeredHalfSpace& rail, const BemPatch& patch);

}  // namespace railstrata
