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

/// Solves A x = b from x = 0 to |b - A x| <= relative |b| or max_iterations. apply(in, out) and precondition(in, out) act on whole vectors.
template <class Apply, class Precondition>
GmresResult gmres(Apply&& apply, Precondition&& precondition, const Plane& b, Plane& x, double relative, int max_iterations, int restart = 60) {
  const std::size_t n = b.size();
  x.assign(n, 0.0);
  Plane r = b, z(n), w(n);
  const double norm_b = std::sqrt(dot(b, b));
  GmresResult result{0, norm_b};
  if (norm_b == 0) return result;
  while (result.iterations < max_iterations && result.residual > relative * norm_b) {
    std::vector<Plane> v{r};
    std::vector<std::vector<double>> h;  // columns of the triangular factor
    std::vector<double> cosine, sine, g{result.residual};
    scale_by(v[0], 1 / result.residual);
    while (static_cast<int>(h.size()) < restart && result.iterations < max_iterations && std::abs(g.back()) > relative * norm_b) {
      const std::size_t k = h.size();
      precondition(v[k], z);
      apply(z, w);
      ++result.iterations;
      std::vector<double> column(k + 2);
      for (std::size_t i = 0; i <= k; ++i) {
        column[i] = dot(v[i], w);
        add_scaled(w, -column[i], v[i]);
      }
      column[k + 1] = std::sqrt(dot(w, w));
      v.push_back(w);
      if (column[k + 1] > 0) scale_by(v.back(), 1 / column[k + 1]);
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
    Plane y(n, 0.0);
    std::vector<double> c(h.size());
    for (std::size_t i = h.size(); i-- > 0;) {
      c[i] = g[i];
      for (std::size_t j = i + 1; j < h.size(); ++j) c[i] -= h[j][i] * c[j];
      c[i] /= h[i][i];
      add_scaled(y, c[i], v[i]);
    }
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
