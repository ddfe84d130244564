#pragma once
// A half-plane of elements that yield, in plane strain, under a Hertz pressure that moves over it again and again.
#include <numbers>

#include "body/plastic_pass.hpp"
#include "body/stress.hpp"
#include "core/parallel.hpp"
#include "tests/body/plastic_state.hpp"
#include "tests/body/relaxation.hpp"

namespace railstrata::fem_checks {

/// Half-width of the pressure 1 m, from -track to +track; cells of `cell` along, `flatness` of that deep.
struct MovingPressure {
  double cell = 0.1, flatness = 0.5, track = 5, p0_over_k = 4.35, kinematic_over_k = 0;
  std::optional<PlasticParameters<double>> law = {};  ///< in place of perfect plasticity at k
  double friction = 0;  ///< of the whole patch, along the travel: a braking wheel's on the rail
  double speed = 0.04;  ///< of the shear wave's
  double shear_yield() const { return kSteel.mu / 2500; }
};

inline std::vector<double> graded(double fine, double fine_to, double end, double growth) {
  std::vector<double> at{0.0};
  double step = fine;
  while (at.back() < end) {
    if (at.back() > fine_to - 1e-9) step *= growth;
    at.push_back(at.back() + step);
  }
  return at;
}

/// Held at this distance below and beside; at 14 half-widths the stress along differs by 4 % of p_0 from a
/// half-plane's.
inline constexpr double kFar = 100;

class RolledHalfPlane {
 public:
  explicit RolledHalfPlane(const MovingPressure& p)
      : p_(p),
        depth_(graded(p.flatness * p.cell, 1.6, kFar, 1.35)),
        body_(mesh(p, depth_), {kSteel}, {}),
        elements_(body_) {
    YieldingMaterial material{perfectly_plastic(kSteel, std::sqrt(3.0) * p.shear_yield()), {}};
    material.law.modulus[0] = p.kinematic_over_k * p.shear_yield();
    if (p.law) material.law = *p.law;
    body_.plastic = PlasticElements(
        body_, [&](int, int quad, int) { return depth_[quad] < 3 ? std::optional(material) : std::nullopt; },
        [](int, int, const Tile&) { return true; });
    state_ = BodyState(body_);
    dt_ = 0.9 * element_step_bound(body_).step;
  }

  /// Rolls once from -track to +track; the load grows and goes in the half-width before and behind.
  void pass() {
    const double wave = std::sqrt(kSteel.mu / kSteel.density), v = p_.speed * wave;
    damping_ = 0.03 * wave;
    const double begin = -p_.track - 1, end = p_.track + 1;
    for (double x = begin; x < end; x += v * dt_) {
      const double ramp = std::clamp(std::min(x - begin, end - x), 0.0, 1.0);
      step(x, ramp * ramp * (3 - 2 * ramp));
    }
    damping_ = 0.06 * wave;
    for (int n = 0; n < static_cast<int>(80 / (wave * dt_)); ++n) step(0, 0);
  }

  struct Row {
    double depth, xx, yy, zz, xz;  ///< residual stresses over k, mean over |x| < 1
  };
  std::vector<Row> residual() {
    elements_.begin(state_.u, 0);
    std::vector<Row> out;
    const std::vector<double>& at = body_.mesh.blocks[0].stations.at;
    for (std::size_t q = 0; q + 1 < depth_.size(); ++q) {
      Row row{0.5 * (depth_[q] + depth_[q + 1]), 0, 0, 0, 0};
      int count = 0;
      for (int e = 0; e + 1 < static_cast<int>(at.size()); ++e) {
        if (std::abs(0.5 * (at[e] + at[e + 1])) > 1) continue;
        const Sym3 s = element_stress(body_, state_.u, state_.history, 0, static_cast<int>(q), e);
        row.xx += s.xx;
        row.yy += s.yy;
        row.zz += s.zz;
        row.xz += s.xz;
        ++count;
      }
      for (double* x : {&row.xx, &row.yy, &row.zz, &row.xz}) *x /= count * p_.shear_yield();
      out.push_back(row);
    }
    return out;
  }
  /// Accumulated plastic strain times G/k, mean over |x| < 1 and integrated over the depth.
  double accumulated() const {
    const std::vector<double>& at = body_.mesh.blocks[0].stations.at;
    double sum = 0;
    int count = 0;
    for (int e = 0; e + 1 < static_cast<int>(at.size()); ++e) {
      if (std::abs(0.5 * (at[e] + at[e + 1])) > 1) continue;
      ++count;
      for (std::size_t q = 0; q + 1 < depth_.size(); ++q)
        if (const auto s = plastic_state(body_, state_.history, 0, static_cast<int>(q), e))
          sum += s->accumulated * (depth_[q + 1] - depth_[q]);
    }
    return sum / count * kSteel.mu / p_.shear_yield();
  }
  /// Mean displacement of the surface along x over |x| < 1, times G/k.
  double surface_shift() const {
    const BlockLayout& lay = body_.layout.blocks[0];
    const std::vector<double>& at = body_.mesh.blocks[0].stations.at;
    double sum = 0;
    int count = 0;
    for (int j = 0; j < lay.stations; ++j)
      if (std::abs(at[j]) < 1) {
        sum += state_.u[lay.line(0, 0) + j];
        ++count;
      }
    return sum / count * kSteel.mu / p_.shear_yield();
  }
  double width() const { return p_.cell; }

 private:
  static SweptBody mesh(const MovingPressure& p, const std::vector<double>& depth) {
    std::vector<double> stations;
    const std::vector<double> half = graded(p.cell, p.track + 2, p.track + kFar, 1.35);
    for (std::size_t k = half.size(); k-- > 1;) stations.push_back(-half[k]);
    for (double x : half) stations.push_back(x);
    return structured_body(SweepKind::extrude, 1, static_cast<int>(depth.size()) - 1, stations, [&](int c, int r) {
      return Vec2{c * p.cell, -depth[r]};
    });
  }
  // Integral of the pressure times the hat function of a surface station, per width.
  double load(int j, double centre) const {
    const std::vector<double>& at = body_.mesh.blocks[0].stations.at;
    double sum = 0;
    constexpr int kParts = 8;
    for (int side : {-1, 1}) {
      if (j + side < 0 || j + side >= static_cast<int>(at.size())) continue;
      const double h = at[j + side] - at[j];
      for (int k = 0; k < kParts; ++k) {
        const double share = (k + 0.5) / kParts, x = at[j] + share * h - centre;
        if (std::abs(x) < 1) sum += std::sqrt(1 - x * x) * (1 - share) * std::abs(h) / kParts;
      }
    }
    return sum * p_.p0_over_k * p_.shear_yield();
  }
  void step(double centre, double share) {
    elements_.begin(state_.u, 0);
    advance_plastic_elements(body_, state_.u, 0, state_.history,
                             count_++ % kLookInterval == 0 ? PlasticLook::all : PlasticLook::awake);
    elements_.internal_force(state_.u, 0, state_.f, state_.history);
    const BlockLayout& lay = body_.layout.blocks[0];
    const std::vector<double>& at = body_.mesh.blocks[0].stations.at;
    if (share > 0)
      for (int j = 0; j < lay.stations; ++j) {
        if (std::abs(at[j] - centre) > 1 + 2 * p_.cell) continue;
        const double force = 0.5 * width() * share * load(j, centre);
        for (int node : {0, 1}) {
          state_.f[lay.line(node, 2) + j] += force;
          state_.f[lay.line(node, 0) + j] -= p_.friction * force;
        }
      }
    const double c = 0.5 * damping_ * dt_;
    const int bottom = lay.nodes - 2;
    for (int n = 0; n < bottom; ++n)
      for (int i : {0, 2}) {
        const std::ptrdiff_t line = lay.line(n, i);
        for (int j = 1; j + 1 < lay.stations; ++j) {
          double& v = state_.v[line + j];
          v = ((1 - c) * v - dt_ * state_.f[line + j] * body_.inverse_mass[line + j]) / (1 + c);
          state_.u[line + j] += dt_ * v;
        }
      }
  }

  MovingPressure p_;
  std::vector<double> depth_;
  Body body_;
  Traversal elements_;
  BodyState state_;
  double dt_ = 0, damping_ = 0;
  long count_ = 0;
};

}  // namespace railstrata::fem_checks
