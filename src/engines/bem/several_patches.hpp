#pragma once
// Several contacts of one rigid wheel with one rail, each in its own plane, solved together.
//
// The axle is guided sideways and lies by d below the place where it touches first; the patch k touches from h_k on.
// With the contact angle delta_k, the rolling radius r_k, the resultants N_k of the pressure and T_k, X_k of the
// friction (on the rail)
//   approach_k = (d - h_k) cos(delta_k) - sum over j of cos(delta_k - delta_j)/(pi E*) ∫ p_j/r_jk dA,
//   xi_k = 1 - (1 - xi) r_k/r_0 (of a rail that turns too R_k/R_0 for the 1) - (y_k - y_0) Omega/V,   eta_k = eta_0
//   cos(delta_0)/cos(delta_k), sum of N_k cos(delta_k) - T_k sin(delta_k) = G,   sum of X_k = X,   sum of T_k = T where
//   these forces are given.
// The sum in approach_k is the depression of both surfaces at the patch's centre of pressure by the other patches
// [Johnson1985 eq. 3.22a]: exact to first order where the planes are one, an estimate where they are not. Its curvature
// over the patch is left out (bending_by_others). T is the sum along the planes of the patches, each its own: what one
// lateral creepage makes. xi, eta and a given spin are those of the wheel's
// reference (reference_of), 0; a given spin turns the wheel about the vertical. Planes and reference follow d.
#include <cstddef>
#include <optional>
#include <vector>

#include "bem/case_patch.hpp"
#include "bem/contact_places.hpp"

namespace railstrata {

struct PatchOnWheel {
  RigidContact contact;
  CasePatch patch;
  RollingSolution solution;
  std::vector<RigidContact> contacts{};  ///< that were solved in one plane, `contact`; empty: that one
  RailStretch stretch{};                 ///< between the ridges to other patches
};

/// Two patches of which one comes near the ridge between them. reach: from 0, where cells within one of the ridge come
/// into contact, over 1, where they bear a tenth of its largest pressure.
struct PatchesMeet {
  std::size_t into = 0, from = 0;
  double reach = 0;
};
/// From this reach on, which is known to some 3 % without friction, patches are one.
inline constexpr double kSurelyOne = 1.05;

/// What bears the load, or one of those that do where the answer is the mean of several (groupings_of).
struct SharedLoad {
  double share = 1;                   ///< in the answer; 0: for the next one to start from
  std::vector<PatchOnWheel> patches;  ///< that carry load; empty: one patch carries it all, at `alone`
  PatchPlace alone;
  std::size_t places = 0;                     ///< that were looked at
  double descent = 0;                         ///< m, of the wheel below the place where it touches first
  double power = kPowerOfHertz;               ///< of the descent in the vertical force, of one patch
  SoughtCreepage along, across;               ///< of the reference, of several patches
  std::vector<std::vector<BemStart>> smooth;  ///< as of BemNeighbour
  std::optional<PatchesMeet> meet;            ///< the two that are nearest to becoming one
  int load_iterations = 0;
};

/// How far patches come to each other before they are one: by the rule, or by any pressure in a cell beside the ridge.
enum class Merging { by_reach, at_once };

/// Shares the load between the patches of these places, in order, of a wheel that is lowered by `descent` [m], that of
/// a first patch that bears the whole load, or given, if they are several. Patches that surely become one are not
/// solved with friction. Throws CaseError: traction above friction, friction that bears the weight (a wedged wheel).
SharedLoad share_between(const CaseSpec& spec, const Placement& placement, const std::vector<ContactPlace>& places,
                         double descent, const BemOptions& options, Merging merging,
                         std::vector<std::vector<BemStart>> smooth = {});

/// The places with the patches that meet as one.
std::vector<ContactPlace> merged(std::vector<ContactPlace> places, const PatchesMeet& meet);
/// The share that an answer with both as one has: 0 to 1.
double share_merged(const PatchesMeet& meet);

/// The same where patches that reach the ridge between them, by half of share_merged, become one. near_merging: becomes
/// true where the share of an answer with others may be more than 0.
SharedLoad share_load(const CaseSpec& spec, const Placement& placement, std::vector<ContactPlace> places,
                      double descent, const BemOptions& options, Merging merging, bool& near_merging);

/// By how much the other patches bend the surfaces over one patch, of the contact's own smaller curvature kappa:
/// the sum of 2/(pi E*) ∫ p_j/r_j³ dA over kappa, in the plane the second derivative of the depression.
double bending_by_others(const CaseSpec& spec, const std::vector<PatchOnWheel>& patches, const PatchOnWheel& one);

/// One connected part of a patch, or several around one place.
struct PatchPiece {
  RigidContact place;  ///< of its own overlap, with the contact angle there
  PatchOnWheel patch;  ///< on the grid and in the plane of the whole, nothing outside of the part
};

/// The cells with pressure that hang together, by sides or corners, belong to the place that their centre of pressure
/// is nearest to: those of the overlaps of the whole's contacts on their stretches of the rail, under a descent [m].
/// The dissipation of the whole is shared by q·slip of the cells. The heaviest first. Of one part: the whole, at the
/// plane's own place.
std::vector<PatchPiece> pieces_of(const PatchOnWheel& whole, const Placement& placement, double descent);

}  // namespace railstrata
