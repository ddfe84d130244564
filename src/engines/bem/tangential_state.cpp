#include "bem/tangential_state.hpp"

namespace railstrata {
namespace {

/// Of each cell of the patch, beyond what the influence operator has.
Plane flexibility_of_film(const TangentialProblem& problem) {
  Plane out(problem.film.size());
  for (std::size_t k = 0; k < out.size(); ++k)
    if (problem.traction_bound[k] > 0) out[k] = problem.film[k].flexibility() - problem.third_body.flexibility();
  return out;
}

GivenSlip scaled(GivenSlip given, double lateral_share, std::size_t n) {
  if (lateral_share == 1) return given;
  for (std::size_t i = n; i < 2 * n; ++i) {
    given.rigid[i] *= lateral_share;
    given.history[i] *= lateral_share;
  }
  for (Plane* plane : {&given.to_own_place, &given.to_middle_of_step})
    for (double& value : *plane) value *= lateral_share;
  return given;
}

/// Largest eigenvalue [m/Pa] of the displacement by tangential traction, rail minus wheel, where `inside` > 0: that of
/// a traction of one sign over the whole patch. By powers of the operator, from below; the tenth has it to a
/// thousandth.
double largest_tangential_influence(const InfluenceOperator& influence, const Plane& inside) {
  constexpr int kPowers = 10;
  const std::size_t n = inside.size();
  Plane q_x(n), q_y(n);
  for (std::size_t i = 0; i < n; ++i) q_x[i] = q_y[i] = inside[i] > 0 ? 1.0 : 0.0;
  double largest = 0;
  for (int power = 0; power < kPowers; ++power) {
    const double size = std::sqrt(dot(q_x, q_x) + dot(q_y, q_y));
    if (!(size > 0)) return 0;
    scale_by(q_x, 1 / size);
    scale_by(q_y, 1 / size);
    const PlanePair u = influence.tangential(q_x, q_y, influence.nx());
    largest = dot(q_x, u.x) + dot(q_y, u.y);
    for (std::size_t i = 0; i < n; ++i) {
      q_x[i] = inside[i] > 0 ? u.x[i] : 0.0;
      q_y[i] = inside[i] > 0 ? u.y[i] : 0.0;
    }
  }
  return largest;
}

}  // namespace

SlipOperator::SlipOperator(const InfluenceOperator& influence, const PatchGrid& grid, const TangentialProblem& problem,
                           const std::vector<LeadingCell>& leading, const Plane& film)
    : influence_(influence),
      grid_(grid),
      leading_(leading),
      film_(film),
      lateral_share_(problem.lateral_share),
      steady_(problem.kind == RollingKind::steady),
      step_(railstrata::step_length(grid, problem)),
      inverse_step_(1 / step_),
      self_((influence.of_one_cell(0).xx - (steady_ ? influence.of_one_cell(1).xx : 0.0)) / step_),
      n_(grid.size()),
      ahead_(static_cast<std::size_t>(grid.ny)),
      u_(2 * (n_ + ahead_)) {}

void SlipOperator::apply(const double* in) {
  const double* q = in;
  if (lateral_share_ != 1) {
    scaled_.assign(in, in + 2 * n_);
    for (std::size_t i = n_; i < 2 * n_; ++i) scaled_[i] *= lateral_share_;
    q = scaled_.data();
  }
  influence_.tangential(q, q + n_, u_.data(), u_.data() + n_ + ahead_, steady_ ? grid_.nx + 1 : grid_.nx);
  ++products_;
  if (!film_.empty()) add_film(q);
  if (lateral_share_ != 1)
    for (std::size_t i = n_ + ahead_; i < u_.size(); ++i) u_[i] *= lateral_share_;
  extrapolate_at_leading_cells();
}

void SlipOperator::add_film(const double* q) {
  for (std::size_t i = 0; i < n_; ++i) {
    u_[i] += film_[i] * q[i];
    u_[n_ + ahead_ + i] += film_[i] * q[n_ + i];
  }
}

/// L + lambda/(1 - lambda) (L - L ahead) in the first cells: written into the displacement that L takes from the
/// empty cell ahead (steady), or into the cell's own. No other cell reads them.
void SlipOperator::extrapolate_at_leading_cells() {
  for (const LeadingCell& first : leading_)
    for (double* u : {u_.data() + first.index, u_.data() + n_ + ahead_ + first.index}) {
      if (steady_)
        u[ahead_] -= first.weight * (u[0] - 2 * u[ahead_] + u[2 * ahead_]);
      else
        u[0] += first.weight * (u[0] - u[ahead_]);
    }
}

void SlipOperator::weights_of_displacement(const double* of_slip, Plane& out) const {
  out.resize(2 * n_);
  for (const std::size_t half : {std::size_t{0}, n_}) {
    const double* slip = of_slip + half;
    double* u = out.data() + half;
    for (std::size_t i = 0; i < ahead_; ++i) u[i] = inverse_step_ * slip[i];
    for (std::size_t i = ahead_; i < n_; ++i) u[i] = inverse_step_ * (slip[i] - slip[i - ahead_]);
    for (const LeadingCell& first : leading_) {
      const double more = inverse_step_ * first.weight * slip[first.index];
      u[first.index] += more;
      u[first.index + ahead_] -= 2 * more;
      u[first.index + 2 * ahead_] += more;
    }
  }
  if (lateral_share_ != 1)
    for (std::size_t i = n_; i < 2 * n_; ++i) out[i] *= lateral_share_;
}

void SlipOperator::weights_of_traction(const Plane& of_displacement, double* out) {
  influence_.tangential(of_displacement.data(), of_displacement.data() + n_, out, out + n_, grid_.nx);
  ++products_;
  for (std::size_t i = 0; i < film_.size(); ++i) {
    out[i] += film_[i] * of_displacement[i];
    out[n_ + i] += film_[i] * of_displacement[n_ + i];
  }
  if (lateral_share_ != 1)
    for (std::size_t i = n_; i < 2 * n_; ++i) out[i] *= lateral_share_;
}

void SlipOperator::traction_of(const Plane& displacement, double* out) {
  const Plane* u = &displacement;
  if (lateral_share_ != 1) {
    scaled_ = displacement;
    for (std::size_t i = n_; i < 2 * n_; ++i) scaled_[i] /= lateral_share_;
    u = &scaled_;
  }
  influence_.precondition_tangential(u->data(), u->data() + n_, out, out + n_);
  if (lateral_share_ != 1)
    for (std::size_t i = n_; i < 2 * n_; ++i) out[i] /= lateral_share_;
  ++products_;
}

double SlipOperator::largest(const Plane& traction_bound, double film) const {
  // Steady: over L of one cell, across, square cells, that of lateral traction in waves along x of nearly two cells:
  // 1.9 for Poisson's ratio 0, 2.1 for 0.3, 2.25 for 0.5; strips of a line contact 1.415. A film's part
  // of L takes from a cell and the one ahead of it alone: row after row, so that it counts once.
  const double largest = grid_.line ? 1.42 : 2.25;
  return (steady_ ? largest * (influence_.of_one_cell(0).yy - influence_.of_one_cell(1).yy - film) + film
                  : largest_tangential_influence(influence_, traction_bound)) /
         step_;
}

TangentialState::TangentialState(const InfluenceOperator& influence, const PatchGrid& cells,
                                 const TangentialProblem& asked)
    : grid(cells),
      problem(asked),
      n(cells.size()),
      ahead(static_cast<std::size_t>(cells.ny)),
      q(2 * n, 0.0),
      slip(2 * n),
      set(n, kOutside),
      given(scaled(given_slip(cells, asked), asked.lateral_share, n)),
      film_flexibility(flexibility_of_film(asked)),
      L(influence, cells, asked, given.leading, film_flexibility),
      bound(asked.traction_bound.data()),
      creepage{asked.x.creepage, asked.lateral_share * asked.y.creepage} {
  if (!VaryingBound::needed(problem)) return;
  if (problem.falling.falls() || problem.third_body.hardening < 0) {
    const double more =
        film_flexibility.empty() ? 0.0 : *std::max_element(film_flexibility.begin(), film_flexibility.end());
    VaryingBound::require_unique_slip(
        problem, L.step_length(),
        L.largest(problem.traction_bound, problem.third_body.flexibility()) + more / L.step_length());
  }
  varying.emplace(grid, problem, given);
  carried = varying->at_rest();
  bound = carried.data();
}

void TangentialState::adopt(const TangentialSolution& start, bool capped) {
  for (std::size_t i = 0; i < n; ++i) {
    if (set[i] == kOutside) continue;
    const double y = start.q_y[i] / problem.lateral_share, size = magnitude(start.q_x[i], y);
    double g = bound[i];
    const bool slips = start.state[i] == ContactState::slip && size > 0;
    if (varying && slips) carried[i] = g = std::min(g, size);
    const double scale = slips || (capped && size > g) ? g / size : 1.0;
    q[i] = scale * start.q_x[i];
    q[n + i] = scale * y;
    if (slips) set[i] = kSlip;
  }
  if (problem.x.force) creepage[0] = start.creepage_x;
  if (problem.y.force) creepage[1] = problem.lateral_share * start.creepage_y;
}

void TangentialState::update_slip() {
  L.apply(q.data());
  for_both([&](std::size_t i) {
    const bool in_patch = set[i] != kOutside;
    slip[i] = in_patch ? given.rigid[i] + creepage[0] + given.history[i] - L.x(i) : 0.0;
    slip[n + i] = in_patch ? given.rigid[n + i] + creepage[1] + given.history[n + i] - L.y(i) : 0.0;
  });
}

void TangentialState::follow_slip() {
  if (!varying) return;
  Plane& along = varying->along();
  for_both([&](std::size_t i) {
    const double x = q[i], y = q[n + i];
    along[i] = set[i] == kSlip ? (slip[i] * x + lateral_slip(i) * y) / magnitude(x, y) : 0.0;
  });
  varying->follow();
  for_both([&](std::size_t i) {
    if (set[i] == kStick) carried[i] = varying->at_rest(i);
  });
}

void take_over(const TangentialSolution& s, TangentialState& state) {
  for (std::size_t i = 0; i < state.n; ++i) state.set[i] = s.state[i] == ContactState::separated ? kOutside : kStick;
  state.adopt(s, false);
  state.update_slip();
}

}  // namespace railstrata
