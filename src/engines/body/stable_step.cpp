#include "body/stable_step.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <cstdint>

#include "body/field_algebra.hpp"
#include "body/traversal.hpp"
#include "core/faults.hpp"

namespace railstrata {
namespace {

// Lanczos on S^-1 K in the inner product of S, which needs S^-1 alone: residuals r = S z are kept beside the vectors z.
// solve: z = S^-1 r in place, zero at nodes that do not take part.
template <class Solve>
double largest_by_lanczos(const Body& body, Solve&& solve) {
  constexpr int kIterations = 60;
  Traversal elements(body);
  const auto n = static_cast<std::ptrdiff_t>(body.inverse_mass.size());
  Field r = body.layout.field(), z = r, q = r, s_q = r, s_before = r;
  std::uint64_t seed = 0x9E3779B97F4A7C15ull;  // any fixed start will do; the same for every width of vectors, to which
                                               // lines are filled up
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    if (body.inverse_mass[i] == 0) continue;
    seed = seed * 6364136223846793005ull + 1442695040888963407ull;
    r[i] = (static_cast<double>(seed >> 11) * 0x1p-53 - 0.5) * std::sqrt(body.mass[i]);
  }
  z = r;
  solve(z);
  Eigen::VectorXd alpha(kIterations), beta(kIterations);
  double norm = std::sqrt(dot(r, z));
  int k = 0;
  for (; k < kIterations && norm > 0; ++k) {
    s_before.swap(s_q);
    for (std::ptrdiff_t i = 0; i < n; ++i) {
      q[i] = z[i] / norm;
      s_q[i] = r[i] / norm;
    }
    free_stiffness(elements, q, r);
    alpha[k] = dot(r, q);
    for (std::ptrdiff_t i = 0; i < n; ++i) r[i] -= alpha[k] * s_q[i] + (k > 0 ? norm : 0) * s_before[i];
    z = r;
    solve(z);
    beta[k] = norm = std::sqrt(std::max(0.0, dot(r, z)));
  }
  if (k == 0 || !std::isfinite(norm))
    throw NumericalError("the stable time step cannot be computed: the stiffness of the mesh is not a number");
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(alpha.head(k), beta.head(k - 1), Eigen::EigenvaluesOnly);
  return solver.eigenvalues().maxCoeff();
}

}  // namespace

double lanczos_stable_step(const Body& body, const MassScaling& scaling) {
  const auto solve = [&](Field& f) {
    scaling.scale(f);
    for_each(static_cast<std::ptrdiff_t>(f.size()), [&](std::ptrdiff_t i) { f[i] *= body.inverse_mass[i]; });
  };
  return 2 / std::sqrt(largest_by_lanczos(body, solve));
}

}  // namespace railstrata
