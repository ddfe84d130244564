#pragma once
// Shape functions and integration of the 8-node hexahedron, for what is made before the computation.
#include <Eigen/Dense>
#include <array>

#include "element/reference.hpp"

namespace railstrata::hex {

using Matrix3 = Eigen::Matrix3d;
using Gradients = Eigen::Matrix<double, 3, 8>;
using Matrix6x24 = Eigen::Matrix<double, 6, 24>;
constexpr double kGauss = 0.57735026918962576451;

// a b and a^T b, entry by entry: Eigen's own products of these sizes take seconds each to compile.
template <int R, int K, int C>
Eigen::Matrix<double, R, C> product(const Eigen::Matrix<double, R, K>& a, const Eigen::Matrix<double, K, C>& b) {
  Eigen::Matrix<double, R, C> out = Eigen::Matrix<double, R, C>::Zero();
  for (int j = 0; j < C; ++j)
    for (int k = 0; k < K; ++k)
      for (int i = 0; i < R; ++i) out(i, j) += a(i, k) * b(k, j);
  return out;
}
template <int R, int K, int C>
Eigen::Matrix<double, R, C> transposed_product(const Eigen::Matrix<double, K, R>& a,
                                               const Eigen::Matrix<double, K, C>& b) {
  Eigen::Matrix<double, R, C> out;
  for (int j = 0; j < C; ++j)
    for (int i = 0; i < R; ++i) {
      out(i, j) = 0;
      for (int k = 0; k < K; ++k) out(i, j) += a(k, i) * b(k, j);
    }
  return out;
}

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

/// Gradients of the shape functions at a point and the Jacobian's determinant.
struct PointGradients {
  double det;
  Gradients g;
};
inline PointGradients gradients_at(const std::array<Vec3, 8>& corners, double xi, double eta, double zeta) {
  const Gradients natural = natural_gradients(xi, eta, zeta);
  const Matrix3 j = jacobian(corners, natural);
  const Matrix3 inverse = j.inverse();
  return {j.determinant(), product(inverse, natural)};
}

struct MeanGradients {
  Gradients b;
  double volume;
};

inline MeanGradients mean_gradients(const std::array<Vec3, 8>& corners) {
  MeanGradients m{Gradients::Zero(), 0.0};
  for_gauss_points([&](double xi, double eta, double zeta) {
    const PointGradients at = gradients_at(corners, xi, eta, zeta);
    m.b += at.det * at.g;
    m.volume += at.det;
  });
  m.b /= m.volume;
  return m;
}

// Strain rows xx, yy, zz, 2xy, 2yz, 2xz of one gradient vector acting on a vector amplitude.
inline Eigen::Matrix<double, 6, 3> strain_rows(const Eigen::Vector3d& g) {
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

inline Eigen::Matrix<double, 6, 6> elasticity(const Elastic& m) {
  Eigen::Matrix<double, 6, 6> c = Eigen::Matrix<double, 6, 6>::Zero();
  c.topLeftCorner<3, 3>().setConstant(m.lambda);
  for (int i = 0; i < 3; ++i) {
    c(i, i) += 2 * m.mu;
    c(i + 3, i + 3) = m.mu;
  }
  return c;
}

// Hourglass patterns on the eight corners: even (eta zeta), odd (xi eta, xi zeta, xi eta zeta).
inline Eigen::Matrix<double, 8, 4> hourglass_patterns() {
  Eigen::Matrix<double, 8, 4> h;
  for (int a = 0; a < 8; ++a) {
    const int k = a % 4;
    h(a, 0) = kEtaZeta[k];
    h(a, 1) = xi_of(a) * kEta[k];
    h(a, 2) = xi_of(a) * kZeta[k];
    h(a, 3) = xi_of(a) * kEtaZeta[k];
  }
  return h;
}

inline Eigen::Matrix<double, 8, 3> positions(const std::array<Vec3, 8>& corners) {
  Eigen::Matrix<double, 8, 3> x;
  for (int a = 0; a < 8; ++a) x.row(a) << corners[a].x, corners[a].y, corners[a].z;
  return x;
}

// Amplitudes 3 l + i (component i of pattern l) in the order in which hourglass_forces gathers them.
constexpr std::array<int, 5> kEvenAmplitudes{1, 2, 3, 6, 9};
constexpr std::array<int, 7> kOddAmplitudes{0, 4, 5, 7, 8, 10, 11};

/// Rows and columns `order` of a symmetric matrix: their upper triangle, row by row. Returns the end.
template <class Matrix, std::size_t N, class To>
To pack_upper(const Matrix& from, const std::array<int, N>& order, To to) {
  for (std::size_t i = 0; i < N; ++i)
    for (std::size_t j = i; j < N; ++j) *to++ = from(order[i], order[j]);
  return to;
}

/// Displacements of unit hourglass amplitudes, q_l = 1: column 3 l + i for component i of pattern l, rows 3 a + i. They
/// have no mean gradient.
inline Eigen::Matrix<double, 24, 12> unit_hourglass_modes(const std::array<Vec3, 8>& corners,
                                                          const MeanGradients& mean) {
  const Eigen::Matrix<double, 8, 4> h = hourglass_patterns();
  const Eigen::Matrix<double, 8, 3> x = positions(corners);
  const Eigen::Matrix<double, 8, 4> gamma = h - transposed_product(mean.b, transposed_product(x, h));
  const Eigen::Matrix<double, 8, 4> phi = h - product(x, product(mean.b, h));
  const Eigen::Matrix4d overlap = transposed_product(gamma, phi);
  const Eigen::Matrix4d amplitude = overlap.inverse();  // phi * amplitude has unit hourglass amplitudes
  const Eigen::Matrix<double, 8, 4> unit = product(phi, amplitude);
  Eigen::Matrix<double, 24, 12> modes = Eigen::Matrix<double, 24, 12>::Zero();
  for (int l = 0; l < 4; ++l)
    for (int i = 0; i < 3; ++i)
      for (int a = 0; a < 8; ++a) modes(3 * a + i, 3 * l + i) = unit(a, l);
  return modes;
}

/// Strain rows of the bubbles 1 - xi^2 in xi, eta, zeta, with their amplitudes as columns (3 n + i): gradients with the
/// centre's Jacobian, so that their mean over the element vanishes (Taylor's correction).
inline Eigen::Matrix<double, 6, 9> bubble_strains(const Matrix3& j0_inverse, double det_ratio, double xi, double eta,
                                                  double zeta) {
  Eigen::Matrix<double, 6, 9> m;
  const double bubbles[3] = {-2 * xi, -2 * eta, -2 * zeta};
  for (int n = 0; n < 3; ++n)
    m.middleCols<3>(3 * n) = strain_rows(Eigen::Vector3d(j0_inverse.col(n) * (bubbles[n] * det_ratio)));
  return m;
}

/// visit(det, b, m) at every Gauss point: the Jacobian's determinant, strain rows of the corners' displacements (3 a +
/// i) and of the bubbles (bubble_strains).
template <class Visit>
void for_gauss_strains(const std::array<Vec3, 8>& corners, Visit&& visit) {
  const Matrix3 j0_inverse = jacobian(corners, natural_gradients(0, 0, 0)).inverse();
  const double det0 = 1.0 / j0_inverse.determinant();
  for_gauss_points([&](double xi, double eta, double zeta) {
    const PointGradients at = gradients_at(corners, xi, eta, zeta);
    Matrix6x24 b;
    for (int a = 0; a < 8; ++a) b.middleCols<3>(3 * a) = strain_rows(at.g.col(a));
    visit(at.det, b, bubble_strains(j0_inverse, det0 / at.det, xi, eta, zeta));
  });
}

}  // namespace railstrata::hex
