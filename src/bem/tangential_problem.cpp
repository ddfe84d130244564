#include "bem/tangential_problem.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "bem/cell_slip.hpp"
#include "bem/given_slip.hpp"
#include "bem/gmres.hpp"
#include "bem/largest_influence.hpp"
#include "bem/patch_part.hpp"
#include "bem/varying_bound.hpp"
#include "core/faults.hpp"

namespace railstrata {

namespace {

constexpr unsigned char kOutside = 0, kStick = 1, kSlip = 2,
                        kLoosened = 3;  // loosened: stuck before the Newton step, over the traction bound after it
constexpr double kCoarse = 0.1;         // of the linear systems, while sets still change
constexpr double kClose = 300;          // tolerances: from a continued start with so small an error sets rarely change
constexpr double kSharp = 1e-4;         // of the linear systems, at most

/// Continued from earlier solutions instead of being one (outer_iterations < 0): close to the answer as a rule.
bool is_continued(const TangentialSolution* start) { return start && start->outer_iterations < 0; }

double length(double x, double y) { return std::sqrt(x * x + y * y); }

/// Active sets with Newton's method. [Kalker1990 ch. 4] With n = q/|q|, t across it and the slip
/// s(q, xi) = w(xi) + history - L q, the equations of the sets are
///   stick: s = 0 (two unknowns dq),   slip: |q| = g and s·t = 0 (one unknown: dq along t, then back to the circle),
/// linearised at the last q. Turning q by dq/g turns t as well, so that a slipping cell's row is
///   t·L dq + ((s·n)/g) dq·t = s·t:   the diagonal (s·n)/g >= 0 is what makes slip solvable by itself.
/// Where a force is given its creepage is a further unknown, and the equation sum of dq dA = missing force a further
/// row. Vectors of the Newton system hold the planes x and y one after the other, then one entry for each such
/// direction.
///
/// Where the bound varies with slip (VaryingBound), the size of the traction of a slipping cell is unknown as well:
///   n·dq + g' n·(L dq - dxi) = g(s·n) - |q|,   weighed like a row of slip, with L of a cell on itself.
class Solver {
 public:
  Solver(const InfluenceOperator& influence, const PatchGrid& grid, const TangentialProblem& problem,
         const TangentialOptions& options)
      : A_(influence),
        grid_(grid),
        problem_(problem),
        options_(options),
        n_(grid.size()),
        ahead_(static_cast<std::size_t>(grid.ny)),
        q_(2 * n_, 0.0),
        slip_(2 * n_),
        normal_(2 * n_, 0.0),
        diagonal_(n_, 0.0),
        integral_(2 * n_),
        given_(given_slip(grid, problem)),
        set_(n_, kOutside),
        u_(2 * (n_ + ahead_)),
        inverse_step_(1 / step_length()),
        bound_(problem.traction_bound.data()) {
    if (problem.x.force) directions_.push_back(0);
    if (problem.y.force) directions_.push_back(1);
    creepage_[0] = problem.x.creepage;
    creepage_[1] = problem.y.creepage;
    self_ = (influence.of_one_cell(0).xx - (steady() ? influence.of_one_cell(1).xx : 0.0)) / step_length();
    force_row_ = self_ / static_cast<double>(n_);  // a force residual weighs like a slip residual
    if (!VaryingBound::needed(problem)) return;
    if (problem.falling.falls()) VaryingBound::require_unique_slip(problem, step_length(), largest_slip_by_traction());
    varying_.emplace(grid, problem, given_);
    carried_.resize(n_);
    for (std::size_t i = 0; i < n_; ++i) carried_[i] = varying_->at_rest(i);
    bound_ = carried_.data();
  }

  /// Newton steps until the slip conditions hold. The linear systems are solved roughly while cells change sets, and as
  /// sharply as the error asks for once the sets stand.
  TangentialSolution solve(const TangentialSolution* start) {
    for (std::size_t i = 0; i < n_; ++i) set_[i] = problem_.traction_bound[i] > 0 ? kStick : kOutside;
    check_forces();
    if (start) adopt(*start);
    update_slip();
    if (start && fill_new_cells(*start)) update_slip();
    int changed = update_sets();
    follow_slip();
    double error = violation();
    const bool continued = is_continued(start);
    for (; error > options_.tolerance && outer_ < options_.max_outer; ++outer_) {
      prepare_slip_cells();
      const bool stand = changed == 0 && (outer_ > 0 || (continued && error < kClose * options_.tolerance));
      if (!stand)
        newton_step(kCoarse);
      else if (continued)
        newton_step(kSharp, 0.4 * options_.tolerance * scale_);
      else
        newton_step(std::clamp(0.3 * options_.tolerance / error, kSharp, kCoarse));
      advance();
      update_slip();
      changed = update_sets();
      follow_slip();
      error = violation();
    }
    if (error <= options_.tolerance || options_.partial) return solution();
    if (varying_ && !directions_.empty())
      throw CaseError(
          fmt::format("no steady state was found under the given force: {} may not carry it",
                      problem_.falling.falls() ? "friction that falls with slip" : "a third-body layer that yields"),
          "give drive.creepage instead, which has an answer beyond the largest force too",
          problem_.falling.falls() ? "friction.law" : "third_body.yield_shear");
    throw NumericalError("the tangential contact problem did not converge");
  }

 private:
  bool steady() const { return problem_.kind == RollingKind::steady; }

  /// Largest eigenvalue of L's symmetric part, 1/Pa.
  double largest_slip_by_traction() const {
    // Steady: over L of one cell, across, square cells, that of lateral traction in waves along x of nearly two cells:
    // 1.9 for Poisson's ratio 0, 2.1 for 0.3, 2.25 for 0.5; strips of a line contact 1.415.
    const double largest = grid_.line ? 1.42 : 2.25;
    return (steady() ? largest * (A_.of_one_cell(0).yy - A_.of_one_cell(1).yy)
                     : largest_tangential_influence(A_, problem_.traction_bound)) /
           step_length();
  }
  double step_length() const { return railstrata::step_length(grid_, problem_); }

  void check_forces() {
    available_ = sum(problem_.third_body.hardening > 0 || !varying_ ? problem_.traction_bound : carried_);
    const double available = available_ * grid_.cell_area(),
                 wanted = std::hypot(problem_.x.force.value_or(0), problem_.y.force.value_or(0));
    constexpr double kRoundOff = 1e-12;  // of the sum: a force of all the friction there is has no solution either
    if (wanted >= (1 - kRoundOff) * available && wanted > 0)
      throw CaseError(
          fmt::format("friction cannot carry the tangential force: {:.4g} kN of at most {:.4g} kN", 1e-3 * wanted,
                      1e-3 * available),
          varying_ && problem_.third_body.yields()
              ? "lower the traction or raise the friction coefficient or third_body.yield_shear"
              : "lower the traction or raise the friction coefficient",
          varying_ && problem_.third_body.yields() ? "third_body.yield_shear" : "drive.friction_coefficient");
  }

  /// Takes over the traction of a similar problem. Its traction bound differs: cells that slipped are put on the new
  /// bound, sticking ones at most on it.
  void adopt(const TangentialSolution& start) {
    for (std::size_t i = 0; i < n_; ++i) {
      if (set_[i] == kOutside) continue;
      const double size = length(start.q_x[i], start.q_y[i]);
      double g = bound_[i];
      const bool slips = start.state[i] == ContactState::slip && size > 0;
      if (varying_ && slips) carried_[i] = g = std::min(g, size);
      const double scale = slips || size > g ? g / size : 1.0;
      q_[i] = scale * start.q_x[i];
      q_[n_ + i] = scale * start.q_y[i];
      if (slips) set_[i] = kSlip;
    }
    if (problem_.x.force) creepage_[0] = start.creepage_x;
    if (problem_.y.force) creepage_[1] = start.creepage_y;
  }

  /// Cells that have come into contact since: as if alone. Left without traction they would mislead the first Newton
  /// step.
  bool fill_new_cells(const TangentialSolution& start) {
    bool any = false;
    for (std::size_t i = 0; i < n_; ++i) {
      const double slip = length(slip_[i], slip_[n_ + i]);
      if (set_[i] == kOutside || start.state[i] != ContactState::separated || slip == 0) continue;
      const double g = bound_[i], q = std::min(g, slip / self_);
      if (q == g) set_[i] = kSlip;
      q_[i] = q * slip_[i] / slip;
      q_[n_ + i] = q * slip_[n_ + i] / slip;
      any = true;
    }
    return any;
  }

  /// kernel(i) for every cell; each stands for the values of two planes.
  template <class Kernel>
  void for_both(Kernel&& kernel) const {
    for_cells(n_, kernel, 2);
  }

  /// L in at cell i, after elastic_displacement(in).
  double L_x(std::size_t i) const { return (u_[i] - (steady() ? u_[i + ahead_] : 0.0)) * inverse_step_; }
  double L_y(std::size_t i) const {
    return (u_[n_ + ahead_ + i] - (steady() ? u_[n_ + ahead_ + i + ahead_] : 0.0)) * inverse_step_;
  }
  void elastic_displacement(const double* in) {
    A_.tangential(in, in + n_, u_.data(), u_.data() + n_ + ahead_, steady() ? grid_.nx + 1 : grid_.nx);
    ++iterations_;
    extrapolate_at_leading_cells();
  }

  /// L + lambda/(1 - lambda) (L - L ahead) in the first cells: written into the displacement that L takes from the
  /// empty cell ahead (steady), or into the cell's own. No other cell reads them.
  void extrapolate_at_leading_cells() {
    for (const LeadingCell& first : given_.leading)
      for (double* u : {u_.data() + first.index, u_.data() + n_ + ahead_ + first.index}) {
        if (steady())
          u[ahead_] -= first.weight * (u[0] - 2 * u[ahead_] + u[2 * ahead_]);
        else
          u[0] += first.weight * (u[0] - u[ahead_]);
      }
  }

  void update_slip() {
    elastic_displacement(q_.data());
    for_both([&](std::size_t i) {
      const bool in_patch = set_[i] != kOutside;
      slip_[i] = in_patch ? given_.rigid[i] + creepage_[0] + given_.history[i] - L_x(i) : 0.0;
      slip_[n_ + i] = in_patch ? given_.rigid[n_ + i] + creepage_[1] + given_.history[n_ + i] - L_y(i) : 0.0;
    });
  }

  using Components = std::array<double, 2>;
  /// The same, and the sums of a pair of planes after it.
  template <class Kernel>
  Components for_both_summed(const double* pair, Kernel&& kernel) const {
    std::vector<Components> part(pieces_of(n_));
    for_pieces(
        n_,
        [&](std::size_t k, std::size_t begin, std::size_t end) {
          for (std::size_t i = begin; i < end; ++i) kernel(i);
          part[k] = {sum_of(begin, end, [&](std::size_t i) { return pair[i]; }),
                     sum_of(begin, end, [&](std::size_t i) { return pair[n_ + i]; })};
        },
        2);
    Components total{0, 0};
    for (const Components& p : part) {
      total[0] += p[0];
      total[1] += p[1];
    }
    return total;
  }

  /// What a given force lacks, over the area of a cell.
  double missing_force(int direction) const {
    const double* q = q_.data() + (direction ? n_ : 0);
    return (direction ? *problem_.y.force : *problem_.x.force) / grid_.cell_area() -
           ordered_sum_of(n_, [&](std::size_t i) { return q[i]; });
  }

  /// Lateral slip of a slipping cell at its own place: slip_ has the spin's mean over the step ahead. A small slip is
  /// changed by a ninth of itself at most, so that Newton's method, which does not see the change, still contracts.
  double lateral_slip(std::size_t i) const {
    const double y = slip_[n_ + i];
    if (given_.to_own_place.empty() || set_[i] != kSlip) return y;
    const double change = given_.to_own_place[i];
    return change == 0 ? y : y + change * std::min(1.0, length(slip_[i], y) / (9 * std::abs(change)));
  }

  /// A bound that varies takes the slip along the traction; cells that stick are bound by its value at rest.
  void follow_slip() {
    if (!varying_) return;
    Plane& along = varying_->along();
    for_both([&](std::size_t i) {
      const double x = q_[i], y = q_[n_ + i];
      along[i] = set_[i] == kSlip ? (slip_[i] * x + lateral_slip(i) * y) / length(x, y) : 0.0;
    });
    varying_->follow();
    for_both([&](std::size_t i) {
      if (set_[i] == kStick) carried_[i] = varying_->at_rest(i);
    });
  }

  /// |q| of a slipping cell after the step along its normal; a step too far would turn the traction round.
  double next_carried(std::size_t i) const {
    const double along = step_[i] * normal_[i] + step_[n_ + i] * normal_[n_ + i];
    return std::clamp(carried_[i] + along, 0.5 * carried_[i], problem_.traction_bound[i]);
  }

  /// Prepares the change of every slipping cell's bound by the slip (x, y)(i) of all cells.
  template <class Slip>
  void change_bound(Slip&& slip) {
    Plane& along = varying_->along();
    for_both([&](std::size_t i) {
      const auto [x, y] = set_[i] == kSlip ? slip(i) : std::pair(0.0, 0.0);
      along[i] = x * normal_[i] + y * normal_[n_ + i];
    });
    varying_->change();
  }

  /// Adds the row along the normal of a slipping cell, after change_bound by L dq - dxi; out has the row across alone.
  void add_row_along(std::size_t i, const Plane& in, Plane& out) const {
    const double x = normal_[i], y = normal_[n_ + i], size = in[i] * x + in[n_ + i] * y,
                 row = self_ * (size + varying_->change(i)) - diagonal_[i] * size;
    out[i] += row * x;
    out[n_ + i] += row * y;
  }

  /// Unit traction direction and the stabilising diagonal (s·n)/g of slipping cells.
  void prepare_slip_cells() {
    for_both([&](std::size_t i) {
      if (set_[i] != kSlip) return;
      const double g = bound_[i];
      normal_[i] = q_[i] / g;
      normal_[n_ + i] = q_[n_ + i] / g;
      diagonal_[i] = std::max(0.0, slip_[i] * normal_[i] + lateral_slip(i) * normal_[n_ + i]) / g;
    });
  }

  /// Restricts a value of cell i to the unknowns: all in stick, across the traction in slip, nothing outside.
  void project(std::size_t i, double& x, double& y) const {
    if (set_[i] == kStick) return;
    if (set_[i] == kOutside) {
      x = y = 0;
      return;
    }
    const double across = -x * normal_[n_ + i] + y * normal_[i];
    x = -across * normal_[n_ + i];
    y = across * normal_[i];
  }

  /// A dq = s in the unknowns of each cell, with the row of each given force scaled like a row of slip. close: a slip
  /// that may be left in every cell; 0: `accuracy` alone ends it.
  void newton_step(double accuracy, double close = 0) {
    prepare_border();
    const std::size_t m = directions_.size();
    right_side_.resize(2 * n_ + m);
    for_both([&](std::size_t i) {
      right_side_[i] = slip_[i];
      right_side_[n_ + i] = lateral_slip(i);
      project(i, right_side_[i], right_side_[n_ + i]);
      if (!varying_ || set_[i] != kSlip) return;
      const double missing = self_ * (varying_->wanted(i) - carried_[i]);
      right_side_[i] += missing * normal_[i];
      right_side_[n_ + i] += missing * normal_[n_ + i];
    });
    for (std::size_t c = 0; c < m; ++c) right_side_[2 * n_ + c] = force_row_ * missing_force(directions_[c]);
    gmres([&](const Plane& in, Plane& out) { newton_product(in, out); },
          [&](const Plane& in, Plane& out) { precondition(in, out); }, right_side_, step_, accuracy, 120, space_,
          close);
  }

  /// out = A in: L dq - creepage, projected, plus the diagonal of slip; then the sums of dq for the given forces.
  void newton_product(const Plane& in, Plane& out) {
    elastic_displacement(in.data());
    const std::size_t m = directions_.size();
    double creep[2] = {0, 0};
    for (std::size_t c = 0; c < m; ++c) creep[directions_[c]] = in[2 * n_ + c];
    if (varying_) change_bound([&](std::size_t i) { return std::pair(L_x(i) - creep[0], L_y(i) - creep[1]); });
    const Components force = for_both_summed(in.data(), [&](std::size_t i) {
      double x = L_x(i) - creep[0], y = L_y(i) - creep[1];
      project(i, x, y);
      const double d = set_[i] == kSlip ? diagonal_[i] : 0.0;
      out[i] = x + d * in[i];
      out[n_ + i] = y + d * in[n_ + i];
      if (varying_ && set_[i] == kSlip) add_row_along(i, in, out);
    });
    for (std::size_t c = 0; c < m; ++c) out[2 * n_ + c] = force_row_ * force[directions_[c]];
  }

  /// Approximate inverse of the first block: u from the slip it makes (steady: summed up from the leading edge), then
  /// the traction on the periodic grid that makes u. Slipping cells take their diagonal alone: that sum runs over
  /// sticking cells only. Returns the sums of the result.
  Components precondition_block(const double* in, double* out) {
    if (steady())
      integrate_from_leading_edge(in);
    else
      for_both([&](std::size_t i) {
        const double step = set_[i] == kStick ? step_length() : 0.0;
        integral_[i] = step * in[i];
        integral_[n_ + i] = step * in[n_ + i];
      });
    A_.precondition_tangential(integral_.data(), integral_.data() + n_, out, out + n_);
    ++iterations_;
    return for_both_summed(out, [&](std::size_t i) {
      if (set_[i] == kStick) return;
      const double scale = set_[i] == kSlip ? 1 / (self_ + diagonal_[i]) : 0.0;
      out[i] = scale * in[i];
      out[n_ + i] = scale * in[n_ + i];
      if (varying_ && set_[i] == kSlip) {
        const double x = normal_[i], y = normal_[n_ + i], along = in[i] * x + in[n_ + i] * y,
                     more = along / (self_ * (1 + self_ * varying_->by_slip(i))) - scale * along;
        out[i] += more * x;
        out[n_ + i] += more * y;
      }
    });
  }

  double first_step(std::size_t k) const { return given_.first_step.empty() ? step_length() : given_.first_step[k]; }

  /// u(x) from u(x) - u(x + dx) = dx r along each run of sticking cells, zero ahead of it and elsewhere.
  void integrate_from_leading_edge(const double* r) {
    constexpr int strip = 32;  // columns
    for_each_if(threads_pay_for_sweep(2 * n_), (grid_.ny + strip - 1) / strip, [&](int s) {
      for (int i = grid_.nx - 1; i >= 0; --i)
        for (int j = s * strip; j < std::min(grid_.ny, (s + 1) * strip); ++j) {
          const std::size_t k = grid_.index(i, j);
          const bool sticks = set_[k] == kStick, continues = sticks && i + 1 < grid_.nx && set_[k + ahead_] == kStick;
          for (std::size_t c : {k, n_ + k})
            integral_[c] = !sticks ? 0.0 : continues ? grid_.dx * r[c] + integral_[c + ahead_] : first_step(k) * r[c];
        }
    });
  }

  /// The approximate inverse applied to a unit creepage, and its force: column and pivot for eliminating the creepages
  /// from the bordered system (`precondition`). Sets change with each Newton step, and so does the border.
  void prepare_border() {
    border_.resize(directions_.size());
    right_side_.resize(2 * n_);
    for (std::size_t c = 0; c < directions_.size(); ++c) {
      const double e_x = directions_[c] == 0, e_y = directions_[c] == 1;
      if (varying_) change_bound([&](std::size_t) { return std::pair(e_x, e_y); });
      for_both([&](std::size_t i) {
        right_side_[i] = e_x;
        right_side_[n_ + i] = e_y;
        project(i, right_side_[i], right_side_[n_ + i]);
        if (!varying_ || set_[i] != kSlip) return;
        const double along = self_ * varying_->change(i);
        right_side_[i] += along * normal_[i];
        right_side_[n_ + i] += along * normal_[n_ + i];
      });
      border_[c].resize(2 * n_);
      const Components force = precondition_block(right_side_.data(), border_[c].data());
      for (std::size_t d = 0; d < directions_.size(); ++d) border_force_[d][c] = force[directions_[d]];
    }
  }

  /// Block elimination with the approximate inverse P of the first block: creepages from P's forces (at most a system
  /// of two), then the traction they make is added.
  void precondition(const Plane& in, Plane& out) {
    const Components force = precondition_block(in.data(), out.data());
    const std::size_t m = directions_.size();
    double r[2] = {0, 0}, creep[2] = {0, 0};
    for (std::size_t c = 0; c < m; ++c) r[c] = in[2 * n_ + c] / force_row_ - force[directions_[c]];
    const auto& a = border_force_;
    if (m == 1) creep[0] = r[0] / a[0][0];
    if (m == 2) {
      const double det = a[0][0] * a[1][1] - a[0][1] * a[1][0];
      creep[0] = (a[1][1] * r[0] - a[0][1] * r[1]) / det;
      creep[1] = (a[0][0] * r[1] - a[1][0] * r[0]) / det;
    }
    for (std::size_t c = 0; c < m; ++c) {
      for_cells(2 * n_, [&](std::size_t i) { out[i] += creep[c] * border_[c][i]; });
      out[2 * n_ + c] = creep[c];
    }
  }

  /// q + dq, brought back to the circle |q| = g where it slips or has left it. A cell that sticks and leaves the circle
  /// starts to slip (kLoosened until update_sets counts it).
  void advance() {
    for (std::size_t c = 0; c < directions_.size(); ++c) creepage_[directions_[c]] += step_[2 * n_ + c];
    for_both([&](std::size_t i) {
      if (set_[i] == kOutside) return;
      q_[i] += step_[i];
      q_[n_ + i] += step_[n_ + i];
      if (varying_ && set_[i] == kSlip) carried_[i] = next_carried(i);
      const double size = length(q_[i], q_[n_ + i]), g = bound_[i];
      if (set_[i] == kSlip || size > g) {
        if (set_[i] == kStick) set_[i] = kLoosened;
        q_[i] *= g / size;
        q_[n_ + i] *= g / size;
      }
    });
  }

  /// Cells that exceed the traction bound slip, those that would slip against their traction stick: s·q < 0 would
  /// feed energy in; the threshold is round-off of the largest rigid slip. Returns how many changed.
  int update_sets() {
    return static_cast<int>(ordered_sum_of(n_, [&](std::size_t i) -> double {
      if (set_[i] == kLoosened) {
        set_[i] = kSlip;
        return 1;
      }
      if (set_[i] != kSlip || slip_[i] * q_[i] + slip_[n_ + i] * q_[n_ + i] >= -1e-9 * scale_ * bound_[i]) return 0;
      set_[i] = kStick;
      return 1;
    }));
  }

  /// Largest violation of the slip conditions and of the given forces, as TangentialOptions::tolerance counts it.
  double violation() {
    struct Largest {
      double wrong = 0, rigid = 0;  // squares
    };
    std::vector<Largest> part(pieces_of(n_));
    for_pieces(
        n_,
        [&](std::size_t k, std::size_t begin, std::size_t end) {
          for (std::size_t i = begin; i < end; ++i) {
            if (set_[i] == kOutside) continue;
            const double x = given_.rigid[i] + creepage_[0], y = given_.rigid[n_ + i] + creepage_[1], g = bound_[i];
            const double across = (slip_[i] * q_[n_ + i] - lateral_slip(i) * q_[i]) / g;
            const double against = std::min(0.0, slip_[i] * q_[i] + slip_[n_ + i] * q_[n_ + i]) / g;
            part[k].rigid = std::max(
                {part[k].rigid, x * x + y * y,
                 1e-4 * (given_.history[i] * given_.history[i] + given_.history[n_ + i] * given_.history[n_ + i])});
            part[k].wrong =
                std::max(part[k].wrong, set_[i] == kStick ? slip_[i] * slip_[i] + slip_[n_ + i] * slip_[n_ + i]
                                                          : across * across + against * against);
          }
        },
        2);
    Largest all;
    for (const Largest& p : part) all = {std::max(all.wrong, p.wrong), std::max(all.rigid, p.rigid)};
    scale_ = std::sqrt(all.rigid);
    double force = bound_violation() * available_;
    for (int direction : directions_) force = std::max(force, std::abs(missing_force(direction)));
    return std::max(all.wrong > 0 ? std::sqrt(all.wrong / all.rigid) : 0.0, force > 0 ? force / available_ : 0.0);
  }

  /// Largest deviation of a cell's traction from a bound that varies, over that bound.
  double bound_violation() const {
    double worst = 0;
    if (varying_)
      for (std::size_t i = 0; i < n_; ++i)
        if (set_[i] == kSlip) worst = std::max(worst, std::abs(carried_[i] / varying_->wanted(i) - 1));
    return worst;
  }

  /// With the spin's lateral slip in the middle of the step; after update_slip.
  StepSlip step_slip() const {
    StepSlip out{Plane(n_, 0.0), Plane(n_, 0.0)};
    const bool rolls = problem_.kind != RollingKind::shift;
    for (std::size_t k = 0; k < n_; ++k) {
      const bool leaves = set_[k] == kOutside && rolls && k + ahead_ < n_ && problem_.traction_bound[k + ahead_] > 0;
      if (set_[k] != kSlip && !leaves) continue;
      out.x[k] = leaves ? given_.rigid[k] + creepage_[0] + given_.history[k] - L_x(k) : slip_[k];
      out.y[k] = leaves ? given_.rigid[n_ + k] + creepage_[1] + given_.history[n_ + k] - L_y(k) : slip_[n_ + k];
      if (!given_.to_middle_of_step.empty()) out.y[k] += given_.to_middle_of_step[k % ahead_];
    }
    return out;
  }

  TangentialSolution solution() const {
    TangentialSolution s;
    const auto half = static_cast<std::ptrdiff_t>(n_);
    s.q_x.assign(q_.begin(), q_.begin() + half);
    s.q_y.assign(q_.begin() + half, q_.end());
    s.slip_x.assign(n_, 0.0);
    s.slip_y.assign(n_, 0.0);
    s.state.assign(n_, ContactState::separated);
    s.creepage_x = creepage_[0];
    s.creepage_y = creepage_[1];
    const double dA = grid_.cell_area();
    for (int i = 0; i < grid_.nx; ++i)
      for (int j = 0; j < grid_.ny; ++j) {
        const std::size_t k = grid_.index(i, j);
        if (set_[k] == kOutside) continue;
        s.state[k] = set_[k] == kStick ? ContactState::stick : ContactState::slip;
        (set_[k] == kStick ? s.stick_area : s.slip_area) += dA;
        if (set_[k] == kSlip) {
          s.slip_x[k] = slip_[k];
          s.slip_y[k] = lateral_slip(k);
        }
        s.moment += (grid_.x(i) * q_[n_ + k] - grid_.y(j) * q_[k]) * dA;
      }
    s.force_x = sum(s.q_x) * dA;
    s.force_y = sum(s.q_y) * dA;
    const StepSlip steps = step_slip();
    s.cell_slip = slip_of_cells(grid_, problem_.kind, s.state, steps);
    s.dissipation = dissipated(grid_, problem_.kind, s.q_x, s.q_y, problem_.traction_before, steps);
    if (varying_) {
      s.plastic = varying_->plastic();
      s.lost_friction = varying_->lost();
      s.bound = varying_->at_rest();
    }
    s.outer_iterations = outer_;
    s.iterations = iterations_;
    return s;
  }

  const InfluenceOperator& A_;
  const PatchGrid& grid_;
  const TangentialProblem& problem_;
  TangentialOptions options_;
  std::size_t n_, ahead_;
  Plane q_, slip_;           // unknown traction; its slip
  Plane normal_, diagonal_;  // of slipping cells: unit traction; (s.n)/g
  Plane step_, right_side_, integral_;
  GivenSlip given_;
  std::optional<VaryingBound> varying_;
  Plane carried_;  // with it: the bound of sticking cells, |q| of slipping ones
  Mask set_;
  Plane u_;
  double inverse_step_;
  const double* bound_;  // of each cell: carried_, or the problem's own
  std::vector<Plane> border_;
  std::vector<int> directions_;  // 0 x, 1 y: those whose force is given
  double border_force_[2][2] = {{1, 0}, {0, 1}};
  GmresSpace space_;
  double creepage_[2] = {0, 0};
  double scale_ = 0;      // largest rigid slip
  double available_ = 0;  // friction over the area of a cell
  double self_ = 0;       // L of one cell on itself
  double force_row_ = 1;
  int outer_ = 0, iterations_ = 0;
};

TangentialProblem taken(const PatchPart& part, const TangentialProblem& p) {
  TangentialProblem out = p;
  for (Plane TangentialProblem::*plane : {&TangentialProblem::traction_bound, &TangentialProblem::leading_weight,
                                          &TangentialProblem::plastic_before, &TangentialProblem::lost_before})
    out.*plane = part.take(p.*plane);
  for (PlanePair TangentialProblem::*pair :
       {&TangentialProblem::extra_slip, &TangentialProblem::before, &TangentialProblem::traction_before})
    out.*pair = part.take(p.*pair);
  out.local_spin = part.take_rows(p.local_spin);
  return out;
}

constexpr Plane TangentialSolution::*kSolutionPlanes[] = {
    &TangentialSolution::q_x,    &TangentialSolution::q_y,     &TangentialSolution::slip_x,
    &TangentialSolution::slip_y, &TangentialSolution::plastic, &TangentialSolution::lost_friction,
    &TangentialSolution::bound};

TangentialSolution taken(const PatchPart& part, const TangentialSolution& s) {
  TangentialSolution out = s;
  for (Plane TangentialSolution::*plane : kSolutionPlanes) out.*plane = part.take(s.*plane);
  out.cell_slip = part.take(s.cell_slip);
  out.state = part.take(s.state);
  return out;
}

/// On the whole grid: nothing bears friction outside the part.
TangentialSolution put_back(const PatchPart& part, TangentialSolution s) {
  for (Plane TangentialSolution::*plane : kSolutionPlanes) s.*plane = part.put(s.*plane);
  s.cell_slip = part.put(s.cell_slip);
  s.state = part.put(s.state, ContactState::separated);
  return s;
}

}  // namespace

TangentialSolution solve_tangential(const InfluenceOperator& influence, const PatchGrid& grid,
                                    const TangentialProblem& problem, const TangentialOptions& options,
                                    const TangentialSolution* start) {
  constexpr int kRing = 2;
  const std::optional<PatchPart> part = is_continued(start) ? tight_part_with(grid, problem.traction_bound)
                                                            : part_with(grid, problem.traction_bound, kRing);
  if (!part) return Solver(influence, grid, problem, options).solve(start);
  const std::shared_ptr<const InfluenceOperator> own = influence.part(part->nx, part->ny);
  const TangentialProblem problem_there = taken(*part, problem);
  const std::optional<TangentialSolution> start_there =
      start ? std::optional<TangentialSolution>(taken(*part, *start)) : std::nullopt;
  const PatchGrid grid_there = part->grid();
  return put_back(*part, Solver(*own, grid_there, problem_there, options).solve(start_there ? &*start_there : nullptr));
}

Plane rolled_on(const PatchGrid& grid, const Plane& values) {
  if (values.empty()) return {};
  Plane out(values.begin() + grid.ny, values.end());
  out.resize(values.size(), 0.0);
  return out;
}

void roll_on_one_cell(const InfluenceOperator& influence, const PatchGrid& grid, const TangentialSolution& before,
                      TangentialProblem& problem) {
  const std::size_t n = grid.size(), row = static_cast<std::size_t>(grid.ny);
  Plane ux(n + row), uy(n + row);
  influence.tangential(before.q_x.data(), before.q_y.data(), ux.data(), uy.data(), grid.nx + 1);
  problem.kind = RollingKind::transient;
  problem.step = grid.dx;
  problem.before.x.assign(ux.begin() + static_cast<std::ptrdiff_t>(row), ux.end());
  problem.before.y.assign(uy.begin() + static_cast<std::ptrdiff_t>(row), uy.end());
  problem.plastic_before = rolled_on(grid, before.plastic);
  problem.lost_before = rolled_on(grid, before.lost_friction);
  problem.traction_before = {rolled_on(grid, before.q_x), rolled_on(grid, before.q_y)};
}

void shift_on(const InfluenceOperator& influence, const PatchGrid& grid, const TangentialSolution& before,
              TangentialProblem& problem) {
  problem.kind = RollingKind::shift;
  problem.before.x.resize(grid.size());
  problem.before.y.resize(grid.size());
  influence.tangential(before.q_x.data(), before.q_y.data(), problem.before.x.data(), problem.before.y.data(), grid.nx);
  problem.plastic_before = before.plastic;
}

}  // namespace railstrata
