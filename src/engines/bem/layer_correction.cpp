#include "bem/layer_correction.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace railstrata {

namespace {

using Complex = std::complex<double>;
constexpr int kNodes = 240;
constexpr std::size_t kMostPlanes = 6;
constexpr std::array<double WaveResponse::*, 10> kResponse{
    &WaveResponse::kU_p, &WaveResponse::kW_p, &WaveResponse::T_p, &WaveResponse::S_p, &WaveResponse::kU_q,
    &WaveResponse::kW_q, &WaveResponse::T_q,  &WaveResponse::S_q, &WaveResponse::kV,  &WaveResponse::Q};

/// `extents` times the grid, up to twice that for thick or loose layers, whose strains reach farther. Those of a line
/// contact reach still farther, and its waves run along x alone.
double period_of(const LayeredHalfSpace& body, const PatchGrid& g, double extents) {
  constexpr double kFarther = 8;
  double thickness = bending_length(body),
         least = g.line ? extents * g.nx * g.dx : extents * std::max(g.nx * g.dx, g.ny * g.dy);
  const double most = 2 * least;
  for (const HalfSpaceLayer& layer : body.layers) {
    thickness += layer.thickness;
    if (layer.bond.shear > 0) least = most;
  }
  if (g.line) return kFarther * std::max(8 * thickness, least);
  return std::clamp(8 * thickness, least, most);
}

/// sin(k d/2)/(k d/2) at the wave numbers 0, 1, … n - 1 times `unit` for cells of a size d.
std::vector<double> steps(int n, double unit, double size) {
  std::vector<double> out{1};
  for (int i = 1; i < n; ++i) {
    const double k = unit * i, half = 0.5 * k * size;
    out.push_back(half > 0 ? std::sin(half) / half : 1.0);
  }
  return out;
}

}  // namespace

// Amplitudes of the two surface waves from unit tractions at the surface, then the state at the depth.
WaveResponse wave_response(const LayerWaves& waves, std::size_t layer, double depth) {
  const WaveState top = waves.state(0, 0), s = waves.state(layer, depth);
  // amplitudes for S/k = -1 (unit pressure) and T/k = -1 (unit radial traction), times k
  const double t1 = top(2, 0), t2 = top(2, 1), s1 = top(3, 0), s2 = top(3, 1), det = t1 * s2 - t2 * s1;
  const Eigen::Vector2d p{t2 / det, -t1 / det}, q{-s2 / det, s1 / det};
  const Eigen::Vector4d by_p = s * p, by_q = s * q;
  const ShearState v0 = waves.shear_state(0, 0), v = waves.shear_state(layer, depth);
  return {by_p[0], by_p[1], by_p[2], by_p[3], by_q[0], by_q[1], by_q[2], by_q[3], -v[0] / v0[1], -v[1] / v0[1]};
}

LayerCorrection::LayerCorrection(const LayeredHalfSpace& body, const PatchGrid& g, double period)
    : grid_(g),
      fft_(static_cast<int>(period_of(body, g, period) / (2 * g.dx)),
           g.line ? 1 : static_cast<int>(period_of(body, g, period) / (2 * g.dy))),
      unit_x_(2 * std::numbers::pi / (fft_.mx() * g.dx)),
      unit_y_(g.line ? 0 : 2 * std::numbers::pi / (fft_.my() * g.dy)) {
  const double low = 1e-3 * (g.line ? unit_x_ : std::min(unit_x_, unit_y_)),
               high = std::numbers::pi * (g.line ? 1 / g.dx : std::hypot(1 / g.dx, 1 / g.dy)) * 1.01;
  log_low_ = std::log(low);
  log_step_ = (std::log(high) - log_low_) / (kNodes - 1);
  const LayeredHalfSpace homogeneous{{}, body.substrate};
  for (int i = 0; i < kNodes; ++i) {
    const double k = std::exp(log_low_ + i * log_step_);
    stack_.emplace_back(body, k);
    plain_.emplace_back(homogeneous, k);
  }
}

double LayerCorrection::points_of(const LayeredHalfSpace& body, const PatchGrid& g, double period) {
  const double along = period_of(body, g, period) / g.dx;
  return g.line ? along : along * along * g.dx / g.dy;
}

LayerCorrection::Nodes LayerCorrection::nodes(double depth, bool below_interface) const {
  Nodes out(kNodes);
  const std::size_t layer = stack_.front().layer_at(depth, below_interface);
  for (std::size_t i = 0; i < kNodes; ++i) {
    const WaveResponse a = wave_response(stack_[i], layer, depth), b = wave_response(plain_[i], 0, depth);
    for (auto m : kResponse) out[i].*m = a.*m - b.*m;
  }
  return out;
}

LayerCorrection::Means LayerCorrection::means_of(const Nodes& node, int power) const {
  if (grid_.line) return {mean_along(node), {}};
  const double unit = std::sqrt(unit_x_ * unit_y_), cut = 4 * unit;
  const auto add = [&](double weight_x, double weight_y, double k, Means& to) {
    const WaveResponse w = between(node, k);
    const double weight = std::exp(-k * k / (cut * cut)) / (power == 0 ? 1.0 : k);
    for (auto m : kResponse) {
      to.x.*m += weight_x * weight * w.*m;
      to.y.*m += weight_y * weight * w.*m;
    }
  };
  Means out;
  constexpr int reach = 20;
  for (int i = 0; i <= reach; ++i)
    for (int j = i == 0 ? 1 : 0; j <= reach; ++j) {  // one quadrant stands for four
      const double kx = i * unit_x_, ky = j * unit_y_, k2 = kx * kx + ky * ky,
                   count = (i == 0 ? 1.0 : 2.0) * (j == 0 ? 1.0 : 2.0);
      add(-count * kx * kx / k2, -count * ky * ky / k2, std::sqrt(k2), out);
    }
  constexpr double step = 0.02;  // of ln k; ∫ pi k² f dln k each
  for (double t = log_low_; t < std::log(reach * unit); t += step) {
    const double weight = std::numbers::pi * std::exp(2 * t) * step / (unit * unit);
    add(weight, weight, std::exp(t), out);
  }
  return out;
}

/// The same of waves along x alone, power 0.
WaveResponse LayerCorrection::mean_along(const Nodes& node) const {
  WaveResponse out;
  const auto add = [&](double weight, double k) {
    const WaveResponse w = between(node, k);
    const double cut = std::exp(-k * k / (16 * unit_x_ * unit_x_));
    for (auto m : kResponse) out.*m += weight * cut * w.*m;
  };
  constexpr int reach = 20;
  for (int i = 1; i <= reach; ++i) add(-2, i * unit_x_);
  constexpr double step = 0.02;  // of ln k; 2 ∫ k f dln k
  for (double t = log_low_; t < std::log(reach * unit_x_); t += step)
    add(2 * std::exp(t) * step / unit_x_, std::exp(t));
  return out;
}

/// Adds to planes of the grid what the layers change. wave(P, X, Y, cx, cy, k, response, z): the quantities z under
/// loads (P, X, Y) of the wave vector k (cx, cy); zero(P, X, Y, z): of the mean.
template <class Planes, class Wave, class Zero>
void LayerCorrection::add_waves(const PlaneLoads& loads, const Nodes& node, Planes& to, Wave&& wave,
                                Zero&& zero) const {
  const int nx = grid_.nx, ny = grid_.ny, mx = fft_.mx(), my = fft_.my();
  const std::size_t pitch = static_cast<std::size_t>(fft_.ny()), n = static_cast<std::size_t>(fft_.nx()) * pitch;
  const Plane* const load[3] = {&loads.p, &loads.q_x, &loads.q_y};
  Plane spread[3];
  for (std::size_t l = 0; l < 3; ++l) {
    spread[l].assign(n, 0.0);
    for (int i = 0; i < nx; ++i)
      std::copy_n(load[l]->begin() + static_cast<std::ptrdiff_t>(grid_.index(i, 0)), ny,
                  spread[l].begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(i) * pitch));
  }
  // The loads are steps, one a cell, as in the closed form: their transform is that of the values times
  // sin(k d/2)/(k d/2) in each direction.
  const std::vector<double> step_x = steps(mx / 2 + 1, unit_x_, grid_.dx),
                            step_y = steps(my / 2 + 1, unit_y_, grid_.dy);
  const double scale = 1 / points(), shortest = largest_wave_number(node);
  Planes wide;
  const std::vector<double*> out = cleared(wide, n);
  fft_.apply({spread[0].data(), spread[1].data(), spread[2].data()}, out, nx,
             [&](std::size_t first, int count, const PlaneFft::Spectra& z) {
               const int j = static_cast<int>(first / static_cast<std::size_t>(count));
               const double ky = unit_y_ * j;
               std::array<Complex, kMostPlanes> value;
               for (int i = 0; 2 * i <= mx; ++i) {  // waves to both sides of x have the same response
                 const double kx = unit_x_ * i, k = std::hypot(kx, ky), weight = scale * step_x[i] * step_y[j];
                 const bool counts =
                     2 * i < mx && (grid_.line || 2 * j < my) && k <= shortest;  // the highest have no direction
                 const WaveResponse w = counts && k > 0 ? between(node, k) : WaveResponse{};
                 for (const int sign : {1, -1}) {
                   if (sign < 0 && (i == 0 || 2 * i == mx)) continue;
                   const int e = sign > 0 ? i : mx - i;
                   const Complex P = weight * z[0][e], X = weight * z[1][e], Y = weight * z[2][e];
                   if (k == 0)
                     zero(P, X, Y, value);
                   else if (counts)
                     wave(P, X, Y, sign * kx / k, ky / k, k, w, value);
                   else
                     value.fill(0);
                   for (std::size_t s = 0; s < out.size(); ++s) z[s][e] = value[s];
                 }
               }
             });
  const auto target = planes_of(to), from = planes_of(wide);
  for (std::size_t s = 0; s < target.size(); ++s)
    for (int i = 0; i < nx; ++i)
      for (int j = 0; j < ny; ++j)
        (*target[s])[grid_.index(i, j)] +=
            (*from[s])[static_cast<std::size_t>(i) * pitch + static_cast<std::size_t>(j)];
}

/// Waves beyond it do not reach down to where the responses are: all are less than rounding of the largest.
double LayerCorrection::largest_wave_number(const Nodes& node) const {
  constexpr double kNothing = 1e-22;
  int last = -1;
  for (auto m : kResponse) {
    double most = 0;
    for (const WaveResponse& w : node) most = std::max(most, std::abs(w.*m));
    for (int i = kNodes - 1; i > last; --i)
      if (!(std::abs(node[static_cast<std::size_t>(i)].*m) <= kNothing * most)) last = i;
  }
  constexpr int kReach = 6;  // nodes of an interpolation
  return std::exp(log_low_ + (last + kReach) * log_step_);
}

/// Lagrange's polynomial of the fifth order in ln k through the six nodes around k.
WaveResponse LayerCorrection::between(const Nodes& node, double k) const {
  const double s = (std::log(k) - log_low_) / log_step_;
  const int i = std::clamp(static_cast<int>(s) - 2, 0, kNodes - 6);
  const double t = s - i, d[6] = {t, t - 1, t - 2, t - 3, t - 4, t - 5}, d01 = d[0] * d[1], d45 = d[4] * d[5],
               d012 = d01 * d[2], d345 = d[3] * d45;
  const double w[6] = {-d[1] * d[2] * d345 / 120, d[0] * d[2] * d345 / 24,  -d01 * d345 / 12,
                       d012 * d45 / 12,           -d012 * d[3] * d[5] / 24, d012 * d[3] * d[4] / 120};
  WaveResponse out;
  for (int l = 0; l < 6; ++l)
    for (auto m : kResponse) out.*m += w[l] * node[i + l].*m;
  return out;
}

// Layered minus homogeneous, wave by wave. k^ = (cx, cy) is the direction of the wave; along = -i k^·q and across =
// k^⊥·q are the tractions in its axes (layer_waves.hpp: sigma_x'z = i T).
void LayerCorrection::add(const PlaneLoads& loads, bool below_interface, StatePlane& to) const {
  const Nodes node = nodes(to.depth, below_interface);
  const Means mean = means_of(node);
  const auto wave = [](Complex P, Complex X, Complex Y, double cx, double cy, double, const WaveResponse& w,
                       std::array<Complex, kMostPlanes>& z) {
    const Complex I(0, 1), along = -I * (cx * X + cy * Y), across = cx * Y - cy * X;
    const Complex kU = w.kU_p * P + w.kU_q * along, T = w.T_p * P + w.T_q * along, S = w.S_p * P + w.S_q * along;
    const Complex kV = w.kV * across, Q = w.Q * across;
    // u = i k^ U + k^⊥ V with k^⊥ = (-cy, cx); strains i k u, tractions i k^ T + k^⊥ Q
    z = {-cx * cx * kU - I * cx * cy * kV,
         -cy * cy * kU + I * cx * cy * kV,
         -cx * cy * kU + 0.5 * I * (cx * cx - cy * cy) * kV,
         I * cx * T - cy * Q,
         I * cy * T + cx * Q,
         S};
  };
  const auto zero = [&](Complex P, Complex X, Complex Y, std::array<Complex, kMostPlanes>& z) {
    z = {-mean.x.kU_p * P,
         -mean.y.kU_p * P,
         0,
         (mean.x.T_q + mean.y.Q) * X,
         (mean.y.T_q + mean.x.Q) * Y,
         (mean.x.S_p + mean.y.S_p) * P};
  };
  add_waves(loads, node, to, wave, zero);
}

void LayerCorrection::add(const PlaneLoads& loads, bool below_interface, DisplacementPlane& to) const {
  const Nodes node = nodes(to.depth, below_interface);
  const Means mean = means_of(node, 1), slope = means_of(node);
  const auto wave = [](Complex P, Complex X, Complex Y, double cx, double cy, double k, const WaveResponse& w,
                       std::array<Complex, kMostPlanes>& z) {
    const Complex I(0, 1), along = -I * (cx * X + cy * Y), across = cx * Y - cy * X;
    const Complex U = (w.kU_p * P + w.kU_q * along) / k, W = (w.kW_p * P + w.kW_q * along) / k, V = w.kV * across / k;
    z = {I * cx * U - cy * V, I * cy * U + cx * V, W};
  };
  const auto zero = [&](Complex P, Complex X, Complex Y, std::array<Complex, kMostPlanes>& z) {
    z = {(mean.x.kU_q + mean.y.kV) * X, (mean.y.kU_q + mean.x.kV) * Y, (mean.x.kW_p + mean.y.kW_p) * P};
  };
  add_waves(loads, node, to, wave, zero);
  // the images' strain as a displacement from each load: e p (x - x'), and the tilt t q·(x - x')
  double p = 0, px = 0, py = 0;
  double qx = 0, qy = 0, qx_x = 0, qy_y = 0;
  for (std::size_t k = 0; k < grid_.size(); ++k) {
    const double x = grid_.x_of(k), y = grid_.y_of(k);
    p += loads.p[k];
    px += loads.p[k] * x;
    py += loads.p[k] * y;
    qx += loads.q_x[k];
    qx_x += loads.q_x[k] * x;
    qy += loads.q_y[k];
    qy_y += loads.q_y[k] * y;
  }
  const double share = 1 / points();
  for (std::size_t k = 0; k < grid_.size(); ++k) {
    const double x = grid_.x_of(k), y = grid_.y_of(k);
    to.u_x[k] -= share * slope.x.kU_p * (p * x - px);
    to.u_y[k] -= share * slope.y.kU_p * (p * y - py);
    to.u_z[k] += share * (slope.x.kW_q * (qx * x - qx_x) + slope.y.kW_q * (qy * y - qy_y));
  }
}

}  // namespace railstrata
