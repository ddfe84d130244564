#include "bem/subsurface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <utility>

#include "bem/plane_fft.hpp"
#include "core/parabola.hpp"
#include "core/stop_wish.hpp"
#include "halfspace/layer_waves.hpp"
#include "halfspace/line_contact.hpp"
#include "material/elastic.hpp"

namespace railstrata {

namespace {

using Complex = std::complex<double>;
constexpr std::size_t kStates = 6;
constexpr std::array<double InteriorState::*, kStates> kState{&InteriorState::e_xx, &InteriorState::e_yy,
                                                              &InteriorState::e_xy, &InteriorState::s_xz,
                                                              &InteriorState::s_yz, &InteriorState::s_zz};
/// Parities in x and y under p, q_x, q_y: of the states, and of the displacements.
struct Parity {
  int x, y;
};
constexpr Parity kParity[3][kStates] = {{{1, 1}, {1, 1}, {-1, -1}, {-1, 1}, {1, -1}, {1, 1}},
                                        {{-1, 1}, {-1, 1}, {1, -1}, {1, 1}, {-1, -1}, {-1, 1}},
                                        {{1, -1}, {1, -1}, {-1, 1}, {-1, -1}, {1, 1}, {1, -1}}};
constexpr std::array<double Vec3::*, 3> kAxis{&Vec3::x, &Vec3::y, &Vec3::z};
constexpr Parity kDisplacementParity[3][3] = {
    {{-1, 1}, {1, -1}, {1, 1}}, {{1, 1}, {-1, -1}, {-1, 1}}, {{-1, -1}, {1, 1}, {1, -1}}};

std::array<Plane*, kStates> planes_of(StatePlane& s) { return {&s.e_xx, &s.e_yy, &s.e_xy, &s.s_xz, &s.s_yz, &s.s_zz}; }
std::array<Plane*, 3> planes_of(DisplacementPlane& u) { return {&u.u_x, &u.u_y, &u.u_z}; }

template <class Planes>
std::vector<double*> pointers(Planes& s, std::size_t n) {
  std::vector<double*> out;
  for (Plane* p : planes_of(s)) {
    p->assign(n, 0.0);
    out.push_back(p->data());
  }
  return out;
}

/// Quantities out[s] = sum over the loads (p, q_x, q_y) of table entry times load, by one FFT: value(entry, load, s) is
/// the influence at an offset from a cell. The table holds the quadrant x, y >= 0 alone; the parities complete it. A
/// spectrum is real where both parities agree, else imaginary with its imaginary part kept: hence the two products
/// below.
template <std::size_t N, class Table, class Value>
void convolve(const PlaneFft& fft, const std::vector<const double*>& loads, const Table& table,
              const Parity (&parity)[3][N], const std::vector<double*>& out, Value&& value) {
  Plane hat[3][N];
  Plane values(table.size());
  for (std::size_t load = 0; load < 3; ++load)
    for (std::size_t s = 0; s < N; ++s) {
      for (std::size_t i = 0; i < table.size(); ++i) values[i] = value(table[i], load, s);
      hat[load][s] = fft.spectrum(values, parity[load][s].x, parity[load][s].y);
    }
  fft.apply(loads, out, fft.nx(), [&](std::size_t first, int count, const PlaneFft::Spectra& z) {
    for (int k = 0; k < count; ++k) {
      const Complex load[3] = {z[0][k], z[1][k], z[2][k]};
      for (std::size_t s = 0; s < N; ++s) {
        Complex sum = 0;
        for (std::size_t l = 0; l < 3; ++l) {
          const double h = hat[l][s][first + static_cast<std::size_t>(k)];
          sum += parity[l][s].x * parity[l][s].y > 0 ? h * load[l] : Complex(-h * load[l].imag(), h * load[l].real());
        }
        z[s][k] = sum;
      }
    }
  });
}

/// The state under unit surface loads at one wave number and depth, in the axes of the wave: displacements times k,
/// tractions; see layer_waves.hpp for U, W, T, S, V, Q.
struct WaveResponse {
  double kU_p = 0, kW_p = 0, T_p = 0, S_p = 0;  // under pressure
  double kU_q = 0, kW_q = 0, T_q = 0, S_q = 0;  // under traction along the wave vector
  double kV = 0, Q = 0;                         // under traction across it
};
constexpr std::array<double WaveResponse::*, 10> kResponse{
    &WaveResponse::kU_p, &WaveResponse::kW_p, &WaveResponse::T_p, &WaveResponse::S_p, &WaveResponse::kU_q,
    &WaveResponse::kW_q, &WaveResponse::T_q,  &WaveResponse::S_q, &WaveResponse::kV,  &WaveResponse::Q};

/// Amplitudes of the two surface waves from unit tractions at the surface, then the state at the depth.
WaveResponse response(const LayerWaves& waves, double depth) {
  const WaveState top = waves.state(0, 0), s = waves.state(depth);
  // amplitudes for S/k = -1 (unit pressure) and T/k = -1 (unit radial traction), times k
  const double t1 = top(2, 0), t2 = top(2, 1), s1 = top(3, 0), s2 = top(3, 1), det = t1 * s2 - t2 * s1;
  const Eigen::Vector2d p{t2 / det, -t1 / det}, q{-s2 / det, s1 / det};
  const Eigen::Vector4d by_p = s * p, by_q = s * q;
  const ShearState v0 = waves.shear_state(0, 0), v = waves.shear_state(depth);
  return {by_p[0], by_p[1], by_p[2], by_p[3], by_q[0], by_q[1], by_q[2], by_q[3], -v[0] / v0[1], -v[1] / v0[1]};
}

}  // namespace

struct Subsurface::Layered {
  static constexpr int kNodes = 240;
  PlaneFft fft;  // over a square: its period
  bool line;
  double unit_x, unit_y, log_low, log_step;
  std::vector<LayerWaves> stack, plain;  // at wave numbers spaced geometrically

  /// `extents` times the grid, up to twice that for thick layers, whose strains reach farther. Those of a line contact
  /// reach still farther, and its waves run along x alone.
  static double period(const LayeredHalfSpace& body, const PatchGrid& g, double extents) {
    constexpr double kFarther = 8;
    double thickness = 0;
    for (const HalfSpaceLayer& layer : body.layers) thickness += layer.thickness;
    if (g.line) return kFarther * std::max(8 * thickness, extents * g.nx * g.dx);
    const double extent = std::max(g.nx * g.dx, g.ny * g.dy);
    return std::clamp(8 * thickness, extents * extent, 2 * extents * extent);
  }

  Layered(const LayeredHalfSpace& body, const PatchGrid& g, double extents)
      : fft(static_cast<int>(period(body, g, extents) / (2 * g.dx)),
            g.line ? 1 : static_cast<int>(period(body, g, extents) / (2 * g.dy))),
        line(g.line),
        unit_x(2 * std::numbers::pi / (fft.mx() * g.dx)),
        unit_y(line ? 0 : 2 * std::numbers::pi / (fft.my() * g.dy)) {
    const double low = 1e-3 * (line ? unit_x : std::min(unit_x, unit_y)),
                 high = std::numbers::pi * (line ? 1 / g.dx : std::hypot(1 / g.dx, 1 / g.dy)) * 1.01;
    log_low = std::log(low);
    log_step = (std::log(high) - log_low) / (kNodes - 1);
    const LayeredHalfSpace homogeneous{{}, body.substrate};
    for (int i = 0; i < kNodes; ++i) {
      const double k = std::exp(log_low + i * log_step);
      stack.emplace_back(body, k);
      plain.emplace_back(homogeneous, k);
    }
  }

  /// Of the transform over a period.
  static double points_of(const LayeredHalfSpace& body, const PatchGrid& g, double extents) {
    const double along = period(body, g, extents) / g.dx;
    return g.line ? along : along * along * g.dx / g.dy;
  }

  double points() const { return static_cast<double>(fft.mx()) * fft.my(); }

  std::vector<WaveResponse> nodes(double depth) const {
    std::vector<WaveResponse> out(kNodes);
    for (std::size_t i = 0; i < kNodes; ++i) {
      const WaveResponse a = response(stack[i], depth), b = response(plain[i], depth);
      for (auto m : kResponse) out[i].*m = a.*m - b.*m;
    }
    return out;
  }

  /// Averages of a response over wave numbers, weighed by (k_x/k)² and (k_y/k)².
  struct Means {
    WaveResponse x, y;
  };
  /// The FFT's sum over wave numbers instead of an integral is the pull of the periodic images, nearly uniform over the
  /// patch. It is the difference of sum and integral at low wave numbers (a Gaussian cuts off the rest); given with the
  /// opposite sign to the mean k = 0, which the sum leaves free, it takes the images away. Of the responses over
  /// k^power: 0 for strains and tractions, 1 for displacements.
  Means mean(const std::vector<WaveResponse>& node, int power = 0) const {
    if (line) return {mean_along(node), {}};
    const double unit = std::sqrt(unit_x * unit_y), cut = 4 * unit;
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
        const double kx = i * unit_x, ky = j * unit_y, k2 = kx * kx + ky * ky,
                     count = (i == 0 ? 1.0 : 2.0) * (j == 0 ? 1.0 : 2.0);
        add(-count * kx * kx / k2, -count * ky * ky / k2, std::sqrt(k2), out);
      }
    constexpr double step = 0.02;  // of ln k; ∫ pi k² f dln k each
    for (double t = log_low; t < std::log(reach * unit); t += step) {
      const double weight = std::numbers::pi * std::exp(2 * t) * step / (unit * unit);
      add(weight, weight, std::exp(t), out);
    }
    return out;
  }

  /// The same of waves along x alone, power 0.
  WaveResponse mean_along(const std::vector<WaveResponse>& node) const {
    WaveResponse out;
    const auto add = [&](double weight, double k) {
      const WaveResponse w = between(node, k);
      const double cut = std::exp(-k * k / (16 * unit_x * unit_x));
      for (auto m : kResponse) out.*m += weight * cut * w.*m;
    };
    constexpr int reach = 20;
    for (int i = 1; i <= reach; ++i) add(-2, i * unit_x);
    constexpr double step = 0.02;  // of ln k; 2 ∫ k f dln k
    for (double t = log_low; t < std::log(reach * unit_x); t += step) add(2 * std::exp(t) * step / unit_x, std::exp(t));
    return out;
  }

  /// Adds to planes of the grid what the layers change. wave(P, X, Y, cx, cy, k, response, z): the quantities z under
  /// loads (P, X, Y) of the wave vector k (cx, cy); zero(P, X, Y, z): of the mean.
  template <class Planes, class Wave, class Zero>
  void add(const PatchGrid& grid, const std::array<const Plane*, 3>& loads, const std::vector<WaveResponse>& node,
           Planes& to, Wave&& wave, Zero&& zero) const {
    const int nx = grid.nx, ny = grid.ny, mx = fft.mx(), my = fft.my();
    const std::size_t pitch = static_cast<std::size_t>(fft.ny()), n = static_cast<std::size_t>(fft.nx()) * pitch;
    Plane spread[3];
    for (std::size_t l = 0; l < 3; ++l) {
      spread[l].assign(n, 0.0);
      for (int i = 0; i < nx; ++i)
        std::copy_n(loads[l]->begin() + static_cast<std::ptrdiff_t>(grid.index(i, 0)), ny,
                    spread[l].begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(i) * pitch));
    }
    // The loads are steps, one a cell, as in the closed form: their transform is that of the values times
    // sin(k d/2)/(k d/2) in each direction.
    const std::vector<double> step_x = steps(mx / 2 + 1, unit_x, grid.dx), step_y = steps(my / 2 + 1, unit_y, grid.dy);
    const double scale = 1 / points(), shortest = largest_wave_number(node);
    Planes wide;
    const std::vector<double*> out = pointers(wide, n);
    static_assert(PlaneFft::kBlock == 1);
    fft.apply({spread[0].data(), spread[1].data(), spread[2].data()}, out, nx,
              [&](std::size_t first, int count, const PlaneFft::Spectra& z) {
                const int j = static_cast<int>(first / static_cast<std::size_t>(count));
                const double ky = unit_y * j;
                std::array<Complex, kStates> value;
                for (int i = 0; 2 * i <= mx; ++i) {  // waves to both sides of x have the same response
                  const double kx = unit_x * i, k = std::hypot(kx, ky), weight = scale * step_x[i] * step_y[j];
                  const bool counts =
                      2 * i < mx && (line || 2 * j < my) && k <= shortest;  // the highest have no direction
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
          (*target[s])[grid.index(i, j)] +=
              (*from[s])[static_cast<std::size_t>(i) * pitch + static_cast<std::size_t>(j)];
  }

  /// sin(k d/2)/(k d/2) at the wave numbers 0, 1, … n - 1 times `unit` for cells of a size d.
  static std::vector<double> steps(int n, double unit, double size) {
    std::vector<double> out{1};
    for (int i = 1; i < n; ++i) {
      const double k = unit * i, half = 0.5 * k * size;
      out.push_back(half > 0 ? std::sin(half) / half : 1.0);
    }
    return out;
  }

  /// Waves beyond it do not reach down to where the responses are: all are less than rounding of the largest.
  double largest_wave_number(const std::vector<WaveResponse>& node) const {
    constexpr double kNothing = 1e-22;
    int last = -1;
    for (auto m : kResponse) {
      double most = 0;
      for (const WaveResponse& w : node) most = std::max(most, std::abs(w.*m));
      for (int i = kNodes - 1; i > last; --i)
        if (!(std::abs(node[static_cast<std::size_t>(i)].*m) <= kNothing * most)) last = i;
    }
    constexpr int kReach = 6;  // nodes of an interpolation
    return std::exp(log_low + (last + kReach) * log_step);
  }

  /// Lagrange's polynomial of the fifth order in ln k through the six nodes around k.
  WaveResponse between(const std::vector<WaveResponse>& node, double k) const {
    const double s = (std::log(k) - log_low) / log_step;
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
};

Subsurface::Subsurface(const LayeredHalfSpace& body, const PatchGrid& grid, Plane p, Plane q_x, Plane q_y,
                       double period)
    : body_(body),
      grid_(grid),
      p_(std::move(p)),
      q_x_(std::move(q_x)),
      q_y_(std::move(q_y)),
      period_(period),
      reach_x_(grid.nx),
      reach_y_(grid.ny) {
  if (!body_.layers.empty()) layered_ = std::make_unique<Layered>(body_, grid_, period_);
}

Subsurface::~Subsurface() = default;
Subsurface::Subsurface(Subsurface&&) noexcept = default;

StatePlane Subsurface::plane(double depth) const {
  stop_if_wished();
  StatePlane out;
  out.depth = depth;
  const PlaneFft fft(grid_.nx, grid_.ny, reach_x_, reach_y_);
  const int nx = fft.mx() / 2 + 1, ny = fft.my() / 2 + 1;
  const auto table = grid_.line ? in_first_column(strip_interior_table(body_.substrate, depth, nx, grid_.dx), ny)
                                : rectangle_interior_table(body_.substrate, depth, nx, ny, grid_.dx, grid_.dy);
  convolve(fft, {p_.data(), q_x_.data(), q_y_.data()}, table, kParity, pointers(out, grid_.size()),
           [](const InteriorInfluence& t, std::size_t load, std::size_t s) { return t[load].*kState[s]; });
  straighten_steps(depth, out);
  if (layered_) {
    stop_if_wished();
    add_layer_difference(depth, out);
  }
  return out;
}

DisplacementPlane Subsurface::displacement(double depth) const {
  DisplacementPlane out;
  out.depth = depth;
  if (grid_.line) {
    for (Plane* u : planes_of(out)) u->assign(grid_.size(), std::numeric_limits<double>::quiet_NaN());
    return out;
  }
  const PlaneFft fft(grid_.nx, grid_.ny, reach_x_, reach_y_);
  const auto table =
      rectangle_displacement_table(body_.substrate, depth, fft.mx() / 2 + 1, fft.my() / 2 + 1, grid_.dx, grid_.dy);
  convolve(fft, {p_.data(), q_x_.data(), q_y_.data()}, table, kDisplacementParity, pointers(out, grid_.size()),
           [](const InteriorDisplacement& t, std::size_t load, std::size_t axis) { return t[load].*kAxis[axis]; });
  if (layered_) {
    stop_if_wished();
    add_layer_difference(depth, out);
  }
  return out;
}

void Subsurface::straighten_steps(double depth, StatePlane& out) const {
  // Tractions constant in each cell differ from linear ones by a sawtooth of the slope. Its waves are k_n = 2 pi n/d
  // with amplitudes (-1)^n/n; at a depth z each carries exp(-k_n z), times k_n z in the terms of the half-space
  // solution that grow with depth. With r = exp(-2 pi z/d) the sums over n at the cell's middle are
  //   sum of -(-r)^n/n = ln(1 + r) ("alternating"),   sum of -(-r)^n = r/(1 + r) ("once"),
  // and a cell below the surface 0.2 % of it is left. Cells at the grid's rim have no neighbour and carry no traction.
  const double G = body_.substrate.shear(), nu = body_.substrate.poisson;
  struct Tooth {
    double normal_strain, shear_strain, s_zz;  // per unit slope of the traction
  };
  const auto tooth = [&](double d) {
    const double r = std::exp(-2 * std::numbers::pi * depth / d), alternating = std::log1p(r), once = r / (1 + r);
    return Tooth{
        d / (2 * std::numbers::pi * G) * (2 * (1 - nu) * alternating - 2 * std::numbers::pi * depth / d * once),
        d / (2 * std::numbers::pi * G) * alternating, 2 * depth * once};
  };
  const Tooth tx = tooth(grid_.dx), ty = tooth(grid_.dy);
  const int rim = grid_.line ? 0 : 1;
  for (int i = 1; i + 1 < grid_.nx; ++i)
    for (int j = rim; j + rim < grid_.ny; ++j) {
      const std::size_t k = grid_.index(i, j), n = grid_.index(i + 1, j), s = grid_.index(i - 1, j);
      const double xx = (q_x_[n] - q_x_[s]) / (2 * grid_.dx), yx = (q_y_[n] - q_y_[s]) / (2 * grid_.dx);
      out.e_xx[k] += tx.normal_strain * xx;
      out.e_xy[k] += tx.shear_strain * yx;
      out.s_zz[k] += tx.s_zz * xx;
      if (grid_.line) continue;
      const double xy = (q_x_[k + 1] - q_x_[k - 1]) / (2 * grid_.dy), yy = (q_y_[k + 1] - q_y_[k - 1]) / (2 * grid_.dy);
      out.e_yy[k] += ty.normal_strain * yy;
      out.e_xy[k] += ty.shear_strain * xy;
      out.s_zz[k] += ty.s_zz * yy;
    }
}

// Layered minus homogeneous, wave by wave. k^ = (cx, cy) is the direction of the wave; along = -i k^·q and across =
// k^⊥·q are the tractions in its axes (layer_waves.hpp: sigma_x'z = i T).
void Subsurface::add_layer_difference(double depth, StatePlane& out) const {
  const std::vector<WaveResponse> node = layered_->nodes(depth);
  const Layered::Means mean = layered_->mean(node);
  const auto wave = [](Complex P, Complex X, Complex Y, double cx, double cy, double, const WaveResponse& w,
                       std::array<Complex, kStates>& z) {
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
  const auto zero = [&](Complex P, Complex X, Complex Y, std::array<Complex, kStates>& z) {
    z = {-mean.x.kU_p * P,
         -mean.y.kU_p * P,
         0,
         (mean.x.T_q + mean.y.Q) * X,
         (mean.y.T_q + mean.x.Q) * Y,
         (mean.x.S_p + mean.y.S_p) * P};
  };
  layered_->add(grid_, {&p_, &q_x_, &q_y_}, node, out, wave, zero);
}

void Subsurface::add_layer_difference(double depth, DisplacementPlane& out) const {
  const std::vector<WaveResponse> node = layered_->nodes(depth);
  const Layered::Means mean = layered_->mean(node, 1), slope = layered_->mean(node);
  const auto wave = [](Complex P, Complex X, Complex Y, double cx, double cy, double k, const WaveResponse& w,
                       std::array<Complex, kStates>& z) {
    const Complex I(0, 1), along = -I * (cx * X + cy * Y), across = cx * Y - cy * X;
    const Complex U = (w.kU_p * P + w.kU_q * along) / k, W = (w.kW_p * P + w.kW_q * along) / k, V = w.kV * across / k;
    z = {I * cx * U - cy * V, I * cy * U + cx * V, W};
  };
  const auto zero = [&](Complex P, Complex X, Complex Y, std::array<Complex, kStates>& z) {
    z = {(mean.x.kU_q + mean.y.kV) * X, (mean.y.kU_q + mean.x.kV) * Y, (mean.x.kW_p + mean.y.kW_p) * P};
  };
  layered_->add(grid_, {&p_, &q_x_, &q_y_}, node, out, wave, zero);
  // the images' strain as a displacement from each load: e p (x - x'), and the tilt t q·(x - x')
  double p = 0, px = 0, py = 0;
  double qx = 0, qy = 0, qx_x = 0, qy_y = 0;
  for (int i = 0; i < grid_.nx; ++i)
    for (int j = 0; j < grid_.ny; ++j) {
      const std::size_t k = grid_.index(i, j);
      p += p_[k];
      px += p_[k] * grid_.x(i);
      py += p_[k] * grid_.y(j);
      qx += q_x_[k];
      qx_x += q_x_[k] * grid_.x(i);
      qy += q_y_[k];
      qy_y += q_y_[k] * grid_.y(j);
    }
  const double share = 1 / layered_->points();
  for (int i = 0; i < grid_.nx; ++i)
    for (int j = 0; j < grid_.ny; ++j) {
      const std::size_t k = grid_.index(i, j);
      out.u_x[k] -= share * slope.x.kU_p * (p * grid_.x(i) - px);
      out.u_y[k] -= share * slope.y.kU_p * (p * grid_.y(j) - py);
      out.u_z[k] += share * (slope.x.kW_q * (qx * grid_.x(i) - qx_x) + slope.y.kW_q * (qy * grid_.y(j) - qy_y));
    }
}

HalfSpaceMaterial Subsurface::material_at(double depth, bool below_interface) const {
  double top = 0;
  for (const HalfSpaceLayer& layer : body_.layers) {
    const double bottom = top + layer.thickness;
    if (below_interface ? depth < bottom : depth <= bottom) return layer.local(depth - top);
    top = bottom;
  }
  return body_.substrate;
}

Sym3 Subsurface::stress(const StatePlane& plane, std::size_t k, bool below_interface) const {
  return stress_of(plane.at(k), material_at(plane.depth, below_interface));
}

namespace {

/// Cubic through four points at 0, 1, 2, 3.
std::array<double, 4> cubic_weights(double t) {
  return {-(t - 1) * (t - 2) * (t - 3) / 6, t * (t - 2) * (t - 3) / 2, -t * (t - 1) * (t - 3) / 2,
          t * (t - 1) * (t - 2) / 6};
}

/// The sixteen cells around a point of the plan with their weights.
struct Around {
  std::size_t first;
  std::array<double, 4> x, y;
  Around(const PatchGrid& g, const Vec3& at) {
    const double u = (at.x - g.x0) / g.dx, v = (at.y - g.y0) / g.dy;
    const int i = std::clamp(static_cast<int>(std::floor(u)) - 1, 0, g.nx - 4),
              j = g.line ? 0 : std::clamp(static_cast<int>(std::floor(v)) - 1, 0, g.ny - 4);
    first = g.index(i, j);
    x = cubic_weights(u - i);
    if (g.line)
      y = {1, 0, 0, 0};
    else
      y = cubic_weights(v - j);
  }
  double of(const PatchGrid& g, const Plane& v) const {
    double sum = 0;
    const std::size_t columns = g.line ? 1 : 4;
    for (std::size_t a = 0; a < 4; ++a)
      for (std::size_t b = 0; b < columns; ++b) sum += x[a] * y[b] * v[first + a * static_cast<std::size_t>(g.ny) + b];
    return sum;
  }
};

bool has_cells_around(const PatchGrid& g, const Vec3& at) {
  return at.x >= g.x(1) && at.x <= g.x(g.nx - 2) && (g.line || (at.y >= g.y(1) && at.y <= g.y(g.ny - 2)));
}

}  // namespace

bool Subsurface::covers(const Vec3& at) const { return has_cells_around(grid_, at); }

Sym3 Subsurface::stress_at(const StatePlane& s, const Vec3& at, bool below_interface) const {
  const Around near(grid_, at);
  const auto of = [&](const Plane& v) { return near.of(grid_, v); };
  return stress_of({of(s.e_xx), of(s.e_yy), of(s.e_xy), of(s.s_xz), of(s.s_yz), of(s.s_zz)},
                   material_at(s.depth, below_interface));
}

std::unique_ptr<Subsurface> Subsurface::widened(int more_x, int more_y) const {
  PatchGrid g{grid_.nx + 2 * more_x,        grid_.ny + 2 * more_y,        grid_.dx,  grid_.dy,
              grid_.x0 - more_x * grid_.dx, grid_.y0 - more_y * grid_.dy, grid_.line};
  const auto padded = [&](const Plane& v) {
    Plane wide(g.size(), 0.0);
    for (int i = 0; i < grid_.nx; ++i)
      std::copy_n(v.begin() + static_cast<std::ptrdiff_t>(grid_.index(i, 0)), grid_.ny,
                  wide.begin() + static_cast<std::ptrdiff_t>(g.index(i + more_x, more_y)));
    return wide;
  };
  auto wide = std::make_unique<Subsurface>(body_, g, padded(p_), padded(q_x_), padded(q_y_), period_);
  wide->reach_x_ = reach_x_ + more_x;
  wide->reach_y_ = reach_y_ + more_y;
  return wide;
}

std::unique_ptr<Subsurface> Subsurface::coarsened() const {
  constexpr int kCells = 3;
  const double middle_x = grid_.x0 + 0.5 * (grid_.nx - 1) * grid_.dx,
               middle_y = grid_.y0 + 0.5 * (grid_.ny - 1) * grid_.dy;
  PatchGrid g = grid_.line ? line_grid(grid_.nx / 2, kCells * grid_.dx, grid_.dy)
                           : centred_grid(grid_.nx / 2, grid_.ny / 2, kCells * grid_.dx, kCells * grid_.dy);
  const double cells = grid_.line ? kCells : kCells * kCells;
  g.x0 += middle_x;
  g.y0 += middle_y;
  const auto means = [&](const Plane& v) {
    Plane out(g.size(), 0.0);
    for (int i = 0; i < grid_.nx; ++i)
      for (int j = 0; j < grid_.ny; ++j) {
        const auto x = static_cast<int>(std::lround((grid_.x(i) - g.x0) / g.dx)),
                   y = static_cast<int>(std::lround((grid_.y(j) - g.y0) / g.dy));
        out[g.index(x, y)] += v[grid_.index(i, j)] / cells;
      }
    return out;
  };
  return std::make_unique<Subsurface>(body_, g, means(p_), means(q_x_), means(q_y_), std::max(2.5, period_ / kCells));
}

namespace {

/// Lengths of the grid beyond its rim, and points of a transform with layers: what lies farther feels a point load, and
/// costs minutes and memory without end.
constexpr double kFarthest = 10, kMostPoints = 2e7;

double length_of(const PatchGrid& grid) { return std::max(grid.nx * grid.dx, grid.line ? 0.0 : grid.ny * grid.dy); }

[[noreturn]] void refuse_far(const PatchGrid& grid, const Vec3& p, double reach) {
  throw std::out_of_range(fmt::format(
      "a point too far away, at x = {:.4g} m, y = {:.4g} m: points reach {:.3g} m beyond the grid of "
      "x = {:.4g} to {:.4g} m, y = {:.4g} to {:.4g} m ({:.3g} of its lengths, for time and memory); they "
      "are in metres, farther off the contact acts as a point load",
      p.x, p.y, reach, grid.x0, grid.x(grid.nx - 1), grid.y0, grid.y(grid.ny - 1), reach / length_of(grid)));
}

}  // namespace

// Points outside the grid: the same tractions on a grid widened with empty cells. Points are taken by depth, since a
// plane costs a convolution and a point on it next to nothing.
std::vector<InteriorPoint> Subsurface::at(const std::vector<Vec3>& points, bool below_interface) const {
  constexpr double kMostCells = 4e6;
  double reach = kFarthest * length_of(grid_);
  const auto points_at_reach = [&] {
    PatchGrid wide = grid_;
    wide.nx += static_cast<int>(2 * reach / grid_.dx);
    if (!grid_.line) wide.ny += static_cast<int>(2 * reach / grid_.dy);
    return Layered::points_of(body_, wide, period_);
  };
  while (layered_ && points_at_reach() > kMostPoints && reach > 0.1 * length_of(grid_)) reach *= 0.9;
  int more_x = 0, more_y = 0;
  for (const Vec3& p : points) {
    if (!(p.z >= 0)) throw std::out_of_range("Subsurface::at: a point above the surface");
    if (covers(p)) continue;
    const double x = std::max(grid_.x0 - p.x, p.x - grid_.x(grid_.nx - 1)) / grid_.dx,
                 y = grid_.line ? 0.0 : std::max(grid_.y0 - p.y, p.y - grid_.y(grid_.ny - 1)) / grid_.dy;
    if (!(std::max(x * grid_.dx, y * grid_.dy) <= reach)) refuse_far(grid_, p, reach);
    more_x = std::max(more_x, static_cast<int>(std::ceil(x)) + 2);
    if (!grid_.line) more_y = std::max(more_y, static_cast<int>(std::ceil(y)) + 2);
    if (!((grid_.nx + 2.0 * more_x) * (grid_.ny + 2.0 * more_y) < kMostCells))
      throw std::out_of_range("Subsurface::at: a point too far away for cells of this size");
  }
  if (more_x > 0 || more_y > 0) return widened(more_x, more_y)->at(points, below_interface);

  std::vector<std::size_t> order(points.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return points[a].z < points[b].z; });
  std::vector<InteriorPoint> out(points.size());
  StatePlane s;
  DisplacementPlane u;
  for (std::size_t k : order) {
    const Vec3& p = points[k];
    if (s.s_zz.empty() || s.depth != p.z) {
      s = plane(p.z);
      u = displacement(p.z);
    }
    const Around near(grid_, p);
    const auto of = [&](const Plane& v) { return near.of(grid_, v); };
    out[k].displacement = {of(u.u_x), of(u.u_y), of(u.u_z)};
    out[k].stress = stress_at(s, p, below_interface);
  }
  return out;
}

namespace {

double largest_at_rim(const Plane& v, const PatchGrid& g) {
  double most = 0;
  for (int i = 0; i < g.nx && !g.line; ++i) most = std::max({most, v[g.index(i, 0)], v[g.index(i, g.ny - 1)]});
  for (int j = 0; j < g.ny; ++j) most = std::max({most, v[g.index(0, j)], v[g.index(g.nx - 1, j)]});
  return most;
}

bool lies_in(const PatchGrid& g, double x, double y) {
  return x >= g.x0 && x <= g.x(g.nx - 1) && y >= g.y0 && y <= g.y(g.ny - 1);
}

/// without: a grid whose cells do not count; may be null.
StressPeak peak_of(const Plane& v, const PatchGrid& g, double depth, const PatchGrid* without) {
  std::size_t k = 0;
  for (int i = 0; i < g.nx; ++i)
    for (int j = 0; j < g.ny; ++j)
      if (v[g.index(i, j)] > v[k] && !(without && lies_in(*without, g.x(i), g.y(j)))) k = g.index(i, j);
  const int i = static_cast<int>(k) / g.ny, j = static_cast<int>(k) % g.ny;
  StressPeak peak{v[k], g.x(i), g.y(j), depth, largest_at_rim(v, g)};
  const auto refine = [&](std::size_t before, std::size_t after, double size, double& place) {
    if (v[before] > v[k] || v[after] > v[k]) return;  // a slope that goes on within the other grid
    const ParabolaTop t = parabola_top(v[before], v[k], v[after]);
    place += t.at * size;
    peak.value += t.above;
  };
  if (i > 0 && i + 1 < g.nx) refine(g.index(i - 1, j), g.index(i + 1, j), g.dx, peak.x);
  if (j > 0 && j + 1 < g.ny) refine(k - 1, k + 1, g.dy, peak.y);
  return peak;
}

void keep_larger(StressPeak& best, const StressPeak& other) {
  const double rim = std::max(best.at_rim, other.at_rim);
  if (other.value > best.value) best = other;
  best.at_rim = rim;
}
void keep_larger(ZonePeaks& zone, const ZonePeaks& other) {
  keep_larger(zone.von_mises, other.von_mises);
  keep_larger(zone.sigma1, other.sigma1);
}

/// Which of the two maxima is wanted.
struct Wanted {
  bool von_mises = true, sigma1 = true;
  bool any() const { return von_mises || sigma1; }
};

/// Which maxima to look for on a wider grid: those of which the rim has a good share. The von Mises stress falls from
/// its maximum on; tension may have a second, larger maximum outside.
Wanted beyond(const ZonePeaks& z) {
  return {z.von_mises.at_rim > 0.9 * z.von_mises.value, z.sigma1.at_rim > 0.5 * z.sigma1.value};
}

/// On one grid. Evaluates planes once, however often a depth is asked for.
class GridSearch {
 public:
  explicit GridSearch(const Subsurface& body, const PatchGrid* without = nullptr)
      : body_(body), grid_(body.grid()), without_(without) {}

  ZonePeaks at(double depth, bool below) {
    const auto key = std::make_pair(depth, below);
    if (const auto found = known_.find(key); found != known_.end()) return found->second;
    if (!(plane_.depth == depth && !plane_.s_zz.empty())) plane_ = body_.plane(depth);
    Plane mises(grid_.size()), sigma1(grid_.size());
    for (std::size_t k = 0; k < mises.size(); ++k) {
      const Sym3 s = body_.stress(plane_, k, below);
      mises[k] = von_mises(s);
      sigma1[k] = principal_stresses(s).x;
    }
    return known_[key] = {peak_of(mises, grid_, depth, without_), peak_of(sigma1, grid_, depth, without_)};
  }

  /// Largest values for depths in [top, bottom] of one material; at the top its own (lower) side is taken.
  ZonePeaks zone(double top, double bottom, Wanted wanted) {
    const int pieces = std::clamp(static_cast<int>(std::ceil((bottom - top) / (2 * grid_.dx))), 2, 16);
    std::vector<double> depth;
    for (int i = 0; i <= pieces; ++i) depth.push_back(i == pieces ? bottom : top + (bottom - top) * i / pieces);
    ZonePeaks best;
    for (double z : depth) keep_larger(best, at(z, z == top));
    if (wanted.von_mises) refine(depth, top, best, &ZonePeaks::von_mises);
    if (wanted.sigma1) refine(depth, top, best, &ZonePeaks::sigma1);
    return best;
  }

 private:
  /// Successive parabolas through the largest value and its neighbours; every depth tried joins the list. No golden
  /// section: a plane costs a convolution, and near its top the curve is a parabola.
  void refine(std::vector<double> depth, double top, ZonePeaks& best, StressPeak ZonePeaks::*which) {
    for (int pass = 0; pass < 6; ++pass) {
      std::size_t m = 0;
      const auto value = [&](std::size_t i) { return (at(depth[i], depth[i] == top).*which).value; };
      for (std::size_t i = 1; i < depth.size(); ++i)
        if (value(i) > value(m)) m = i;
      if (m == 0 ||
          m + 1 == depth.size()) {  // at the end of the zone: halve the end interval, the peak may hide inside
        const double inner = m == 0 ? 0.5 * (depth[0] + depth[1]) : 0.5 * (depth[m] + depth[m - 1]);
        if (std::abs(inner - depth[m]) < 0.05 * grid_.dx) return;
        depth.insert(m == 0 ? depth.begin() + 1 : depth.end() - 1, inner);
        keep_larger(best, at(inner, false));
        continue;
      }
      const double a = depth[m - 1], b = depth[m], c = depth[m + 1], fa = value(m - 1), fb = value(m),
                   fc = value(m + 1);
      const double numerator = (b - a) * (b - a) * (fb - fc) - (b - c) * (b - c) * (fb - fa),
                   denominator = (b - a) * (fb - fc) - (b - c) * (fb - fa);
      const double next = denominator != 0 ? b - 0.5 * numerator / denominator : b;
      if (!(next > a && next < c) || std::abs(next - b) < 0.01 * grid_.dx) return;
      keep_larger(best, at(next, false));
      depth.insert(depth.begin() + static_cast<std::ptrdiff_t>(next < b ? m : m + 1), next);
    }
  }

  const Subsurface& body_;
  const PatchGrid& grid_;
  const PatchGrid* without_;
  StatePlane plane_;
  std::map<std::pair<double, bool>, ZonePeaks> known_;
};

/// Goes outside of the grid where its rim has a good share of a maximum, and deeper where one lies at the lower end.
class PeakSearch {
 public:
  using Coarsen = std::function<std::unique_ptr<Subsurface>()>;
  PeakSearch(const Subsurface& body, Coarsen coarsen) : grid_(body.grid()), near_(body), coarsen_(std::move(coarsen)) {}

  ZonePeaks at(double depth, bool below) {
    return widening([&](GridSearch& grid, Wanted) { return grid.at(depth, below); });
  }

  ZonePeaks zone(double top, double bottom) {
    return widening([&](GridSearch& grid, Wanted wanted) { return grid.zone(top, bottom, wanted); });
  }

  /// A zone without a floor, looked at from `top` to `bottom` and, while a maximum lies there, to twice that depth.
  ZonePeaks zone_without_floor(double top, double bottom) {
    constexpr int kDeepenings = 3;
    ZonePeaks best = zone(top, bottom);
    const auto at_floor = [&] { return best.von_mises.depth >= bottom || best.sigma1.depth >= bottom; };
    for (int i = 0; i < kDeepenings && at_floor(); ++i) {
      top = bottom;
      bottom *= 2;
      keep_larger(best, zone(top, bottom));
    }
    for (StressPeak* peak : {&best.von_mises, &best.sigma1})
      if (peak->depth >= bottom) peak->at_rim = peak->value;
    return best;
  }

 private:
  template <class Search>
  ZonePeaks widening(Search&& search) {
    ZonePeaks best = search(near_, Wanted{});
    const Wanted wanted = beyond(best);
    if (!wanted.any()) return best;
    if (!far_) {
      far_body_ = coarsen_();
      far_.emplace(*far_body_, &grid_);
    }
    const ZonePeaks outside = search(*far_, wanted);
    const auto take = [](StressPeak& peak, const StressPeak& other) {
      if (other.value > peak.value) peak = other;
      peak.at_rim = other.at_rim;
    };
    if (wanted.von_mises) take(best.von_mises, outside.von_mises);
    if (wanted.sigma1) take(best.sigma1, outside.sigma1);
    return best;
  }

  const PatchGrid& grid_;
  GridSearch near_;
  Coarsen coarsen_;
  std::unique_ptr<Subsurface> far_body_;
  std::optional<GridSearch> far_;
};

}  // namespace

SubsurfacePeaks Subsurface::peaks(SearchDepths depths) const {
  PeakSearch search(*this, [this] { return coarsened(); });
  SubsurfacePeaks out;
  out.surface = search.at(0, true);
  double top = 0;
  for (const LayerExtent& layer : layer_extents(body_)) {
    const double from = top == 0 ? std::min(depths.from, 0.5 * layer.bottom) : top;
    out.layers.push_back(search.zone(from, layer.bottom));
    if (layer.bottom > depths.from) keep_larger(out.subsurface, out.layers.back());
    out.above_interface.push_back(search.at(layer.bottom, false));
    out.below_interface.push_back(search.at(layer.bottom, true));
    top = layer.bottom;
  }
  out.matrix = search.zone_without_floor(std::max(top, depths.from), std::max(depths.deepest, top + 4 * grid_.dx));
  keep_larger(out.subsurface, out.matrix);
  return out;
}

}  // namespace railstrata
