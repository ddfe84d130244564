#pragma once
// The traction bound of cells where it depends on their slip: friction that falls with the slip velocity, a third-body
// layer that yields (friction/).
#include "bem/given_slip.hpp"
#include "friction/friction_memory.hpp"

namespace railstrata {

/// With v the slip of a cell along its traction, g(v) is what the cell carries, and Newton's method takes
///   |q| + n·dq = g(v) + dg,    dg = g'(v) dv,    dv = -n·(L dq - dxi).
/// A film and friction are in series: v is the film's while it yields, and what its path leaves of a cell's slip is
/// friction's. Falling friction without a memory follows v alone. What its memory has lost, and the film's path of
/// plastic shear, go along each row from the leading edge on: there dg has the changes of the cells ahead too.
class VaryingBound {
 public:
  VaryingBound(const PatchGrid& grid, const TangentialProblem& problem, const GivenSlip& given);

  static bool needed(const TangentialProblem& problem) {
    return problem.falling.falls() || problem.third_body.yields();
  }
  /// Throws CaseError for friction that falls too steeply and for a film that softens too fast: with L's symmetric part
  /// up to `largest` [1/Pa], a film's elastic shear in it, the slip of a cell has one value for every traction around
  /// it only while largest |g'| < 1; in a step of history L is the whole displacement over the step, and beyond that
  /// the surfaces jump. And for shifts, whose slip has no velocity. With a memory g' is that of one step of `step` [m].
  static void require_unique_slip(const TangentialProblem& problem, double step, double largest);

  /// To be filled with the slip along the traction of each cell, 0 where it sticks, before `follow`; with a change of
  /// it before `change`.
  Plane& along() { return along_; }
  void follow();
  void change();

  const Plane& at_rest() const { return rest_; }  ///< Pa, what a sticking cell carries at most
  double at_rest(std::size_t k) const { return rest_[k]; }
  double wanted(std::size_t k) const { return wanted_[k]; }    ///< Pa, g(v)
  double by_slip(std::size_t k) const { return by_slip_[k]; }  ///< Pa, g'(v) by the cell's own slip
  double change(std::size_t k) const { return change_[k]; }    ///< Pa, dg by the last `change`
  const Plane& plastic() const { return plastic_; }            ///< m, u_pl; empty without a film that yields
  const Plane& lost() const { return lost_; }                  ///< share; empty without a memory

 private:
  double before(const Plane& now, const Plane& history, std::size_t k) const;
  /// length: of the cell's step [m]; inside: what of it a particle is in the patch.
  void follow_cell(std::size_t k, double length, double inside);
  /// Like yield_or_slide, `plastic` only what this step adds.
  FilmStep follow_film(std::size_t k, double length);
  void change_of_film();
  void change_of_memory();
  const PatchGrid& grid_;
  const TangentialProblem& problem_;
  const GivenSlip& given_;
  Plane along_ = Plane(grid_.size()), rest_ = along_, wanted_ = along_, by_slip_ = along_, change_ = along_;
  Plane plastic_;      // with a film that yields
  Plane lost_, kept_;  // with a memory; kept_: what is left of a change of what was lost before
  Mask yields_;        // the film is the lower bound; with a film that yields
  Mask taken_over_;    // friction is, from the film within the cell's step: what lies ahead no longer matters
};

}  // namespace railstrata
