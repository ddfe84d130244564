#include "halfspace/layered.hpp"

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <string>

#include "core/faults.hpp"
#include "halfspace/layer_waves.hpp"

namespace railstrata {

// The surface state (U, W; T/k, S/k) of the two waves gives u = D a and traction = B a with the amplitudes a, hence
// u = -D B^-1 traction (tractions act on the body, stresses on its cut). By reciprocity the coupling is the same both
// ways; the mean of the two takes out round-off.
CompliancePoint layered_compliance_at(const LayeredHalfSpace& body, double k) {
  const LayerWaves waves(body, k);
  const WaveState s = waves.state(0, 0);
  const Eigen::Matrix2d displacement = s.topRows<2>();  // U, W
  const Eigen::Matrix2d by_traction =
      -displacement * s.bottomRows<2>().inverse();  // columns: tangential (T), normal (S)
  const ShearState t = waves.shear_state(0, 0);
  return {by_traction(1, 1), 0.5 * (by_traction(0, 1) + by_traction(1, 0)), by_traction(0, 0), -t[0] / t[1]};
}

namespace {

using Four = Eigen::Matrix<double, 1, 4>;
using Compliances = Eigen::Matrix<double, Eigen::Dynamic, 4>;
Four four(const CompliancePoint& c) { return {c.zz, c.rz, c.rr, c.tt}; }

// Without interfaces between equal materials: a reflection there would be round-off, and a body of equal layers is
// recognised as homogeneous.
LayeredHalfSpace merged(const LayeredHalfSpace& body) {
  LayeredHalfSpace out{{}, body.substrate};
  for (const HalfSpaceLayer& layer : body.layers) {
    if (layer.thickness <= 0) continue;
    if (!out.layers.empty() && out.layers.back().material == layer.material)
      out.layers.back().thickness += layer.thickness;
    else
      out.layers.push_back(layer);
  }
  while (!out.layers.empty() && out.layers.back().material == out.substrate) out.layers.pop_back();
  return out;
}

struct Samples {
  Eigen::VectorXd k;
  Compliances c;
};
// At n wave numbers spaced geometrically.
Samples sample(const LayeredHalfSpace& body, double k_low, double k_high, int n) {
  Samples s{Eigen::VectorXd(n), Compliances(n, 4)};
  for (int i = 0; i < n; ++i) {
    s.k[i] = k_low * std::pow(k_high / k_low, static_cast<double>(i) / (n - 1));
    s.c.row(i) = four(layered_compliance_at(body, s.k[i]));
  }
  return s;
}

// exp(-k_i d_j): what image j adds at wave number i per unit coefficient.
Eigen::MatrixXd exponentials(const Eigen::VectorXd& k, const Eigen::VectorXd& depth) {
  return (-(k * depth.transpose())).array().exp().matrix();
}

/// Largest relative deviation of a fit from the compliances; the search ends at the first one above `enough`. The
/// coupling may pass through zero: it counts over the geometric mean of the two that it couples.
double largest_deviation(const Samples& s, const Four& top, const Eigen::VectorXd& depth,
                         const Compliances& coefficient, double enough) {
  constexpr Eigen::Index kTogether = 32;
  double largest = 0;
  for (Eigen::Index first = 0; first < s.k.size() && !(largest > enough); first += kTogether) {
    const Eigen::Index count = std::min(kTogether, s.k.size() - first);
    const Compliances c = s.c.middleRows(first, count);
    Compliances size = c;
    size.col(1) = c.col(0).cwiseProduct(c.col(2)).cwiseSqrt();
    const Compliances deviation = (c.rowwise() - top) - exponentials(s.k.segment(first, count), depth) * coefficient;
    largest = std::max(largest, deviation.cwiseQuotient(size).cwiseAbs().maxCoeff());
  }
  return largest;
}

/// Depths nearest, nearest ratio, nearest ratio², … of `count` images.
struct DepthLadder {
  double nearest, ratio;
  int count;
  Eigen::VectorXd depths() const {
    Eigen::VectorXd d(count);
    for (int j = 0; j < count; ++j) d[j] = nearest * std::pow(ratio, j);
    return d;
  }
};

/// From few images to many: a moderate stack needs about fifteen, an extreme one fifty.
std::vector<DepthLadder> ladders(double nearest, double total) {
  std::vector<DepthLadder> all;
  for (double farthest : {20.0, 100.0, 400.0, 2000.0})
    for (double ratio : {2.2, 1.9, 1.7, 1.5, 1.35, 1.25, 1.18, 1.12})
      all.push_back({nearest, ratio, 1 + static_cast<int>(std::log(farthest * total / nearest) / std::log(ratio))});
  std::stable_sort(all.begin(), all.end(),
                   [](const DepthLadder& a, const DepthLadder& b) { return a.count < b.count; });
  return all;
}

}  // namespace

// Fits c(k) - c_top = sum over j of a_j exp(-k d_j) by least squares, all four compliances with the same depths d_j.
// The matrix of exponentials is nearly singular by nature: the complete orthogonal decomposition gives the smallest
// coefficients. The fit is judged at other wave numbers than it was made at. Below k_low the stack is thinner than 1e-5
// wave lengths (the substrate), above k_high only the top material is felt (exp(-60)).
SurfaceCompliance layered_compliance(const LayeredHalfSpace& given, double tolerance) {
  const LayeredHalfSpace body = merged(given);
  if (body.layers.empty()) return homogeneous_compliance(body.substrate);
  double total = 0, thinnest = body.layers.front().thickness;
  for (const HalfSpaceLayer& l : body.layers) {
    total += l.thickness;
    thinnest = std::min(thinnest, l.thickness);
  }

  SurfaceCompliance out = homogeneous_compliance(body.layers.front().material);
  const Four top = four(out[0].c);
  const double k_low = 1e-5 / total, k_high = 60 / thinnest;
  const Samples fit = sample(body, k_low, k_high, 400), check = sample(body, k_low, k_high, 1013);
  // relative to the compliance itself: a soft layer's 1/k is as exact as the stiff substrate's
  const Eigen::VectorXd weight = fit.c.col(0).cwiseInverse();
  double best = std::numeric_limits<double>::infinity();
  for (const DepthLadder& ladder : ladders(0.4 * thinnest, total)) {
    const Eigen::VectorXd depth = ladder.depths();
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> qr;
    qr.setThreshold(1e-15);
    qr.compute(weight.asDiagonal() * exponentials(fit.k, depth));
    const Compliances coefficient = qr.solve(weight.asDiagonal() * (fit.c.rowwise() - top));
    const double deviation = largest_deviation(check, top, depth, coefficient, tolerance);
    best = std::min(best, deviation);
    if (deviation > tolerance) continue;
    for (int j = 0; j < depth.size(); ++j)
      out.push_back({depth[j], {coefficient(j, 0), coefficient(j, 1), coefficient(j, 2), coefficient(j, 3)}});
    return out;
  }
  throw NumericalError("the compliance of the layer stack is represented only to a relative deviation of " +
                       std::to_string(best));
}

std::vector<LayerExtent> layer_extents(const LayeredHalfSpace& body) {
  std::vector<LayerExtent> out;
  double top = 0;
  bool goes_on = false;
  for (const HalfSpaceLayer& layer : body.layers) {
    const double bottom = top + layer.thickness;
    if (goes_on)
      out.back().bottom = bottom;
    else
      out.push_back({top, bottom});
    goes_on = layer.continues;
    top = bottom;
  }
  return out;
}

std::vector<HalfSpaceLayer> cut_into_layers(const std::vector<GradedPoint>& table, double tolerance) {
  assert(tolerance > 0);
  if (table.size() < 2 || table.front().depth != 0)
    throw CaseError("a graded modulus needs at least two depths, and the first must be 0", "add rows to the table");
  std::vector<HalfSpaceLayer> layers;
  for (std::size_t i = 0; i + 1 < table.size(); ++i) {
    const GradedPoint &a = table[i], &b = table[i + 1];
    if (!(b.depth > a.depth)) throw CaseError("the depths of a graded modulus must increase", "sort the rows by depth");
    const double ratio = b.material.young / a.material.young, height = b.depth - a.depth;
    const double young_slope = (b.material.young - a.material.young) / height,
                 poisson_slope = (b.material.poisson - a.material.poisson) / height;
    const int pieces =
        std::max({1, static_cast<int>(std::ceil(std::abs(std::log(ratio)) / std::log1p(tolerance) - 1e-9)),
                  static_cast<int>(std::ceil(std::abs(b.material.poisson - a.material.poisson) / tolerance - 1e-9))});
    // equal steps of ln E
    const auto border = [&](int j) {
      return std::abs(ratio - 1) < 1e-9 ? static_cast<double>(j) / pieces
                                        : (std::pow(ratio, static_cast<double>(j) / pieces) - 1) / (ratio - 1);
    };
    for (int j = 0; j < pieces; ++j) {
      const double t = 0.5 * (border(j) + border(j + 1));
      layers.push_back({height * (border(j + 1) - border(j)),
                        {a.material.young + t * height * young_slope, a.material.poisson + t * height * poisson_slope},
                        true,
                        young_slope,
                        poisson_slope});
    }
  }
  layers.back().continues = false;
  return layers;
}

}  // namespace railstrata
