#include "bem/newton_step.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace railstrata {
NewtonStep::NewtonStep(TangentialState& state)
    : s_(state),
      normal_(2 * state.n, 0.0),
      diagonal_(state.n, 0.0),
      integral_(2 * state.n),
      slowed_(2 * state.n),
      force_row_(state.L.self() / static_cast<double>(state.n)) {
  if (state.problem.x.force) directions_.push_back(0);
  if (state.problem.y.force) directions_.push_back(1);
}

void NewtonStep::take(double accuracy, double close) {
  prepare_slip_cells();
  solve(accuracy, close);
  advance();
}

/// |q| of a slipping cell after the step along its normal; a step too far would turn the traction round.
double NewtonStep::next_carried(std::size_t i) const {
  const double along = step_[i] * normal_[i] + step_[s_.n + i] * normal_[s_.n + i];
  return std::clamp(s_.carried[i] + along, 0.5 * s_.carried[i], s_.problem.traction_bound[i]);
}

/// Prepares the change of every slipping cell's bound by the slip (x, y)(i) of all cells.
template <class Slip>
void NewtonStep::change_bound(Slip&& slip) {
  Plane& along = s_.varying->along();
  s_.for_both([&](std::size_t i) {
    const auto [x, y] = s_.set[i] == kSlip ? slip(i) : std::pair(0.0, 0.0);
    along[i] = x * normal_[i] + y * normal_[s_.n + i];
  });
  s_.varying->change();
}

/// Adds the row along the normal of a slipping cell, after change_bound by L dq - dxi; out has the row across alone.
void NewtonStep::add_row_along(std::size_t i, const Plane& in, Plane& out) const {
  const double x = normal_[i], y = normal_[s_.n + i], size = in[i] * x + in[s_.n + i] * y,
               row = s_.L.self() * (size + s_.varying->change(i)) - diagonal_[i] * size;
  out[i] += row * x;
  out[s_.n + i] += row * y;
}

/// Unit traction direction and the stabilising diagonal (s·n)/g of slipping cells.
void NewtonStep::prepare_slip_cells() {
  s_.for_both([&](std::size_t i) {
    if (s_.set[i] != kSlip) return;
    const double g = s_.bound[i];
    normal_[i] = s_.q[i] / g;
    normal_[s_.n + i] = s_.q[s_.n + i] / g;
    diagonal_[i] = std::max(0.0, s_.slip[i] * normal_[i] + s_.lateral_slip(i) * normal_[s_.n + i]) / g;
  });
}

/// Restricts a value of cell i to the unknowns: all in stick, across the traction in slip, nothing outside.
void NewtonStep::project(std::size_t i, double& x, double& y) const {
  if (s_.set[i] == kStick) return;
  if (s_.set[i] == kOutside) {
    x = y = 0;
    return;
  }
  const double across = -x * normal_[s_.n + i] + y * normal_[i];
  x = -across * normal_[s_.n + i];
  y = across * normal_[i];
}

/// A dq = s in the unknowns of each cell, with the row of each given force scaled like a row of slip.
void NewtonStep::solve(double accuracy, double close) {
  prepare_border();
  const std::size_t m = directions_.size();
  right_side_.resize(2 * s_.n + m);
  s_.for_both([&](std::size_t i) {
    right_side_[i] = s_.slip[i];
    right_side_[s_.n + i] = s_.lateral_slip(i);
    project(i, right_side_[i], right_side_[s_.n + i]);
    if (!s_.varying || s_.set[i] != kSlip) return;
    const double missing = s_.L.self() * (s_.varying->wanted(i) - s_.carried[i]);
    right_side_[i] += missing * normal_[i];
    right_side_[s_.n + i] += missing * normal_[s_.n + i];
  });
  for (std::size_t c = 0; c < m; ++c) right_side_[2 * s_.n + c] = force_row_ * s_.missing_force(directions_[c]);
  gmres([&](const Plane& in, Plane& out) { product(in, out); },
        [&](const Plane& in, Plane& out) { precondition(in, out); }, right_side_, step_, accuracy, 120, space_, close);
}

/// TangentialState::lateral_slip by the slip.
void NewtonStep::prepare_steer() {
  steer_.assign(2 * s_.n, 0.0);
  if (s_.given.to_own_place.empty()) return;
  s_.for_both([&](std::size_t i) {
    const double change = s_.given.to_own_place[i], size = magnitude(s_.slip[i], s_.slip[s_.n + i]);
    if (s_.set[i] != kSlip || change == 0 || size == 0 || size >= 9 * std::abs(change)) return;
    steer_[i] = std::copysign(s_.slip[i] / (9 * size), change * s_.slip[i]);
    steer_[s_.n + i] = std::copysign(s_.slip[s_.n + i] / (9 * size), change * s_.slip[s_.n + i]);
  });
}

void NewtonStep::linearise() {
  prepare_slip_cells();
  prepare_steer();
  prepare_border();
}

Plane NewtonStep::right_side_of(const Plane& sum) const {
  Plane out = sum;
  s_.for_both([&](std::size_t i) { project(i, out[i], out[s_.n + i]); });
  for (std::size_t c = 2 * s_.n; c < sum.size(); ++c) out[c] *= force_row_;
  return out;
}

double NewtonStep::length_of(const Plane& sum) const {
  const Plane side = right_side_of(sum);
  return std::sqrt(dot(side, side));
}

Plane NewtonStep::adjoint(const Plane& sum, double left) {
  Plane out;
  searched_.solve([&](const Plane& in, Plane& image) { product_transposed(in, image); },
                  [&](const Plane& in, Plane& image) { precondition_transposed(in, image); }, right_side_of(sum), out,
                  left);
  for (std::size_t c = 2 * s_.n; c < out.size(); ++c) out[c] *= force_row_;
  return out;
}

void NewtonStep::weights_of_slip(const Plane& z, Plane& out, Plane& lateral) const {
  out.resize(2 * s_.n);
  lateral.resize(s_.n);
  s_.for_both([&](std::size_t i) {
    double x = z[i], y = z[s_.n + i];
    project(i, x, y);
    lateral[i] = y;
    out[i] = x + (steer_.empty() ? 0.0 : steer_[i] * y);
    out[s_.n + i] = y + (steer_.empty() ? 0.0 : steer_[s_.n + i] * y);
  });
}

/// `product`, transposed; the rows of the creepages weigh like those of tractions.
void NewtonStep::product_transposed(const Plane& in, Plane& out) {
  const std::size_t m = directions_.size(), n = s_.n;
  weights_of_slip(in, weights_, lateral_);
  const Components creep = s_.for_both_summed(weights_.data(), [](std::size_t) {});
  s_.L.weights_of_displacement(weights_.data(), displacement_);
  s_.L.weights_of_traction(displacement_, out.data());
  double force[2] = {0, 0};
  for (std::size_t c = 0; c < m; ++c) {
    force[directions_[c]] = force_row_ * in[2 * n + c];
    out[2 * n + c] = -force_row_ * creep[static_cast<std::size_t>(directions_[c])];
  }
  s_.for_both([&](std::size_t i) {
    out[i] += force[0];
    out[n + i] += force[1];
    project(i, out[i], out[n + i]);
    const double d = s_.set[i] == kSlip ? diagonal_[i] : 0.0;
    out[i] += d * in[i];
    out[n + i] += d * in[n + i];
  });
}

/// `precondition`, transposed.
void NewtonStep::precondition_transposed(const Plane& in, Plane& out) {
  const std::size_t m = directions_.size(), n = s_.n;
  double r[2] = {0, 0}, force[2] = {0, 0}, g[2] = {0, 0};
  for (std::size_t c = 0; c < m; ++c)
    r[c] = in[2 * n + c] / force_row_ + ordered_sum_of(2 * n, [&](std::size_t i) { return border_[c][i] * in[i]; });
  const auto& a = border_force_;
  if (m == 1) g[0] = r[0] / a[0][0];
  if (m == 2) {
    const double det = a[0][0] * a[1][1] - a[0][1] * a[1][0];
    g[0] = (a[1][1] * r[0] - a[1][0] * r[1]) / det;
    g[1] = (a[0][0] * r[1] - a[0][1] * r[0]) / det;
  }
  for (std::size_t c = 0; c < m; ++c) {
    force[directions_[c]] = g[c];
    out[2 * n + c] = g[c] / force_row_;
  }
  s_.for_both([&](std::size_t i) {
    double x = in[i] - force[0], y = in[n + i] - force[1];
    project(i, x, y);
    const double share = s_.set[i] == kSlip ? s_.L.self() / (s_.L.self() + diagonal_[i]) : 1.0;
    slowed_[i] = x * share;
    slowed_[n + i] = y * share;
    integral_[i] = nearly_sticks(i) ? slowed_[i] : 0.0;
    integral_[n + i] = nearly_sticks(i) ? slowed_[n + i] : 0.0;
  });
  s_.L.traction_of(integral_, out.data());
  integral_.assign(out.begin(), out.begin() + static_cast<std::ptrdiff_t>(2 * n));
  integrate_from_trailing_edge(integral_.data(), out.data());
  s_.for_both([&](std::size_t i) {
    if (s_.set[i] == kSlip && !nearly_sticks(i)) {
      out[i] = slowed_[i] / s_.L.self();
      out[n + i] = slowed_[n + i] / s_.L.self();
    }
    project(i, out[i], out[n + i]);
  });
}

/// out = A in: L dq - creepage, projected, plus the diagonal of slip; then the sums of dq for the given forces.
void NewtonStep::product(const Plane& in, Plane& out) {
  s_.L.apply(in.data());
  const std::size_t m = directions_.size();
  double creep[2] = {0, 0};
  for (std::size_t c = 0; c < m; ++c) creep[directions_[c]] = in[2 * s_.n + c];
  if (s_.varying) change_bound([&](std::size_t i) { return std::pair(s_.L.x(i) - creep[0], s_.L.y(i) - creep[1]); });
  const Components force = s_.for_both_summed(in.data(), [&](std::size_t i) {
    double x = s_.L.x(i) - creep[0], y = s_.L.y(i) - creep[1];
    project(i, x, y);
    const double d = s_.set[i] == kSlip ? diagonal_[i] : 0.0;
    out[i] = x + d * in[i];
    out[s_.n + i] = y + d * in[s_.n + i];
    if (s_.varying && s_.set[i] == kSlip) add_row_along(i, in, out);
  });
  for (std::size_t c = 0; c < m; ++c) out[2 * s_.n + c] = force_row_ * force[directions_[c]];
}

/// In steady rolling without VaryingBound: slipping cells whose diagonal is small beside L's are taken as sticking,
/// with the share that the diagonal leaves.
bool NewtonStep::nearly_sticks(std::size_t i) const {
  return s_.set[i] == kStick || (s_.set[i] == kSlip && s_.L.steady() && !s_.varying && diagonal_[i] < s_.L.self());
}

/// Approximate inverse of the first block: u from the slip it makes (steady: summed up from the leading edge), then
/// the traction on the periodic grid that makes u. Other slipping cells than nearly_sticks take their diagonal alone:
/// that sum runs over those only. Returns the sums of the result.
NewtonStep::Components NewtonStep::precondition_block(const double* in, double* out) {
  if (s_.L.steady())
    integrate_from_leading_edge(in);
  else
    s_.for_both([&](std::size_t i) {
      const double step = s_.set[i] == kStick ? s_.L.step_length() : 0.0;
      integral_[i] = step * in[i];
      integral_[s_.n + i] = step * in[s_.n + i];
    });
  s_.L.traction_of(integral_, out);
  return s_.for_both_summed(out, [&](std::size_t i) {
    if (s_.set[i] == kStick) return;
    if (nearly_sticks(i)) {
      project(i, out[i], out[s_.n + i]);
      const double share = s_.L.self() / (s_.L.self() + diagonal_[i]);
      out[i] *= share;
      out[s_.n + i] *= share;
      return;
    }
    const double scale = s_.set[i] == kSlip ? 1 / (s_.L.self() + diagonal_[i]) : 0.0;
    out[i] = scale * in[i];
    out[s_.n + i] = scale * in[s_.n + i];
    if (s_.varying && s_.set[i] == kSlip) {
      const double x = normal_[i], y = normal_[s_.n + i], along = in[i] * x + in[s_.n + i] * y,
                   more = along / (s_.L.self() * (1 + s_.L.self() * s_.varying->by_slip(i))) - scale * along;
      out[i] += more * x;
      out[s_.n + i] += more * y;
    }
  });
}

/// u(x) from u(x) - u(x + dx) = dx r along each run of nearly sticking cells, zero ahead of it and elsewhere.
void NewtonStep::integrate_from_leading_edge(const double* r) {
  constexpr int strip = 32;  // columns
  for_each_if(threads_pay_for_sweep(2 * s_.n), (s_.grid.ny + strip - 1) / strip, [&](int s) {
    for (int i = s_.grid.nx - 1; i >= 0; --i)
      for (int j = s * strip; j < std::min(s_.grid.ny, (s + 1) * strip); ++j) {
        const std::size_t k = s_.grid.index(i, j);
        const bool sticks = nearly_sticks(k), continues = sticks && i + 1 < s_.grid.nx && nearly_sticks(k + s_.ahead);
        for (std::size_t c : {k, s_.n + k})
          integral_[c] = !sticks ? 0.0 : continues ? s_.grid.dx * r[c] + integral_[c + s_.ahead] : first_step(k) * r[c];
      }
  });
}

double NewtonStep::first_step(std::size_t i) const {
  return s_.given.first_step.empty() ? s_.L.step_length() : s_.given.first_step[i];
}

/// Transposed: what a cell's slip adds to the displacements of its run, w of the cell and of those behind it.
void NewtonStep::integrate_from_trailing_edge(const double* w, double* out) const {
  Plane behind(2 * s_.ahead, 0.0);
  for (int i = 0; i < s_.grid.nx; ++i)
    for (int j = 0; j < s_.grid.ny; ++j) {
      const std::size_t k = s_.grid.index(i, j), row = static_cast<std::size_t>(j);
      const bool sticks = nearly_sticks(k), continues = sticks && i + 1 < s_.grid.nx && nearly_sticks(k + s_.ahead);
      for (const auto& [c, sum] : {std::pair(k, &behind[row]), {s_.n + k, &behind[s_.ahead + row]}}) {
        *sum = sticks ? *sum + w[c] : 0.0;
        out[c] = *sum * (continues ? s_.grid.dx : first_step(k));
      }
    }
}

/// The approximate inverse applied to a unit creepage, and its force: column and pivot for eliminating the creepages
/// from the bordered system (`precondition`). Sets change with each Newton step, and so does the border.
void NewtonStep::prepare_border() {
  border_.resize(directions_.size());
  right_side_.resize(2 * s_.n);
  for (std::size_t c = 0; c < directions_.size(); ++c) {
    const double e_x = directions_[c] == 0, e_y = directions_[c] == 1;
    if (s_.varying) change_bound([&](std::size_t) { return std::pair(e_x, e_y); });
    s_.for_both([&](std::size_t i) {
      right_side_[i] = e_x;
      right_side_[s_.n + i] = e_y;
      project(i, right_side_[i], right_side_[s_.n + i]);
      if (!s_.varying || s_.set[i] != kSlip) return;
      const double along = s_.L.self() * s_.varying->change(i);
      right_side_[i] += along * normal_[i];
      right_side_[s_.n + i] += along * normal_[s_.n + i];
    });
    border_[c].resize(2 * s_.n);
    const Components force = precondition_block(right_side_.data(), border_[c].data());
    for (std::size_t d = 0; d < directions_.size(); ++d) border_force_[d][c] = force[directions_[d]];
  }
}

/// Block elimination with the approximate inverse P of the first block: creepages from P's forces (at most a system
/// of two), then the traction they make is added.
void NewtonStep::precondition(const Plane& in, Plane& out) {
  const Components force = precondition_block(in.data(), out.data());
  const std::size_t m = directions_.size();
  double r[2] = {0, 0}, creep[2] = {0, 0};
  for (std::size_t c = 0; c < m; ++c) r[c] = in[2 * s_.n + c] / force_row_ - force[directions_[c]];
  const auto& a = border_force_;
  if (m == 1) creep[0] = r[0] / a[0][0];
  if (m == 2) {
    const double det = a[0][0] * a[1][1] - a[0][1] * a[1][0];
    creep[0] = (a[1][1] * r[0] - a[0][1] * r[1]) / det;
    creep[1] = (a[0][0] * r[1] - a[1][0] * r[0]) / det;
  }
  for (std::size_t c = 0; c < m; ++c) {
    for_cells(2 * s_.n, [&](std::size_t i) { out[i] += creep[c] * border_[c][i]; });
    out[2 * s_.n + c] = creep[c];
  }
}

/// q + dq, brought back to the circle |q| = g where it slips or has left it. A cell that sticks and leaves the circle
/// starts to slip (kLoosened until update_sets counts it).
void NewtonStep::advance() {
  for (std::size_t c = 0; c < directions_.size(); ++c) s_.creepage[directions_[c]] += step_[2 * s_.n + c];
  s_.for_both([&](std::size_t i) {
    if (s_.set[i] == kOutside) return;
    s_.q[i] += step_[i];
    s_.q[s_.n + i] += step_[s_.n + i];
    if (s_.varying && s_.set[i] == kSlip) s_.carried[i] = next_carried(i);
    const double size = magnitude(s_.q[i], s_.q[s_.n + i]), g = s_.bound[i];
    if (s_.set[i] == kSlip || size > g) {
      if (s_.set[i] == kStick) s_.set[i] = kLoosened;
      s_.q[i] *= g / size;
      s_.q[s_.n + i] *= g / size;
    }
  });
}

}  // namespace railstrata
