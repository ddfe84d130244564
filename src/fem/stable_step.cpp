#include "fem/stable_step.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <cstdint>

namespace railstrata {

// Lanczos on S^-1 K in the inner product of S = M + A, which needs S^-1 alone: residuals r = S z are kept beside the vectors z.
double lanczos_stable_step(const DeformableBody& body, const MassScaling& scaling, int iterations) {
  const auto n = static_cast<std::ptrdiff_t>(body.inverse_mass.size());
  auto dot = [n](const Field& a, const Field& b) {
    return ordered_sum(n, [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
      double s = 0;
      for (std::ptrdiff_t i = begin; i < end; ++i) s += a[i] * b[i];
      return s;
    });
  };
  Field r = body.solid.layout().field(), z = r, q = r, s_q = r, s_before = r, k_q = r;
  auto solve = [&] {
    z = r;
    scaling.scale(z);
    for (std::ptrdiff_t i = 0; i < n; ++i) z[i] *= body.inverse_mass[i];
  };
  std::uint64_t seed = 0x9E3779B97F4A7C15ull;  // any fixed start will do
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    seed = seed * 6364136223846793005ull + 1442695040888963407ull;
    if (body.inverse_mass[i] > 0) r[i] = (static_cast<double>(seed >> 11) * 0x1p-53 - 0.5) * std::sqrt(body.mass[i]);
  }
  solve();
  Eigen::VectorXd alpha(iterations), beta(iterations);
  double norm = std::sqrt(dot(r, z));
  int k = 0;
  for (; k < iterations && norm > 0; ++k) {
    s_before.swap(s_q);
    for (std::ptrdiff_t i = 0; i < n; ++i) q[i] = z[i] / norm, s_q[i] = r[i] / norm;
    body.ties.spread(q, 0, true);  // slaves follow their masters
    body.solid.linear_force(q, r);
    body.ties.collect(r);
    for (std::ptrdiff_t i = 0; i < n; ++i) r[i] = body.inverse_mass[i] > 0 ? r[i] : 0;
    alpha[k] = dot(r, q);
    for (std::ptrdiff_t i = 0; i < n; ++i) r[i] -= alpha[k] * s_q[i] + (k > 0 ? norm : 0) * s_before[i];
    solve();
    beta[k] = norm = std::sqrt(dot(r, z));
  }
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(alpha.head(k), beta.head(k - 1), Eigen::EigenvaluesOnly);
  return 2 / std::sqrt(solver.eigenvalues().maxCoeff());
}

}  // namespace railstrata
