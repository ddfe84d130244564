#include "element/element_matrix.hpp"

#include "element/shape_functions.hpp"

namespace railstrata {
namespace {

using namespace shape;
using Matrix6x24 = Eigen::Matrix<double, 6, 24>;

// Strain rows xx, yy, zz, 2xy, 2yz, 2xz of one gradient vector acting on a vector amplitude.
Eigen::Matrix<double, 6, 3> strain_rows(const Eigen::Vector3d& g) {
  Eigen::Matrix<double, 6, 3> b = Eigen::Matrix<double, 6, 3>::Zero();
  b(0, 0) = g(0);
  b(1, 1) = g(1);
  b(2, 2) = g(2);
  b(3, 0) = g(1);
  b(3, 1) = g(0);
  b(4, 1) = g(2);
  b(4, 2) = g(1);
  b(5, 0) = g(2);
  b(5, 2) = g(0);
  return b;
}

Eigen::Matrix<double, 6, 6> elasticity(const Elastic& m) {
  Eigen::Matrix<double, 6, 6> c = Eigen::Matrix<double, 6, 6>::Zero();
  c.topLeftCorner<3, 3>().setConstant(m.lambda);
  for (int i = 0; i < 3; ++i) {
    c(i, i) += 2 * m.mu;
    c(i + 3, i + 3) = m.mu;
  }
  return c;
}

}  // namespace

Matrix24 incompatible_mode_stiffness(const std::array<Vec3, 8>& corners, const Elastic& material) {
  const Eigen::Matrix<double, 6, 6> c = elasticity(material);
  const Matrix3 j0_inverse = jacobian(corners, natural_gradients(0, 0, 0)).inverse();
  const double det0 = 1.0 / j0_inverse.determinant();
  Matrix24 kuu = Matrix24::Zero();
  Eigen::Matrix<double, 9, 24> kau = Eigen::Matrix<double, 9, 24>::Zero();
  Eigen::Matrix<double, 9, 9> kaa = Eigen::Matrix<double, 9, 9>::Zero();
  for_gauss_points([&](double xi, double eta, double zeta) {
    const Gradients natural = natural_gradients(xi, eta, zeta);
    const Matrix3 j = jacobian(corners, natural);
    const double det = j.determinant();
    const Gradients g = j.inverse() * natural;
    Matrix6x24 b;
    for (int a = 0; a < 8; ++a) b.middleCols<3>(3 * a) = strain_rows(g.col(a));
    // Taylor's correction: gradients of the bubbles 1 - xi^2 with the centre's Jacobian, so that their mean over the
    // element vanishes.
    Eigen::Matrix<double, 6, 9> m;
    const double bubbles[3] = {-2 * xi, -2 * eta, -2 * zeta};
    for (int n = 0; n < 3; ++n)
      m.middleCols<3>(3 * n) = strain_rows(Eigen::Vector3d(j0_inverse.col(n) * (bubbles[n] * det0 / det)));
    kuu += det * b.transpose() * c * b;
    kau += det * m.transpose() * c * b;
    kaa += det * m.transpose() * c * m;
  });
  return kuu - kau.transpose() * kaa.ldlt().solve(kau);
}

Matrix24 linear_stiffness(const QuadReference& ref, SweepScale scale, const HourglassStiffness& hourglass) {
  const StationScale<double> st = station_scale(scale);
  const auto entry = [&](int e) { return hourglass[static_cast<std::size_t>(e)]; };
  Matrix24 k;
  for (int column = 0; column < 24; ++column) {
    const int a = column / 3;
    const auto unit_displacement = [&](int c, int i, double& sum, double& difference) {
      sum = c == a % 4 && i == column % 3 ? 1.0 : 0.0;
      difference = a < 4 ? -sum : sum;
    };
    const auto add_forces = [&](int c, int i, auto&& add) {
      double s = 0, d = 0;
      add(s, d);
      k(3 * c + i, column) = s - d;
      k(3 * (c + 4) + i, column) = s + d;
    };
    double* no_history = nullptr;
    ElasticHex::forces<SweepKind::revolve, Evaluation::linear>(
        ref, st, Rotation<double>{}, no_history, unit_displacement,
        [&](ElementKinematics<double>& kin) { hourglass_forces(entry, kin); }, add_forces);
  }
  return k;
}

}  // namespace railstrata
