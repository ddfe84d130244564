#include "bem/varying_bound.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/faults.hpp"

namespace railstrata {

VaryingBound::VaryingBound(const PatchGrid& grid, const TangentialProblem& problem, const GivenSlip& given)
    : grid_(grid),
      problem_(problem),
      given_(given),
      along_(grid.size(), 0.0),
      rest_(grid.size()),
      wanted_(grid.size()),
      by_slip_(grid.size()),
      change_(grid.size()) {
  if (problem.third_body.yields()) {
    plastic_.assign(grid.size(), 0.0);
    slides_.assign(grid.size(), 0);
  }
  follow();
}

void VaryingBound::require_unique_slip(const TangentialProblem& problem, double largest) {
  if (!problem.falling.falls() || problem.traction_bound.empty()) return;
  if (problem.kind == RollingKind::shift)
    throw CaseError("friction that falls with slip velocity has no meaning in a shift, whose slip has no velocity",
                    "let it roll, or take friction.law = \"coulomb\"", "friction.law");
  if (problem.third_body.thickness > 0)
    throw CaseError("friction that falls with slip has no steady answer on an elastic third-body layer: it would jump",
                    "leave out third_body.thickness, or take friction.law = \"coulomb\"", "third_body.thickness");
  const double bound = *std::max_element(problem.traction_bound.begin(), problem.traction_bound.end()),
               fall = -friction_share(problem.falling, {}).by_slip_velocity,
               steepness = bound * fall * problem.speed * largest;
  const bool steady = problem.kind == RollingKind::steady;
  if (!(steepness < 1))
    throw CaseError(
        fmt::format("friction falls too steeply with slip: below a half-value velocity of {:.3g} m/s {} here",
                    problem.falling.half_velocity * steepness,
                    steady ? "steady rolling has several answers" : "massless surfaces jump from step to step"),
        steady ? "raise friction.half_velocity or friction.kinetic_coefficient, or lower drive.speed"
               : "raise friction.half_velocity or friction.kinetic_coefficient, lower drive.speed, take larger cells, "
                 "or ask for steady rolling, which bears a steeper fall",
        "friction.half_velocity");
}

double VaryingBound::plastic_before(int i, std::size_t k) const {
  if (problem_.kind != RollingKind::steady) return problem_.plastic_before.empty() ? 0.0 : problem_.plastic_before[k];
  return i + 1 < grid_.nx ? plastic_[k + static_cast<std::size_t>(grid_.ny)] : 0.0;
}

void VaryingBound::follow() {
  const double step = step_length(grid_, problem_);
  for (int i = grid_.nx - 1; i >= 0; --i)
    for (int j = 0; j < grid_.ny; ++j) {
      const std::size_t k = grid_.index(i, j);
      const double slip = std::max(0.0, along_[k]), bound = problem_.traction_bound[k];
      const FrictionShare share = friction_share(problem_.falling, {slip * problem_.speed});
      rest_[k] = bound;
      wanted_[k] = share.value * bound;
      by_slip_[k] = slip > 0 ? share.by_slip_velocity * bound * problem_.speed : 0.0;
      if (plastic_.empty()) continue;
      const double before = plastic_before(i, k), length = given_.first_step.empty() ? step : given_.first_step[k];
      const FilmStep film = yield_or_slide(problem_.third_body, bound, before, slip * length);
      rest_[k] = yield_or_slide(problem_.third_body, bound, before, 0).bound;
      wanted_[k] = film.bound;
      by_slip_[k] = film.by_slip * length;
      plastic_[k] = bound > 0 ? film.plastic : before;
      slides_[k] = film.by_slip == 0 && film.plastic > before;
    }
}

void VaryingBound::change() {
  for (std::size_t k = 0; k < change_.size(); ++k) change_[k] = by_slip_[k] * along_[k];
  if (!(problem_.third_body.hardening > 0) || problem_.kind != RollingKind::steady) return;
  for (int j = 0; j < grid_.ny; ++j) {
    double ahead = 0;
    for (int i = grid_.nx - 1; i >= 0; --i) {
      const std::size_t k = grid_.index(i, j);
      if (slides_[k]) ahead = 0;
      if (by_slip_[k] > 0 && along_[k] != 0) ahead = change_[k] += ahead;
    }
  }
}

}  // namespace railstrata
