#include "bem/varying_bound.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/faults.hpp"

namespace railstrata {

namespace {

const char* several_answers(const TangentialProblem& problem) {
  return problem.kind == RollingKind::steady ? "steady rolling has several answers"
                                             : "massless surfaces jump from step to step";
}

[[noreturn]] void refuse_fall(const TangentialProblem& problem, double steepness) {
  const bool steady = problem.kind == RollingKind::steady;
  throw CaseError(fmt::format("friction falls too steeply with slip: below a half-value velocity of {:.3g} m/s {} here",
                              problem.falling.half_velocity * steepness, several_answers(problem)),
                  steady ? "raise friction.half_velocity or friction.kinetic_coefficient, or lower drive.speed"
                         : "raise friction.half_velocity or friction.kinetic_coefficient, lower drive.speed, use "
                           "larger cells, or compute steady rolling, which allows a steeper fall",
                  "friction.half_velocity");
}

/// Names the memory distance that would do.
template <class Steepness>
[[noreturn]] void refuse_memory(const TangentialProblem& problem, Steepness&& steepness) {
  constexpr double kFiner = 1.02, kLargest = 1;  // m
  FallingFriction law = problem.falling;
  while (!(steepness(law) < 1) && law.memory_distance < kLargest) law.memory_distance *= kFiner;
  const bool film = problem.third_body.thickness > 0;
  throw CaseError(fmt::format("friction falls too soon with slip: below a memory distance of {:.3g} um {} here{}",
                              1e6 * law.memory_distance, several_answers(problem),
                              film ? ", because the film springs back as friction falls" : ""),
                  film ? "raise friction.memory_distance, friction.half_velocity or friction.kinetic_coefficient, or "
                         "use a stiffer film"
                       : "raise friction.memory_distance, friction.half_velocity or friction.kinetic_coefficient",
                  "friction.memory_distance");
}

void require_unique_film(const TangentialProblem& problem, double step, double largest) {
  const double softening = -problem.third_body.hardening;
  if (!problem.third_body.yields() || softening * step * largest < 1) return;
  throw CaseError(fmt::format("the film softens too fast: beyond {:.3g} MPa/mm {} here", -1e-9 / (step * largest),
                              several_answers(problem)),
                  "use slower softening, a stiffer film or smaller cells", "third_body.hardening");
}

/// The part of a first cell's step that lies inside the patch: the edge is S ahead of the empty cell, with lambda =
/// S^1.5/((S + dx)^1.5 - S^1.5) (leading_edge.hpp); `length` is (1 - lambda) dx.
double inside_of_patch(double length, double step) {
  const double lambda = 1 - length / step;
  if (!(lambda > 0)) return length;
  return step * std::max(0.0, 1 - 1 / (std::cbrt(std::pow(1 + 1 / lambda, 2)) - 1));
}

}  // namespace

VaryingBound::VaryingBound(const PatchGrid& grid, const TangentialProblem& problem, const GivenSlip& given)
    : grid_(grid), problem_(problem), given_(given) {
  if (problem.third_body.yields()) {
    plastic_.assign(grid.size(), 0.0);
    yields_.assign(grid.size(), 0);
    taken_over_.assign(grid.size(), 0);
  }
  if (problem.falling.remembers()) lost_ = kept_ = Plane(grid.size(), 0.0);
  follow();
}

void VaryingBound::require_unique_slip(const TangentialProblem& problem, double step, double largest) {
  require_unique_film(problem, step, largest);
  if (!problem.falling.falls() || problem.traction_bound.empty()) return;
  if (problem.kind == RollingKind::shift)
    throw CaseError("friction that falls with slip velocity has no meaning in a shift, whose slip has no velocity",
                    "use transient.kind = \"rolling\", or friction.law = \"coulomb\"", "friction.law");
  const double bound = *std::max_element(problem.traction_bound.begin(), problem.traction_bound.end()),
               reach = bound * problem.speed * largest;
  const auto steepness = [&](const FallingFriction& law) { return reach * steepest_fall(law, step / problem.speed); };
  if (const double steep = steepness(problem.falling); !(steep < 1)) {
    if (problem.falling.remembers()) refuse_memory(problem, steepness);
    refuse_fall(problem, steep);
  }
}

double VaryingBound::before(const Plane& now, const Plane& history, std::size_t k) const {
  if (problem_.kind != RollingKind::steady) return history.empty() ? 0.0 : history[k];
  const std::size_t ahead = k + static_cast<std::size_t>(grid_.ny);
  return ahead < now.size() ? now[ahead] : 0.0;
}

FilmStep VaryingBound::follow_film(std::size_t k, double length) {
  const double at_rest = rest_[k], plastic = before(plastic_, problem_.plastic_before, k);
  const ThirdBody& law = problem_.film.empty() ? problem_.third_body : problem_.film[k];
  const FilmStep film = yield_or_slide(law, at_rest, plastic, std::max(0.0, along_[k]) * length);
  rest_[k] = yield_or_slide(law, at_rest, plastic, 0).bound;
  plastic_[k] = problem_.traction_bound[k] > 0 ? film.plastic : plastic;
  yields_[k] = !film.slides;
  taken_over_[k] = film.slides && film.plastic > plastic;
  return {film.bound, film.by_slip, film.plastic - plastic, film.slides};
}

void VaryingBound::follow_cell(std::size_t k, double length, double inside) {
  const double bound = problem_.traction_bound[k], V = problem_.speed, time = inside / V,
               lost = lost_.empty() ? 0.0 : before(lost_, problem_.lost_before, k);
  const FallingFriction& law = problem_.falling;
  const RememberedShare at_rest = remembered_share(law, lost, 0, time);
  rest_[k] = at_rest.share.value * bound;
  const FilmStep film = plastic_.empty() ? FilmStep{rest_[k], 0, 0, true} : follow_film(k, length);
  const double slip = film.slides ? std::max(0.0, along_[k] - film.plastic / length) : 0.0;
  const RememberedShare now = slip > 0 ? remembered_share(law, lost, slip * V, time) : at_rest;
  wanted_[k] = film.slides ? now.share.value * bound : film.bound;
  by_slip_[k] = film.slides ? (slip > 0 ? now.share.by_slip_velocity * bound * V : 0.0) : film.by_slip * length;
  if (lost_.empty()) return;
  lost_[k] = bound > 0 ? now.lost() : 0.0;
  kept_[k] = now.by_lost_before;
}

void VaryingBound::follow() {
  const double step = step_length(grid_, problem_);
  const bool film = problem_.third_body.thickness > 0;  // weights of first cells then are shares of the step
  for (std::size_t k = grid_.size(); k-- > 0;) {        // from the leading edge on
    const double length = given_.first_step.empty() ? step : given_.first_step[k];
    follow_cell(k, length, film ? length : inside_of_patch(length, step));
  }
}

void VaryingBound::change() {
  for (std::size_t k = 0; k < change_.size(); ++k) change_[k] = by_slip_[k] * along_[k];
  if (problem_.kind != RollingKind::steady) return;
  if (problem_.third_body.hardening != 0) change_of_film();
  if (!lost_.empty()) change_of_memory();
}

void VaryingBound::change_of_film() {
  for (int j = 0; j < grid_.ny; ++j) {
    double ahead = 0;
    for (int i = grid_.nx - 1; i >= 0; --i) {
      const std::size_t k = grid_.index(i, j);
      if (taken_over_[k]) ahead = 0;
      if (yields_[k] && by_slip_[k] != 0 && along_[k] != 0) ahead = change_[k] += ahead;
    }
  }
}

void VaryingBound::change_of_memory() {
  for (int j = 0; j < grid_.ny; ++j) {
    double ahead = 0;  // of the share
    for (int i = grid_.nx - 1; i >= 0; --i) {
      const std::size_t k = grid_.index(i, j);
      const double bound = problem_.traction_bound[k];
      ahead *= kept_[k];
      if (!yields_.empty() && yields_[k]) continue;
      change_[k] += ahead * bound;
      ahead = bound > 0 ? change_[k] / bound : 0.0;
    }
  }
}

}  // namespace railstrata
