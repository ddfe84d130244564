// Central differences on the solid alone: stable step, waves; and the static convergence of the elements.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "body/stable_step.hpp"
#include "fem/stepper.hpp"
#include "tests/body/free_matrix.hpp"
#include "tests/body/sample_bodies.hpp"
#include "tests/mesh/brick_mesh.hpp"

namespace railstrata {
namespace {

using namespace fem_checks;

// 2 / omega_max of the assembled free degrees of freedom from a dense eigenproblem.
double dense_stable_step(const Body& body) {
  Eigen::MatrixXd k = stiffness_matrix(body);
  const std::vector<std::ptrdiff_t> index = free_indices(body);
  for (Eigen::Index r = 0; r < k.rows(); ++r)
    for (Eigen::Index c = 0; c < k.cols(); ++c)
      k(r, c) *= std::sqrt(body.inverse_mass[index[r]] * body.inverse_mass[index[c]]);
  return 2 /
         std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff());
}

Body brick_on_its_base() { return {mesh_brick(3, 2, 5, 2e-3, 1e-3, 1.5e-3), {kSteel}, {}}; }

// Largest |u|_M over `steps` central-difference steps from a scattered displacement at rest, over its start.
double growth(const Body& body, double dt, int steps) {
  const std::vector<std::ptrdiff_t> index = free_indices(body);
  Field u = body.layout.field(), v = u, f = u;
  for (std::size_t k = 0; k < index.size(); ++k) u[index[k]] = 1e-12 * scatter(k);
  auto size = [&] {
    double sum = 0;
    for (std::ptrdiff_t i : index) sum += body.mass[i] * u[i] * u[i];
    return std::sqrt(sum);
  };
  const double start = size();
  double largest = start;
  for (int s = 0; s < steps; ++s) {
    internal_force(body, u, 0, f);
    for (std::ptrdiff_t i : index) {
      v[i] -= dt * body.inverse_mass[i] * f[i];
      u[i] += dt * v[i];
    }
    largest = std::max(largest, size());
  }
  return largest / start;
}

// Frequency of a standing plane wave in a bar: u_i = cos(k x), `lambda` elements a wavelength. Sampled from the
// projection on the mode.
struct Wave {
  double omega, dt, k;
};
Wave standing_wave(const Elastic& material, int component, double step_ratio) {
  constexpr int kElements = 40, kPerWave = 20;
  const double h = 2e-3,
               speed = std::sqrt((component == 0 ? material.p_wave_modulus() : material.mu) / material.density);
  const Body solid(mesh_brick(1, 1, kElements, h, h, h), {material}, {});
  const BlockLayout& l = solid.layout.blocks[0];
  Wave w{0, step_ratio * h / speed, 2 * std::numbers::pi / (kPerWave * h)};
  const Field mode = nodal_field(solid, [&](Vec3 x) {
    return component == 0 ? Vec3{std::cos(w.k * x.x), 0, 0} : Vec3{0, std::cos(w.k * x.x), 0};
  });
  Field u = mode, v = solid.layout.field(), f = v, momentum = v;
  for (double& x : u) x *= 1e-9;
  double before = 0, crossing = 0, first = 0;
  int crossings = 0;
  for (int s = 0; crossings < 9 && s < 20000; ++s) {  // four whole periods between the first and the ninth zero
    for (std::size_t i = 0; i < u.size(); ++i) momentum[i] = solid.element_mass[i] * u[i];
    const double now = nodal_dot(solid.layout, momentum, mode);
    if (s > 0 && (now < 0) != (before < 0)) {
      crossing = (s - 1 + before / (before - now)) * w.dt;
      if (crossings++ == 0) first = crossing;
    }
    before = now;
    internal_force(solid, u, 0, f);
    for (int n = 0; n < l.nodes; ++n)
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < l.stations; ++j) {
          const std::ptrdiff_t p = l.line(n, i) + j;
          if (i != component) continue;  // a plane wave: the others are held
          v[p] -= (s == 0 ? 0.5 : 1.0) * w.dt * f[p] / solid.element_mass[p];
          u[p] += w.dt * v[p];
        }
  }
  w.omega = 4 * 2 * std::numbers::pi / (crossing - first);
  return w;
}

}  // namespace

TEST(StableStep, LanczosAgreesWithTheDenseEigenvalueWithinOnePercent) {
  for (const Body& body : {brick_on_its_base(), Body(tied_body(SweepKind::revolve), {kSteel}, {})}) {
    const double dense = dense_stable_step(body), lanczos = lanczos_stable_step(body);
    EXPECT_NEAR(lanczos / dense, 1.0, 0.01);
    EXPECT_GE(lanczos, dense * (1 - 1e-9));           // Ritz values approach omega_max from below
    EXPECT_LT(element_step_bound(body).step, dense);  // [Hughes2000 ch. 9]
  }
}

TEST(StableStep, CentralDifferencesStayBoundedJustBelowItAndBlowUpJustAbove) {
  const Body body = brick_on_its_base();
  const double limit = dense_stable_step(body);
  EXPECT_LT(growth(body, 0.99 * limit, 2000),
            1.001 / std::sqrt(1 - 0.99 * 0.99));  // of a mode with omega dt / 2 = r: u_0 / sqrt(1 - r^2) at most
  EXPECT_GT(growth(body, 1.02 * limit, 200), 1e6);
}

TEST(WaveSpeed, OfABarIsWithinOnePercentAtTwentyElementsPerWavelength) {
  const Elastic bar = elastic(210e9, 0.0, 7800);  // nu = 0: sqrt(E / rho) is the speed of plane waves
  for (double ratio : {0.1, 0.3, 0.6}) {
    const Wave w = standing_wave(bar, 0, ratio);
    EXPECT_NEAR(w.omega / w.k / std::sqrt(210e9 / 7800), 1.0, 0.01) << ratio;
  }
}

// sin(omega dt / 2) = (c dt / h) sin(k h / 2): linear elements, lumped mass, central differences.
TEST(WaveSpeed, OfPressureAndShearWavesIsThatOfTheDiscreteDispersionRelation) {
  for (int component : {0, 1})
    for (double ratio : {0.1, 0.4}) {
      const Wave w = standing_wave(kSteel, component, ratio);
      const double h = 2e-3, omega = 2 / w.dt * std::asin(ratio * std::sin(0.5 * w.k * h));
      EXPECT_NEAR(w.omega / omega, 1.0, 2e-4) << component << " " << ratio;
    }
}

}  // namespace railstrata
