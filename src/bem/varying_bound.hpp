#pragma once
// The traction bound of cells where it depends on their slip: friction that falls with the slip velocity, a third-body
// layer that yields (friction/).
#include "bem/given_slip.hpp"

namespace railstrata {

/// With v the slip of a cell along its traction, g(v) is what the cell carries, and Newton's method takes
///   |q| + n·dq = g(v) + g'(v) dv,    dv = -n·(L dq - creepage).
/// Falling friction follows v alone. The film's path of plastic shear adds up along each row, from the leading edge
/// on: a cell takes it from the cell ahead of it as that has slipped last.
class VaryingBound {
 public:
  VaryingBound(const PatchGrid& grid, const TangentialProblem& problem, const GivenSlip& given);

  static bool needed(const TangentialProblem& problem) {
    return problem.falling.falls() || problem.third_body.yields();
  }
  /// Throws CaseError for friction that falls too steeply: with L's symmetric part up to `largest` [1/Pa] the slip of a
  /// cell has one value for every traction around it only while largest |g'| < 1. And for steps of history, in which
  /// falling friction jumps.
  static void require_unique_slip(const TangentialProblem& problem, double largest);

  /// Takes the slip along the traction of every cell, 0 where it sticks.
  void follow(const Plane& along);

  double at_rest(std::size_t k) const { return rest_[k]; }     ///< Pa, what a sticking cell carries at most
  double wanted(std::size_t k) const { return wanted_[k]; }    ///< Pa, g(v)
  double by_slip(std::size_t k) const { return by_slip_[k]; }  ///< Pa, g'(v)
  const Plane& plastic() const { return plastic_; }            ///< m, u_pl; empty without a film that yields

 private:
  double plastic_before(int i, std::size_t k) const;
  const PatchGrid& grid_;
  const TangentialProblem& problem_;
  const GivenSlip& given_;
  Plane rest_, wanted_, by_slip_, plastic_;
};

}  // namespace railstrata
