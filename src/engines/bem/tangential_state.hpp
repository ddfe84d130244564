#pragma once
// State of a tangential solution from step to step: traction, slip, and which cells stick.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "bem/given_slip.hpp"
#include "bem/varying_bound.hpp"

namespace railstrata {

enum CellSet : unsigned char {
  kOutside,
  kStick,
  kSlip,
  kLoosened  ///< stuck before the Newton step, over the traction bound after it
};

/// L of tangential_problem.hpp: the slip that tractions take away, of one pair of planes at a time.
class SlipOperator {
 public:
  /// film: m/Pa, of each cell beyond the influence's own; empty: none.
  SlipOperator(const InfluenceOperator& influence, const PatchGrid& grid, const TangentialProblem& problem,
               const std::vector<LeadingCell>& leading, const Plane& film);

  /// Prepares L in.
  void apply(const double* in);
  /// L in at cell i.
  double x(std::size_t i) const { return (u_[i] - (steady_ ? u_[i + ahead_] : 0.0)) * inverse_step_; }
  double y(std::size_t i) const {
    const std::size_t k = n_ + ahead_ + i;
    return (u_[k] - (steady_ ? u_[k + ahead_] : 0.0)) * inverse_step_;
  }
  /// In steady rolling the weights of displacements that weights of slips make: of the surfaces, x and y. What is not 0
  /// lies two rows from the grid's end.
  void weights_of_displacement(const double* of_slip, Plane& out) const;
  /// From these weights those of the tractions: together out = L^T in.
  void weights_of_traction(const Plane& of_displacement, double* out);
  /// The traction on the periodic grid that makes a displacement.
  void traction_of(const Plane& displacement, double* out);

  bool steady() const { return steady_; }
  double step_length() const { return step_; }  ///< m
  double self() const { return self_; }         ///< 1/Pa, L of one cell on itself
  int products() const { return products_; }    ///< with the influence and its preconditioner, so far
  /// How much slip a traction takes away at most, 1/Pa: the largest eigenvalue of L's symmetric part, of a film [m/Pa]
  /// its own part.
  double largest(const Plane& traction_bound, double film) const;

 private:
  void extrapolate_at_leading_cells();
  void add_film(const double* in);

  const InfluenceOperator& influence_;
  const PatchGrid& grid_;
  const std::vector<LeadingCell>& leading_;
  const Plane& film_;
  double lateral_share_;
  bool steady_;
  double step_, inverse_step_, self_;
  std::size_t n_, ahead_;
  Plane u_;       // rail minus wheel displacement, with a row of cells ahead
  Plane scaled_;  // traction or displacement as the influence has it; with a lateral share
  int products_ = 0;
};

inline double magnitude(double x, double y) { return std::sqrt(x * x + y * y); }

/// Pairs of planes hold x and y one after the other. With a lateral share c of friction all lateral parts are q_y/c and
/// c s_y, creepage and force too.
struct TangentialState {
  TangentialState(const InfluenceOperator& influence, const PatchGrid& grid, const TangentialProblem& problem);
  TangentialState(const TangentialState&) = delete;

  const PatchGrid& grid;
  const TangentialProblem& problem;
  std::size_t n, ahead;  ///< cells of the grid and of one of its rows
  Plane q, slip;         ///< unknown traction; its slip
  Mask set;              ///< CellSet
  GivenSlip given;
  Plane film_flexibility;  ///< m/Pa, beyond the influence operator's; empty: none
  SlipOperator L;
  std::optional<VaryingBound> varying;
  Plane carried;        ///< with `varying`: the bound of sticking cells, |q| of slipping ones
  const double* bound;  ///< of each cell: `carried`, or the problem's own
  std::array<double, 2> creepage;

  /// kernel(i) for every cell; each stands for the values of two planes.
  template <class Kernel>
  void for_both(Kernel&& kernel) const {
    for_cells(n, 2, kernel);
  }
  using Components = std::array<double, 2>;
  /// The same, and the sums of a pair of planes after it.
  template <class Kernel>
  Components for_both_summed(const double* pair, Kernel&& kernel) const {
    std::vector<Components> part(pieces_of(n));
    for_pieces(n, 2, [&](std::size_t k, std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) kernel(i);
      part[k] = {sum_of(begin, end, [&](std::size_t i) { return pair[i]; }),
                 sum_of(begin, end, [&](std::size_t i) { return pair[n + i]; })};
    });
    Components total{0, 0};
    for (const Components& p : part) {
      total[0] += p[0];
      total[1] += p[1];
    }
    return total;
  }

  /// (Given force - force of the tractions) / area of a cell, Pa.
  double missing_force(int direction) const {
    const double* values = q.data() + (direction ? n : 0);
    return (direction ? *problem.y.force / problem.lateral_share : *problem.x.force) / grid.cell_area() -
           ordered_sum_of(n, [&](std::size_t i) { return values[i]; });
  }

  /// Lateral slip of a slipping cell at its own place: slip has the spin's mean over the step ahead. A small slip is
  /// changed by a ninth of itself at most, so that Newton's method, which does not see the change, still contracts.
  double lateral_slip(std::size_t i) const {
    const double y = slip[n + i];
    if (given.to_own_place.empty() || set[i] != kSlip) return y;
    const double change = given.to_own_place[i];
    return change == 0 ? y : y + change * std::min(1.0, magnitude(slip[i], y) / (9 * std::abs(change)));
  }

  /// Lateral tractions, slips and creepages from and to those of the surfaces.
  double traction_y(double of_state) const { return problem.lateral_share * of_state; }
  double slip_y(double of_state) const { return of_state / problem.lateral_share; }

  /// Takes over the tractions of a similar problem in the cells of the patch, and the creepages of given forces. Its
  /// traction bound differs: cells that slipped are put on the new bound, with `capped` sticking ones at most on it.
  void adopt(const TangentialSolution& start, bool capped);
  void update_slip();
  /// A bound that varies takes the slip along the traction; cells that stick are bound by its value at rest.
  void follow_slip();
};

/// Takes a solution of the state's own problem: sets stand, slipping cells are on their bound.
void take_over(const TangentialSolution& solution, TangentialState& state);

}  // namespace railstrata
