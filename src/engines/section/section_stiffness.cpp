#include "section/section_stiffness.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <map>

#include "core/faults.hpp"
#include "crack/gauss.hpp"

namespace railstrata {

namespace {

using Strains = Eigen::Matrix<double, 6, 24>;
using ElementMatrix = Eigen::Matrix<double, 24, 24>;

struct Shape {
  std::array<double, 8> value, by_a, by_b;
};

/// The eight-node quadrilateral on -1 … 1, corners first.
Shape quadratic_shape(double a, double b) {
  constexpr std::array<double, 4> kA{-1, 1, 1, -1}, kB{-1, -1, 1, 1};
  Shape s;
  for (std::size_t i = 0; i < 4; ++i) {
    const double p = 1 + a * kA[i], q = 1 + b * kB[i], r = a * kA[i] + b * kB[i] - 1;
    s.value[i] = 0.25 * p * q * r;
    s.by_a[i] = 0.25 * kA[i] * q * (r + p);
    s.by_b[i] = 0.25 * kB[i] * p * (r + q);
  }
  for (std::size_t i = 0; i < 4; ++i) {
    const bool along_a = i % 2 == 0;
    const double side = i == 0 || i == 3 ? -1 : 1, across = along_a ? b : a, along = along_a ? a : b;
    const double bump = 0.5 * (1 - along * along), slope = -along * (1 + side * across), rise = bump * side;
    s.value[4 + i] = bump * (1 + side * across);
    s.by_a[4 + i] = along_a ? slope : rise;
    s.by_b[4 + i] = along_a ? rise : slope;
  }
  return s;
}

PointStrains strains_of(const std::array<Vec2, 8>& x, const Shape& s, double radius) {
  Vec2 by_a{}, by_b{}, at{};
  for (std::size_t n = 0; n < 8; ++n) {
    by_a = by_a + s.by_a[n] * x[n];
    by_b = by_b + s.by_b[n] * x[n];
    at = at + s.value[n] * x[n];
  }
  const double det = cross(by_a, by_b);
  if (!(det > 0)) throw NumericalError("an element of the section is turned inside out");
  const bool revolved = radius > 0;
  const double stretch = revolved ? radius / -at.z : 1, turn = revolved ? 1 / -at.z : 0;
  PointStrains out;
  for (int n = 0; n < 8; ++n) {
    const auto i = static_cast<std::size_t>(n);
    const double N = s.value[i], by_y = (s.by_a[i] * by_b.z - s.by_b[i] * by_a.z) / det,
                 by_z = (s.by_b[i] * by_a.y - s.by_a[i] * by_b.y) / det;
    const int U = 3 * n, v = U + 1, w = U + 2;
    out.b0(0, w) = -N * turn;
    out.b0(1, v) = by_y;
    out.b0(2, w) = by_z;
    out.b0(3, v) = by_z;
    out.b0(3, w) = by_y;
    out.b0(4, U) = by_z + N * turn;
    out.b0(5, U) = by_y;
    out.b1(0, U) = -N * stretch;
    out.b1(4, w) = N * stretch;
    out.b1(5, v) = N * stretch;
  }
  out.weight = det / stretch;
  return out;
}

struct ElementStiffness {
  ElementMatrix k0 = ElementMatrix::Zero(), k1 = k0, k2 = k0;
  std::array<double, 8> rotation{};
};

ElementStiffness element_stiffness(const std::array<Vec2, 8>& x, const Elastic& material, double radius) {
  constexpr double kOuter = 0.7745966692414834;  // three points of Gauss's rule
  constexpr std::array<double, 3> kAt{-kOuter, 0, kOuter}, kWeight{5.0 / 9, 8.0 / 9, 5.0 / 9};
  Eigen::Matrix<double, 6, 6> d = Eigen::Matrix<double, 6, 6>::Zero();
  d.topLeftCorner<3, 3>().setConstant(material.lambda);
  d.diagonal() << material.p_wave_modulus(), material.p_wave_modulus(), material.p_wave_modulus(), material.mu,
      material.mu, material.mu;
  ElementStiffness out;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      const Shape shape = quadratic_shape(kAt[i], kAt[j]);
      const PointStrains p = strains_of(x, shape, radius);
      const double weight = p.weight * kWeight[i] * kWeight[j];
      for (std::size_t n = 0; n < 8; ++n)
        for (std::size_t of = 0; of < 8; ++of)
          out.rotation[n] += weight * material.density * shape.value[n] * shape.value[of] * x[of].z;
      const Strains d0 = weight * d * p.b0, d1 = weight * d * p.b1;
      const ElementMatrix mixed = p.b0.transpose() * d1;
      out.k0 += p.b0.transpose() * d0;
      out.k1 += mixed + mixed.transpose();
      out.k2 += p.b1.transpose() * d1;
    }
  return out;
}

using Triplets = std::vector<Eigen::Triplet<double>>;

/// Terms of K0, the others have their places: pads over the width b, k/b ∫ N_i N_j ds, and less the force of the
/// sleeper, which follows the mean height: k²/(k + ballast) m_i m_j, m_i = 1/b ∫ N_i ds.
void add_support(const QuadraticSection& mesh, const RailSupport& support, std::array<Triplets, 3>& entries) {
  const auto add = [&](int row, int column, double value) {
    for (std::size_t j = 0; j < 3; ++j) entries[j].emplace_back(row, column, j == 0 ? value : 0);
  };
  const std::array<double, 3> pad{support.pad_across, support.pad_across, support.pad};
  double width = 0;
  for (const auto& side : mesh.on_pads) width += norm(mesh.nodes[side[2]] - mesh.nodes[side[0]]);
  std::map<int, double> mean;  // of free nodes
  for (const auto& side : mesh.on_pads)
    for (const GaussPoint& g : kGauss8) {
      const double share = g.weight * norm(mesh.nodes[side[2]] - mesh.nodes[side[0]]) / width;
      const std::array<double, 3> shape = shape_on_side(g.node);
      std::map<int, double> here;
      for (std::size_t i = 0; i < 3; ++i)
        for (const auto& [node, part] : mesh.shares[side[i]]) here[node] += part * shape[i];
      for (const auto& [row, a] : here) {
        mean[row] += share * a;
        for (auto b = here.begin(); b != here.end() && b->first <= row; ++b)
          for (int d = 0; d < 3; ++d) add(3 * row + d, 3 * b->first + d, pad[d] * share * a * b->second);
      }
    }
  const double follows = support.pad / (support.pad + support.ballast) * support.pad;
  for (const auto& [row, a] : mean)
    for (auto b = mean.begin(); b != mean.end() && b->first <= row; ++b)
      add(3 * row + 2, 3 * b->first + 2, -follows * a * b->second);
}

}  // namespace

Eigen::SparseMatrix<double> SectionStiffness::at(double k) const {
  Eigen::SparseMatrix<double> out = k0;
  out.coeffs() += k * k1.coeffs() + k * k * k2.coeffs();
  return out;
}

PointStrains point_strains(const std::array<Vec2, 8>& nodes, double a, double b, double radius) {
  return strains_of(nodes, quadratic_shape(a, b), radius);
}

SectionStiffness section_stiffness(const QuadraticSection& mesh, const std::vector<Elastic>& materials, double radius,
                                   const RailSupport& support) {
  std::array<Triplets, 3> entries;
  SectionStiffness out;
  const int size = 3 * mesh.free_nodes;
  if (radius > 0) out.rotation = Eigen::VectorXd::Zero(size);
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const std::array<int, 8>& nodes = mesh.elements[e];
    std::array<Vec2, 8> x;
    std::transform(nodes.begin(), nodes.end(), x.begin(), [&](int n) { return mesh.nodes[n]; });
    const ElementStiffness own = element_stiffness(x, materials[mesh.material[e]], radius);
    for (std::size_t a = 0; radius > 0 && a < 8; ++a)
      for (const auto& [node, share] : mesh.shares[nodes[a]]) out.rotation[3 * node + 2] += share * own.rotation[a];
    for (int a = 0; a < 24; ++a)
      for (const auto& [row_node, row_share] : mesh.shares[nodes[a / 3]])
        for (int b = 0; b < 24; ++b)
          for (const auto& [column_node, column_share] : mesh.shares[nodes[b / 3]]) {
            const int row = 3 * row_node + a % 3, column = 3 * column_node + b % 3;
            if (row < column) continue;
            const double share = row_share * column_share;
            entries[0].emplace_back(row, column, share * own.k0(a, b));
            entries[1].emplace_back(row, column, share * own.k1(a, b));
            entries[2].emplace_back(row, column, share * own.k2(a, b));
          }
  }
  if (!mesh.on_pads.empty()) add_support(mesh, support, entries);
  const std::array<Eigen::SparseMatrix<double>*, 3> parts{&out.k0, &out.k1, &out.k2};
  for (std::size_t j = 0; j < 3; ++j) {
    parts[j]->resize(size, size);
    parts[j]->setFromTriplets(entries[j].begin(), entries[j].end());
  }
  return out;
}

}  // namespace railstrata
