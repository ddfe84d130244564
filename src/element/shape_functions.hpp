#pragma once
// Trilinear shape functions of the hexahedron at its Gauss points, for set-up.
#include <Eigen/Dense>
#include <array>

#include "core/vec.hpp"
#include "element/swept_hex.hpp"

namespace railstrata::shape {

using Matrix3 = Eigen::Matrix3d;
using Gradients = Eigen::Matrix<double, 3, 8>;
inline constexpr double kGauss = 0.57735026918962576451;

// Natural coordinates: xi along the sweep; corner a < 4 at xi = -1, a >= 4 at xi = +1.
inline double xi_of(int a) { return a < 4 ? -1.0 : 1.0; }

inline Gradients natural_gradients(double xi, double eta, double zeta) {
  Gradients g;
  for (int a = 0; a < 8; ++a) {
    const double x = xi_of(a), e = kEta[a % 4], z = kZeta[a % 4];
    g(0, a) = 0.125 * x * (1 + e * eta) * (1 + z * zeta);
    g(1, a) = 0.125 * e * (1 + x * xi) * (1 + z * zeta);
    g(2, a) = 0.125 * z * (1 + x * xi) * (1 + e * eta);
  }
  return g;
}

inline Matrix3 jacobian(const std::array<Vec3, 8>& corners, const Gradients& natural) {
  Matrix3 j = Matrix3::Zero();  // j(m, i) = dX_i / dxi_m
  for (int a = 0; a < 8; ++a)
    for (int m = 0; m < 3; ++m) {
      j(m, 0) += natural(m, a) * corners[a].x;
      j(m, 1) += natural(m, a) * corners[a].y;
      j(m, 2) += natural(m, a) * corners[a].z;
    }
  return j;
}

template <class F>
void for_gauss_points(F&& f) {
  for (int p = 0; p < 8; ++p) f((p & 1 ? kGauss : -kGauss), (p & 2 ? kGauss : -kGauss), (p & 4 ? kGauss : -kGauss));
}

struct MeanGradients {
  Gradients b;
  double volume;
};

inline MeanGradients mean_gradients(const std::array<Vec3, 8>& corners) {
  MeanGradients m{Gradients::Zero(), 0.0};
  for_gauss_points([&](double xi, double eta, double zeta) {
    const Gradients natural = natural_gradients(xi, eta, zeta);
    const Matrix3 j = jacobian(corners, natural);
    const double det = j.determinant();
    m.b += det * (j.inverse() * natural);
    m.volume += det;
  });
  m.b /= m.volume;
  return m;
}

}  // namespace railstrata::shape
