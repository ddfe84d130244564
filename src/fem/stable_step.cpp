#include <Eigen/Eigenvalues>
#include <cmath>
#include <cstdint>

#include "fem/stepper.hpp"

namespace railstrata {

double lanczos_stable_step(const DeformableBody& body, int iterations) {
  const auto n = static_cast<std::ptrdiff_t>(body.inverse_mass.size());
  auto dot = [n](const Field& a, const Field& b) {
    return ordered_sum(n, [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
      double s = 0;
      for (std::ptrdiff_t i = begin; i < end; ++i) s += a[i] * b[i];
      return s;
    });
  };
  // The operator A = M^-1/2 K M^-1/2 on free nodes; slaves follow their masters.
  Field root = body.solid.layout().field(), q = root, before = root, w = root, u = root;
  std::uint64_t seed = 0x9E3779B97F4A7C15ull;  // any fixed start will do
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    root[i] = std::sqrt(body.inverse_mass[i]);
    seed = seed * 6364136223846793005ull + 1442695040888963407ull;
    q[i] = root[i] > 0 ? static_cast<double>(seed >> 11) * 0x1p-53 - 0.5 : 0;
  }
  const double norm0 = std::sqrt(dot(q, q));
  for (double& v : q) v /= norm0;
  Eigen::VectorXd alpha(iterations), beta(iterations);
  double last = 0;
  int k = 0;
  for (; k < iterations; ++k) {
    for (std::ptrdiff_t i = 0; i < n; ++i) u[i] = root[i] * q[i];
    body.ties.spread(u, 0, true);
    body.solid.linear_force(u, w);
    body.ties.collect(w);
    for (std::ptrdiff_t i = 0; i < n; ++i) w[i] *= root[i];
    alpha[k] = dot(w, q);
    for (std::ptrdiff_t i = 0; i < n; ++i) w[i] -= alpha[k] * q[i] + last * before[i];
    last = std::sqrt(dot(w, w));
    beta[k] = last;
    if (last == 0) {
      ++k;
      break;
    }
    for (std::ptrdiff_t i = 0; i < n; ++i) {
      before[i] = q[i];
      q[i] = w[i] / last;
    }
  }
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(alpha.head(k), beta.head(k - 1), Eigen::EigenvaluesOnly);
  return 2 / std::sqrt(solver.eigenvalues().maxCoeff());
}

}  // namespace railstrata
