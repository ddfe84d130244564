#pragma once
// Equilibrium before the rolling: gravity, the centrifugal forces of the wheel's starting spin (they widen the rim by
// some 10 um, a tenth of the approach: a wheel set spinning without them rings), contact without friction, or with a
// given lateral friction (fem/lateral_start.hpp) in the ratio of the pressures.
//
// Unknown: the displacements of both bodies, the axle's height and the pressures. A primal-dual active set: a node is
// in contact where p - c g > 0 (c: stiffness of a surface element); a step solves the equilibrium of the undeformed
// bodies' stiffness with the gaps of these nodes closed by springs a thousand times stiffer than an element, whose
// pressures are the next p, and opens and closes nodes by it until residual and penetration are met
// [HueberWohlmuth2005]. The linear systems are solved by conjugate gradients with the explicit solver's element kernel
// as the operator and two levels of preconditioning (fem/static_preconditioner.hpp), never more exactly than the next
// step can use. Nothing but the coarse level is assembled. Several ranks share vectors and elements by tiles.
//
// Elements that may yield add their eigenstress to the residual: of one increment from the virgin state to the present
// displacements, so that what a step on the way overshoots leaves nothing behind. The steps keep the elastic stiffness
// (initial stress method) and converge the slower the more has yielded.
#include <array>
#include <functional>

#include "core/ranks.hpp"
#include "fem/rolling_system.hpp"
#include "fem/steady_start.hpp"

namespace railstrata {

/// A rail over which wheels have rolled.
struct RailBefore {
  Field u;                 ///< m, displacements of the rail at rest (fem/rail_at_rest.hpp)
  PlasticHistory history;  ///< of its elements
};

struct PreloadResult {
  std::array<Field, 2> u;                 ///< m, displacements by BodyId
  std::array<PlasticHistory, 2> history;  ///< of the elements, with what has yielded
  Field before;                           ///< m, displacements of the rail without the wheel; empty: none
  double axle_z = 0;  ///< m, displacement of the axle from the rigid contact position, negative: down
  SurfaceTractions tractions{0, 0};
  double foot_z = 0;                        ///< m, of a rail on a track: displacement of its foot below the wheel
  double residual = 0;                      ///< |r| / |load vector|
  double penetration = 0;                   ///< m, largest of the nodes in contact
  Vec3 contact_force;                       ///< N, on the wheel, with the lateral friction
  int newton_steps = 0, cg_iterations = 0;  ///< steps: evaluations of the exact residual
  StartMotion motion;                       ///< of the wheel
  int steady_passes = 0;                    ///< of the friction of steady rolling; 0: starts without
  double steady_change = 0;                 ///< in the last of them, over the friction
  double wall_seconds = 0;
};

/// Called after every Newton step with (relative residual, wanted residual, CG iterations so far). False: stop.
using PreloadProgress = std::function<bool(double, double, int)>;

/// before: not null: what earlier wheels have left in the rail. ranks: that share the work (fem/static_share.hpp); all
/// get the result of one to the last bit. Throws NumericalError when it does not converge, Interrupted when `progress`
/// asks for it on any rank.
PreloadResult solve_preload(const RollingSystem& system, double tolerance, const PreloadProgress& progress = {},
                            const RailBefore* before = nullptr, const Ranks& ranks = {},
                            const SteadyFriction& friction = {});

}  // namespace railstrata
