#pragma once
// Passes of a wheel over a rail that yields, from a half-space solution: the rail's rows, their laws and the strain of
// the contact on the grid of the stationary method (steady/steady_pass.hpp); and what either method says of a pass.
//
// Assumptions of the half-space remain: layers without lateral ends; one patch, which rolls along a straight rail.
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "bem/solve_bem.hpp"
#include "bem/subsurface.hpp"
#include "model/model.hpp"
#include "spec/case_fwd.hpp"
#include "steady/pass_class.hpp"
#include "steady/steady_pass.hpp"

namespace railstrata {

/// A rail ready for passes.
struct RailPasses {
  SteadyGrid grid;        ///< x from the middle of the patch, y in the contact frame
  double middle_x = 0;    ///< m, of the patch in the contact frame
  double window = 0;      ///< half-lengths of the patch behind the load where flow is followed
  std::vector<int> zone;  ///< of rows: 0 the rail, then its layers from the surface down
  std::vector<SteadyRow> rows;
  RowModuli below;                                    ///< of what lies under the rows
  std::vector<std::array<double, 2>> initial_stress;  ///< Pa, of rows
  std::vector<std::string> notes;                     ///< which strengths are estimates, and how
  std::vector<Field> contact_stress;                  ///< Pa, of each solution, on SteadyGrid::path() (active_size)
};

/// Columns and rows that passes of several wheels share.
struct PassLattice {
  double apart = 0, line = 0;  ///< m, of columns; y of one of them in the contact frame, from RailPasses' origin
  std::vector<double> thickness = {};  ///< m, of rows
  InteriorKernels* kernels = nullptr;  ///< that they share too; may be null
};

/// solutions: of cases_of_tractions (passes/pass_plan.hpp), the grid is that of the first one's patch, as wide as the
/// wheels wander. lattice: of the columns and rows; null: those of the patch. Throws CaseError: no strength of rail or
/// layers, several patches, wheels that wander too far.
RailPasses rail_passes(const CaseSpec& spec, const std::vector<BemResult>& solutions,
                       const PassLattice* lattice = nullptr);

/// Of the largest flow of a pass: what may come in the last quarter of the window.
inline constexpr double kLateFlow = 1e-3;
/// The next longer window for a rail whose first pass flows on behind this one (kLateFlow); none if it
/// does not, if the case gives the window, or if it is four times the usual one.
std::optional<double> longer_window(const PassesSpec& passes, const RailPasses& rail, double late_flow);

/// Stress in the rail under another contact of the same wheel, Pa, as contact_stress.
Field contact_stress(const RailPasses& passes, const BemResult& contact);

/// The strain of a stress of the contact, so many columns to the side.
Field contact_strain(const RailPasses& passes, const SteadyBody& body, const Field& contact_stress, int columns = 0);
/// The column nearest to a place across.
int columns_to(const SteadyGrid& grid, double lateral);

/// The contact of a pass.
struct PassContact {
  double traction = 0, creepage = 0;  ///< F_T over the normal force; of the wheel along the rail
  double p_max = 0;                   ///< Pa
  double lateral = 0;                 ///< m across, where the wheel ran, from the case's own place to the field side
};

/// A pass as one row of a table.
struct PassRow {
  int pass = 0, iterations = 0;
  double error = 0;
  bool converged = true;
  PassStrain largest;                    ///< Δp and net strain, each of the point where it is largest
  double net_y = 0, net_depth = 0;       ///< m, where the net strain is largest
  double strain = 0;                     ///< largest equivalent plastic strain √(2/3 Ep:Ep) so far
  std::array<double, 2> stress{};        ///< Pa, most compressive residual stress along x and y
  std::array<double, 2> stress_depth{};  ///< m, where
  double forward = 0, lateral = 0;       ///< m, largest displacement of the surface since the first pass, with its sign
  double sinking = 0;                    ///< m, largest
  PassContact contact;
  double force = 0;        ///< N along x: what the passes put into an endless rail; of a line contact N/m
  double force_share = 0;  ///< the same, over the integral of |S_xx|
  int rounds = 0;          ///< of contact and yielding; 0: pressure of the elastic bodies
  double late_flow = 0;    ///< as of PassResult
  double balance = 0;      ///< largest |mean of S_zz, S_yz, S_xz of a row| over the largest mean |S_xx|: equilibrium
};
PassRow pass_row(const SteadyGrid& grid, int pass, const PassResult& result);

/// Axes of the rigid contact point: x along the rail, y in the contact plane, z into the rail.
struct PassPoint {
  double y = 0, depth = 0;  ///< m
  int zone = 0;             ///< 0 the rail, then its layers from the surface down
  PassStrain strain;        ///< of the pass
  PassClass kind = PassClass::transient;
  std::array<double, 6> stress{};   ///< Pa, residual, xx, yy, zz, xy, yz, xz
  std::array<double, 6> plastic{};  ///< Ep, tensor shears
  double accumulated = 0;           ///< p over all passes
  int row = -1, column = -1;        ///< of the fine zone's elements; none deeper and of the stationary method
};

/// A point and what it sees at the stations, in the order in which the load reaches them.
struct PassLoop {
  std::string name;                  ///< "governing", "surface", "above the border", "below the border"
  double y = 0, depth = 0;           ///< m, as of PassPoint
  std::vector<double> x;             ///< m, of the stations from the load
  std::vector<StationState> states;  ///< as many, in the axes of PassPoint
};

/// Takes a point into the largest and smallest values of a row.
void add_extremes(const PassPoint& point, PassRow& row);

/// Points of the unworn profile at most 0.25 mm apart, lowered along its normal by what the surface has sunk at their
/// arc length from the contact point (PassResult::sinking, linear between columns), in the rail's own frame
/// (geometry.rail_mirror and rail_offset are in it). Beside the grid it stays as it is. Needs a grid with columns.
std::vector<Vec2> pressed_profile(const Placement& placement, const SteadyGrid& grid, const PassResult& last);

}  // namespace railstrata
