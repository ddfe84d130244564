#include "bem/normal_problem.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "core/faults.hpp"

namespace railstrata {

namespace {

/// In the patch (the active set) the equation gap + u_n(p) = approach is linear in p; u_n is a symmetric positive
/// definite operator, so conjugate gradients solve it, on the active cells alone. [PolonskyKeer1999] The FFT inverse of
/// the periodic grid, cut to the active cells, preconditions it and keeps the number of iterations nearly independent
/// of the grid. [Vollebregt2014] For a given load F the approach is a multiplier: residuals lose their mean, directions
/// their load. Then cells with p <= 0 leave the set, cells that interpenetrate enter it, until none changes.
class ActiveSetSolver {
 public:
  ActiveSetSolver(const InfluenceOperator& influence, const PatchGrid& grid, const Plane& gap, NormalTarget target,
                  const NormalOptions& options)
      : influence_(influence), grid_(grid), gap_(gap), target_(target), options_(options) {}
  /// Of p cos(turn), u_n/cos(turn) and gap/cos(turn), for which the problem is as without turns.
  void turn_rows(const Plane& turn) {
    for (std::size_t i = 0; i < n_; ++i) cosine_.push_back(std::cos(turn[i % turn.size()]));
  }

  NormalSolution solve(const Plane& start) {
    if (start.empty())
      first_guess();
    else
      p_ = start;
    for (std::size_t i = 0; i < n_; ++i) active_[i] = p_[i] > 0;
    // While cells change, solving further than a hundredth is wasted; few changes: sharper; none: to the end.
    double reduce = 1e-2;
    for (int outer = 0; outer < options_.max_outer; ++outer) {
      const double scale = gap_range();
      if (outer == 0 && !start.empty()) follow(scale);
      const double left = conjugate_gradients(reduce, tolerance_ * scale),
                   close = std::max(tolerance_ * scale, round_off());
      const int changed = update_active_set(close);
      if (changed == 0 && left <= close) return solution();
      reduce = changed == 0 ? 1e-4 : changed < 8 ? 1e-3 : 1e-2;
    }
    throw NumericalError(
        "the normal contact problem did not converge; the gap may be flat, or very rough on the scale of a cell");
  }

 private:
  /// Sharpens the tolerance for a start that is close already.
  void follow(double scale) {
    if (options_.share_of_first >= 1) return;
    product(p_, displacement_);
    ++iterations_;
    const double first = compute_residual() / scale;
    tolerance_ = std::min(tolerance_, std::max(NormalOptions::kRoundOff, options_.share_of_first * first));
  }

  /// Of the displacements that fast transforms give [m]: residuals settle at some 13 epsilon of the largest one, and
  /// directions from such residuals end in 0/0.
  double round_off() const {
    constexpr double kOfLargest = 64 * std::numeric_limits<double>::epsilon();
    return kOfLargest * largest_of(displacement_);
  }

  bool load_given() const { return target_.load.has_value(); }

  /// p ~ sqrt(depth of rigid interpenetration). For a given load the depth is right when u_n is the gap's mirror image:
  /// gap + u_n is the same in every cell of the patch.
  void first_guess() {
    const double lowest = *std::min_element(gap_.begin(), gap_.end());
    if (!load_given()) {
      if (*target_.approach <= lowest)
        throw CaseError("the bodies do not touch at this approach", "increase the approach or the load",
                        "vehicle.approach");
      set_pressure(lowest + 0.5 * (*target_.approach - lowest));
      product(p_, displacement_);
      scale_by(p_, (*target_.approach - lowest) / *std::max_element(displacement_.begin(), displacement_.end()));
      return;
    }
    double level = level_of_a_half_space(lowest);
    for (int i = 0; i < 4; ++i) {
      set_pressure(level);
      scale_by(p_, *target_.load / (sum(p_) * grid_.cell_area()));
      product(p_, displacement_);
      ++iterations_;
      const double slope = displacement_slope();
      if (!(std::abs(slope - 1) > 0.1)) return;
      level = lowest + (level - lowest) * std::clamp(std::pow(slope, 0.6), 0.2,
                                                     5.0);  // ~ level^(-3/2) on a half-space, level^-2 on a mattress
    }
  }

  void set_pressure(double level) {
    for (std::size_t i = 0; i < n_; ++i) p_[i] = std::sqrt(std::max(0.0, level - gap_[i]));
    if (sum(p_) == 0) p_[static_cast<std::size_t>(std::min_element(gap_.begin(), gap_.end()) - gap_.begin())] = 1;
  }

  /// The gap level whose Hertz circle of the same area has an approach of twice the level; its compliance is taken from
  /// that of one cell (a square of side s: 1.122 s/E*).
  double level_of_a_half_space(double lowest) const {
    const double compliance = influence_.of_one_cell(0).nn / (1.122 * std::sqrt(grid_.cell_area()));
    Plane sorted = gap_;
    std::sort(sorted.begin(), sorted.end());
    std::size_t low = std::min<std::size_t>(1, n_ - 1), high = n_ - 1;
    while (high - low > 1) {
      const std::size_t mid = (low + high) / 2;
      const double area = static_cast<double>(mid) * grid_.cell_area(), p0 = 1.5 * *target_.load / area;
      const double approach = p0 * compliance * 0.5 * std::sqrt(area * std::numbers::pi);
      (2 * (sorted[mid] - lowest) < approach ? low : high) = mid;
    }
    return sorted[high];
  }

  /// Slope of -u_n over the gap by least squares, where there is pressure: 1 in the solution, more for too small a
  /// patch.
  double displacement_slope() const {
    double n = 0, gap = 0, u = 0, both = 0, square = 0;
    for (std::size_t i = 0; i < n_; ++i)
      if (p_[i] > 0) {
        n += 1;
        gap += gap_[i];
        u += displacement_[i];
        both += gap_[i] * displacement_[i];
        square += gap_[i] * gap_[i];
      }
    return (gap * u - n * both) / (n * square - gap * gap);
  }

  /// Range of the gap over the active cells, the scale of the tolerance. At least a thousandth of the approach, for a
  /// flat gap.
  double gap_range() const {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t i = 0; i < n_; ++i)
      if (active_[i]) {
        low = std::min(low, gap_[i]);
        high = std::max(high, gap_[i]);
      }
    return std::max(high - low, 1e-3 * std::abs(approach_ - low));
  }

  /// Removes from z the part that would change the load: sum(z) = 0. The correction is M^-1 applied to the multiplier
  /// of the load, M the preconditioner.
  void keep_load(Plane& z) const {
    if (!load_given()) return;
    add_scaled(z, -sum(z) / ones_sum_, ones_);
  }

  void product(const Plane& p, Plane& u) const {
    if (cosine_.empty()) return influence_.normal(p.data(), u.data());
    Plane pressure = p;
    for (std::size_t i = 0; i < n_; ++i) pressure[i] /= cosine_[i];
    influence_.normal(pressure.data(), u.data());
    for (std::size_t i = 0; i < n_; ++i) u[i] /= cosine_[i];
  }

  void precondition(const Plane& r, Plane& z) const {
    influence_.precondition_normal(r.data(), z.data());
    for_cells(n_, [&](std::size_t i) { z[i] = active_[i] ? z[i] : 0.0; });
  }

  /// residual = approach - gap - u_n on the active cells, zero elsewhere. For a given load the approach is the mean of
  /// gap + u_n, which makes the sum of the residual zero. Returns the largest.
  double compute_residual() {
    struct Part {
      double sum = 0, count = 0, largest = 0;
    };
    std::vector<Part> part(pieces_of(n_));
    Part all;
    if (load_given()) {
      for_pieces(n_, 2, [&](std::size_t k, std::size_t begin, std::size_t end) {
        part[k].sum = sum_of(begin, end, [&](std::size_t i) { return active_[i] ? gap_[i] + displacement_[i] : 0.0; });
        part[k].count = sum_of(begin, end, [&](std::size_t i) { return active_[i] ? 1.0 : 0.0; });
      });
      for (const Part& p : part) {
        all.sum += p.sum;
        all.count += p.count;
      }
    }
    approach_ = load_given() ? all.sum / all.count : *target_.approach;
    for_pieces(n_, 2, [&](std::size_t k, std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        residual_[i] = active_[i] ? approach_ - gap_[i] - displacement_[i] : 0.0;
        part[k].largest = std::max(part[k].largest, std::abs(residual_[i]));
      }
    });
    for (const Part& p : part) all.largest = std::max(all.largest, p.largest);
    return all.largest;
  }

  /// Preconditioned conjugate gradients on the active cells; a given load is met from the first iterate on. Returns the
  /// largest residual left, at most the largest of 0.3 floor, `reduce` times the first one and half the round-off.
  double conjugate_gradients(double reduce, double floor) {
    if (load_given()) {
      Plane mask(active_.begin(), active_.end());
      precondition(mask, ones_);
      ones_sum_ = sum(ones_);
      add_scaled(p_, (*target_.load / grid_.cell_area() - sum(p_)) / ones_sum_, ones_);
    }
    product(p_, displacement_);
    ++iterations_;
    double left = compute_residual(), previous = 0;
    const double goal = std::max({0.3 * floor, reduce * left, 0.5 * round_off()});
    std::fill(d_.begin(), d_.end(), 0.0);
    for (int it = 0; it < 200 && left > goal; ++it) {
      precondition(residual_, z_);
      keep_load(z_);
      const double rho = dot(residual_, z_), beta = previous > 0 ? rho / previous : 0.0;
      previous = rho;
      for_cells(n_, [&](std::size_t i) { d_[i] = z_[i] + beta * d_[i]; });
      product(d_, Ad_);
      ++iterations_;
      const double bent = dot(d_, Ad_);
      if (!(rho > 0 && bent > 0)) break;  // what is left is round-off
      const double alpha = rho / bent;
      for_cells(n_, 2, [&](std::size_t i) {
        p_[i] += alpha * d_[i];
        displacement_[i] += alpha * Ad_[i];
      });
      left = compute_residual();
    }
    return left;
  }

  /// Returns how many cells changed; those whose negative pressure is round-off leave the set uncounted.
  int update_active_set(double tolerance) {
    const double p_small = 1e-9 * *std::max_element(p_.begin(), p_.end());
    int changed = 0;
    for (std::size_t i = 0; i < n_; ++i) {
      if (active_[i] && p_[i] <= 0) {
        changed += p_[i] < -p_small;
        active_[i] = 0;
        p_[i] = 0;
      } else if (!active_[i] && approach_ - gap_[i] - displacement_[i] > tolerance) {
        ++changed;
        active_[i] = 1;
      }
    }
    if (std::none_of(active_.begin(), active_.end(), [](unsigned char a) { return a; }))
      throw CaseError("the bodies do not touch", "increase the approach or the load", "vehicle");
    return changed;
  }

  NormalSolution solution() const {
    NormalSolution s;
    s.pressure = p_;
    s.gap.resize(n_);
    for_cells(n_, [&](std::size_t i) { s.gap[i] = active_[i] ? 0.0 : gap_[i] + displacement_[i] - approach_; });
    s.approach = approach_;
    s.load = sum(p_) * grid_.cell_area();
    s.iterations = iterations_;
    s.touches_edge = largest_at_rim(p_, grid_) > 0;
    return s;
  }

  const InfluenceOperator& influence_;
  const PatchGrid& grid_;
  const Plane& gap_;
  NormalTarget target_;
  NormalOptions options_;
  const std::size_t n_ = grid_.size();
  Plane p_ = Plane(n_), displacement_ = p_;  // u_n(p)
  // of the conjugate gradients; ones_: preconditioned indicator of active cells
  Plane residual_ = p_, z_ = p_, d_ = p_, Ad_ = p_, ones_ = p_;
  Mask active_ = Mask(n_);
  Plane cosine_;  // of the rows' turns, in each cell; empty: none
  double tolerance_ = options_.tolerance;
  double approach_ = 0, ones_sum_ = 1;
  int iterations_ = 0;
};

}  // namespace

NormalSolution solve_normal(const InfluenceOperator& influence, const PatchGrid& grid, const Plane& gap,
                            NormalTarget target, const NormalOptions& options, const Plane& start, const Plane& turn) {
  assert(target.load.has_value() != target.approach.has_value());
  if (target.load && !(*target.load > 0))
    throw CaseError("the load must press the bodies together", "give a positive load", "vehicle.wheel_load");
  if (turn.empty()) return ActiveSetSolver(influence, grid, gap, target, options).solve(start);
  const auto scaled = [&](Plane plane, int power) {
    for (std::size_t i = 0; i < plane.size(); ++i) plane[i] *= std::pow(std::cos(turn[i % turn.size()]), power);
    return plane;
  };
  const Plane over_cosine = scaled(gap, -1);
  ActiveSetSolver solver(influence, grid, over_cosine, target, options);
  solver.turn_rows(turn);
  NormalSolution s = solver.solve(scaled(start, 1));
  s.pressure = scaled(std::move(s.pressure), -1);
  s.gap = scaled(std::move(s.gap), 1);
  return s;
}

NormalInverse::NormalInverse(const InfluenceOperator& influence, const Plane& pressure)
    : influence_(influence), active_(pressure.size()) {
  for (std::size_t i = 0; i < active_.size(); ++i) active_[i] = pressure[i] > 0;
}

Plane NormalInverse::of(const Plane& displacement, double left) {
  const auto keep = [&](Plane& plane) { for_cells(plane.size(), [&](std::size_t i) { plane[i] *= active_[i]; }); };
  const auto cut = [&](auto&& product) {
    return [&](const Plane& in, Plane& out) {
      product(in.data(), out.data());
      keep(out);
    };
  };
  Plane wanted = displacement, pressure;
  keep(wanted);
  searched_.solve(cut([&](const double* in, double* out) { influence_.normal(in, out); }),
                  cut([&](const double* in, double* out) { influence_.precondition_normal(in, out); }), wanted,
                  pressure, left);
  return pressure;
}

}  // namespace railstrata
