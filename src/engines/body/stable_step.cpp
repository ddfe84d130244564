#include "body/stable_step.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <cstdint>

#include "body/traversal.hpp"
#include "core/faults.hpp"
#include "core/parallel.hpp"

namespace railstrata {
namespace {

// Lanczos on S^-1 K in the inner product of S, which needs S^-1 alone: residuals r = S z are kept beside the vectors z.
// stiffness: w = K q on free nodes, q may be spread to slaves; solve: z = S^-1 r in place, zero at nodes that do not
// take part.
template <class Stiffness, class Solve>
double largest_by_lanczos(const Body& body, int iterations, Stiffness&& stiffness, Solve&& solve) {
  const auto n = static_cast<std::ptrdiff_t>(body.inverse_mass.size());
  auto dot = [n](const Field& a, const Field& b) {
    return ordered_sum(n, [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
      double s = 0;
      for (std::ptrdiff_t i = begin; i < end; ++i) s += a[i] * b[i];
      return s;
    });
  };
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
  Eigen::VectorXd alpha(iterations), beta(iterations);
  double norm = std::sqrt(dot(r, z));
  int k = 0;
  for (; k < iterations && norm > 0; ++k) {
    s_before.swap(s_q);
    for (std::ptrdiff_t i = 0; i < n; ++i) {
      q[i] = z[i] / norm;
      s_q[i] = r[i] / norm;
    }
    stiffness(q, r);
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

// w = K q, slaves follow their masters
void stiffness_of(Traversal& elements, Field& q, Field& w) {
  const Body& body = elements.body();
  body.ties.apply_homogeneous(q);
  elements.linear_force(q, w);
  body.ties.apply_transpose(w);
  for_each(static_cast<std::ptrdiff_t>(w.size()), [&](std::ptrdiff_t i) {
    if (body.inverse_mass[i] == 0) w[i] = 0;
  });
}

void divide_by_mass(const Body& body, Field& f) {
  for_each(static_cast<std::ptrdiff_t>(f.size()), [&](std::ptrdiff_t i) { f[i] *= body.inverse_mass[i]; });
}

}  // namespace

double lanczos_stable_step(const Body& body, const MassScaling& scaling, int iterations) {
  Traversal elements(body);
  const auto solve = [&](Field& f) {
    scaling.scale(f);
    divide_by_mass(body, f);
  };
  const auto stiffness = [&](Field& q, Field& w) { stiffness_of(elements, q, w); };
  return 2 / std::sqrt(largest_by_lanczos(body, iterations, stiffness, solve));
}

}  // namespace railstrata
