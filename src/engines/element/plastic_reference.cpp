#include "element/plastic_reference.hpp"

#include "element/hex_integration.hpp"

namespace railstrata {
namespace {

using namespace hex;

// Gradients of the four patterns' unit amplitudes at a point, direction by pattern.
Eigen::Matrix<double, 3, 4> pattern_gradients(const std::array<Vec3, 8>& corners,
                                              const Eigen::Matrix<double, 24, 12>& modes, double xi, double eta,
                                              double zeta) {
  const Gradients natural = natural_gradients(xi, eta, zeta);
  const Matrix3 inverse = jacobian(corners, natural).inverse();
  const Gradients g = product(inverse, natural);
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
// Columns 3 l + i of the unit hourglass modes in the order of hourglass_forces.
constexpr std::array<int, 5> kEvenAmplitudes{1, 2, 3, 6, 9};
constexpr std::array<int, 7> kOddAmplitudes{0, 4, 5, 7, 8, 10, 11};

struct BubbleStiffness {
  Eigen::Matrix<double, 9, 9> kaa = Eigen::Matrix<double, 9, 9>::Zero();
  Eigen::Matrix<double, 9, 12> kaq = Eigen::Matrix<double, 9, 12>::Zero();
};

BubbleStiffness bubble_stiffness(const std::array<Vec3, 8>& corners, const Elastic& material) {
  const Eigen::Matrix<double, 6, 6> c = elasticity(material);
  const Eigen::Matrix<double, 24, 12> modes = unit_hourglass_modes(corners, mean_gradients(corners));
  BubbleStiffness out;
  for_gauss_strains(corners, [&](double det, const Matrix6x24& b, const Eigen::Matrix<double, 6, 9>& m) {
    const Eigen::Matrix<double, 6, 9> stress = product(c, m);
    out.kaa += det * transposed_product(m, stress);
    out.kaq += det * transposed_product(stress, product(b, modes));
  });
  return out;
}

template <int N, std::size_t M>
void pack_upper(const Eigen::MatrixXd& from, double (&to)[M]) {
  int e = 0;
  for (int i = 0; i < N; ++i)
    for (int j = i; j < N; ++j) to[e++] = from(i, j);
}

}  // namespace

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
    const Eigen::Matrix<double, 3, 4> common = 0.5 * (front + behind), opposite = 0.5 * (front - behind);
    GaussPair<double>& g = out.pair[p];
    g.weight = det / mean.volume;
    g.even_y = common(1, 0);
    g.even_z = common(2, 0);
    for (int m = 0; m < 3; ++m) {
      g.along[m] = common(0, 1 + m);
      g.odd_y[m] = opposite(1, 1 + m);
      g.odd_z[m] = opposite(2, 1 + m);
    }
    g.bubble_x = -2 * xi * ratio * j0_inverse(0, 0);
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
  const BubbleStiffness k = bubble_stiffness(local_corners(kind, quad, scale), material);
  const Eigen::Matrix<double, 9, 9> inverse = k.kaa.inverse();
  const Eigen::Matrix<double, 9, 12> follow = k.kaa.ldlt().solve(k.kaq);
  IncompatibleModes<double> out;
  for (int n = 0; n < 6; ++n)
    for (int j = 0; j < 5; ++j) out.follow_even[n][j] = follow(kEvenBubbles[n], kEvenAmplitudes[j]);
  for (int n = 0; n < 3; ++n)
    for (int j = 0; j < 7; ++j) out.follow_odd[n][j] = follow(kOddBubbles[n], kOddAmplitudes[j]);
  Eigen::MatrixXd even(6, 6), odd(3, 3);
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) even(i, j) = inverse(kEvenBubbles[i], kEvenBubbles[j]);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) odd(i, j) = inverse(kOddBubbles[i], kOddBubbles[j]);
  pack_upper<6>(even, out.compliance_even);
  pack_upper<3>(odd, out.compliance_odd);
  return out;
}

}  // namespace railstrata
