#include "bem/subsurface.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "bem/plane_fft.hpp"
#include "halfspace/layer_waves.hpp"
#include "material/elastic.hpp"

namespace railstrata {

namespace {

using Complex = std::complex<double>;
constexpr std::size_t kStates = 6;
constexpr std::array<double InteriorState::*, kStates> kState{&InteriorState::e_xx, &InteriorState::e_yy, &InteriorState::e_xy, &InteriorState::s_xz, &InteriorState::s_yz, &InteriorState::s_zz};
/// Parities in x and y of the states under p, q_x, q_y.
struct Parity {
  int x, y;
};
constexpr Parity kParity[3][kStates] = {{{1, 1}, {1, 1}, {-1, -1}, {-1, 1}, {1, -1}, {1, 1}},
                                        {{-1, 1}, {-1, 1}, {1, -1}, {1, 1}, {-1, -1}, {-1, 1}},
                                        {{1, -1}, {1, -1}, {-1, 1}, {-1, -1}, {1, 1}, {1, -1}}};

std::array<Plane*, kStates> planes_of(StatePlane& s) { return {&s.e_xx, &s.e_yy, &s.e_xy, &s.s_xz, &s.s_yz, &s.s_zz}; }

std::vector<double*> pointers(StatePlane& s, std::size_t n) {
  std::vector<double*> out;
  for (Plane* p : planes_of(s)) {
    p->assign(n, 0.0);
    out.push_back(p->data());
  }
  return out;
}

/// The state under unit surface loads at one wave number and depth, in the axes of the wave: strains times 1, tractions; see layer_waves.hpp for U, W, T, S, V, Q.
struct WaveResponse {
  double kU_p = 0, T_p = 0, S_p = 0, kU_q = 0, T_q = 0, S_q = 0, kV = 0, Q = 0;
};
constexpr std::array<double WaveResponse::*, 8> kResponse{&WaveResponse::kU_p, &WaveResponse::T_p, &WaveResponse::S_p, &WaveResponse::kU_q,
                                                          &WaveResponse::T_q,  &WaveResponse::S_q, &WaveResponse::kV,  &WaveResponse::Q};

WaveResponse response(const LayerWaves& waves, double depth) {
  const WaveState top = waves.state(0, 0), s = waves.state(depth);
  // amplitudes for S/k = -1 (unit pressure) and T/k = -1 (unit radial traction), times k
  const double t1 = top(2, 0), t2 = top(2, 1), s1 = top(3, 0), s2 = top(3, 1), det = t1 * s2 - t2 * s1;
  const Eigen::Vector2d p{t2 / det, -t1 / det}, q{-s2 / det, s1 / det};
  const Eigen::Vector4d by_p = s * p, by_q = s * q;
  const ShearState v0 = waves.shear_state(0, 0), v = waves.shear_state(depth);
  return {by_p[0], by_p[2], by_p[3], by_q[0], by_q[2], by_q[3], -v[0] / v0[1], -v[1] / v0[1]};
}

}  // namespace

struct Subsurface::Layered {
  static constexpr int kNodes = 240;
  PlaneFft fft;  // over a square: its period
  double unit_x, unit_y, log_low, log_step;
  std::vector<LayerWaves> stack, plain;  // at wave numbers spaced geometrically

  /// Four times the grid, more for thick layers, whose strains reach farther.
  static double period(const LayeredHalfSpace& body, const PatchGrid& g) {
    double thickness = 0;
    for (const HalfSpaceLayer& layer : body.layers) thickness += layer.thickness;
    const double extent = std::max(g.nx * g.dx, g.ny * g.dy);
    return std::clamp(8 * thickness, 4 * extent, 8 * extent);
  }

  Layered(const LayeredHalfSpace& body, const PatchGrid& g)
      : fft(static_cast<int>(period(body, g) / (2 * g.dx)), static_cast<int>(period(body, g) / (2 * g.dy))), unit_x(2 * std::numbers::pi / (fft.mx() * g.dx)), unit_y(2 * std::numbers::pi / (fft.my() * g.dy)) {
    const double low = 1e-3 * std::min(unit_x, unit_y), high = std::numbers::pi * std::hypot(1 / g.dx, 1 / g.dy) * 1.01;
    log_low = std::log(low);
    log_step = (std::log(high) - log_low) / (kNodes - 1);
    const LayeredHalfSpace homogeneous{{}, body.substrate};
    for (int i = 0; i < kNodes; ++i) {
      const double k = std::exp(log_low + i * log_step);
      stack.emplace_back(body, k);
      plain.emplace_back(homogeneous, k);
    }
  }

  std::vector<WaveResponse> nodes(double depth) const {
    std::vector<WaveResponse> out(kNodes);
    for (std::size_t i = 0; i < kNodes; ++i) {
      const WaveResponse a = response(stack[i], depth), b = response(plain[i], depth);
      for (auto m : kResponse) out[i].*m = a.*m - b.*m;
    }
    return out;
  }

  /// The FFT's sum over wave numbers instead of an integral is the pull of the periodic images, nearly uniform over the patch. It is the difference of sum and integral at
  /// low wave numbers (a Gaussian cuts off the rest); given with the opposite sign to the mean k = 0, which the sum leaves free, it takes the images away.
  WaveResponse mean(const std::vector<WaveResponse>& node) const {
    const double unit = std::sqrt(unit_x * unit_y), cut = 4 * unit;
    const auto add = [&](WaveResponse& to, double weight, double k) {
      const WaveResponse w = between(node, k);
      for (auto m : kResponse) to.*m += weight * std::exp(-k * k / (cut * cut)) * w.*m;
    };
    WaveResponse out;
    constexpr int reach = 20;
    for (int i = -reach; i <= reach; ++i)
      for (int j = -reach; j <= reach; ++j)
        if (i != 0 || j != 0) add(out, -1, unit * std::hypot(i, j));
    constexpr double step = 0.02;  // of ln k; ∫ 2 pi k² f dln k
    for (double t = log_low; t < std::log(reach * unit); t += step) add(out, 2 * std::numbers::pi * std::exp(2 * t) * step / (unit * unit), std::exp(t));
    return out;
  }

  /// Cubic through the four nodes around k.
  WaveResponse between(const std::vector<WaveResponse>& node, double k) const {
    const double s = (std::log(k) - log_low) / log_step;
    const int i = std::clamp(static_cast<int>(s) - 1, 0, kNodes - 4);
    const double t = s - i;
    const double w[4] = {-(t - 1) * (t - 2) * (t - 3) / 6, t * (t - 2) * (t - 3) / 2, -t * (t - 1) * (t - 3) / 2, t * (t - 1) * (t - 2) / 6};
    WaveResponse out;
    for (int l = 0; l < 4; ++l)
      for (auto m : kResponse) out.*m += w[l] * node[static_cast<std::size_t>(i + l)].*m;
    return out;
  }
};

Subsurface::Subsurface(const LayeredHalfSpace& body, const PatchGrid& grid, Plane p, Plane q_x, Plane q_y)
    : body_(body), grid_(grid), p_(std::move(p)), q_x_(std::move(q_x)), q_y_(std::move(q_y)) {
  if (!body_.layers.empty()) layered_ = std::make_unique<Layered>(body_, grid_);
}

Subsurface::~Subsurface() = default;

StatePlane Subsurface::plane(double depth) const {
  StatePlane out;
  out.depth = depth;
  const PlaneFft fft(grid_.nx, grid_.ny);
  const auto table = rectangle_interior_table(body_.substrate, depth, fft.mx() / 2 + 1, fft.my() / 2 + 1, grid_.dx, grid_.dy);
  Plane hat[3][kStates];
  Plane values(table.size());
  for (std::size_t load = 0; load < 3; ++load)
    for (std::size_t s = 0; s < kStates; ++s) {
      for (std::size_t i = 0; i < table.size(); ++i) values[i] = table[i][load].*kState[s];
      hat[load][s] = fft.spectrum(values, kParity[load][s].x, kParity[load][s].y);
    }
  fft.apply({p_.data(), q_x_.data(), q_y_.data()}, pointers(out, grid_.size()), grid_.nx, [&](std::size_t first, int count, Complex** z) {
    for (int k = 0; k < count; ++k) {
      const Complex load[3] = {z[0][k], z[1][k], z[2][k]};
      for (std::size_t s = 0; s < kStates; ++s) {
        Complex sum = 0;
        for (std::size_t l = 0; l < 3; ++l) {
          const double h = hat[l][s][first + static_cast<std::size_t>(k)];
          sum += kParity[l][s].x * kParity[l][s].y > 0 ? h * load[l] : Complex(-h * load[l].imag(), h * load[l].real());
        }
        z[s][k] = sum;
      }
    }
  });
  straighten_steps(depth, out);
  if (layered_) add_layer_difference(depth, out);
  return out;
}

void Subsurface::straighten_steps(double depth, StatePlane& out) const {
  // Tractions constant in each cell differ from linear ones by a sawtooth, whose waves k = 2 pi n/dx reach the cell's middle with the sum of (-1)^n/n exp(-k z) …
  const double G = body_.substrate.shear(), nu = body_.substrate.poisson;
  struct Tooth {
    double normal_strain, shear_strain, s_zz;  // per unit slope of the traction
  };
  const auto tooth = [&](double d) {
    const double r = std::exp(-2 * std::numbers::pi * depth / d), alternating = std::log1p(r), once = r / (1 + r);
    return Tooth{d / (2 * std::numbers::pi * G) * (2 * (1 - nu) * alternating - 2 * std::numbers::pi * depth / d * once), d / (2 * std::numbers::pi * G) * alternating, 2 * depth * once};
  };
  const Tooth tx = tooth(grid_.dx), ty = tooth(grid_.dy);
  for (int i = 1; i + 1 < grid_.nx; ++i)
    for (int j = 1; j + 1 < grid_.ny; ++j) {
      const std::size_t k = grid_.index(i, j), n = grid_.index(i + 1, j), s = grid_.index(i - 1, j);
      const double xx = (q_x_[n] - q_x_[s]) / (2 * grid_.dx), yx = (q_y_[n] - q_y_[s]) / (2 * grid_.dx);
      const double xy = (q_x_[k + 1] - q_x_[k - 1]) / (2 * grid_.dy), yy = (q_y_[k + 1] - q_y_[k - 1]) / (2 * grid_.dy);
      out.e_xx[k] += tx.normal_strain * xx;
      out.e_yy[k] += ty.normal_strain * yy;
      out.e_xy[k] += tx.shear_strain * yx + ty.shear_strain * xy;
      out.s_zz[k] += tx.s_zz * xx + ty.s_zz * yy;
    }
}

void Subsurface::add_layer_difference(double depth, StatePlane& out) const {
  const Layered& layered = *layered_;
  const PlaneFft& fft = layered.fft;
  const int nx = grid_.nx, ny = grid_.ny, mx = fft.mx(), my = fft.my();
  const std::size_t pitch = static_cast<std::size_t>(fft.ny()), n = static_cast<std::size_t>(fft.nx()) * pitch;
  const auto spread = [&](const Plane& v) {
    Plane wide(n, 0.0);
    for (int i = 0; i < nx; ++i) std::copy_n(v.begin() + static_cast<std::ptrdiff_t>(grid_.index(i, 0)), ny, wide.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(i) * pitch));
    return wide;
  };
  const Plane p = spread(p_), qx = spread(q_x_), qy = spread(q_y_);
  const std::vector<WaveResponse> node = layered.nodes(depth);
  const WaveResponse mean = layered.mean(node);
  const double unit_x = layered.unit_x, unit_y = layered.unit_y, scale = 1.0 / (static_cast<double>(mx) * my);
  StatePlane wide;
  fft.apply({p.data(), qx.data(), qy.data()}, pointers(wide, n), nx, [&](std::size_t first, int count, Complex** z) {
    const int block = static_cast<int>(first / static_cast<std::size_t>(count));
    for (int e = 0; e < count; ++e) {
      const int i = e / PlaneFft::kBlock, j = block * PlaneFft::kBlock + e % PlaneFft::kBlock;
      const double kx = unit_x * (2 * i < mx ? i : i - mx), ky = unit_y * j, k = std::hypot(kx, ky);
      const Complex P = scale * z[0][e], X = scale * z[1][e], Y = scale * z[2][e], I(0, 1);
      if (k == 0) {
        z[0][e] = z[1][e] = -0.5 * mean.kU_p * P;
        z[2][e] = 0;
        z[3][e] = 0.5 * (mean.T_q + mean.Q) * X;
        z[4][e] = 0.5 * (mean.T_q + mean.Q) * Y;
        z[5][e] = mean.S_p * P;
        continue;
      }
      if (2 * i == mx || 2 * j >= my) {  // the highest waves have no direction
        for (std::size_t s = 0; s < kStates; ++s) z[s][e] = 0;
        continue;
      }
      const double cx = kx / k, cy = ky / k;
      const WaveResponse w = layered.between(node, k);
      const Complex along = -I * (cx * X + cy * Y), across = cx * Y - cy * X;
      const Complex kU = w.kU_p * P + w.kU_q * along, T = w.T_p * P + w.T_q * along, S = w.S_p * P + w.S_q * along;
      const Complex kV = w.kV * across, Q = w.Q * across;
      // u = i k^ U + k^⊥ V with k^⊥ = (-cy, cx); strains i k u, tractions i k^ T + k^⊥ Q
      z[0][e] = -cx * cx * kU - I * cx * cy * kV;
      z[1][e] = -cy * cy * kU + I * cx * cy * kV;
      z[2][e] = -cx * cy * kU + 0.5 * I * (cx * cx - cy * cy) * kV;
      z[3][e] = I * cx * T - cy * Q;
      z[4][e] = I * cy * T + cx * Q;
      z[5][e] = S;
    }
  });
  const auto to = planes_of(out), from = planes_of(wide);
  for (std::size_t s = 0; s < kStates; ++s)
    for (int i = 0; i < nx; ++i)
      for (int j = 0; j < ny; ++j) (*to[s])[grid_.index(i, j)] += (*from[s])[static_cast<std::size_t>(i) * pitch + static_cast<std::size_t>(j)];
}

const HalfSpaceMaterial& Subsurface::material_at(double depth, bool below_interface) const {
  double bottom = 0;
  for (const HalfSpaceLayer& layer : body_.layers) {
    bottom += layer.thickness;
    if (below_interface ? depth < bottom : depth <= bottom) return layer.material;
  }
  return body_.substrate;
}

Sym3 Subsurface::stress(const StatePlane& plane, std::size_t k, bool below_interface) const { return stress_of(plane.at(k), material_at(plane.depth, below_interface)); }

Sym3 Subsurface::stress_at(double x, double y, double depth) const {
  const double u = (x - grid_.x0) / grid_.dx, v = (y - grid_.y0) / grid_.dy;
  if (u < 0 || v < 0 || u > grid_.nx - 1 || v > grid_.ny - 1 || depth < 0) throw std::out_of_range("stress_at: outside the grid");
  const StatePlane s = plane(depth);
  const auto weights = [](double t, double (&w)[4]) {
    w[0] = -(t - 1) * (t - 2) * (t - 3) / 6, w[1] = t * (t - 2) * (t - 3) / 2, w[2] = -t * (t - 1) * (t - 3) / 2, w[3] = t * (t - 1) * (t - 2) / 6;
  };
  const int i = std::clamp(static_cast<int>(u) - 1, 0, grid_.nx - 4), j = std::clamp(static_cast<int>(v) - 1, 0, grid_.ny - 4);
  double wx[4], wy[4];
  weights(u - i, wx);
  weights(v - j, wy);
  InteriorState state;
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b < 4; ++b) {
      const InteriorState here = s.at(grid_.index(i + a, j + b));
      for (auto m : kState) state.*m += wx[a] * wy[b] * here.*m;
    }
  return stress_of(state, material_at(depth));
}

namespace {

/// Vertex of the parabola through (-1, a), (0, b), (1, c): offset in [-1/2, 1/2] and value; b is the largest.
struct Vertex {
  double offset, rise;
};
Vertex vertex(double a, double b, double c) {
  const double curvature = a - 2 * b + c;
  if (!(curvature < 0)) return {0, 0};
  const double t = std::clamp(0.5 * (a - c) / curvature, -0.5, 0.5);
  return {t, -0.25 * (a - c) * t};
}

StressPeak peak_of(const Plane& v, const PatchGrid& g, double depth) {
  const auto k = static_cast<std::size_t>(std::max_element(v.begin(), v.end()) - v.begin());
  const int i = static_cast<int>(k) / g.ny, j = static_cast<int>(k) % g.ny;
  StressPeak peak{v[k], g.x(i), g.y(j), depth};
  if (i > 0 && i + 1 < g.nx) {
    const Vertex t = vertex(v[g.index(i - 1, j)], v[k], v[g.index(i + 1, j)]);
    peak.x += t.offset * g.dx;
    peak.value += t.rise;
  }
  if (j > 0 && j + 1 < g.ny) {
    const Vertex t = vertex(v[k - 1], v[k], v[k + 1]);
    peak.y += t.offset * g.dy;
    peak.value += t.rise;
  }
  return peak;
}

void keep_larger(ZonePeaks& zone, const ZonePeaks& other) {
  if (other.von_mises.value > zone.von_mises.value) zone.von_mises = other.von_mises;
  if (other.sigma1.value > zone.sigma1.value) zone.sigma1 = other.sigma1;
}

/// Evaluates planes once, however often a depth is asked for.
class PeakSearch {
 public:
  PeakSearch(const Subsurface& body, const PatchGrid& grid) : body_(body), grid_(grid) {}

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
    return known_[key] = {peak_of(mises, grid_, depth), peak_of(sigma1, grid_, depth)};
  }

  /// Largest values for depths in [top, bottom] of one material; at the top its own (lower) side is taken.
  ZonePeaks zone(double top, double bottom) {
    const int pieces = std::clamp(static_cast<int>(std::ceil((bottom - top) / (2 * grid_.dx))), 2, 16);
    std::vector<double> depth;
    for (int i = 0; i <= pieces; ++i) depth.push_back(i == pieces ? bottom : top + (bottom - top) * i / pieces);
    ZonePeaks best;
    for (double z : depth) keep_larger(best, at(z, z == top));
    refine(depth, top, best, &ZonePeaks::von_mises);
    refine(depth, top, best, &ZonePeaks::sigma1);
    return best;
  }

 private:
  void refine(std::vector<double> depth, double top, ZonePeaks& best, StressPeak ZonePeaks::*which) {
    for (int turn = 0; turn < 6; ++turn) {
      std::size_t m = 0;
      const auto value = [&](std::size_t i) { return (at(depth[i], depth[i] == top).*which).value; };
      for (std::size_t i = 1; i < depth.size(); ++i)
        if (value(i) > value(m)) m = i;
      if (m == 0 || m + 1 == depth.size()) {  // at the end of the zone: halve the end interval, the peak may hide inside
        const double inner = m == 0 ? 0.5 * (depth[0] + depth[1]) : 0.5 * (depth[m] + depth[m - 1]);
        if (std::abs(inner - depth[m]) < 0.05 * grid_.dx) return;
        depth.insert(m == 0 ? depth.begin() + 1 : depth.end() - 1, inner);
        keep_larger(best, at(inner, false));
        continue;
      }
      const double a = depth[m - 1], b = depth[m], c = depth[m + 1], fa = value(m - 1), fb = value(m), fc = value(m + 1);
      const double numerator = (b - a) * (b - a) * (fb - fc) - (b - c) * (b - c) * (fb - fa), denominator = (b - a) * (fb - fc) - (b - c) * (fb - fa);
      const double next = denominator != 0 ? b - 0.5 * numerator / denominator : b;
      if (!(next > a && next < c) || std::abs(next - b) < 0.01 * grid_.dx) return;
      keep_larger(best, at(next, false));
      depth.insert(depth.begin() + static_cast<std::ptrdiff_t>(next < b ? m : m + 1), next);
    }
  }

  const Subsurface& body_;
  const PatchGrid& grid_;
  StatePlane plane_;
  std::map<std::pair<double, bool>, ZonePeaks> known_;
};

}  // namespace

SubsurfacePeaks Subsurface::peaks(double deepest) const {
  PeakSearch search(*this, grid_);
  SubsurfacePeaks out;
  out.surface = search.at(0, true);
  const double shallow = 0.5 * std::min(grid_.dx, grid_.dy);
  double top = 0;
  for (const HalfSpaceLayer& layer : body_.layers) {
    const double bottom = top + layer.thickness, from = top == 0 ? std::min(shallow, 0.5 * layer.thickness) : top;
    out.layers.push_back(search.zone(from, bottom));
    if (bottom > shallow) keep_larger(out.subsurface, out.layers.back());
    out.above_interface.push_back(search.at(bottom, false));
    out.below_interface.push_back(search.at(bottom, true));
    top = bottom;
  }
  out.matrix = search.zone(std::max(top, shallow), std::max(deepest, top + 4 * grid_.dx));
  keep_larger(out.subsurface, out.matrix);
  return out;
}

}  // namespace railstrata
