#include "crack/level_crack.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "crack/gauss.hpp"
#include "crack/jump_waves.hpp"

namespace railstrata {
namespace {

constexpr double kNear = 1.0 / 16;

/// The length that points and waves resolve.
double resolved(const CrackLine& line) { return std::min(line.length, 4 * line.depth); }

/// (T/k, S/k) by (U, W).
Eigen::Matrix2d tractions(const CutBody& cut, double depth, double k) {
  const JumpStress s = JumpWaves(cut, k).stress(cut.jump, depth);
  Eigen::Matrix2d out;
  out << s.row(2), s.row(1);
  return out / k;
}

/// Of metals without end on either side of the cut.
Eigen::Matrix2d far_from_all(const CutBody& cut, double depth) {
  double thinnest = depth;
  for (const Slab& s : cut.slabs)
    if (s.thickness > 0) thinnest = std::min(thinnest, s.thickness);
  return tractions(cut, depth, 40 / thinnest);
}

struct Waves {
  std::vector<double> k, weight;
};
Waves waves_to(double last, double reach, double length) {
  Waves out;
  for (double low = 0, high = 0.25 / reach; low < last; low = high, high += std::min(high, 6 / length))
    for (const GaussPoint& g : kGauss8) {
      out.k.push_back(low + (high - low) * g.node);
      out.weight.push_back((high - low) * g.weight / std::numbers::pi);
    }
  return out;
}

}  // namespace

double strip_release(const HalfSpaceMaterial& layer, double thickness, double tension) {
  return tension * tension * thickness * (1 - layer.poisson * layer.poisson) / (2 * layer.young);
}

// A Gaussian of standard width s in place of a point's β: its wave at the tip has the phase of L = s/e² (to the order
// of ε, by the closed form of a crack between two half-planes; level_crack_test.cpp).
double reference_length(const CrackLine& line) { return kNear * resolved(line) * std::exp(-2.0); }

int level_points(const CrackLine& line, int points) {
  return static_cast<int>(std::ceil(points * line.length / resolved(line)));
}

LevelCrack level_crack(const LayeredHalfSpace& body, const CrackLine& line, const CrackRule& rule) {
  const CutBody cut = cut_at(body, line.depth);
  const Eigen::Matrix2d far = far_from_all(cut, line.depth);
  const double near = kNear * resolved(line);
  double reach = std::max(line.length, line.depth);
  for (const Slab& s : cut.slabs) reach = std::max(reach, s.top);
  const Waves waves = waves_to(6 / near, reach, line.length);
  const auto n = rule.point.size(), nodes = rule.node.size(), count = static_cast<Eigen::Index>(waves.k.size());
  // sums over waves of sin and cos k (x - x') by the products of those of x and x'
  Eigen::MatrixXd sin_at(n, count), cos_at(n, count), sin_from(nodes, count), cos_from(nodes, count);
  Eigen::MatrixXd by_wave(4, count);  // xz by x, zz by z (of sin), zz by x, xz by z (of cos)
  for (Eigen::Index i = 0; i < count; ++i) {
    const double k = waves.k[static_cast<std::size_t>(i)], decay = std::exp(-0.5 * k * k * near * near);
    const Eigen::ArrayXd at = k * line.length * rule.point.array(), from = k * line.length * rule.node.array();
    sin_at.col(i) = at.sin();
    cos_at.col(i) = at.cos();
    sin_from.col(i) = from.sin();
    cos_from.col(i) = from.cos();
    Eigen::Matrix2d m = tractions(cut, line.depth, k) - far;
    m(0, 1) += decay * far(0, 1);
    m(1, 0) += decay * far(1, 0);
    by_wave.col(i) = waves.weight[static_cast<std::size_t>(i)] * Eigen::Vector4d(-m(0, 0), -m(1, 1), m(1, 0), -m(0, 1));
  }
  const auto of_sin = [&](Eigen::Index row) -> Eigen::MatrixXd {
    const auto w = by_wave.row(row).asDiagonal();
    Eigen::MatrixXd out = sin_at * w * cos_from.transpose() - cos_at * w * sin_from.transpose();
    for (Eigen::Index k = 0; k < n; ++k)
      for (Eigen::Index j = 0; j < nodes; ++j)
        out(k, j) -= far(row, row) / (std::numbers::pi * line.length * (rule.point[k] - rule.node[j]));
    return out * rule.density;
  };
  const auto of_cos = [&](Eigen::Index row) -> Eigen::MatrixXd {
    const auto w = by_wave.row(row).asDiagonal();
    return (cos_at * w * cos_from.transpose() + sin_at * w * sin_from.transpose()) * rule.density;
  };
  LevelCrack out{-4 * far(0, 0), Eigen::MatrixXd(2 * n, 2 * n)};
  out.stiffness << -of_sin(1), -of_cos(2), -of_cos(3), -of_sin(0);
  return out;
}

}  // namespace railstrata
