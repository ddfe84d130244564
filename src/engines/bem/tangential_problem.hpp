#pragma once
// The frictional (tangential) contact problem for a given pressure: Kalker's theory on a grid of cells. [Kalker1990 ch.
// 4, Vollebregt2014]
//
// In every cell of the patch, with the relative slip s = (velocity of the wheel's surface over the rail's)/V and the
// traction bound g = f p,
//   |q| <= g;   |q| < g: s = 0 (stick);   s != 0: q = g s/|s| (slip),        q acts on the rail,
//   s = w - L q + history,   w = (xi - phi y, eta + phi x) the rigid slip, u = rail minus wheel displacement by q:
//   steady rolling     L q = (u(x) - u(x + dx))/dx         (particles enter at the leading edge, x large)
//   transient rolling  L q = u(x)/dq, history = u_before(x + dq)/dq, one step of rolled distance dq
//   shift              L q = u(x), history = u_before(x), s and w are distances [m], no rolling: one increment of a
//   load that may come and go.
// The leading edge lies somewhere between the first cell of a row and the empty cell ahead of it (leading_edge.hpp).
// With weights lambda, the slip of a first cell counts less lambda times that of the empty cell ahead of it:
//   s <- (s - lambda s_ahead)/(1 - lambda),     steady and transient rolling; divided so that a creepage stays what it
//   is
// and the spin's lateral slip is its mean over the step, phi (x + dq/2), in stick. In slip the cell stands for itself,
// not for the step ahead of it: (0, -phi dq/3) min(1, |s|/(3 |phi| dq)) is added to the slip that gives the direction.
// Without weights (whole cells, the scheme of Kalker and CONTACT) it is phi (x + dq/6) everywhere.
// Friction that is another across rolling, by the factor c: in q_y/c and c s_y the same problem with f alone, L
// between. Where friction falls with slip or a third-body layer yields, g is a function of the cell's slip
// (varying_bound.hpp). Solved by an active-set Newton method: unknown are both components in stick and the direction in
// slip; each linear system by GMRES with FFT products. L has a positive semi-definite symmetric part, and slip along
// the traction adds a positive diagonal, so every linear system is solvable.
#include <optional>
#include <vector>

#include "bem/influence_operator.hpp"
#include "bem/patch_grid.hpp"
#include "bem/patch_part.hpp"
#include "bem/plane_algebra.hpp"
#include "contact/contact_field.hpp"
#include "friction/falling_friction.hpp"
#include "friction/third_body.hpp"

namespace railstrata {

enum class RollingKind { steady, transient, shift };

/// Each direction is governed by its creepage (rigid slip of the wheel over the rail / V; for a shift the distance) or
/// by its force on the rail [N].
struct CreepOrForce {
  double creepage = 0;
  std::optional<double> force;
};

/// Motion of two surfaces over each other, the state before and the law of friction: all but the pressure.
struct RollingConditions {
  RollingKind kind = RollingKind::steady;
  CreepOrForce x, y;
  double spin = 0;       ///< 1/m
  Plane local_spin;      ///< 1/m, what the lateral slip has for a spin beyond `spin` in each row of cells, [j]; empty:
                         ///< none
  PlanePair extra_slip;  ///< further rigid slip (or m for a shift) in each cell: conformity, dissimilar bodies; mean
                         ///< over the step
  double step = 0;       ///< rolled distance dq [m]: transient only
  PlanePair before;      ///< m, history: rail minus wheel displacement of the state before; transient: at (x + dq, y);
                         ///< shift: at (x, y)
  PlanePair traction_before;  ///< Pa, transient: of the state before at (x + dq, y), for the work of friction alone;
                              ///< empty: not known
  FallingFriction falling;    ///< steady rolling; the bound of friction is that at rest
  double speed = 0;           ///< V [m/s], for the slip velocity of `falling`
  double lateral_share = 1;   ///< f across rolling over f along it: |(q_x, q_y/share)| <= g, slip along the normal of
                              ///< that ellipse
  ThirdBody third_body;       ///< where it yields; its elastic part is the influence operator's
  Plane plastic_before;       ///< m, history of the third body: as `before` (rolled_on); empty: none yet
  Plane lost_before;  ///< share of friction that slip has taken, history of a memory (friction_memory.hpp); as the one
                      ///< above
};

struct TangentialProblem : RollingConditions {
  Plane traction_bound;         ///< f p in each cell [Pa]; 0 outside the patch
  std::vector<ThirdBody> film;  ///< in each cell, where it is not `third_body` everywhere; empty: it is
  Plane leading_weight;  ///< lambda in each cell (leading_weights), 0 but in the first cells of the rows; empty: whole
                         ///< cells
};

struct TangentialOptions {
  double tolerance = 1e-5;    ///< of the slip conditions, relative to the largest rigid slip (history counts with a
                              ///< hundredth), and of a given force, relative to friction
  double share_of_first = 1;  ///< from a start, what may be left of the violation that it has here: see NormalOptions
  int max_outer = 80;
  bool partial = false;  ///< true: after max_outer steps what was reached is the answer, not an error
};

struct TangentialSolution {
  Plane q_x, q_y;                   ///< Pa, on the rail
  PlanePair slip;                   ///< relative to V (shift: m), of the slipping cells, along their traction; over the
                                    ///< step that ends there
  PlanePair cell_slip;              ///< the same at the middle of each cell (slip_of_cells)
  std::vector<ContactState> state;  ///< a cell whose third body yields slips
  Plane plastic;                    ///< m, plastic shear of the third body; empty: none that yields
  Plane lost_friction;              ///< share of friction that slip has taken; empty: friction without a memory
  Plane bound;                      ///< Pa, what sticking cells carry at most; empty: the problem's traction_bound
  Plane film_flexibility;           ///< m/Pa, of the film in each cell beyond the influence operator's; empty: none
  double creepage_x = 0, creepage_y = 0;
  double force_x = 0, force_y = 0;       ///< N, on the rail
  double moment = 0;                     ///< N m about the normal at the grid's origin, on the rail
  double dissipation = 0;                ///< friction power over V [N]; shift: work [J] (dissipated, cell_slip.hpp)
  double stick_area = 0, slip_area = 0;  ///< m²
  bool extrapolated = false;  ///< as a start: made of solutions of the steps before, close to the next one as a rule
  int outer_iterations = 0,
      iterations = 0;  ///< active sets; products with the influence operator and its preconditioner
};

/// start: traction of a similar problem, or null; taken as it is where it solves this problem. Throws CaseError for a
/// force that friction cannot carry, NumericalError without an end.
TangentialSolution solve_tangential(const InfluenceOperator& influence, const PatchGrid& grid,
                                    const TangentialProblem& problem, const TangentialOptions& options = {},
                                    const TangentialSolution* start = nullptr);

/// On a part of the grid.
TangentialProblem on_part(const PatchPart& part, const TangentialProblem& problem);
TangentialSolution on_part(const PatchPart& part, const TangentialSolution& solution);

/// Values of cells after the wheel has rolled on by one cell; new ones are zero.
Plane rolled_on(const PatchGrid& grid, const Plane& values);

/// Makes `next` the transient step in which the wheel rolls on by one cell (dx) from the state `before`, at the same
/// pressure.
void roll_on_one_cell(const InfluenceOperator& influence, const PatchGrid& grid, const TangentialSolution& before,
                      RollingConditions& next);
/// Makes `next` the next increment of a shift from the state `before`: creepages are further distances, forces the new
/// totals.
void shift_on(const InfluenceOperator& influence, const PatchGrid& grid, const TangentialSolution& before,
              RollingConditions& next);

}  // namespace railstrata
