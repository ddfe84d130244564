#include "halfspace/layered.hpp"

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <initializer_list>
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
    if (!out.layers.empty() && out.layers.back().material == layer.material && !out.layers.back().bond.gives()) {
      out.layers.back().thickness += layer.thickness;
      out.layers.back().bond = layer.bond;
    } else {
      out.layers.push_back(layer);
    }
  }
  while (!out.layers.empty() && out.layers.back().material == out.substrate && !out.layers.back().bond.gives())
    out.layers.pop_back();
  return out;
}

bool gives_anywhere(const LayeredHalfSpace& body) {
  return std::any_of(body.layers.begin(), body.layers.end(), [](const HalfSpaceLayer& l) { return l.bond.gives(); });
}

double plate_modulus(const HalfSpaceMaterial& m) { return m.young / (1 - m.poisson * m.poisson); }

// A smooth layer without end holds no tangential force: springs so soft that it stretches over 1 m hold it.
LayeredHalfSpace held(LayeredHalfSpace body) {
  constexpr double kLength = 1;
  double stiffness = 0;  // of the plate above, in its plane
  for (HalfSpaceLayer& layer : body.layers) {
    stiffness += plate_modulus(layer.material) * layer.thickness;
    if (std::isinf(layer.bond.shear)) layer.bond.shear = kLength * kLength / stiffness;
  }
  return body;
}

/// Length over which the body takes up what presses and pulls on it, m: its thickness, and of interfaces that give
/// bending, stretching sqrt(E' h c_s), and c G of the substrate, beyond which the springs are stiffer than the body.
double spreading_length(const LayeredHalfSpace& body) {
  double depth = 0, stiffness = 0, longest = bending_length(body);
  for (const HalfSpaceLayer& layer : body.layers) {
    depth += layer.thickness;
    stiffness += plate_modulus(layer.material) * layer.thickness;
    longest = std::max({longest, std::sqrt(stiffness * layer.bond.shear),
                        std::max(layer.bond.normal, layer.bond.shear) * body.substrate.shear()});
  }
  return std::max(depth, longest);
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

/// Relative to the compliance itself: a soft layer's 1/k is as exact as the stiff substrate's. each: every column
/// relative to its own, else to zz.
Compliances fitted(const Samples& s, const Four& top, const Eigen::VectorXd& depth, bool each) {
  const Eigen::MatrixXd waves = exponentials(s.k, depth);
  Compliances size = s.c.col(0).replicate<1, 4>(), out(depth.size(), 4);
  if (each) size = s.c;
  size.col(1) = size.col(0).cwiseProduct(size.col(2)).cwiseSqrt();
  for (Eigen::Index first = 0, count = each ? 1 : 4; first < 4; first += count) {
    const Eigen::VectorXd weight = size.col(first).cwiseInverse();
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> qr;
    qr.setThreshold(1e-15);
    qr.compute(weight.asDiagonal() * waves);
    out.middleCols(first, count) = qr.solve(weight.asDiagonal() * (s.c.rowwise() - top).middleCols(first, count));
  }
  return out;
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
std::vector<DepthLadder> ladders(double nearest, std::initializer_list<double> farthest,
                                 std::initializer_list<double> ratios) {
  std::vector<DepthLadder> all;
  for (double deepest : farthest)
    for (double ratio : ratios)
      all.push_back({nearest, ratio, 1 + static_cast<int>(std::log(deepest / nearest) / std::log(ratio))});
  std::stable_sort(all.begin(), all.end(),
                   [](const DepthLadder& a, const DepthLadder& b) { return a.count < b.count; });
  return all;
}

}  // namespace

// Fits c(k) - c_top = sum over j of a_j exp(-k d_j) by least squares, all four compliances with the same depths d_j.
// The matrix of exponentials is nearly singular by nature: the complete orthogonal decomposition gives the smallest
// coefficients. The fit is judged at other wave numbers than it was made at. Below k_low the stack is thinner than 1e-5
// wave lengths (the substrate), above k_high only the top material is felt (exp(-60)). On interfaces that give the four
// compliances differ by orders: each is fitted relative to itself.
SurfaceCompliance layered_compliance(const LayeredHalfSpace& given, double tolerance) {
  constexpr double kSoft = 100;  // tolerances on soft springs: rounding of images thousands of times the compliance
  const LayeredHalfSpace body = held(merged(given));
  if (body.layers.empty()) return homogeneous_compliance(body.substrate);
  double thinnest = body.layers.front().thickness;
  for (const HalfSpaceLayer& l : body.layers) thinnest = std::min(thinnest, l.thickness);

  SurfaceCompliance out = homogeneous_compliance(body.layers.front().material);
  const Four top = four(out[0].c);
  const bool gives = gives_anywhere(body);
  const double length = spreading_length(body), k_low = 1e-5 / length, k_high = 60 / thinnest;
  const double more = gives ? std::log(k_high / k_low) / std::log(6e6) : 1;
  const Samples fit = sample(body, k_low, k_high, static_cast<int>(400 * more)),
                check = sample(body, k_low, k_high, static_cast<int>(1013 * more));
  double best = std::numeric_limits<double>::infinity();
  Eigen::VectorXd depth;
  Compliances coefficient;
  for (const DepthLadder& ladder :
       gives ? ladders(0.4 * thinnest, {2000 * length}, {1.5, 1.35, 1.25, 1.18, 1.12})
             : ladders(0.4 * thinnest, {20 * length, 100 * length, 400 * length, 2000 * length},
                       {2.2, 1.9, 1.7, 1.5, 1.35, 1.25, 1.18, 1.12})) {
    const Eigen::VectorXd depths = ladder.depths();
    const Compliances fitting = fitted(fit, top, depths, gives);
    const double deviation = largest_deviation(check, top, depths, fitting, std::min(best, gives ? best : tolerance));
    if (!(deviation < best)) continue;
    best = deviation;
    depth = depths;
    coefficient = fitting;
    if (best <= tolerance) break;
  }
  if (best > (gives ? kSoft * tolerance : tolerance))
    throw NumericalError("the compliance of the layer stack is represented only to a relative deviation of " +
                         std::to_string(best));
  for (int j = 0; j < depth.size(); ++j)
    out.push_back({depth[j], {coefficient(j, 0), coefficient(j, 1), coefficient(j, 2), coefficient(j, 3)}});
  return out;
}

double bending_length(const LayeredHalfSpace& body) {
  double depth = 0, modulus = 0, longest = 0;
  for (const HalfSpaceLayer& layer : body.layers) {
    depth += layer.thickness;
    modulus = std::max(modulus, plate_modulus(layer.material));
    const double rigidity = modulus * depth * depth * depth / 12;
    if (std::isfinite(layer.bond.normal))
      longest = std::max(longest, std::sqrt(std::sqrt(rigidity * layer.bond.normal)));
  }
  return longest;
}

HalfSpaceMaterial material_at(const LayeredHalfSpace& body, double depth) {
  double top = 0;
  for (const HalfSpaceLayer& layer : body.layers) {
    if (depth <= top + layer.thickness) return layer.local(depth - top);
    top += layer.thickness;
  }
  return body.substrate;
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
