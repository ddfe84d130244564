#include "section/section_compliance.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/parallel.hpp"
#include "crack/gauss.hpp"
#include "section/wave_factor.hpp"

namespace railstrata {

int station_count(const QuadraticSection& mesh, int columns) {
  return static_cast<int>(mesh.surface.size()) / 2 / columns - 1;
}

Eigen::MatrixXd hat_loads(const QuadraticSection& mesh, int columns, int count) {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(3 * mesh.free_nodes, 3 * count);
  const double spacing = mesh.s[static_cast<std::size_t>(2 * columns)] - mesh.s.front();
  const auto add = [&](std::size_t surface_node, int station, double force) {
    if (station < 0 || station >= count) return;
    for (const auto& [node, share] : mesh.shares[mesh.surface[surface_node]])
      for (int d = 0; d < 3; ++d) out(3 * node + d, 3 * station + d) += share * force;
  };
  for (std::size_t first = 0; first + 2 < mesh.surface.size(); first += 2) {
    const double from = mesh.s[first], length = mesh.s[first + 2] - from;
    for (const GaussPoint& g : kGauss8) {
      const double place = (from + g.node * length - mesh.s.front()) / spacing;
      const int left = static_cast<int>(place) - 1;  // station m stands at m + 1 spacings
      const double right_share = place - std::floor(place), weight = g.weight * length / spacing;
      const std::array<double, 3> shape = shape_on_side(g.node);
      for (std::size_t i = 0; i < 3; ++i) {
        add(first + i, left, weight * shape[i] * (1 - right_share));
        add(first + i, left + 1, weight * shape[i] * right_share);
      }
    }
  }
  return out;
}

SectionCompliance section_compliance(const QuadraticSection& mesh, const SectionStiffness& stiffness, int columns,
                                     const std::vector<double>& k) {
  const int count = station_count(mesh, columns);
  SectionCompliance out;
  out.spacing = mesh.s[static_cast<std::size_t>(2 * columns)] - mesh.s.front();
  for (int m = 0; m < count; ++m)
    out.stations.push_back(mesh.nodes[mesh.surface[static_cast<std::size_t>(2 * columns * (m + 1))]]);
  out.k = k;
  out.at.resize(k.size());
  const WaveFactor::Rows loads = hat_loads(mesh, columns, count);
  if (stiffness.rotation.size() > 0) {
    const Eigen::VectorXd moved = loads.transpose() * WaveFactor(stiffness.at(0)).solve(stiffness.rotation);
    for (int m = 0; m < count; ++m) out.by_rotation.push_back(moved[3 * m + 2]);
  }
  for_each_that_throws(k.size(), [&](std::size_t i) {
    const WaveFactor::Rows half = WaveFactor(stiffness.at(k[i])).half(loads);
    out.at[i] = half.transpose() * half;
  });
  return out;
}

std::vector<Eigen::MatrixXd> half_space_compliance(const LayeredHalfSpace& body, bool above, double spacing, int count,
                                                   const std::vector<double>& k) {
  constexpr double kFarthest = 24;  // over the spacing: the hats' spectrum has fallen to 1e-5 of the integral
  std::vector<Eigen::MatrixXd> out(k.size(), Eigen::MatrixXd::Zero(3 * count, 3 * count));
  const double panel = std::numbers::pi / (spacing * count), far = kFarthest / spacing;
  for_each_that_throws(k.size(), [&](std::size_t i) {
    std::vector<Eigen::Matrix3d> by_offset(static_cast<std::size_t>(count), Eigen::Matrix3d::Zero());
    for (double l0 = 0, l1 = std::min(panel, 0.5 * k[i]); l0 < far; l0 = l1, l1 = l0 + std::min(panel, l0))
      for (const GaussPoint& g : kGauss8) {
        const double l = l0 + g.node * (l1 - l0), n = std::hypot(k[i], l), c = k[i] / n, s = l / n;
        const double half = 0.5 * l * spacing, hat = half > 0 ? std::pow(std::sin(half) / half, 4) : 1;
        const double weight = g.weight * (l1 - l0) * hat / (std::numbers::pi * n);
        const CompliancePoint p = layered_compliance_at(body, n);
        const double rz = above ? -p.rz : p.rz;
        for (int m = 0; m < count; ++m) {
          const double even = weight * std::cos(l * spacing * m), odd = weight * std::sin(l * spacing * m);
          Eigen::Matrix3d& sum = by_offset[static_cast<std::size_t>(m)];
          sum(0, 0) += even * (c * c * p.rr + s * s * p.tt);
          sum(1, 1) += even * (s * s * p.rr + c * c * p.tt);
          sum(2, 2) += even * p.zz;
          sum(0, 2) += even * c * rz;
          sum(0, 1) += odd * c * s * (p.rr - p.tt);
          sum(1, 2) -= odd * s * rz;
        }
      }
    for (Eigen::Matrix3d& sum : by_offset) {
      sum(2, 0) = sum(0, 2);
      sum(1, 0) = -sum(0, 1);
      sum(2, 1) = -sum(1, 2);
    }
    for (int m = 0; m < count; ++m)
      for (int n = 0; n < count; ++n) {
        const Eigen::Matrix3d& sum = by_offset[static_cast<std::size_t>(std::abs(m - n))];
        out[i].block<3, 3>(3 * m, 3 * n) = m >= n ? sum : Eigen::Matrix3d(sum.transpose());
      }
  });
  return out;
}

}  // namespace railstrata
