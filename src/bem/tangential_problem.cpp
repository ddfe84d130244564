#include "bem/tangential_problem.hpp"

#include <algorithm>
#include <cmath>

#include "bem/gmres.hpp"
#include "core/faults.hpp"

namespace railstrata {

namespace {

constexpr unsigned char kOutside = 0, kStick = 1, kSlip = 2;
constexpr double kCoarse = 0.1;  // of the linear systems, while sets still change

/// Vectors of the Newton system hold the planes x and y one after the other, then one entry for each direction whose force is given.
class Solver {
 public:
  Solver(const InfluenceOperator& influence, const PatchGrid& grid, const TangentialProblem& problem, const TangentialOptions& options)
      : A_(influence), grid_(grid), problem_(problem), options_(options), n_(grid.size()), ahead_(static_cast<std::size_t>(grid.ny)),
        q_(2 * n_, 0.0), slip_(2 * n_), rigid_(2 * n_), normal_(2 * n_, 0.0), diagonal_(n_, 0.0), history_(2 * n_, 0.0),
        set_(n_, kOutside), u_(2 * (n_ + ahead_)) {
    if (problem.x.force) directions_.push_back(0);
    if (problem.y.force) directions_.push_back(1);
    creepage_[0] = problem.x.creepage;
    creepage_[1] = problem.y.creepage;
    self_ = (influence.of_one_cell(0).xx - (steady() ? influence.of_one_cell(1).xx : 0.0)) / step_length();
    force_row_ = self_ / static_cast<double>(n_);  // a force residual weighs like a slip residual
    fill_fixed_slip();
  }

  TangentialSolution solve(const TangentialSolution* start) {
    for (std::size_t i = 0; i < n_; ++i) set_[i] = problem_.bound[i] > 0 ? kStick : kOutside;
    check_forces();
    if (start) adopt(*start);
    update_slip();
    if (start && fill_new_cells(*start)) update_slip();
    int changed = update_sets();
    double error = violation();
    for (; error > options_.tolerance && outer_ < options_.max_outer; ++outer_) {
      prepare_slip_cells();
      Plane step;
      newton_step(changed == 0 && outer_ > 0 ? std::clamp(0.3 * options_.tolerance / error, 1e-4, kCoarse) : kCoarse, step);
      advance(step);
      update_slip();
      changed = update_sets();
      error = violation();
    }
    if (error <= options_.tolerance || options_.partial) return solution();
    throw NumericalError("the tangential contact problem did not converge");
  }

 private:
  bool steady() const { return problem_.kind == RollingKind::steady; }
  double step_length() const { return problem_.kind == RollingKind::transient ? problem_.step : problem_.kind == RollingKind::shift ? 1.0 : grid_.dx; }

  void fill_fixed_slip() {
    // The spin's lateral slip is taken a sixth of a step ahead: between the cell and the middle of the step this cancels most of the leading edge's discretisation error.
    const double ahead = problem_.kind == RollingKind::shift ? 0.0 : step_length() / 6;
    for (int i = 0; i < grid_.nx; ++i)
      for (int j = 0; j < grid_.ny; ++j) {
        const std::size_t k = grid_.index(i, j);
        rigid_[k] = -problem_.spin * grid_.y(j) + (problem_.extra_x.empty() ? 0.0 : problem_.extra_x[k]);
        rigid_[n_ + k] = problem_.spin * (grid_.x(i) + ahead) + (problem_.extra_y.empty() ? 0.0 : problem_.extra_y[k]);
        if (!problem_.before_x.empty()) history_[k] = problem_.before_x[k] / step_length();
        if (!problem_.before_y.empty()) history_[n_ + k] = problem_.before_y[k] / step_length();
      }
  }

  void check_forces() {
    available_ = sum(problem_.bound);
    const double available = available_ * grid_.cell_area(), wanted = std::hypot(problem_.x.force.value_or(0), problem_.y.force.value_or(0));
    if (wanted >= available && wanted > 0)
      throw CaseError("friction cannot carry the tangential force: " + std::to_string(wanted) + " N of at most " + std::to_string(available) + " N",
                      "lower the traction or raise the friction coefficient");
  }

  void adopt(const TangentialSolution& start) {
    for (std::size_t i = 0; i < n_; ++i) {
      if (set_[i] == kOutside) continue;
      const double size = std::hypot(start.q_x[i], start.q_y[i]), g = problem_.bound[i];
      const bool slips = start.state[i] == ContactState::slip && size > 0;
      const double scale = slips || size > g ? g / size : 1.0;
      q_[i] = scale * start.q_x[i];
      q_[n_ + i] = scale * start.q_y[i];
      if (slips) set_[i] = kSlip;
    }
    if (problem_.x.force) creepage_[0] = start.creepage_x;
    if (problem_.y.force) creepage_[1] = start.creepage_y;
  }

  /// Cells that have come into contact since: as if alone. Left without traction they would mislead the first Newton step.
  bool fill_new_cells(const TangentialSolution& start) {
    bool any = false;
    for (std::size_t i = 0; i < n_; ++i) {
      const double slip = std::hypot(slip_[i], slip_[n_ + i]);
      if (set_[i] == kOutside || start.state[i] != ContactState::separated || slip == 0) continue;
      const double g = problem_.bound[i], q = std::min(g, slip / self_);
      if (q == g) set_[i] = kSlip;
      q_[i] = q * slip_[i] / slip;
      q_[n_ + i] = q * slip_[n_ + i] / slip;
      any = true;
    }
    return any;
  }

  /// out = L in on the patch.
  void apply_L(const double* in, double* out) {
    const int rows = steady() ? grid_.nx + 1 : grid_.nx;
    double *ux = u_.data(), *uy = ux + n_ + ahead_;
    A_.tangential(in, in + n_, ux, uy, rows);
    ++iterations_;
    const double over = 1 / step_length();
    const std::size_t next = steady() ? ahead_ : 0;
    for_cells(n_, [&](std::size_t i) {
      const bool in_patch = set_[i] != kOutside;
      out[i] = in_patch ? over * (next ? ux[i] - ux[i + next] : ux[i]) : 0.0;
      out[n_ + i] = in_patch ? over * (next ? uy[i] - uy[i + next] : uy[i]) : 0.0;
    });
  }

  void update_slip() {
    apply_L(q_.data(), slip_.data());
    for (std::size_t i = 0; i < n_; ++i) {
      if (set_[i] == kOutside) continue;
      slip_[i] = rigid_[i] + creepage_[0] + history_[i] - slip_[i];
      slip_[n_ + i] = rigid_[n_ + i] + creepage_[1] + history_[n_ + i] - slip_[n_ + i];
    }
  }

  /// What a given force lacks, over the area of a cell.
  double missing_force(int direction) const {
    const std::size_t offset = direction ? n_ : 0;
    const double wanted = direction ? *problem_.y.force : *problem_.x.force;
    return wanted / grid_.cell_area() - ordered_sum_of(n_, [&](std::size_t i) { return q_[offset + i]; });
  }

  /// Unit traction direction and the stabilising diagonal (s·n)/g of slipping cells.
  void prepare_slip_cells() {
    for (std::size_t i = 0; i < n_; ++i) {
      if (set_[i] != kSlip) continue;
      const double g = problem_.bound[i];
      normal_[i] = q_[i] / g;
      normal_[n_ + i] = q_[n_ + i] / g;
      diagonal_[i] = std::max(0.0, slip_[i] * normal_[i] + slip_[n_ + i] * normal_[n_ + i]) / g;
    }
  }

  /// Restricts a pair of planes to the unknowns: all in stick, across the traction in slip, nothing outside.
  void project(double* v) const {
    for_cells(n_, [&](std::size_t i) {
      if (set_[i] == kStick) return;
      if (set_[i] == kOutside) {
        v[i] = v[n_ + i] = 0;
        return;
      }
      const double across = -v[i] * normal_[n_ + i] + v[n_ + i] * normal_[i];
      v[i] = -across * normal_[n_ + i];
      v[n_ + i] = across * normal_[i];
    });
  }

  void newton_step(double accuracy, Plane& step) {
    prepare_border();
    const std::size_t m = directions_.size();
    Plane b(2 * n_ + m);
    std::copy(slip_.begin(), slip_.end(), b.begin());
    project(b.data());
    for (std::size_t c = 0; c < m; ++c) {
      b[2 * n_ + c] = force_row_ * missing_force(directions_[c]);
    }
    gmres([&](const Plane& in, Plane& out) { newton_product(in, out); }, [&](const Plane& in, Plane& out) { precondition(in, out); }, b, step, accuracy, 120);
  }

  void newton_product(const Plane& in, Plane& out) {
    apply_L(in.data(), out.data());
    const std::size_t m = directions_.size();
    for (std::size_t c = 0; c < m; ++c) {
      const std::size_t offset = directions_[c] ? n_ : 0;
      for_cells(n_, [&](std::size_t i) { out[offset + i] -= in[2 * n_ + c]; });
      out[2 * n_ + c] = force_row_ * ordered_sum_of(n_, [&](std::size_t i) { return in[offset + i]; });
    }
    project(out.data());
    for_cells(n_, [&](std::size_t i) {
      if (set_[i] != kSlip) return;
      out[i] += diagonal_[i] * in[i];
      out[n_ + i] += diagonal_[i] * in[n_ + i];
    });
  }

  /// Approximate inverse of the first block.
  void precondition_block(const double* in, double* out) {
    Plane v(in, in + 2 * n_);
    if (steady()) integrate_from_leading_edge(v);
    else
      for (double& e : v) e *= step_length();
    for_cells(n_, [&](std::size_t i) {
      if (set_[i] != kStick) v[i] = v[n_ + i] = 0;
    });
    A_.precondition_tangential(v.data(), v.data() + n_, out, out + n_);
    ++iterations_;
    for_cells(n_, [&](std::size_t i) {
      if (set_[i] == kStick) return;
      const double scale = set_[i] == kSlip ? 1 / (self_ + diagonal_[i]) : 0.0;
      out[i] = scale * in[i];
      out[n_ + i] = scale * in[n_ + i];
    });
  }

  /// u(x) from u(x) - u(x + dx) = dx r along each run of sticking cells, zero ahead of it.
  void integrate_from_leading_edge(Plane& v) const {
    constexpr int strip = 64;  // columns
    for_each_if(threads_pay_for_sweep(n_), (grid_.ny + strip - 1) / strip, [&](int s) {
      for (int i = grid_.nx - 1; i >= 0; --i)
        for (int j = s * strip; j < std::min(grid_.ny, (s + 1) * strip); ++j) {
          const std::size_t k = grid_.index(i, j);
          if (set_[k] != kStick) continue;
          const bool continues = i + 1 < grid_.nx && set_[k + ahead_] == kStick;
          for (std::size_t c : {k, n_ + k}) v[c] = grid_.dx * v[c] + (continues ? v[c + ahead_] : 0.0);
        }
    });
  }

  void prepare_border() {
    border_.clear();
    for (int direction : directions_) {
      Plane e(2 * n_, 0.0), z(2 * n_);
      std::fill(e.begin() + static_cast<std::ptrdiff_t>(direction ? n_ : 0), e.begin() + static_cast<std::ptrdiff_t>(direction ? 2 * n_ : n_), 1.0);
      project(e.data());
      precondition_block(e.data(), z.data());
      border_.push_back(std::move(z));
    }
  }

  void precondition(const Plane& in, Plane& out) {
    out.resize(in.size());
    precondition_block(in.data(), out.data());
    const std::size_t m = directions_.size();
    if (m == 0) return;
    const auto total = [&](const double* v, int direction) { return ordered_sum_of(n_, [&](std::size_t i) { return v[(direction ? n_ : 0) + i]; }); };
    double a[2][2] = {{1, 0}, {0, 1}}, r[2] = {0, 0};
    for (std::size_t c = 0; c < m; ++c) {
      r[c] = in[2 * n_ + c] / force_row_ - total(out.data(), directions_[c]);
      for (std::size_t d = 0; d < m; ++d) a[c][d] = total(border_[d].data(), directions_[c]);
    }
    const double det = a[0][0] * a[1][1] - a[0][1] * a[1][0];
    const double creep[2] = {(a[1][1] * r[0] - a[0][1] * r[1]) / det, (a[0][0] * r[1] - a[1][0] * r[0]) / det};
    for (std::size_t c = 0; c < m; ++c) {
      for_cells(2 * n_, [&](std::size_t i) { out[i] += creep[c] * border_[c][i]; });
      out[2 * n_ + c] = creep[c];
    }
  }

  void advance(const Plane& step) {
    for (std::size_t c = 0; c < directions_.size(); ++c) creepage_[directions_[c]] += step[2 * n_ + c];
    for (std::size_t i = 0; i < n_; ++i) {
      if (set_[i] == kOutside) continue;
      q_[i] += step[i];
      q_[n_ + i] += step[n_ + i];
      const double size = std::hypot(q_[i], q_[n_ + i]), g = problem_.bound[i];
      if (set_[i] == kSlip || size > g) {
        if (set_[i] == kStick) pending_.push_back(i);
        q_[i] *= g / size;
        q_[n_ + i] *= g / size;
      }
    }
  }

  int update_sets() {
    const int to_slip = static_cast<int>(pending_.size());
    int to_stick = 0;
    for (std::size_t i = 0; i < n_; ++i) {
      if (set_[i] != kSlip) continue;
      if (slip_[i] * q_[i] + slip_[n_ + i] * q_[n_ + i] < -1e-9 * scale_ * problem_.bound[i]) {
        set_[i] = kStick;
        ++to_stick;
      }
    }
    for (std::size_t i : pending_) set_[i] = kSlip;
    pending_.clear();
    return to_slip + to_stick;
  }

  /// Largest violation of the slip conditions and of the given forces, as TangentialOptions::tolerance counts it.
  double violation() {
    double worst = 0, largest = 0, force = 0;
    for (std::size_t i = 0; i < n_; ++i) {
      if (set_[i] == kOutside) continue;
      largest = std::max({largest, std::hypot(rigid_[i] + creepage_[0], rigid_[n_ + i] + creepage_[1]), 0.01 * std::hypot(history_[i], history_[n_ + i])});
      const double g = problem_.bound[i];
      const double wrong = set_[i] == kStick ? std::hypot(slip_[i], slip_[n_ + i]) : std::abs(slip_[i] * q_[n_ + i] - slip_[n_ + i] * q_[i]) / g;
      worst = std::max(worst, wrong);
    }
    for (int direction : directions_) force = std::max(force, std::abs(missing_force(direction)));
    scale_ = largest;
    return std::max(worst > 0 ? worst / largest : 0.0, force > 0 ? force / available_ : 0.0);
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
          s.slip_y[k] = slip_[n_ + k];
        }
        s.dissipation += (q_[k] * s.slip_x[k] + q_[n_ + k] * s.slip_y[k]) * dA;
        s.moment += (grid_.x(i) * q_[n_ + k] - grid_.y(j) * q_[k]) * dA;
      }
    s.force_x = sum(s.q_x) * dA;
    s.force_y = sum(s.q_y) * dA;
    s.outer_iterations = outer_;
    s.iterations = iterations_;
    return s;
  }

  const InfluenceOperator& A_;
  const PatchGrid& grid_;
  const TangentialProblem& problem_;
  TangentialOptions options_;
  std::size_t n_, ahead_;
  Plane q_, slip_, rigid_, normal_, diagonal_, history_;
  Mask set_;
  Plane u_;
  std::vector<Plane> border_;
  std::vector<int> directions_;  // 0 x, 1 y: those whose force is given
  std::vector<std::size_t> pending_;
  double creepage_[2] = {0, 0};
  double scale_ = 0;          // largest rigid slip
  double available_ = 0;      // friction over the area of a cell
  double self_ = 0;           // L of one cell on itself
  double force_row_ = 1;
  int outer_ = 0, iterations_ = 0;
};

}  // namespace

TangentialSolution solve_tangential(const InfluenceOperator& influence, const PatchGrid& grid, const TangentialProblem& problem, const TangentialOptions& options, const TangentialSolution* start) {
  return Solver(influence, grid, problem, options).solve(start);
}

void roll_on_one_cell(const InfluenceOperator& influence, const PatchGrid& grid, const TangentialSolution& before, TangentialProblem& problem) {
  const std::size_t n = grid.size(), row = static_cast<std::size_t>(grid.ny);
  Plane ux(n + row), uy(n + row);
  influence.tangential(before.q_x.data(), before.q_y.data(), ux.data(), uy.data(), grid.nx + 1);
  problem.kind = RollingKind::transient;
  problem.step = grid.dx;
  problem.before_x.assign(ux.begin() + static_cast<std::ptrdiff_t>(row), ux.end());
  problem.before_y.assign(uy.begin() + static_cast<std::ptrdiff_t>(row), uy.end());
}

void shift_on(const InfluenceOperator& influence, const PatchGrid& grid, const TangentialSolution& before, TangentialProblem& problem) {
  problem.kind = RollingKind::shift;
  problem.before_x.resize(grid.size());
  problem.before_y.resize(grid.size());
  influence.tangential(before.q_x.data(), before.q_y.data(), problem.before_x.data(), problem.before_y.data(), grid.nx);
}

}  // namespace railstrata
