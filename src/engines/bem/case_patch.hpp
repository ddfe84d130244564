#pragma once
// Makes the problem on a grid from a case, for solve_bem and creep_curve.
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "bem/bem_options.hpp"
#include "bem/profile_gap.hpp"
#include "contact/contact_field.hpp"
#include "geometry/height_field.hpp"
#include "halfspace/layered.hpp"
#include "model/model.hpp"

namespace railstrata {

/// The part of the surfaces that belongs to one patch, in the contact plane: t along the common tangent from the rigid
/// contact point, m. What lies beyond belongs to a neighbour.
struct PatchRoom {
  double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
  double held_low = 0, held_high = 0;  ///< the grid reaches over these
};

struct CasePatch {
  PatchGrid grid;
  ProfileGap profile;   ///< its gap with the sinking of the rail's surface
  RailSurface surface;  ///< empty planes: the surface of the profile
  std::shared_ptr<const InfluenceOperator> influence;
  std::shared_ptr<SectionStore> sections;  ///< null: half-spaces
  RollingContact contact;  ///< gap, load, friction, spin and rigid slip of the geometry; creepages and forces are left
                           ///< to the caller (drive_contact)
  NormalSolution frictionless;  ///< under its target, as the grid was fitted to it
  LayeredHalfSpace wheel, rail;
  HeightField rail_heights, wheel_heights;
  std::vector<std::string> notes;
};

/// The gap where the wheel has rolled by `distance` [m] from the first contact, without slip: that of the profiles less
/// the heights of both bodies, cell by cell.
Plane gap_after(const CasePatch& patch, double distance);

/// The potential contact area to begin with: a little larger than the ellipse of Hertz under the weight, or at the
/// target's approach; no smaller than what it has to hold.
PatchGrid first_grid(const CaseSpec& spec, const Placement& placement, const BemOptions& options,
                     const NormalTarget& target = {}, const PatchRoom& room = {});

/// Layers of one body from the case, from the surface down; a graded one cut into uniform ones.
LayeredHalfSpace layered_body(const CaseSpec& spec, BodyId body);

/// Spin that the lateral slip of each row of cells has beyond wheel_spin, 1/m: -sin(delta(y))/r with the angle of the
/// middle between the two surfaces there. The wheel turns by V/r about its axle, so that a point at x moves up or down
/// by x/r, over V, and slips by what of that lies along the surface. 0 where a profile has ended.
Plane local_spin(const PatchGrid& grid, const ProfileGap& profile, const RigidContact& contact);

/// Gives the problem the case's drive: creepages, or forces on the rail over the weight [N]. Without friction there are
/// no forces.
void drive_contact(const CaseSpec& spec, const RigidContact& contact, double weight, RollingContact& problem);

/// Turns the creepages and the spin of the contact `first` of a wheel into those of another one: the wheel moves as a
/// whole (several_patches.hpp), turning about the vertical by `turn` (turn_about_vertical of the case, 1/m).
void carry_creepages(double turn, const RigidContact& first, const RigidContact& own, RollingContact& problem);

/// The normal force [N] that balances the weight G together with a lateral force T_y on the rail, in the contact plane
/// at the angle delta: N cos(delta) - T_y sin(delta) = G.
double normal_load(double weight, double lateral, const RigidContact& contact);
/// Throws CaseError: there is no such force for what is `borne`, the "weight" or the "load".
[[noreturn]] void refuse_wedged(const char* borne, const RigidContact& contact);

/// Places the grid and grows it until the frictionless patch under the normal load or approach, with a ring to spare,
/// lies inside. Throws CaseError as solve_bem.
CasePatch make_case_patch(const CaseSpec& spec, const Placement& placement, const BemOptions& options,
                          const NormalTarget& target, const PatchRoom& room = {});

/// The same on a grid that is given, without the frictionless contact: the caller looks at reaches_edge of his
/// solution.
CasePatch case_patch_on(const PatchGrid& grid, const CaseSpec& spec, const Placement& placement,
                        const BemOptions& options, const NormalTarget& target, const PatchRoom& room = {});

/// Fills the patch's contact problem from the case; the grid and the gap are there already.
void set_problem(const CaseSpec& spec, const Placement& placement, const NormalTarget& target, CasePatch& patch);

/// Makes a field of the cells: where they lie on the rail, x from the contact on, and their areas.
void place_cells(const CasePatch& patch, const RigidContact& contact, ContactField& field);

/// Whether the patch touches the outermost ring of cells.
bool reaches_edge(const PatchGrid& grid, const Plane& pressure);

/// Whether the grid reaches over what it has to hold.
bool holds(const PatchGrid& grid, const PatchRoom& room);

/// Whether the grid of a solution is a suitable start where another one would be laid first: large enough, and not much
/// larger than that or than its patch.
bool suits(const BemStart& start, const PatchGrid& wanted);

}  // namespace railstrata
