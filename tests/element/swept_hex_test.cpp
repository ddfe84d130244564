#include "element/swept_hex.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "element/element_matrix.hpp"

using namespace railstrata;

namespace {

const Elastic kSteel = elastic(210e9, 0.3, 7800);
const std::array<Vec2, 4> kSquare{{{0, 0}, {1e-3, 0}, {1e-3, 1e-3}, {0, 1e-3}}};
const std::array<Vec2, 4> kSkewed{{{0.1e-3, -0.2e-3}, {1.3e-3, 0.1e-3}, {1.0e-3, 1.2e-3}, {-0.1e-3, 0.9e-3}}};
std::array<Vec2, 4> on_wheel(std::array<Vec2, 4> q) {
  for (Vec2& p : q) p.z -= 0.43;
  return q;
}

struct Shape {
  SweepKind kind;
  std::array<Vec2, 4> quad;
  double spacing;
};
std::vector<Shape> shapes() {
  return {{SweepKind::extrude, kSquare, 1e-3},
          {SweepKind::extrude, kSkewed, 2e-3},
          {SweepKind::revolve, on_wheel(kSquare), 2.3e-3},
          {SweepKind::revolve, on_wheel(kSkewed), 0.1}};
}

Vec3 turn(double angle, Vec3 v) {
  return {std::cos(angle) * v.x - std::sin(angle) * v.z, v.y, std::sin(angle) * v.x + std::cos(angle) * v.z};
}

// Nodal forces of one element for given corner displacements in the model frame, rotated station (Q) and body (R).
std::array<Vec3, 8> forces(const Shape& shape, double theta, double psi, const std::array<Vec3, 8>& u,
                           const HourglassStiffness& hg, ElementStress<double>* out = nullptr,
                           double* energy = nullptr) {
  const QuadReference r = quad_reference(shape.kind, shape.quad, kSteel);
  const SweepScale sc = sweep_scale(shape.kind, shape.spacing);
  const StationScale<double> st = station_scale(sc);
  auto kin =
      element_kinematics<SweepKind::revolve, double>(r.shape, st, [&](int k, int i, double& sum, double& difference) {
        auto component = [i](Vec3 v) { return i == 0 ? v.x : i == 1 ? v.y : v.z; };
        sum = component(turn(psi - theta, u[k + 4] + u[k]));
        difference = component(turn(psi - theta, u[k + 4] - u[k]));
      });
  const auto stress = hex_stress<SweepKind::revolve, double>(r, rotation_by(psi), kin);
  const double hourglass = hourglass_forces([&](int e) { return hg[static_cast<std::size_t>(e)]; }, kin);
  double f[8][3];
  element_forces(r.shape, st, stress, kin, [&](int k, int i, auto&& add) {
    double s = 0, d = 0;
    add(s, d);
    f[k][i] = s - d;
    f[k + 4][i] = s + d;
  });
  if (out) *out = stress;
  if (energy) {
    const double* e = stress.strain;
    const double* p = stress.s;
    *energy = hourglass + 0.5 * r.shape.volume * sc.sigma * sc.c *
                              (e[0] * p[0] + e[1] * p[1] + e[2] * p[2] + 2 * (e[3] * p[3] + e[4] * p[4] + e[5] * p[5]));
  }
  std::array<Vec3, 8> out_forces;
  for (int k = 0; k < 8; ++k) out_forces[k] = turn(theta - psi, {f[k][0], f[k][1], f[k][2]});
  return out_forces;
}

}  // namespace

TEST(SweptHex, FullElementIsTheIncompatibleModeHexahedronOnEveryShape) {
  for (const Shape& shape : shapes()) {
    const SweepScale sc = sweep_scale(shape.kind, shape.spacing);
    const auto hg = hourglass_stiffness(shape.kind, shape.quad, sc, kSteel, ElementKind::full, 0);
    const Matrix24 fast = linear_stiffness(quad_reference(shape.kind, shape.quad, kSteel), sc, hg);
    const Matrix24 truth = incompatible_mode_stiffness(local_corners(shape.kind, shape.quad, sc), kSteel);
    EXPECT_LT((fast - truth).norm() / truth.norm(), 1e-12);
  }
}

TEST(SweptHex, StiffnessHasSixRigidModesAndNoOtherZeroEnergyMode) {
  for (const Shape& shape : shapes())
    for (ElementKind kind : {ElementKind::full, ElementKind::one_point}) {
      const SweepScale sc = sweep_scale(shape.kind, shape.spacing);
      const auto hg = hourglass_stiffness(shape.kind, shape.quad, sc, kSteel, kind, 0.05);
      const Matrix24 k = linear_stiffness(quad_reference(shape.kind, shape.quad, kSteel), sc, hg);
      EXPECT_LT((k - k.transpose()).norm() / k.norm(), 1e-13);
      Eigen::SelfAdjointEigenSolver<Matrix24> eigen(0.5 * (k + k.transpose()));
      EXPECT_LT(std::abs(eigen.eigenvalues()(5)), 1e-9 * eigen.eigenvalues()(23));
      EXPECT_GT(eigen.eigenvalues()(6), 1e-5 * eigen.eigenvalues()(23));
    }
}

TEST(SweptHex, RigidRotationBy90DegreesInOneDegreeStepsLeavesLessThan1e9OfYoungsModulus) {
  for (const Shape& shape : shapes()) {
    const SweepScale sc = sweep_scale(shape.kind, shape.spacing);
    const auto hg = hourglass_stiffness(shape.kind, shape.quad, sc, kSteel, ElementKind::full, 0);
    for (int degree = 0; degree <= 90; ++degree) {
      const double a = degree * std::numbers::pi / 180, theta = 0.4;
      std::array<Vec3, 8> u;
      const auto local = local_corners(shape.kind, shape.quad, sc);
      for (std::size_t i = 0; i < 8; ++i) {
        const Vec3 x = turn(theta, local[i]);
        u[i] = turn(-a, x) - x + Vec3{0.3, 0, 0.01};
      }
      ElementStress<double> stress;
      const auto f = forces(shape, theta, a, u, hg, &stress);
      for (double s : stress.s) EXPECT_LT(std::abs(s), 1e-9 * 210e9);
      for (const Vec3& force : f) EXPECT_LT(norm(force), 1e-9 * 210e9 * 1e-6);
    }
  }
}

TEST(SweptHex, ForcesAreTheGradientOfTheEnergyAtFiniteRotationAndStrain) {
  for (const Shape& shape : shapes()) {
    const SweepScale sc = sweep_scale(shape.kind, shape.spacing);
    const auto hg = hourglass_stiffness(shape.kind, shape.quad, sc, kSteel, ElementKind::full, 0);
    const double theta = 0.7, psi = 0.5;
    std::array<Vec3, 8> u;
    const auto local = local_corners(shape.kind, shape.quad, sc);
    for (std::size_t i = 0; i < 8; ++i) {
      const Vec3 x = turn(theta, local[i]);
      u[i] = turn(-psi, x) - x +
             3e-6 * Vec3{std::sin(7.0 * double(i)), std::cos(5.0 * double(i)), std::sin(3.0 + 11.0 * double(i))};
    }
    const auto f = forces(shape, theta, psi, u, hg);
    for (std::size_t i = 0; i < 8; ++i)
      for (int c = 0; c < 3; ++c) {
        const double step = 1e-9;
        double energy[2];
        for (int side = 0; side < 2; ++side) {
          auto v = u;
          const double shift = side ? step : -step;
          (c == 0 ? v[i].x : c == 1 ? v[i].y : v[i].z) += shift;
          forces(shape, theta, psi, v, hg, nullptr, &energy[side]);
        }
        const double expected = (energy[1] - energy[0]) / (2 * step);
        EXPECT_NEAR(c == 0 ? f[i].x : c == 1 ? f[i].y : f[i].z, expected, 1e-6 * 210e9 * 1e-6);
      }
  }
}

TEST(SweptHex, UniformStrainGivesTheExactStressOnEveryShape) {  // patch test of a single element
  for (const Shape& shape : shapes()) {
    const SweepScale sc = sweep_scale(shape.kind, shape.spacing);
    const auto hg = hourglass_stiffness(shape.kind, shape.quad, sc, kSteel, ElementKind::full, 0);
    std::array<Vec3, 8> u;
    const auto x = local_corners(shape.kind, shape.quad, sc);
    for (std::size_t i = 0; i < 8; ++i)
      u[i] = 1e-9 * Vec3{x[i].x + 0.5 * x[i].y, -0.3 * x[i].y + 0.2 * x[i].z, 0.7 * x[i].z};
    ElementStress<double> stress;
    double energy = 0;
    forces(shape, 0, 0, u, hg, &stress, &energy);
    const double trace = 1 - 0.3 + 0.7;
    EXPECT_NEAR(stress.s[0], 1e-9 * (kSteel.lambda * trace + 2 * kSteel.mu), 1e-2);
    EXPECT_NEAR(stress.s[1], 1e-9 * (kSteel.lambda * trace - 0.6 * kSteel.mu), 1e-2);
    EXPECT_NEAR(stress.s[3], 1e-9 * kSteel.mu * 0.5, 1e-2);
    EXPECT_NEAR(stress.s[4], 1e-9 * kSteel.mu * 0.2, 1e-2);
  }
}

TEST(SweptHex, CubeInPureBendingWithOneElementIsExact) {  // M = E I / R with sigma = E y / R; full integration without
                                                          // incompatible modes is 1.5 times too stiff
  const double side = 1e-3, curvature = 1e-6;
  const Shape shape{SweepKind::extrude,
                    {{{-side / 2, -side / 2}, {side / 2, -side / 2}, {side / 2, side / 2}, {-side / 2, side / 2}}},
                    side};
  const auto hg = hourglass_stiffness(shape.kind, shape.quad, sweep_scale(shape.kind, side), elastic(210e9, 0.0, 7800),
                                      ElementKind::full, 0);
  const QuadReference r = quad_reference(shape.kind, shape.quad, elastic(210e9, 0.0, 7800));
  const Matrix24 k = linear_stiffness(r, sweep_scale(shape.kind, side), hg);
  Eigen::Matrix<double, 24, 1> u = Eigen::Matrix<double, 24, 1>::Zero();
  const auto x = local_corners(shape.kind, shape.quad, sweep_scale(shape.kind, side));
  for (int a = 0; a < 8; ++a)
    u(3 * a) = -curvature * x[static_cast<std::size_t>(a)].x * x[static_cast<std::size_t>(a)].z;
  const double energy = 0.5 * u.dot(k * u), exact = 0.5 * 210e9 * std::pow(side, 4) / 12 * curvature * curvature * side;
  EXPECT_NEAR(energy / exact, 1.0, 1e-10);
}

TEST(SweptHex, HourglassCoefficientOfACubeThatBendsExactlyIsEOver9PWaveModuli) {
  const SweepScale sc = sweep_scale(SweepKind::extrude, 1e-3);
  const Elastic m = elastic(210e9, 0.0, 7800);
  const auto full = hourglass_stiffness(SweepKind::extrude, kSquare, sc, m, ElementKind::full, 0);
  const auto scaled =
      hourglass_stiffness(SweepKind::extrude, kSquare, sc, m, ElementKind::one_point, 210e9 / (9 * m.p_wave_modulus()));
  EXPECT_NEAR(full[9] / scaled[9], 1.0, 1e-10);  // pattern xi eta along the sweep: bending
}

TEST(SweptHex, LumpedMassesAddUpToTheElement) {
  for (const Shape& shape : shapes()) {
    const SweepScale sc = sweep_scale(shape.kind, shape.spacing);
    const auto m = corner_masses(shape.kind, shape.quad, sc, 7800);
    const double volume = quad_reference(shape.kind, shape.quad, kSteel).shape.volume * sc.sigma * sc.c;
    EXPECT_NEAR(2 * (m[0] + m[1] + m[2] + m[3]) / (7800 * volume), 1.0, 1e-13);
  }
}

// The highest mode of a free cube of side h with lumped masses rho h^3/8 is the uniform dilatation u = e x: its energy
// 1/2 h^3 9 K e^2 (K bulk modulus) over the nodes' 8 x 3 (h/2)^2 e^2 gives omega^2 = 12 K/(rho h^2), and with the P
// wave modulus M = rho c_p^2 the stable step 2/omega = sqrt(M/(3 K)) h/c_p; 0.734 h/c_p at nu = 0.3.
TEST(SweptHex, StableStepOfACubeIsThatOfItsDilatation) {
  const SweepScale sc = sweep_scale(SweepKind::extrude, 1e-3);
  const auto hg = hourglass_stiffness(SweepKind::extrude, kSquare, sc, kSteel, ElementKind::full, 0);
  const double cp = std::sqrt(kSteel.p_wave_modulus() / kSteel.density);
  const double ratio = element_stable_step(SweepKind::extrude, kSquare, sc, kSteel, hg) / (1e-3 / cp);
  EXPECT_NEAR(ratio, std::sqrt(kSteel.p_wave_modulus() / (3 * kSteel.lambda + 2 * kSteel.mu)), 1e-10);
}
