#include "single_track/cone_program.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <string>

#include "core/faults.hpp"
#include "core/parallel.hpp"

namespace railstrata {
namespace {

/// An element of the cone or its dual: first the bound, then a deviator.
using Vec6 = std::array<double, 6>;
using Matrix6 = std::array<Vec6, 6>;

constexpr int kFree = 2;  // the direction of c among the six

double inner(const Vec6& a, const Vec6& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3] + a[4] * b[4] + a[5] * b[5];
}
/// a^T J b, J = diag(1, -1, ..., -1).
double j_inner(const Vec6& a, const Vec6& b) { return 2 * a[0] * b[0] - inner(a, b); }

/// How far along d one may go from a inside the cone: the least t > 0 with (a + t d)^T J (a + t d) = 0.
double way_to_boundary(const Vec6& a, const Vec6& d) {
  const double c = j_inner(a, a), b = j_inner(a, d), e = j_inner(d, d), root = b * b - e * c;
  if (root < 0) return std::numeric_limits<double>::infinity();
  const double denominator = std::sqrt(root) - b;
  return denominator > 0 ? c / denominator : std::numeric_limits<double>::infinity();
}

/// A sample: its dual and the scaling W = eta (2 v v^T - J) with W z = W^-1 s.
struct Cone {
  Vec6 z, scaling;  ///< scaling: w with w^T J w = 1, W^2 = eta^2 (2 w w^T - J)
  Vec6 correction;  ///< W^-1 of the corrector's right side
  double eta = 1;

  /// With s_, z_ over sqrt(s^T J s), sqrt(z^T J z): w = (s_ + J z_)/(2 gamma), gamma^2 = (1 + s_·z_)/2, and
  /// eta^2 = sqrt(s^T J s/z^T J z).
  void scale(const Vec6& s) {
    const double rs = std::sqrt(std::max(j_inner(s, s), 1e-300)), rz = std::sqrt(std::max(j_inner(z, z), 1e-300));
    const double g = 0.5 / std::sqrt(0.5 * (1 + inner(s, z) / (rs * rz)));
    scaling[0] = g * (s[0] / rs + z[0] / rz);
    for (int a = 1; a < 6; ++a) scaling[a] = g * (s[a] / rs - z[a] / rz);
    eta = std::sqrt(rs / rz);
  }
  /// W^-1 y.
  Vec6 unscaled(const Vec6& y) const {
    const double d = 1 / std::sqrt(2 * (scaling[0] + 1));
    Vec6 jv;
    jv[0] = d * (scaling[0] + 1);
    for (int a = 1; a < 6; ++a) jv[a] = -d * scaling[a];
    const double f = 2 * inner(jv, y);
    Vec6 out;
    out[0] = (f * jv[0] - y[0]) / eta;
    for (int a = 1; a < 6; ++a) out[a] = (f * jv[a] + y[a]) / eta;
    return out;
  }
  /// W^-2 y.
  Vec6 twice_unscaled(const Vec6& y) const {
    const double f = 2 * j_inner(scaling, y), i = 1 / (eta * eta);
    Vec6 out;
    out[0] = i * (f * scaling[0] - y[0]);
    for (int a = 1; a < 6; ++a) out[a] = i * (-f * scaling[a] + y[a]);
    return out;
  }
};

/// Step lengths, and the products that give the gap after the step.
struct Reach {
  double primal = std::numeric_limits<double>::infinity(), dual = primal;
  double s_dz = 0, ds_z = 0, ds_dz = 0;
  void join(const Reach& r) {
    primal = std::min(primal, r.primal);
    dual = std::min(dual, r.dual);
    s_dz += r.s_dz;
    ds_z += r.ds_z;
    ds_dz += r.ds_dz;
  }
};

/// A symmetric positive definite matrix with a band, and its factor L L^T after scaling to a unit diagonal.
class Band {
 public:
  Band(int size, int half) : size_(size), half_(half), a_(static_cast<std::size_t>(size) * (half + 1)) {}
  void clear() { std::fill(a_.begin(), a_.end(), 0.); }
  double& at(int row, int column) { return column_of(column)[row - column]; }  // row >= column

  void factor() {
    scale_.resize(static_cast<std::size_t>(size_));
    for (int j = 0; j < size_; ++j) scale_[j] = column_of(j)[0] > 0 ? 1 / std::sqrt(column_of(j)[0]) : 1;
    for (int j = 0; j < size_; ++j) {
      double* column = column_of(j);
      const int n = std::min(half_, size_ - 1 - j);
      for (int i = 1; i <= n; ++i) column[i] *= scale_[j] * scale_[j + i];
      column[0] = 1 + 1e-11;
    }
    for (int j = 0; j < size_; ++j) {
      double* column = column_of(j);
      const int n = std::min(half_, size_ - 1 - j);
      const double pivot = std::sqrt(std::max(column[0], 1e-13));
      column[0] = pivot;
      for (int i = 1; i <= n; ++i) column[i] /= pivot;
      for (int k = 1; k <= n; ++k) {
        double* other = column_of(j + k);
        const double f = column[k];
        if (f == 0) continue;
        for (int i = k; i <= n; ++i) other[i - k] -= f * column[i];
      }
    }
  }
  std::vector<double> solved(std::vector<double> x) const {
    for (int j = 0; j < size_; ++j) x[j] *= scale_[j];
    for (int j = 0; j < size_; ++j) {
      const double* column = column_of(j);
      const int n = std::min(half_, size_ - 1 - j);
      x[j] /= column[0];
      for (int i = 1; i <= n; ++i) x[j + i] -= column[i] * x[j];
    }
    for (int j = size_ - 1; j >= 0; --j) {
      const double* column = column_of(j);
      const int n = std::min(half_, size_ - 1 - j);
      double sum = x[j];
      for (int i = 1; i <= n; ++i) sum -= column[i] * x[j + i];
      x[j] = sum / column[0];
    }
    for (int j = 0; j < size_; ++j) x[j] *= scale_[j];
    return x;
  }

 private:
  double* column_of(int j) { return a_.data() + static_cast<std::size_t>(j) * (half_ + 1); }
  const double* column_of(int j) const { return a_.data() + static_cast<std::size_t>(j) * (half_ + 1); }
  int size_, half_;
  std::vector<double> a_, scale_;
};

/// With the cone K = {s: s_0 >= |(s_1 … s_5)|}, and A_p dx = (dR, B_p dq + dc_p e_2):
///   min R,  s_pi = (R, u_pi + B_p q + c_p e_2) in K;     max -sum of u_pi·z_pi,  z_pi in K,  sum of A_p^T z_pi = e_R.
/// Both ends meet where s·z = 0. A step linearises s o z = mu e in the scaled variables lambda = W^-1 s = W z
/// [NesterovTodd1998], o the product (a·b, a_0 b_1 + b_0 a_1, …):
///   sum of A_p^T W^-2 A_p dx = sum of A_p^T W^-1 t - e_R,   ds = A_p dx,   dz = W^-1 t - z - W^-2 ds.
/// The predictor has mu = 0 and t = 0; the corrector mu = (gap after the predictor over gap)^3 times the mean of s·z,
/// and lambda o t = mu e - (W^-1 ds) o (W dz) of the predictor.
class InteriorPoint {
 public:
  InteriorPoint(const std::vector<ConePoint>& points, int unknowns, int half_bandwidth);
  ConeSolution solve(double accuracy);

 private:
  struct Local {
    std::vector<Cone> cones;
    Vec6 move{};            ///< (0, B q + c e_2): what is added to each sample
    Matrix6 stiffness{};    ///< sum of W^-2
    Vec6 right{}, z_sum{};  ///< sums of the corrector's right sides and of the duals
    Vec6 step{};            ///< ds, the same for every sample
    double gap = 0;
  };
  struct Direction {
    double radius = 0;
    std::vector<double> q;
  };

  void start();
  void scale_cones();
  void assemble();
  /// M dx = sum of `right` - e_R; leaves the local steps in `step`.
  Direction direction(bool with_right);
  Reach reach_of_predictor();
  void prepare_corrector(double centring);
  Reach reach_of_corrector();
  void move(const Direction& d, double primal, double dual);
  double dual_residual() const;
  Vec6 slack(std::size_t p, std::size_t i) const {
    const Vec5& u = points_[p].path[i];
    const Vec6& m = local_[p].move;
    return {radius_, u[0] + m[1], u[1] + m[2], u[2] + m[3], u[3] + m[4], u[4] + m[5]};
  }
  template <class Kernel>
  void for_points(Kernel&& kernel) {
    for_each(static_cast<std::ptrdiff_t>(points_.size()), kernel, true);
  }
  /// B_p^T of a vector of six, added to a vector of unknowns.
  void add_transposed(std::size_t p, const Vec6& six, std::vector<double>& to) const {
    for (const ShapeTerm& t : points_[p].shapes)
      to[t.unknown] += t.value[0] * six[t.component[0] + 1] + t.value[1] * six[t.component[1] + 1];
  }
  Vec6 shaped(std::size_t p, const std::vector<double>& q) const {
    Vec6 w{};
    for (const ShapeTerm& t : points_[p].shapes)
      for (int j = 0; j < 2; ++j) w[t.component[j] + 1] += t.value[j] * q[t.unknown];
    return w;
  }

  const std::vector<ConePoint>& points_;
  std::vector<Local> local_;
  std::vector<double> q_, border_, border_solved_;
  double radius_ = 0, corner_ = 0, gap_ = 0;
  std::size_t cones_ = 0;
  Band band_;
};

InteriorPoint::InteriorPoint(const std::vector<ConePoint>& points, int unknowns, int half_bandwidth)
    : points_(points),
      local_(points.size()),
      q_(static_cast<std::size_t>(unknowns)),
      border_(q_.size()),
      band_(unknowns, half_bandwidth) {}

void InteriorPoint::start() {
  double largest = 0;
  for (const ConePoint& p : points_)
    for (const Vec5& u : p.path) largest = std::max(largest, norm_squared(u));
  radius_ = 1.2 * std::sqrt(largest);
  double sum = 0;
  for (std::size_t p = 0; p < points_.size(); ++p) {
    local_[p].cones.resize(points_[p].path.size());
    cones_ += points_[p].path.size();
    for (std::size_t i = 0; i < points_[p].path.size(); ++i) {
      const Vec6 s = slack(p, i);
      const double f = 1 / j_inner(s, s);
      for (int a = 0; a < 6; ++a) local_[p].cones[i].z[a] = (a == 0 ? f : -f) * s[a];
      sum += f * s[0];
    }
  }
  for (Local& l : local_)
    for (Cone& c : l.cones)
      for (double& z : c.z) z /= sum;
}

void InteriorPoint::scale_cones() {
  for_points([&](std::ptrdiff_t p) {
    Local& l = local_[p];
    l.stiffness = {};
    l.z_sum = {};
    l.gap = 0;
    for (std::size_t i = 0; i < l.cones.size(); ++i) {
      Cone& c = l.cones[i];
      const Vec6 s = slack(static_cast<std::size_t>(p), i);
      c.scale(s);
      l.gap += inner(s, c.z);
      const double f = 1 / (c.eta * c.eta);
      Vec6 jw = c.scaling;
      for (int a = 1; a < 6; ++a) jw[a] = -jw[a];
      for (int a = 0; a < 6; ++a) {
        const double g = 2 * f * jw[a];
        for (int b = 0; b <= a; ++b) l.stiffness[a][b] += g * jw[b];
        l.stiffness[a][a] += a == 0 ? -f : f;
        l.z_sum[a] += c.z[a];
      }
    }
    for (int a = 0; a < 6; ++a)
      for (int b = a + 1; b < 6; ++b) l.stiffness[a][b] = l.stiffness[b][a];
  });
  gap_ = 0;
  for (const Local& l : local_) gap_ += l.gap;
}

/// The matrix of (q, R) with every c_p eliminated: sum of A_p^T (H - H e_2 e_2^T H/H_22) A_p, H the sum of W^-2 of a
/// point.
void InteriorPoint::assemble() {
  band_.clear();
  std::fill(border_.begin(), border_.end(), 0.);
  corner_ = 0;
  for (std::size_t p = 0; p < points_.size(); ++p) {
    Matrix6 h = local_[p].stiffness;
    for (int a = 0; a < 6; ++a)
      for (int b = 0; b < 6; ++b)
        h[a][b] -= local_[p].stiffness[a][kFree] * local_[p].stiffness[kFree][b] / local_[p].stiffness[kFree][kFree];
    h[kFree] = {};
    corner_ += h[0][0];
    add_transposed(p, h[0], border_);
    const std::vector<ShapeTerm>& shapes = points_[p].shapes;
    for (const ShapeTerm& e : shapes) {
      Vec6 row;
      for (int a = 0; a < 6; ++a)
        row[a] = e.value[0] * h[e.component[0] + 1][a] + e.value[1] * h[e.component[1] + 1][a];
      for (const ShapeTerm& f : shapes)
        if (f.unknown <= e.unknown)
          band_.at(e.unknown, f.unknown) += f.value[0] * row[f.component[0] + 1] + f.value[1] * row[f.component[1] + 1];
    }
  }
  band_.factor();
  border_solved_ = band_.solved(border_);
}

InteriorPoint::Direction InteriorPoint::direction(bool with_right) {
  std::vector<double> right(q_.size());
  double right_radius = -1;
  if (with_right)
    for (std::size_t p = 0; p < points_.size(); ++p) {
      const Local& l = local_[p];
      Vec6 r = l.right;
      const double f = r[kFree] / l.stiffness[kFree][kFree];
      for (int a = 0; a < 6; ++a) r[a] -= f * l.stiffness[a][kFree];
      right_radius += r[0];
      add_transposed(p, r, right);
    }
  Direction d{.radius = 0, .q = with_right ? band_.solved(right) : right};
  double across = right_radius, corner = corner_;
  for (std::size_t i = 0; i < q_.size(); ++i) {
    across -= border_[i] * d.q[i];
    corner -= border_[i] * border_solved_[i];
  }
  d.radius = across / corner;
  for (std::size_t i = 0; i < q_.size(); ++i) d.q[i] -= border_solved_[i] * d.radius;
  for_points([&](std::ptrdiff_t p) {
    Local& l = local_[p];
    l.step = shaped(static_cast<std::size_t>(p), d.q);
    l.step[0] = d.radius;
    l.step[kFree] = 0;
    const double right_free = with_right ? l.right[kFree] : 0;
    l.step[kFree] = (right_free - inner(l.stiffness[kFree], l.step)) / l.stiffness[kFree][kFree];
  });
  return d;
}

/// Adds a step's effect on a sample and its dual to `r`.
void take_step(const Vec6& s, const Vec6& ds, const Vec6& z, const Vec6& dz, Reach& r) {
  r.primal = std::min(r.primal, way_to_boundary(s, ds));
  r.dual = std::min(r.dual, way_to_boundary(z, dz));
  r.s_dz += inner(s, dz);
  r.ds_z += inner(ds, z);
  r.ds_dz += inner(ds, dz);
}

Reach joined(const std::vector<Reach>& parts) {
  Reach all;
  for (const Reach& r : parts) all.join(r);
  return all;
}

/// dz = W^-1 d - W^-2 ds; the predictor has W^-1 d = -z.
Vec6 dual_step(const Cone& c, const Vec6& ds, bool corrected) {
  const Vec6 back = c.twice_unscaled(ds);
  Vec6 dz;
  for (int a = 0; a < 6; ++a) dz[a] = (corrected ? c.correction[a] : 0) - c.z[a] - back[a];
  return dz;
}

Reach InteriorPoint::reach_of_predictor() {
  std::vector<Reach> parts(points_.size());
  for_points([&](std::ptrdiff_t p) {
    const Local& l = local_[p];
    for (std::size_t i = 0; i < l.cones.size(); ++i)
      take_step(slack(static_cast<std::size_t>(p), i), l.step, l.cones[i].z, dual_step(l.cones[i], l.step, false),
                parts[p]);
  });
  return joined(parts);
}

Reach InteriorPoint::reach_of_corrector() {
  std::vector<Reach> parts(points_.size());
  for_points([&](std::ptrdiff_t p) {
    const Local& l = local_[p];
    for (std::size_t i = 0; i < l.cones.size(); ++i)
      take_step(slack(static_cast<std::size_t>(p), i), l.step, l.cones[i].z, dual_step(l.cones[i], l.step, true),
                parts[p]);
  });
  return joined(parts);
}

/// t with lambda o t = centring e - (W^-1 ds) o (W dz) of the predictor; o is the product of the cone's algebra.
void InteriorPoint::prepare_corrector(double centring) {
  for_points([&](std::ptrdiff_t p) {
    Local& l = local_[p];
    l.right = {};
    for (std::size_t i = 0; i < l.cones.size(); ++i) {
      Cone& c = l.cones[i];
      const Vec6 lambda = c.unscaled(slack(static_cast<std::size_t>(p), i)), ds = c.unscaled(l.step);
      Vec6 dz, y, t;
      for (int a = 0; a < 6; ++a) dz[a] = -lambda[a] - ds[a];
      y[0] = centring - inner(ds, dz);
      for (int a = 1; a < 6; ++a) y[a] = -ds[0] * dz[a] - dz[0] * ds[a];
      t[0] = j_inner(lambda, y) / j_inner(lambda, lambda);
      for (int a = 1; a < 6; ++a) t[a] = (y[a] - t[0] * lambda[a]) / lambda[0];
      c.correction = c.unscaled(t);
      for (int a = 0; a < 6; ++a) l.right[a] += c.correction[a];
    }
  });
}

void InteriorPoint::move(const Direction& d, double primal, double dual) {
  for_points([&](std::ptrdiff_t p) {
    Local& l = local_[p];
    for (Cone& c : l.cones) {
      const Vec6 dz = dual_step(c, l.step, true);
      for (int a = 0; a < 6; ++a) c.z[a] += dual * dz[a];
    }
    for (int a = 1; a < 6; ++a) l.move[a] += primal * l.step[a];
  });
  radius_ += primal * d.radius;
  for (std::size_t i = 0; i < q_.size(); ++i) q_[i] += primal * d.q[i];
}

double InteriorPoint::dual_residual() const {
  std::vector<double> sum(q_.size());
  double largest = 0, work = 0;
  for (std::size_t p = 0; p < points_.size(); ++p) {
    add_transposed(p, local_[p].z_sum, sum);
    largest = std::max(largest, std::abs(local_[p].z_sum[kFree]));
    work += local_[p].z_sum[0];
  }
  for (const double v : sum) largest = std::max(largest, std::abs(v));
  return std::max(largest, std::abs(work - 1));
}

ConeSolution InteriorPoint::solve(double accuracy) {
  start();
  ConeSolution out;
  for (;; ++out.iterations) {
    scale_cones();
    out.gap = gap_ / radius_;
    out.residual = dual_residual();
    if (out.gap < accuracy && out.residual < 0.1 * accuracy) break;
    if (out.iterations == 100 || !std::isfinite(out.gap))
      throw NumericalError("shakedown of a single track: no convergence, gap " + std::to_string(out.gap) +
                           ", residual " + std::to_string(out.residual));
    assemble();
    direction(false);
    const Reach predictor = reach_of_predictor();
    const double primal = std::min(1., predictor.primal), dual = std::min(1., predictor.dual);
    const double after = gap_ + primal * predictor.ds_z + dual * predictor.s_dz + primal * dual * predictor.ds_dz;
    prepare_corrector(std::pow(std::clamp(after / gap_, 1e-3, 1.), 3) * gap_ / static_cast<double>(cones_));
    const Direction d = direction(true);
    const Reach reach = reach_of_corrector();
    move(d, std::min(1., 0.98 * reach.primal), std::min(1., 0.98 * reach.dual));
  }
  out.radius = radius_;
  out.unknowns = q_;
  for (const Local& l : local_) {
    out.free.push_back(l.move[kFree]);
    out.work.push_back(l.z_sum[0]);
  }
  return out;
}

}  // namespace

ConeSolution solve_cone_program(const std::vector<ConePoint>& points, int unknowns, int half_bandwidth,
                                double accuracy) {
  assert(!points.empty() && unknowns > 0 && half_bandwidth >= 0);
  return InteriorPoint(points, unknowns, half_bandwidth).solve(accuracy);
}

}  // namespace railstrata
