#pragma once
// Restarted GMRES with a right preconditioner, for operators given as functions. [SaadSchultz1986]
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "bem/plane_algebra.hpp"
#include "core/rotation.hpp"

namespace railstrata {

/// Vectors that later solutions of the same size use again.
struct GmresSpace {
  std::vector<Plane> basis;
  Plane r, z, w, y, left;
  /// The k-th vector of the basis, of n values.
  Plane& vector(std::size_t k, std::size_t n) {
    if (basis.size() <= k) basis.emplace_back();
    basis[k].resize(n);
    return basis[k];
  }
};

/// Takes out of w its parts along basis[0 … count-1] (orthonormal) and adds them to `parts`. Returns |w|² left. Two
/// sweeps: classical Gram–Schmidt.
inline double orthogonalize(const std::vector<Plane>& basis, std::size_t count, Plane& w, std::vector<double>& parts) {
  const std::size_t n = w.size();
  std::vector<double> dots(pieces_of(n) * count), squares(pieces_of(n));
  for_pieces(n, count, [&](std::size_t k, std::size_t begin, std::size_t end) {
    for (std::size_t i = 0; i < count; ++i)
      dots[k * count + i] = sum_of(begin, end, [&](std::size_t j) { return basis[i][j] * w[j]; });
  });
  std::vector<double> h(count, 0.0);
  for (std::size_t k = 0; k < pieces_of(n); ++k)
    for (std::size_t i = 0; i < count; ++i) h[i] += dots[k * count + i];
  for_pieces(n, count, [&](std::size_t k, std::size_t begin, std::size_t end) {
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t j = begin; j < end; ++j) w[j] -= h[i] * basis[i][j];
    squares[k] = sum_of(begin, end, [&](std::size_t j) { return w[j] * w[j]; });
  });
  for (std::size_t i = 0; i < count; ++i) parts[i] += h[i];
  double left = 0;
  for (double s : squares) left += s;
  return left;
}

/// One step of Arnoldi's process, A v_k = sum over i <= k + 1 of h_ik v_i [SaadSchultz1986]: the part of w across
/// basis[0 … k], normalised, becomes basis[k + 1]. Returns column k of the Hessenberg matrix: w in the extended basis.
inline std::vector<double> extend_basis(GmresSpace& space, std::size_t k) {
  Plane& w = space.w;
  std::vector<double> column(k + 2);
  double square = orthogonalize(space.basis, k + 1, w, column), along = 0;
  for (double c : column) along += c * c;
  // little was left: once more against round-off
  if (square < 1e-4 * along) square = orthogonalize(space.basis, k + 1, w, column);
  column[k + 1] = std::sqrt(square);
  Plane& next = space.vector(k + 1, w.size());
  const double scale = square > 0 ? 1 / column[k + 1] : 0.0;
  for_cells(w.size(), [&](std::size_t i) { next[i] = scale * w[i]; });
  return column;
}

/// The least-squares problem of one cycle, min over c of |r e_1 - H c|. The Hessenberg matrix H comes by columns, and
/// plane rotations make each triangular at once: so the residual is known without c. [SaadSchultz1986 sec. 3.2]
class HessenbergLeastSquares {
 public:
  explicit HessenbergLeastSquares(double residual) : g_{residual} {}
  std::size_t columns() const { return h_.size(); }
  double residual() const { return std::abs(g_.back()); }
  const Rotation<double>& last_rotation() const { return rotations_.back(); }

  void add(std::vector<double> column) {
    const std::size_t k = h_.size();
    for (std::size_t i = 0; i < k; ++i) {
      const auto [upper, lower] = rotations_[i].forward(column[i], column[i + 1]);
      column[i] = upper;
      column[i + 1] = lower;
    }
    const double length = std::hypot(column[k], column[k + 1]);
    rotations_.push_back({column[k] / length, column[k + 1] / length});
    column[k] = length;
    g_.push_back(-rotations_[k].s * g_[k]);
    g_[k] *= rotations_[k].c;
    h_.push_back(std::move(column));
  }

  std::vector<double> solution() const {
    std::vector<double> c(h_.size());
    for (std::size_t i = h_.size(); i-- > 0;) {
      c[i] = g_[i];
      for (std::size_t j = i + 1; j < h_.size(); ++j) c[i] -= h_[j][i] * c[j];
      c[i] /= h_[i][i];
    }
    return c;
  }

 private:
  std::vector<std::vector<double>> h_;  // columns of the triangular factor
  std::vector<Rotation<double>> rotations_;
  std::vector<double> g_;  // the right side, rotated
};

/// y = sum of c_i basis_i
inline void combine(const std::vector<Plane>& basis, const std::vector<double>& c, Plane& y) {
  for_pieces(y.size(), c.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t j = begin; j < end; ++j) y[j] = 0;
    for (std::size_t i = 0; i < c.size(); ++i)
      for (std::size_t j = begin; j < end; ++j) y[j] += c[i] * basis[i][j];
  });
}

inline double largest_of(const Plane& values) {
  double largest = 0;
  for (const double v : values) largest = std::max(largest, std::abs(v));
  return largest;
}

/// Solves A x = b from x = 0 to |b - A x| <= relative |b| or max_iterations, or until no entry of b - A x is larger
/// than `close` (0: not looked at). apply(in, out) and precondition(in, out) act on whole vectors. Right
/// preconditioner: A M^-1 y = b, x = M^-1 y, so that the residual is that of x itself; the basis spans y, and one more
/// application of M^-1 per cycle gives x.
template <class Apply, class Precondition>
void gmres(Apply&& apply, Precondition&& precondition, const Plane& b, Plane& x, double relative, int max_iterations,
           GmresSpace& space, double close) {
  constexpr std::size_t kRestart = 60;  // columns
  const std::size_t n = b.size();
  Plane &r = space.r, &z = space.z, &w = space.w, &y = space.y;
  x.assign(n, 0.0);
  z.resize(n);
  w.resize(n);
  y.resize(n);
  r = b;
  const double norm_b = std::sqrt(dot(b, b));
  int iterations = 0;
  double residual = norm_b;
  while (iterations < max_iterations && residual > relative * norm_b) {
    HessenbergLeastSquares cycle(residual);
    Plane& first = space.vector(0, n);
    for_cells(n, [&](std::size_t i) { first[i] = r[i] / residual; });
    if (close > 0) space.left = first;
    bool all_close = false;
    while (cycle.columns() < kRestart && iterations < max_iterations && cycle.residual() > relative * norm_b &&
           !all_close) {
      precondition(space.basis[cycle.columns()], z);
      apply(z, w);
      ++iterations;
      cycle.add(extend_basis(space, cycle.columns()));
      if (!(close > 0)) continue;
      // the residual's direction, of unit length, after one more column: along Q^T e, Q the rotations so far
      const Rotation<double>& turned = cycle.last_rotation();
      const Plane& next = space.basis[cycle.columns()];
      for_cells(n, [&](std::size_t i) { space.left[i] = turned.c * next[i] - turned.s * space.left[i]; });
      all_close = cycle.residual() * largest_of(space.left) <= close;
    }
    combine(space.basis, cycle.solution(), y);
    precondition(y, z);
    add_scaled(x, 1, z);
    residual = cycle.residual();
    if (all_close || residual <= relative * norm_b) break;
    // the residual by the recursion drifts from the true one: a restart begins with the latter
    apply(x, w);
    for (std::size_t j = 0; j < n; ++j) r[j] = b[j] - w[j];
    residual = std::sqrt(dot(r, r));
  }
}

/// Solutions of A x = b for several right sides b, one after the other, in one Krylov space: directions that one right
/// side has searched serve all after it. Generalised conjugate residuals, which reach what GMRES reaches for one right
/// side [SaadSchultz1986], with the images of all directions kept.
///
/// Keeps the directions z_k and the orthonormal w_i of A z_k = sum over i <= k of R_ik w_i. Of one operator.
class RecycledKrylov {
 public:
  /// Until |b - A x| <= goal, or without an end: as far as the directions get. apply(in, out) is A, precondition(in,
  /// out) an approximate inverse.
  template <class Apply, class Precondition>
  void solve(Apply&& apply, Precondition&& precondition, const Plane& b, Plane& x, double goal) {
    constexpr std::size_t kMost = 400;  // directions
    left_ = b;
    std::vector<double> parts(columns_.size(), 0.0);
    double square = columns_.empty() ? dot(left_, left_) : orthogonalize(images_.basis, columns_.size(), left_, parts);
    while (std::sqrt(square) > goal && columns_.size() < kMost) {
      const std::size_t k = columns_.size();
      directions_.emplace_back(b.size());
      precondition(left_, directions_[k]);
      images_.w.resize(b.size());
      apply(directions_[k], images_.w);
      columns_.push_back(k == 0 ? first_column() : extend_basis(images_, k - 1));
      parts.push_back(dot(images_.basis[k], left_));
      add_scaled(left_, -parts[k], images_.basis[k]);
      square = dot(left_, left_);
    }
    x.assign(b.size(), 0.0);
    for (std::size_t k = parts.size(); k-- > 0;) {
      const double share = parts[k] / columns_[k][k];
      for (std::size_t i = 0; i < k; ++i) parts[i] -= share * columns_[k][i];
      add_scaled(x, share, directions_[k]);
    }
  }

  std::size_t directions() const { return columns_.size(); }

 private:
  std::vector<double> first_column() {
    const double length = std::sqrt(dot(images_.w, images_.w));
    Plane& first = images_.vector(0, images_.w.size());
    for_cells(first.size(), [&](std::size_t i) { first[i] = images_.w[i] / length; });
    return {length};
  }

  std::vector<Plane> directions_;
  std::vector<std::vector<double>> columns_;  // of R
  GmresSpace images_;
  Plane left_;
};

}  // namespace railstrata
