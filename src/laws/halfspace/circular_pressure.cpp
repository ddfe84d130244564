#include "halfspace/circular_pressure.hpp"

#include <Eigen/LU>

#include <cassert>
#include <cmath>

#include "halfspace/interior.hpp"
#include "halfspace/layer_waves.hpp"

namespace railstrata {
namespace {

constexpr double kDeepest = 30;  // k z: what is left of a wave there is e^-30
constexpr double kPhase = 0.02;  // between two wave numbers, over the largest length

/// Strains in plan and tractions of one circle under unit pressure, x along its radius.
struct OfCircle {
  InteriorState state;
  double sinking = 0;
};

OfCircle of_circle(const LayeredHalfSpace& body, double a, double r, double depth) {
  double length = a + r + depth + bending_length(body);
  for (const HalfSpaceLayer& layer : body.layers) length += layer.thickness;
  const auto steps = static_cast<long>(std::ceil(kDeepest / depth * length / kPhase));
  const double step = kDeepest / depth / static_cast<double>(steps);
  OfCircle sum;
  for (long i = 0; i < steps; ++i) {
    const double k = (static_cast<double>(i) + 0.5) * step;
    const LayerWaves waves(body, k);
    const WaveState top = waves.state(0);
    const Eigen::Vector2d amplitude = top.bottomRows<2>().partialPivLu().solve(Eigen::Vector2d(0, -1 / k));
    const Eigen::Vector4d at = waves.state(depth) * amplitude;  // U, W, T/k, S/k of unit pressure
    const double weight = a * std::cyl_bessel_j(1, k * a) * step, j0 = std::cyl_bessel_j(0, k * r),
                 j1 = std::cyl_bessel_j(1, k * r), over_r = r > 0 ? j1 / r : 0.5 * k;
    sum.state.e_xx -= weight * at[0] * (k * j0 - over_r);
    sum.state.e_yy -= weight * at[0] * over_r;
    sum.state.s_xz -= weight * at[2] * k * j1;
    sum.state.s_zz += weight * at[3] * k * j0;
    sum.sinking += weight * at[1] * j0;
  }
  return sum;
}

Sym3 strain_of(const Sym3& s, const HalfSpaceMaterial& m) {
  const double trace = m.poisson * (s.xx + s.yy + s.zz), turn = (1 + m.poisson) / m.young;
  return {.xx = turn * s.xx - trace / m.young,
          .yy = turn * s.yy - trace / m.young,
          .zz = turn * s.zz - trace / m.young,
          .xy = turn * s.xy,
          .yz = turn * s.yz,
          .xz = turn * s.xz};
}

}  // namespace

PointBelow below_circles(const LayeredHalfSpace& body, std::span<const PressedCircle> circles, Vec3 at) {
  assert(at.z > 0);
  PointBelow out;
  const HalfSpaceMaterial material = material_at(body, at.z);
  for (const PressedCircle& circle : circles) {
    const double x = at.x - circle.x, y = at.y - circle.y, r = std::hypot(x, y);
    const double c = r > 0 ? x / r : 1, s = r > 0 ? y / r : 0;
    const OfCircle one = of_circle(body, circle.radius, r, at.z);
    const Sym3 polar = stress_of(one.state, material);
    const Sym3 turned{.xx = c * c * polar.xx + s * s * polar.yy,
                      .yy = s * s * polar.xx + c * c * polar.yy,
                      .zz = polar.zz,
                      .xy = c * s * (polar.xx - polar.yy),
                      .yz = s * polar.xz,
                      .xz = c * polar.xz};
    out.stress = out.stress + circle.pressure * turned;
    out.sinking += circle.pressure * one.sinking;
  }
  out.strain = strain_of(out.stress, material);
  return out;
}

}  // namespace railstrata
