#pragma once
// Restarted GMRES with a right preconditioner, for operators given as functions. [SaadSchultz1986]
#include <cmath>
#include <vector>

#include "bem/plane_algebra.hpp"

namespace railstrata {

struct GmresResult {
  int iterations = 0;
  double residual = 0;  ///< 2-norm left
};

/// Vectors that later solutions of the same size use again.
struct GmresSpace {
  std::vector<Plane> basis;
  Plane r, z, w, y;
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

/// Solves A x = b from x = 0 to |b - A x| <= relative |b| or max_iterations. apply(in, out) and precondition(in, out)
/// act on whole vectors.
template <class Apply, class Precondition>
GmresResult gmres(Apply&& apply, Precondition&& precondition, const Plane& b, Plane& x, double relative,
                  int max_iterations, GmresSpace& space, int restart = 60) {
  const std::size_t n = b.size();
  auto& basis = space.basis;  // no structured binding: clang++ 14 does not capture one
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
    const auto vector = [&](std::size_t k) -> Plane& {
      if (basis.size() <= k) basis.emplace_back();
      basis[k].resize(n);
      return basis[k];
    };
    std::vector<std::vector<double>> h;  // columns of the triangular factor
    std::vector<double> cosine, sine, g{result.residual};
    Plane& first = vector(0);
    for_cells(n, [&](std::size_t i) { first[i] = r[i] / result.residual; });
    while (static_cast<int>(h.size()) < restart && result.iterations < max_iterations &&
           std::abs(g.back()) > relative * norm_b) {
      const std::size_t k = h.size();
      precondition(basis[k], z);
      apply(z, w);
      ++result.iterations;
      std::vector<double> column(k + 2);
      double square = orthogonalize(basis, k + 1, w, column), along = 0;
      for (double c : column) along += c * c;
      if (square < 1e-4 * along)
        square = orthogonalize(basis, k + 1, w, column);  // little was left: once more against round-off
      column[k + 1] = std::sqrt(square);
      Plane& next = vector(k + 1);
      const double scale = square > 0 ? 1 / column[k + 1] : 0.0;
      for_cells(n, [&](std::size_t i) { next[i] = scale * w[i]; });
      for (std::size_t i = 0; i < k; ++i) {
        const double a = column[i], c = column[i + 1];
        column[i] = cosine[i] * a + sine[i] * c;
        column[i + 1] = cosine[i] * c - sine[i] * a;
      }
      const double length = std::hypot(column[k], column[k + 1]);
      cosine.push_back(column[k] / length);
      sine.push_back(column[k + 1] / length);
      column[k] = length;
      g.push_back(-sine[k] * g[k]);
      g[k] *= cosine[k];
      h.push_back(std::move(column));
    }
    std::vector<double> c(h.size());
    for (std::size_t i = h.size(); i-- > 0;) {
      c[i] = g[i];
      for (std::size_t j = i + 1; j < h.size(); ++j) c[i] -= h[j][i] * c[j];
      c[i] /= h[i][i];
    }
    for_pieces(
        n,
        [&](std::size_t, std::size_t begin, std::size_t end) {
          for (std::size_t j = begin; j < end; ++j) y[j] = 0;
          for (std::size_t i = 0; i < c.size(); ++i)
            for (std::size_t j = begin; j < end; ++j) y[j] += c[i] * basis[i][j];
        },
        c.size());
    precondition(y, z);
    add_scaled(x, 1, z);
    result.residual = std::abs(g.back());
    if (result.residual <= relative * norm_b) break;
    apply(x, w);
    for (std::size_t j = 0; j < n; ++j) r[j] = b[j] - w[j];
    result.residual = std::sqrt(dot(r, r));
  }
  return result;
}

}  // namespace railstrata
