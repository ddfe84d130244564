#include "bem/normal_problem.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "core/faults.hpp"

namespace railstrata {

namespace {

class ActiveSetSolver {
 public:
  ActiveSetSolver(const InfluenceOperator& influence, const PatchGrid& grid, const Plane& gap, NormalTarget target, const NormalOptions& options)
      : influence_(influence), grid_(grid), gap_(gap), target_(target), options_(options), n_(grid.size()), p_(n_, 0.0), closing_(n_), residual_(n_), z_(n_), d_(n_), Ad_(n_), ones_(n_), active_(n_, 0) {}

  NormalSolution solve(const Plane& start) {
    if (start.empty())
      first_guess();
    else
      p_ = start;
    for (std::size_t i = 0; i < n_; ++i) active_[i] = p_[i] > 0;
    double reduce = 1e-2;
    for (int outer = 0; outer < options_.max_outer; ++outer) {
      const double scale = gap_range();
      const double left = conjugate_gradients(reduce, options_.tolerance * scale);
      const int changed = update_active_set(options_.tolerance * scale);
      if (changed == 0 && left <= options_.tolerance * scale) return solution();
      reduce = changed == 0 ? 1e-4 : changed < 8 ? 1e-3 : 1e-2;
    }
    throw NumericalError("the normal contact problem did not converge; the gap may be flat or wildly rough on the scale of a cell");
  }

 private:
  bool load_given() const { return target_.load.has_value(); }

  /// p ~ sqrt(depth of rigid interpenetration), scaled to the load of a Hertz-like patch of that area.
  void first_guess() {
    const double lowest = *std::min_element(gap_.begin(), gap_.end());
    if (!load_given()) {
      if (*target_.approach <= lowest) throw CaseError("the bodies do not touch at this approach", "increase the approach or the load");
      for (std::size_t i = 0; i < n_; ++i) p_[i] = std::sqrt(std::max(0.0, lowest + 0.5 * (*target_.approach - lowest) - gap_[i]));
      const double per_metre = unit_pressure_closing();
      const double scale = (*target_.approach - lowest) / per_metre;
      for (double& p : p_) p *= scale;
      return;
    }
    Plane sorted = gap_;
    std::sort(sorted.begin(), sorted.end());
    // the level whose sqrt pressure, carrying the load, closes about twice the level (Hertz: approach = 2 x gap at the mean edge)
    std::size_t low = 1, high = n_ - 1;
    while (high - low > 1) {
      const std::size_t mid = (low + high) / 2;
      const double level = sorted[mid], area = static_cast<double>(mid) * grid_.cell_area();
      const double p0 = 1.5 * *target_.load / area;
      const double closes = p0 * centre_closing_of_unit_hertz(area);
      (2 * (level - lowest) < closes ? low : high) = mid;
    }
    const double level = sorted[high];
    for (std::size_t i = 0; i < n_; ++i) p_[i] = std::sqrt(std::max(0.0, level - gap_[i]));
    if (sum(p_) == 0) p_[static_cast<std::size_t>(std::min_element(gap_.begin(), gap_.end()) - gap_.begin())] = 1;
    const double scale = *target_.load / (sum(p_) * grid_.cell_area());
    for (double& p : p_) p *= scale;
  }

  /// Closing at the centre of a circular Hertz patch with p0 = 1 Pa, from the operator's own compliance of one cell.
  double centre_closing_of_unit_hertz(double area) {
    if (cell_closing_ == 0) {
      Plane one(n_, 0.0), u(n_);
      const std::size_t middle = grid_.index(grid_.nx / 2, grid_.ny / 2);
      one[middle] = 1;
      influence_.normal(one.data(), u.data());
      cell_closing_ = u[middle];
    }
    // a square cell of side s: 1.122 s/E* under 1 Pa; a Hertz circle: pi a/(2 E*)
    return cell_closing_ / (1.122 * std::sqrt(grid_.cell_area())) * 0.5 * std::sqrt(area * 3.141592653589793);
  }

  double unit_pressure_closing() {
    influence_.normal(p_.data(), closing_.data());
    return *std::max_element(closing_.begin(), closing_.end());
  }

  double gap_range() const {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t i = 0; i < n_; ++i)
      if (active_[i]) low = std::min(low, gap_[i]), high = std::max(high, gap_[i]);
    return std::max(high - low, 1e-3 * std::abs(approach_ - low));
  }

  /// Removes from z the part that would change the load.
  void keep_load(Plane& z) const {
    if (!load_given()) return;
    const double excess = sum(z) / ones_sum_;
    for (std::size_t i = 0; i < n_; ++i) z[i] -= excess * ones_[i];
  }

  void precondition(const Plane& r, Plane& z) const {
    influence_.precondition_normal(r.data(), z.data());
    for (std::size_t i = 0; i < n_; ++i)
      if (!active_[i]) z[i] = 0;
  }

  void compute_residual() {
    double mean = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < n_; ++i)
      if (active_[i]) mean += gap_[i] + closing_[i], ++count;
    approach_ = load_given() ? mean / static_cast<double>(count) : *target_.approach;
    for (std::size_t i = 0; i < n_; ++i) residual_[i] = active_[i] ? approach_ - gap_[i] - closing_[i] : 0.0;
  }

  double largest_residual() const {
    double r = 0;
    for (double v : residual_) r = std::max(r, std::abs(v));
    return r;
  }

  /// On the active cells. Returns the largest residual left.
  double conjugate_gradients(double reduce, double floor) {
    if (load_given()) {
      Plane mask(active_.begin(), active_.end());
      precondition(mask, ones_);
      ones_sum_ = sum(ones_);
      const double excess = (sum(p_) - *target_.load / grid_.cell_area()) / ones_sum_;
      for (std::size_t i = 0; i < n_; ++i) p_[i] -= excess * ones_[i];
    }
    influence_.normal(p_.data(), closing_.data());
    ++iterations_;
    compute_residual();
    double left = largest_residual(), previous = 0;
    const double goal = std::max(0.3 * floor, reduce * left);
    std::fill(d_.begin(), d_.end(), 0.0);
    for (int it = 0; it < 200 && left > goal; ++it) {
      precondition(residual_, z_);
      keep_load(z_);
      const double rho = dot(residual_, z_), beta = previous > 0 ? rho / previous : 0.0;
      previous = rho;
      for (std::size_t i = 0; i < n_; ++i) d_[i] = z_[i] + beta * d_[i];
      influence_.normal(d_.data(), Ad_.data());
      ++iterations_;
      const double alpha = rho / dot(d_, Ad_);
      for (std::size_t i = 0; i < n_; ++i) p_[i] += alpha * d_[i], closing_[i] += alpha * Ad_[i];
      compute_residual();
      left = largest_residual();
    }
    return left;
  }

  int update_active_set(double tolerance) {
    const double p_small = 1e-9 * *std::max_element(p_.begin(), p_.end());
    int changed = 0;
    for (std::size_t i = 0; i < n_; ++i) {
      if (active_[i] && p_[i] <= 0) {
        changed += p_[i] < -p_small;
        active_[i] = 0;
        p_[i] = 0;
      } else if (!active_[i] && approach_ - gap_[i] - closing_[i] > tolerance) {
        ++changed;
        active_[i] = 1;
      }
    }
    if (std::none_of(active_.begin(), active_.end(), [](unsigned char a) { return a; })) throw CaseError("the bodies do not touch", "increase the approach or the load");
    return changed;
  }

  NormalSolution solution() const {
    NormalSolution s;
    s.pressure = p_;
    s.approach = approach_;
    s.load = sum(p_) * grid_.cell_area();
    s.iterations = iterations_;
    for (int i = 0; i < grid_.nx; ++i)
      for (int j = 0; j < grid_.ny; ++j)
        if ((i == 0 || j == 0 || i == grid_.nx - 1 || j == grid_.ny - 1) && p_[grid_.index(i, j)] > 0) s.touches_edge = true;
    return s;
  }

  const InfluenceOperator& influence_;
  const PatchGrid& grid_;
  const Plane& gap_;
  NormalTarget target_;
  NormalOptions options_;
  std::size_t n_;
  Plane p_, closing_, residual_, z_, d_, Ad_, ones_;
  Mask active_;
  double approach_ = 0, ones_sum_ = 1, cell_closing_ = 0;
  int iterations_ = 0;
};

}  // namespace

NormalSolution solve_normal(const InfluenceOperator& influence, const PatchGrid& grid, const Plane& gap, NormalTarget target, const NormalOptions& options, const Plane& start) {
  assert(target.load.has_value() != target.approach.has_value());
  if (target.load && !(*target.load > 0)) throw CaseError("the load must press the bodies together", "give a positive load");
  return ActiveSetSolver(influence, grid, gap, target, options).solve(start);
}

}  // namespace railstrata
