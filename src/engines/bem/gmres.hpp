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

struct GmresResult {
  int iterations = 0;
  double residual = 0;  ///< 2-norm left
};

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
  for_pieces(
      n,
      [&](std::size_t k, std::size_t begin, std::size_t end) {
        for (std::size_t i = 0; i < count; ++i)
          dots[k * count + i] = sum_of(begin, end, [&](std::size_t j) { return basis[i][j] * w[j]; });
      },
      count);
  std::vector<double> h(count, 0.0);
  for (std::size_t k = 0; k < pieces_of(n); ++k)
    for (std::size_t i = 0; i < count; ++i) h[i] += dots[k * count + i];
  for_pieces(
      n,
      [&](std::size_t k, std::size_t begin, std::size_t end) {
        for (std::size_t i = 0; i < count; ++i)
          for (std::size_t j = begin; j < end; ++j) w[j] -= h[i] * basis[i][j];
        squares[k] = sum_of(begin, end, [&](std::size_t j) { return w[j] * w[j]; });
      },
      count);
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
  for_pieces(
      y.size(),
      [&](std::size_t, std::size_t begin, std::size_t end) {
        for (std::size_t j = begin; j < end; ++j) y[j] = 0;
        for (std::size_t i = 0; i < c.size(); ++i)
          for (std::size_t j = begin; j < end; ++j) y[j] += c[i] * basis[i][j];
      },
      c.size());
}

/// The direction of the residual, of unit length, after one more column: it lies along Q^T e, Q the rotations so far.
inline void turn_residual(const Rotation<double>& rotation, const Plane& next, Plane& direction) {
  for_cells(next.size(), [&](std::size_t i) { direction[i] = rotation.c * next[i] - rotation.s * direction[i]; });
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
GmresResult gmres(Apply&& apply, Precondition&& precondition, const Plane& b, Plane& x, double relative,
                  int max_iterations, GmresSpace& space, double close = 0, int restart = 60) {
  const std::size_t n = b.size();
  Plane &r = space.r, &z = space.z, &w = space.w, &y = space.y;
  x.assign(n, 0.0);
  z.resize(n);
  w.resize(n);
  y.resize(n);
  r = b;
  const double norm_b = std::sqrt(dot(b, b));
  GmresResult result{0, norm_b};
  if (norm_b == 0) return result;
  while (result.iterations < max_iterations && result.residual > relative * norm_b) {
    HessenbergLeastSquares cycle(result.residual);
    Plane& first = space.vector(0, n);
    for_cells(n, [&](std::size_t i) { first[i] = r[i] / result.residual; });
    if (close > 0) space.left = first;
    bool all_close = false;
    while (static_cast<int>(cycle.columns()) < restart && result.iterations < max_iterations &&
           cycle.residual() > relative * norm_b && !all_close) {
      precondition(space.basis[cycle.columns()], z);
      apply(z, w);
      ++result.iterations;
      cycle.add(extend_basis(space, cycle.columns()));
      if (!(close > 0)) continue;
      turn_residual(cycle.last_rotation(), space.basis[cycle.columns()], space.left);
      all_close = cycle.residual() * largest_of(space.left) <= close;
    }
    combine(space.basis, cycle.solution(), y);
    precondition(y, z);
    add_scaled(x, 1, z);
    result.residual = cycle.residual();
    if (all_close || result.residual <= relative * norm_b) break;
    // the residual by the recursion drifts from the true one: a restart begins with the latter
    apply(x, w);
    for (std::size_t j = 0; j < n; ++j) r[j] = b[j] - w[j];
    result.residual = std::sqrt(dot(r, r));
  }
  return result;
}

}  // namespace railstrata
