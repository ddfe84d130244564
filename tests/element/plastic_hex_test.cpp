// The eigenstress of plastic strains at the Gauss points, alike along the sweep, against the dense incompatible-mode
// hexahedron.
#include "element/plastic_hex.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "element/element_matrix.hpp"
#include "element/reference.hpp"

namespace railstrata {
namespace {

using Real = long double;
using Vector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;

const Elastic kSteel = elastic(210e9, 0.3, 7800);
const std::array<Vec2, 4> kSquare{{{0, 0}, {1e-3, 0}, {1e-3, 1e-3}, {0, 1e-3}}};
const std::array<Vec2, 4> kSkewed{{{0.1e-3, -0.2e-3}, {1.3e-3, 0.1e-3}, {1.0e-3, 1.2e-3}, {-0.1e-3, 0.9e-3}}};

struct Shape {
  SweepKind kind;
  std::array<Vec2, 4> quad;
  double spacing;
};
std::vector<Shape> shapes() {
  const auto on_wheel = [](std::array<Vec2, 4> q) {
    for (Vec2& p : q) p.z -= 0.01;
    return q;
  };
  return {{SweepKind::extrude, kSquare, 1e-3},
          {SweepKind::extrude, kSkewed, 2e-3},
          {SweepKind::revolve, on_wheel(kSquare), 0.1},
          {SweepKind::revolve, on_wheel(kSkewed), 0.2}};
}

double scatter(int i) { return 2 * std::fmod(0.6180339887498949 * (i * i + 7 * i + 1), 1.0) - 1; }

// Trilinear element with Wilson's modes from scratch: strains (tensor) at 8 points, linear in displacements and
// bubbles; shears of the matrices are tensor shears.
struct Dense {
  Matrix b[8], g[8];  // 6 x 24, 6 x 9
  Real w[8];
  Dense(const Shape& s, SweepScale scale) {
    const std::array<Vec3, 8> x = local_corners(s.kind, s.quad, scale);
    const Real kAt = 1 / std::sqrt(Real(3));
    const Matrix inverse0 = jacobian(x, 0, 0, 0).inverse();
    for (int p = 0; p < 8; ++p) {
      const Real xi = p < 4 ? kAt : -kAt, eta = p & 1 ? kAt : -kAt, zeta = p & 2 ? kAt : -kAt;
      const Matrix j = jacobian(x, xi, eta, zeta);
      w[p] = j.determinant();
      const Matrix grad = j.inverse() * natural(xi, eta, zeta);
      b[p] = Matrix(6, 24);
      for (int a = 0; a < 8; ++a) b[p].middleCols(3 * a, 3) = rows(grad.col(a));
      g[p] = Matrix(6, 9);
      const Real bubble[3] = {-2 * xi, -2 * eta, -2 * zeta};
      for (int n = 0; n < 3; ++n)
        g[p].middleCols(3 * n, 3) = rows(inverse0.col(n) * (bubble[n] / inverse0.determinant() / w[p]));
    }
  }
  static Matrix natural(Real xi, Real eta, Real zeta) {
    Matrix n(3, 8);
    for (int a = 0; a < 8; ++a) {
      const Real x = a < 4 ? -1 : 1, e = kEta[a % 4], z = kZeta[a % 4];
      n.col(a) << x * (1 + e * eta) * (1 + z * zeta) / 8, e * (1 + x * xi) * (1 + z * zeta) / 8,
          z * (1 + x * xi) * (1 + e * eta) / 8;
    }
    return n;
  }
  static Matrix jacobian(const std::array<Vec3, 8>& x, Real xi, Real eta, Real zeta) {
    Matrix at(8, 3);
    for (int a = 0; a < 8; ++a) at.row(a) << Real(x[a].x), Real(x[a].y), Real(x[a].z);
    return natural(xi, eta, zeta) * at;
  }
  static Matrix rows(const Vector& d) {
    Matrix m = Matrix::Zero(6, 3);
    m(0, 0) = d(0);
    m(1, 1) = d(1);
    m(2, 2) = d(2);
    m(3, 0) = m(4, 2) = d(1) / 2;
    m(3, 1) = m(5, 2) = d(0) / 2;
    m(4, 1) = m(5, 0) = d(2) / 2;
    return m;
  }
  static Vector stress(const Vector& e) {
    Vector s = 2 * Real(kSteel.mu) * e;
    const Real p = Real(kSteel.lambda) * (e(0) + e(1) + e(2));
    for (int i = 0; i < 3; ++i) s(i) += p;
    return s;
  }
  static Matrix twice_shear(Matrix m) {
    m.bottomRows(3) *= 2;
    return m;
  }
  Vector bubbles(const Vector& u, const Matrix& plastic) const {
    Matrix k = Matrix::Zero(9, 9);
    Vector f = Vector::Zero(9);
    for (int p = 0; p < 8; ++p) {
      const Matrix t = w[p] * twice_shear(g[p]).transpose();
      for (int c = 0; c < 9; ++c) k.col(c) += t * stress(g[p].col(c));
      f -= t * (stress(b[p] * u) - 2 * Real(kSteel.mu) * Vector(plastic.col(p)));
    }
    return k.fullPivLu().solve(f);
  }
  Vector strain(int p, const Vector& u, const Vector& a) const { return b[p] * u + g[p] * a; }
  Vector forces(const Vector& u, const Vector& a, const Matrix& plastic) const {
    Vector f = Vector::Zero(24);
    for (int p = 0; p < 8; ++p)
      f += w[p] * twice_shear(b[p]).transpose() *
           (stress(strain(p, u, a)) - 2 * Real(kSteel.mu) * Vector(plastic.col(p)));
    return f;
  }
};

struct Sample {
  Vector u{24};
  Matrix plastic{6, 8};  // column p: + points 0–3, then - points with the same
  Sample() {
    for (int i = 0; i < 24; ++i) u(i) = 1e-6 * scatter(i);
    for (int p = 0; p < 4; ++p) {
      for (int i = 0; i < 6; ++i) plastic(i, p) = 1e-3 * scatter(100 + 6 * p + i);
      const Real mean = (plastic(0, p) + plastic(1, p) + plastic(2, p)) / 3;
      for (int i = 0; i < 3; ++i) plastic(i, p) -= mean;
      plastic.col(p + 4) = plastic.col(p);
    }
  }
};

// The element's own functions on the same numbers.
struct Mine {
  GaussShape<double> gauss;
  IncompatibleModes<double> modes;
  QuadReference reference;
  StationScale<double> st;
  HourglassStiffness hourglass;
  Mine(const Shape& s, SweepScale scale)
      : gauss(gauss_shape(s.kind, s.quad)),
        modes(incompatible_modes(s.kind, s.quad, scale, kSteel)),
        reference(quad_reference(s.kind, s.quad, kSteel)),
        st(station_scale(scale)),
        hourglass(hourglass_stiffness(s.kind, s.quad, scale, kSteel, ElementKind::full, 0)) {}
  ElementKinematics<double> kinematics(const Vector& u) const {
    return element_kinematics<SweepKind::revolve, double>(reference.shape, st, [&](int k, int i, double& s, double& d) {
      s = static_cast<double>(u(3 * (k + 4) + i) + u(3 * k + i));
      d = static_cast<double>(u(3 * (k + 4) + i) - u(3 * k + i));
    });
  }
  Eigenstress<double> eigenstress(const Matrix& plastic) const {
    PlasticSums<double> sums{};
    for (int p = 0; p < kGaussPairs; ++p) {
      double s[6];
      for (int i = 0; i < 6; ++i) s[i] = 2 * kSteel.mu * static_cast<double>(plastic(i, p));
      add_pair(gauss.pair[p], st.inv_sigma, st.inv_c, s, sums);
    }
    return condensed(modes, reference.shape.volume * st.sigma_c, sums);
  }
};

class PlasticHex : public testing::Test {
 protected:
  const Sample sample_;
};

TEST_F(PlasticHex, TheEighteenNumbersMakeTheForcesOfTheDenseElementWithPlasticStrains) {
  for (const Shape& shape : shapes()) {
    const SweepScale scale = sweep_scale(shape.kind, shape.spacing);
    const Dense dense(shape, scale);
    const Mine mine(shape, scale);
    const Vector truth = dense.forces(sample_.u, dense.bubbles(sample_.u, sample_.plastic), sample_.plastic);
    auto kin = mine.kinematics(sample_.u);
    auto stress = small_stress(kin, [&](const double(&e)[6], double(&s)[6]) {
      elastic_stress(kSteel.lambda, kSteel.mu, e, s);
      Eigenstress<double> off = mine.eigenstress(sample_.plastic);
      for (int i = 0; i < 6; ++i) s[i] -= off.mean[i];
    });
    hourglass_forces([&](int e) { return mine.hourglass[static_cast<std::size_t>(e)]; }, kin);
    Eigenstress<double> off = mine.eigenstress(sample_.plastic);
    for (int i = 0; i < 3; ++i) {
      kin.even[i] -= off.even[i];
      for (int m = 0; m < 3; ++m) kin.odd[m][i] -= off.odd[m][i];
    }
    Vector f(24);
    element_forces(mine.reference.shape, mine.st, stress, kin, [&](int k, int i, auto&& add) {
      double s = 0, d = 0;
      add(s, d);
      f(3 * k + i) = s - d;
      f(3 * (k + 4) + i) = s + d;
    });
    EXPECT_LT(static_cast<double>((f - truth).norm() / truth.norm()), 1e-12);
  }
}

TEST_F(PlasticHex, StrainsOfThePairsAreTheMeansOfTheDenseElement) {
  for (const Shape& shape : shapes()) {
    const SweepScale scale = sweep_scale(shape.kind, shape.spacing);
    const Dense dense(shape, scale);
    const Mine mine(shape, scale);
    const Vector a = dense.bubbles(sample_.u, sample_.plastic);
    const auto kin = mine.kinematics(sample_.u);
    const auto mean = small_stress(kin, [](const double(&)[6], double(&)[6]) {});
    BubbleAmplitudes<double> bubbles = following_bubbles(mine.modes, kin);
    const Eigenstress<double> plastic = mine.eigenstress(sample_.plastic);
    for (int n = 0; n < 3; ++n)
      for (int i = 0; i < 3; ++i) bubbles.a[n][i] += plastic.bubbles.a[n][i];
    for (int p = 0; p < kGaussPairs; ++p) {
      double e[6];
      pair_strain(mine.gauss.pair[p], mine.st.inv_sigma, mine.st.inv_c, mean.strain, kin, bubbles, e);
      const Vector plus = dense.strain(p, sample_.u, a), minus = dense.strain(p + 4, sample_.u, a);
      for (int i = 0; i < 6; ++i)
        EXPECT_NEAR(e[i], static_cast<double>(plus(i) + minus(i)) / 2, 1e-12 * static_cast<double>(plus.norm()));
    }
  }
}

TEST_F(PlasticHex, UniformPlasticStrainTouchesOnlyTheMeanStress) {
  for (const Shape& shape : shapes()) {
    const Mine mine(shape, sweep_scale(shape.kind, shape.spacing));
    Matrix uniform(6, 8);
    for (int p = 0; p < 8; ++p) uniform.col(p) = sample_.plastic.col(0);
    const Eigenstress<double> e = mine.eigenstress(uniform);
    const double size = 2 * kSteel.mu * static_cast<double>(uniform.col(0).norm());
    for (int i = 0; i < 6; ++i)
      EXPECT_NEAR(e.mean[i], 2 * kSteel.mu * static_cast<double>(uniform(i, 0)), 1e-13 * size);
    const double force = size * mine.reference.shape.volume * mine.st.sigma_c / 1e-3;
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(e.even[i], 0, 1e-12 * force);
      for (int m = 0; m < 3; ++m) EXPECT_NEAR(e.odd[m][i], 0, 1e-12 * force);
    }
  }
}

}  // namespace
}  // namespace railstrata
