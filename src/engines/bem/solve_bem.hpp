#pragma once
// The half-space solution of a case: the same case file the finite elements run, answered by Kalker's method.
//
// Options of a case that it uses: profiles and track, wheel radius, moduli, layers (unbounded sideways), load G =
// (wheel + sprung mass) g as the vertical force, friction and the drive. Steady rolling: along and across the rail a
// force on the wheel (over G) or a creepage; what is not given follows from the geometry: lateral creepage from the
// yaw, spin from contact angle and curve, the variation of the rolling radius across the patch from the profiles. The
// normal force is such that normal and lateral force together bear the load. Where the wheel touches at several places
// they share it, each in its own plane (several_patches.hpp). Where the approach is given instead, the load is a
// result, and forces of the drive count over it. Not in it: inertia, the bodies' shape outside the patches, the layer's
// edges.
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "bem/bem_options.hpp"
#include "bem/case_patch.hpp"
#include "bem/subsurface.hpp"
#include "contact/contact_field.hpp"
#include "halfspace/layered.hpp"
#include "model/model.hpp"
#include "model/surroundings.hpp"

namespace railstrata {

/// Sums and extremes over the cells.
struct PatchTotals {
  double largest_pressure = 0, largest_traction = 0;  ///< Pa, of a cell; p_max and q_max of a result lie between cells
  double area = 0, slip_area = 0;                     ///< m²
};

/// Resultants on the rail.
struct RailForces {
  double x = 0, y = 0, z = 0;         ///< N, model frame (z up: z < 0), pressure and friction together
  double normal = 0, tangential = 0;  ///< N, contact frame: of the pressure; of the lateral friction, along y
  double moment = 0;                  ///< N m about the contact normal
};

/// Rigid slip of the wheel over the rail, divided by V; a driving wheel has x < 0.
struct RigidSlip {
  double x = 0, y = 0;  ///< creepages
  double spin = 0;      ///< 1/m
};

struct SolverEffort {
  int load_iterations = 1;   ///< normal loads tried until the vertical force was the weight
  int outer_iterations = 1;  ///< of pressure and friction, see RollingSolution; of the last normal load
  int iterations = 0;        ///< products with the influence operators, of the last normal load
  double wall_s = 0;
};

/// What the states below a patch ask for where the bodies are their sections.
struct SectionsBelowPatch {
  std::shared_ptr<SectionStore> store;
  CaseSpec spec;
  Placement placement;  ///< its contact is that of the patch
};

/// One patch in its contact plane.
struct BemPatch {
  ContactField field;
  PatchGrid grid;        ///< contact frame: x rolling, y along the common tangent, origin at the rigid contact point
  RigidContact contact;  ///< the plane that it was solved in: pressure acts along its normal
  /// Of a part of a patch of several contacts (several_patches.hpp) the place of its own overlap, with its angle; else
  /// `contact`. Moments, creepages and spin refer to it.
  RigidContact place;
  /// Of such a part: all that was solved in its plane, on the same grid. Stresses inside are under all of it.
  std::shared_ptr<const ContactField> together;
  PatchTotals patch;
  RailForces force;
  RigidSlip rigid_slip;
  double approach = 0;     ///< m; of a line contact NaN: distant points come together without end
  double dissipation = 0;  ///< W; of a shift J, of its last increment
  /// W, of the tractions in the rigid slip of the cells: creepages, spin and the rows' own rolling radii. In steady
  /// rolling the dissipation, as elastic displacements take no work round.
  double motion_power = std::numeric_limits<double>::quiet_NaN();
  /// Of the running surface by the rail's bending on its track under this patch's load; NaN: no section on a track.
  double bending_stretch = std::numeric_limits<double>::quiet_NaN();
  PatchSurroundings surroundings;
  std::shared_ptr<const SectionsBelowPatch> sections;  ///< null: half-spaces
};

struct InterfaceSlip;  // interface_slip.hpp

/// The patches of one of several solutions whose mean is the answer, and its share.
struct BemShare {
  double share = 0;
  std::vector<BemPatch> patches;
};

/// A result is its patch, where the wheel touches at several places the one with the largest pressure; the others
/// follow in that order. Their forces together are force_on_rail(). Where two places are on the way into one plane
/// (groupings_of) the patches are those of the solution with the largest share, and sums are means of all solutions.
struct BemResult : BemPatch {
  LayeredHalfSpace wheel, rail;
  std::vector<BemPatch> further;
  double share = 1;                                     ///< of these patches in the sums
  std::vector<BemShare> others;                         ///< the other solutions
  std::shared_ptr<const InterfaceSlip> interface_slip;  ///< null: no interface slides
  SolverEffort effort;
  std::vector<std::string> notes;  ///< what the user should know: a grown grid, …
};

/// Its own patch first, then the further ones.
std::vector<const BemPatch*> patches_of(const BemResult& result);
/// One of its patches as a result of its own.
BemResult alone(const BemResult& result, const BemPatch& patch);
/// The mean over the solutions of a sum, which `sum_of` makes of their patches.
template <class SumOf>
auto mean_of_solutions(const BemResult& result, SumOf&& sum_of) {
  auto out = sum_of(patches_of(result));
  if (result.others.empty()) return out;
  out = result.share * out;
  for (const BemShare& other : result.others) {
    std::vector<const BemPatch*> patches;
    for (const BemPatch& p : other.patches) patches.push_back(&p);
    out = out + other.share * sum_of(patches);
  }
  return out;
}
/// N, model frame: of all patches together.
Vec3 force_on_rail(const BemResult& result);
/// W, of all patches together.
double dissipation(const BemResult& result);

/// Throws CaseError: no contact, traction above friction, a load that flattens the largest patch, friction that bears
/// the weight whatever the normal force (a wedged wheel).
BemResult solve_bem(const CaseSpec& spec, const Placement& placement, const BemOptions& options = {});

struct PatchOnWheel;
/// A solved patch as a result; the effort's iterations of the load and time are left to the caller.
BemResult bem_result(const CaseSpec& spec, const Placement& placement, const PatchOnWheel& patch);

/// The stresses inside the rail or the wheel of a result. Axes x rolling, y along the common tangent, z into the body
/// (rail: down, wheel: up).
Subsurface rail_interior(const BemResult& result);
Subsurface wheel_interior(const BemResult& result);
/// The same under one of several patches.
Subsurface rail_interior(const LayeredHalfSpace& rail, const BemPatch& patch);
Subsurface wheel_interior(const LayeredHalfSpace& wheel, const BemPatch& patch);

}  // namespace railstrata
