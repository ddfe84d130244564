#pragma once
// Several contacts of one rigid wheel with one rail, each in its own plane, solved together.
//
// The axle is guided sideways and lies by d below the place where it touches first; the patch k touches from h_k on.
// With the contact angle delta_k, the rolling radius r_k, the resultants N_k of the pressure and T_k, X_k of the
// friction (on the rail)
//   approach_k = (d - h_k) cos(delta_k) - sum over j of cos(delta_k - delta_j)/(pi E*) ∫ p_j/r_jk dA,
//   xi_k = 1 - (1 - xi) r_k/r_1 (of a rail that turns too R_k/R_1 for the 1),   eta_k = eta_1
//   cos(delta_1)/cos(delta_k), sum of N_k cos(delta_k) - T_k sin(delta_k) = G,   sum of X_k = X,   sum of T_k = T where
//   these forces are given.
// The sum in approach_k is the depression of both surfaces at the patch's centre of pressure by the other patches
// [Johnson1985 eq. 3.22a]: exact to first order where the planes are one, an estimate where they are not. Its curvature
// over the patch is left out (bending_by_others). T is the sum along the planes of the patches, each its own: what one
// lateral creepage makes. xi, eta and a given spin are those of the contact that touches first;
// a given spin turns the wheel about the vertical.
#include <vector>

#include "bem/case_patch.hpp"

namespace railstrata {

/// Neighbouring contacts nearer to each other in angle than this are solved in one plane with all their interaction
/// where the wheel overlaps the rail all the way between them: half of the angle that one patch may span without a
/// warning.
inline constexpr double kAngleOfOnePlane = 10 * std::numbers::pi / 180;

struct PatchOnWheel {
  RigidContact contact;
  CasePatch patch;
  RollingSolution solution;
};

struct SharedLoad {
  std::vector<PatchOnWheel> patches;  ///< that carry load; empty: the first patch carries it all, in one plane
  PatchRoom room;                     ///< what the grid of that one has to hold
  int load_iterations = 0;
};

/// Looks for contacts beside a first one that was solved alone under the whole load, where its approach is `approach`
/// [m], and shares the load if there are.
/// Patches that reach the ridge between them become one, in the plane of the one that touches first. Throws CaseError:
/// traction above friction, friction that bears the weight (a wedged wheel).
SharedLoad share_load(const CaseSpec& spec, const Placement& placement, double approach, const BemOptions& options);

/// Throws CaseError with both places, the case's key and the remedy where a wheel that comes down by `approach` [m]
/// touches in a further plane: for what follows one patch alone.
void require_one_plane(const Placement& placement, double approach, const std::string& key, const std::string& remedy);

/// By how much the other patches bend the surfaces over one patch, of the contact's own smaller curvature kappa:
/// the sum of 2/(pi E*) ∫ p_j/r_j³ dA over kappa, in the plane the second derivative of the depression.
double bending_by_others(const CaseSpec& spec, const std::vector<PatchOnWheel>& patches, const PatchOnWheel& one);

}  // namespace railstrata
