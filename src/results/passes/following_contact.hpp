#pragma once
// Contact that goes along with the yielding of the rail: pressure and friction of a pass on the surface that plastic
// strain has left and is making under the load.
//
// The tractions cause plastic strain (steady/steady_pass.hpp), whose elastic answer displaces the surface by u(x, y).
// Its sinking opens the gap of the half-spaces, its tangential part slips under the wheel by du/dx as an elastic
// displacement does; both change the tractions. Solved as a fixed point of u with Anderson's acceleration
// [WalkerNi2011]: contact on u, a pass under its stress, u of that pass. Ended when the pressure of no cell changes by
// more than 0.2 % of the largest one from one round to the next.
#include <vector>

#include "bem/solve_bem.hpp"
#include "passes/rail_passes.hpp"

namespace railstrata {

/// A pass and the contact that it was computed under.
struct FollowedPass {
  PassResult result;
  Field contact_strain;
  double largest_pressure = 0, creepage = 0;  ///< Pa
  int rounds = 0;
  double change = 0;  ///< of pressure in the last round, over the largest
  bool converged = true;
};

class FollowingContact {
 public:
  /// One case and its placement for each traction (cases_of_tractions); bem: how their contacts are solved.
  FollowingContact(std::vector<CaseSpec> specs, std::vector<Placement> placements, const BemOptions& bem);
  /// The next pass with the traction and place given; the state advances. Throws as SteadyBody::run_pass, the state is
  /// then as it was, and as solve_bem.
  FollowedPass run_pass(const RailPasses& rail, const SteadyBody& body, std::size_t traction, int columns,
                        PassState& state, const PassLimits& limits);

 private:
  BemResult solve(const RailPasses& rail, const Field& surface, std::size_t traction, int columns,
                  BemNeighbour& neighbour);

  std::vector<CaseSpec> specs_;
  std::vector<Placement> placements_;
  BemOptions bem_;
  InfluenceCache cache_;
};

/// The displacement of a rail's surface (as of PassResult) in cells of a contact whose wheel runs so many columns to
/// the side, by trigonometric interpolation.
RailSurface surface_in_cells(const PatchGrid& cells, const SteadyGrid& grid, double middle_x, int columns,
                             const Field& surface);

}  // namespace railstrata
