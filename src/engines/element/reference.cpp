#include "element/reference.hpp"

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>
#include <cmath>

#include "element/element_matrix.hpp"
#include "element/hex_integration.hpp"

namespace railstrata {
namespace {

using namespace hex;

// Gradients of the four patterns' unit amplitudes at a point, direction by pattern.
Eigen::Matrix<double, 3, 4> pattern_gradients(const std::array<Vec3, 8>& corners,
                                              const Eigen::Matrix<double, 24, 12>& modes, double xi, double eta,
                                              double zeta) {
  const Gradients g = gradients_at(corners, xi, eta, zeta).g;
  Eigen::Matrix<double, 3, 4> out;
  for (int l = 0; l < 4; ++l) {
    Eigen::Matrix<double, 8, 1> unit;
    for (int a = 0; a < 8; ++a) unit(a) = modes(3 * a, 3 * l);
    out.col(l) = product(g, unit);
  }
  return out;
}

// Even and odd modes of the incompatible displacements, amplitudes 3 n + i.
constexpr std::array<int, 6> kEvenBubbles{1, 2, 4, 5, 7, 8};
constexpr std::array<int, 3> kOddBubbles{0, 3, 6};

}  // namespace

SweepScale sweep_scale(SweepKind kind, double spacing) {
  if (kind == SweepKind::extrude) return {0.5 * spacing, 1.0};
  return {std::sin(0.5 * spacing), std::cos(0.5 * spacing)};
}

std::array<Vec3, 8> local_corners(SweepKind kind, const std::array<Vec2, 4>& quad, SweepScale scale) {
  std::array<Vec3, 8> x;
  for (int k = 0; k < 4; ++k) {
    const double a = scale.sigma * (kind == SweepKind::extrude ? 1.0 : -quad[k].z);
    x[k] = {-a, quad[k].y, quad[k].z * scale.c};
    x[k + 4] = {a, quad[k].y, quad[k].z * scale.c};
  }
  return x;
}

QuadReference quad_reference(SweepKind kind, const std::array<Vec2, 4>& quad, const Elastic& material) {
  const std::array<Vec3, 8> corners = local_corners(kind, quad, {1.0, 1.0});
  const MeanGradients mean = mean_gradients(corners);
  QuadShape<double> r{};
  r.volume = mean.volume;
  for (int k = 0; k < 4; ++k) {
    r.gx[k] = mean.b(0, k + 4);
    r.gy[k] = mean.b(1, k + 4);
    r.gz[k] = mean.b(2, k + 4);
    const Vec3 x = corners[k + 4];
    r.even_y += 2 * kEtaZeta[k] * x.y;
    r.even_z += 2 * kEtaZeta[k] * x.z;
    r.odd[0] += 2 * kEta[k] * x.x;
    r.odd[1] += 2 * kZeta[k] * x.x;
    r.odd[2] += 2 * kEtaZeta[k] * x.x;
  }
  return {r, material_parameters(material)};
}

HexReference<float> rounded(const QuadReference& r) {
  HexReference<float> out{};
  auto f = [](double x) { return static_cast<float>(x); };
  for (int k = 0; k < 4; ++k) {
    out.shape.gx[k] = f(r.shape.gx[k]);
    out.shape.gy[k] = f(r.shape.gy[k]);
    out.shape.gz[k] = f(r.shape.gz[k]);
  }
  for (int k = 0; k < 3; ++k) out.shape.odd[k] = f(r.shape.odd[k]);
  out.shape.volume = f(r.shape.volume);
  out.shape.even_y = f(r.shape.even_y);
  out.shape.even_z = f(r.shape.even_z);
  out.material = r.material.rounded_to<float>();
  return out;
}

StationScale<double> station_scale(SweepScale scale) {
  return {1 / scale.sigma, 1 / scale.c, scale.sigma * scale.c, scale.sigma, scale.c};
}

Matrix24 incompatible_mode_stiffness(const std::array<Vec3, 8>& corners, const Elastic& material) {
  const Eigen::Matrix<double, 6, 6> c = elasticity(material);
  Matrix24 kuu = Matrix24::Zero();
  Eigen::Matrix<double, 9, 24> kau = Eigen::Matrix<double, 9, 24>::Zero();
  Eigen::Matrix<double, 9, 9> kaa = Eigen::Matrix<double, 9, 9>::Zero();
  for_gauss_strains(corners, [&](double det, const Matrix6x24& b, const Eigen::Matrix<double, 6, 9>& m) {
    const Matrix6x24 stress = product(c, b);
    kuu += det * transposed_product(b, stress);
    kau += det * transposed_product(m, stress);
    kaa += det * transposed_product(m, product(c, m));
  });
  const Eigen::Matrix<double, 9, 24> follow = kaa.ldlt().solve(kau);
  return kuu - transposed_product(kau, follow);
}

HourglassStiffness hourglass_stiffness(SweepKind kind, const std::array<Vec2, 4>& quad, SweepScale scale,
                                       const Elastic& material, ElementKind element, double kappa) {
  const std::array<Vec3, 8> corners = local_corners(kind, quad, scale);
  const MeanGradients mean = mean_gradients(corners);
  Eigen::Matrix<double, 12, 12> k;
  if (element == ElementKind::one_point) {
    k = Eigen::Matrix<double, 12, 12>::Identity() *
        (kappa * material.p_wave_modulus() * mean.volume * mean.b.squaredNorm() / 8);
  } else {
    const Eigen::Matrix<double, 24, 12> modes = unit_hourglass_modes(corners, mean);
    k = transposed_product(modes, product(incompatible_mode_stiffness(corners, material), modes));
  }
  HourglassStiffness out{};
  pack_upper(k, kOddAmplitudes, pack_upper(k, kEvenAmplitudes, out.begin()));
  return out;
}

std::array<double, 4> corner_masses(SweepKind kind, const std::array<Vec2, 4>& quad, SweepScale scale, double density) {
  const std::array<Vec3, 8> corners = local_corners(kind, quad, scale);
  std::array<double, 4> mass{};
  for_gauss_points([&](double xi, double eta, double zeta) {
    const double det = jacobian(corners, natural_gradients(xi, eta, zeta)).determinant();
    for (int k = 0; k < 4; ++k)
      mass[static_cast<std::size_t>(k)] += 0.5 * density * det * 0.25 * (1 + kEta[k] * eta) * (1 + kZeta[k] * zeta);
  });
  return mass;
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
    hex_forces<SweepKind::revolve, Evaluation::linear>(
        ref, st, Rotation<double>{}, unit_displacement,
        [&](ElementKinematics<double>& kin) { hourglass_forces(entry, kin); }, add_forces);
  }
  return k;
}

double element_stable_step(SweepKind kind, const std::array<Vec2, 4>& quad, SweepScale scale, const Elastic& material,
                           const HourglassStiffness& hourglass) {
  const Matrix24 k = linear_stiffness(quad_reference(kind, quad, material), scale, hourglass);
  const std::array<double, 4> mass = corner_masses(kind, quad, scale, material.density);
  Eigen::Matrix<double, 24, 1> root;
  for (int i = 0; i < 24; ++i) root(i) = 1 / std::sqrt(mass[static_cast<std::size_t>(i / 3 % 4)]);
  const Matrix24 scaled = root.asDiagonal() * k * root.asDiagonal();
  Eigen::SelfAdjointEigenSolver<Matrix24> eigen(0.5 * (scaled + scaled.transpose()), Eigen::EigenvaluesOnly);
  return 2 / std::sqrt(eigen.eigenvalues().maxCoeff());
}

GaussShape<double> gauss_shape(SweepKind kind, const std::array<Vec2, 4>& quad) {
  const std::array<Vec3, 8> corners = local_corners(kind, quad, {1.0, 1.0});
  const MeanGradients mean = mean_gradients(corners);
  const Eigen::Matrix<double, 24, 12> modes = unit_hourglass_modes(corners, mean);
  const Matrix3 j0_inverse = jacobian(corners, natural_gradients(0, 0, 0)).inverse();
  const double det0 = 1.0 / j0_inverse.determinant();
  GaussShape<double> out{};
  for (int p = 0; p < kGaussPairs; ++p) {
    const double xi = kGauss, eta = p & 1 ? kGauss : -kGauss, zeta = p & 2 ? kGauss : -kGauss;
    const double det = jacobian(corners, natural_gradients(xi, eta, zeta)).determinant(), ratio = det0 / det;
    const Eigen::Matrix<double, 3, 4> front = pattern_gradients(corners, modes, xi, eta, zeta);
    const Eigen::Matrix<double, 3, 4> behind = pattern_gradients(corners, modes, -xi, eta, zeta);
    const Eigen::Matrix<double, 3, 4> common = 0.5 * (front + behind);
    GaussPair<double>& g = out.pair[p];
    g.weight = 2 * det / mean.volume;
    g.even_y = common(1, 0);
    g.even_z = common(2, 0);
    for (int m = 0; m < 3; ++m) g.along[m] = common(0, 1 + m);
    const double across[2] = {-2 * eta * ratio, -2 * zeta * ratio};
    for (int n = 0; n < 2; ++n) {
      g.bubble_y[n] = across[n] * j0_inverse(1, 1 + n);
      g.bubble_z[n] = across[n] * j0_inverse(2, 1 + n);
    }
  }
  return out;
}

IncompatibleModes<double> incompatible_modes(SweepKind kind, const std::array<Vec2, 4>& quad, SweepScale scale,
                                             const Elastic& material) {
  const std::array<Vec3, 8> corners = local_corners(kind, quad, scale);
  const Eigen::Matrix<double, 6, 6> c = elasticity(material);
  const Eigen::Matrix<double, 24, 12> modes = unit_hourglass_modes(corners, mean_gradients(corners));
  Eigen::Matrix<double, 9, 9> kaa = Eigen::Matrix<double, 9, 9>::Zero();
  Eigen::Matrix<double, 9, 12> kaq = Eigen::Matrix<double, 9, 12>::Zero();
  for_gauss_strains(corners, [&](double det, const Matrix6x24& b, const Eigen::Matrix<double, 6, 9>& m) {
    const Eigen::Matrix<double, 6, 9> stress = product(c, m);
    kaa += det * transposed_product(m, stress);
    kaq += det * transposed_product(stress, product(b, modes));
  });
  const Eigen::Matrix<double, 9, 12> follow = kaa.ldlt().solve(kaq);
  IncompatibleModes<double> out;
  for (int n = 0; n < 6; ++n)
    for (int j = 0; j < 5; ++j) out.follow_even[n][j] = follow(kEvenBubbles[n], kEvenAmplitudes[j]);
  for (int n = 0; n < 3; ++n)
    for (int j = 0; j < 7; ++j) out.follow_odd[n][j] = follow(kOddBubbles[n], kOddAmplitudes[j]);
  const Eigen::Matrix<double, 9, 9> inverse = kaa.inverse();
  pack_upper(inverse, kEvenBubbles, out.compliance_even);
  pack_upper(inverse, kOddBubbles, out.compliance_odd);
  return out;
}

}  // namespace railstrata
