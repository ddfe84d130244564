#include "halfspace/creep_theories.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace railstrata {

namespace {

/// [Kalker1990 table E.3]: axis ratio a/b, then C11, C22, C23 for nu = 0, 1/4, 1/2.
struct KalkerRow {
  double ratio;
  std::array<CreepCoefficients, 3> at_nu;
};
constexpr std::array<KalkerRow, 19> kTable{{
    {0.1, {{{2.51, 2.51, 0.334}, {3.31, 2.52, 0.473}, {4.85, 2.53, 0.731}}}},
    {0.2, {{{2.59, 2.59, 0.483}, {3.37, 2.63, 0.603}, {4.81, 2.66, 0.809}}}},
    {0.3, {{{2.68, 2.68, 0.607}, {3.44, 2.75, 0.715}, {4.8, 2.81, 0.889}}}},
    {0.4, {{{2.78, 2.78, 0.72}, {3.53, 2.88, 0.823}, {4.82, 2.98, 0.977}}}},
    {0.5, {{{2.88, 2.88, 0.827}, {3.62, 3.01, 0.929}, {4.83, 3.14, 1.07}}}},
    {0.6, {{{2.98, 2.98, 0.93}, {3.72, 3.14, 1.03}, {4.91, 3.31, 1.18}}}},
    {0.7, {{{3.09, 3.09, 1.03}, {3.81, 3.28, 1.14}, {4.97, 3.48, 1.29}}}},
    {0.8, {{{3.19, 3.19, 1.13}, {3.91, 3.41, 1.25}, {5.05, 3.65, 1.4}}}},
    {0.9, {{{3.29, 3.29, 1.23}, {4.01, 3.54, 1.36}, {5.12, 3.82, 1.51}}}},
    {1, {{{3.4, 3.4, 1.33}, {4.12, 3.67, 1.47}, {5.2, 3.98, 1.63}}}},
    {1.0 / 0.9, {{{3.51, 3.51, 1.44}, {4.22, 3.81, 1.59}, {5.3, 4.16, 1.77}}}},
    {1.0 / 0.8, {{{3.65, 3.65, 1.58}, {4.36, 3.99, 1.75}, {5.42, 4.39, 1.94}}}},
    {1.0 / 0.7, {{{3.82, 3.82, 1.76}, {4.54, 4.21, 1.95}, {5.58, 4.67, 2.18}}}},
    {1.0 / 0.6, {{{4.06, 4.06, 2.01}, {4.78, 4.5, 2.23}, {5.8, 5.04, 2.5}}}},
    {2, {{{4.37, 4.37, 2.35}, {5.1, 4.9, 2.62}, {6.11, 5.56, 2.96}}}},
    {2.5, {{{4.84, 4.84, 2.88}, {5.57, 5.48, 3.24}, {6.57, 6.31, 3.7}}}},
    {1.0 / 0.3, {{{5.57, 5.57, 3.79}, {6.34, 6.4, 4.32}, {7.34, 7.51, 5.01}}}},
    {5, {{{6.96, 6.96, 5.72}, {7.78, 8.14, 6.63}, {8.82, 9.79, 7.89}}}},
    {10, {{{10.7, 10.7, 12.2}, {11.7, 12.8, 14.6}, {12.9, 16, 18}}}},
}};

CreepCoefficients weighted(const std::array<CreepCoefficients, 3>& c, const std::array<double, 3>& w) {
  CreepCoefficients s;
  for (std::size_t i = 0; i < 3; ++i) {
    s.c11 += w[i] * c[i].c11;
    s.c22 += w[i] * c[i].c22;
    s.c23 += w[i] * c[i].c23;
  }
  return s;
}

}  // namespace

CreepCoefficients kalker_coefficients(double a_over_b, double poisson) {
  const double ratio = std::clamp(a_over_b, kTable.front().ratio, kTable.back().ratio);
  const auto above = std::upper_bound(kTable.begin() + 1, kTable.end() - 1, ratio,
                                      [](double r, const KalkerRow& row) { return r < row.ratio; });
  const KalkerRow &low = *(above - 1), &high = *above;
  // the coefficients go with b/a above one and with a/b below: interpolate in whichever is bounded
  const auto coordinate = [](double r) { return r <= 1 ? r : 2 - 1 / r; };
  const double t = (coordinate(ratio) - coordinate(low.ratio)) / (coordinate(high.ratio) - coordinate(low.ratio));
  const double n = 4 * poisson;  // parabola through nu = 0, 1/4, 1/2
  std::array<CreepCoefficients, 3> at_nu;
  for (std::size_t v = 0; v < 3; ++v) {
    const CreepCoefficients &a = low.at_nu[v], &b = high.at_nu[v];
    at_nu[v] = {a.c11 + t * (b.c11 - a.c11), a.c22 + t * (b.c22 - a.c22), a.c23 + t * (b.c23 - a.c23)};
  }
  return weighted(at_nu, {(n - 1) * (n - 2) / 2, -n * (n - 2), n * (n - 1) / 2});
}

CreepCoefficients kalker_coefficients_by_inverse(double a_over_b, double poisson) {
  const double n = 4 * poisson, weight[] = {(n - 1) * (n - 2) / 2, -n * (n - 2), n * (n - 1) / 2};
  CreepCoefficients inverse;
  for (int k = 0; k < 3; ++k) {
    const CreepCoefficients c = kalker_coefficients(a_over_b, 0.25 * k);
    inverse.c11 += weight[k] / c.c11;
    inverse.c22 += weight[k] / c.c22;
    inverse.c23 += weight[k] / c.c23;
  }
  return {1 / inverse.c11, 1 / inverse.c22, 1 / inverse.c23};
}

RollingEllipse rolling_ellipse(const HertzContact& contact, double friction, const HalfSpaceMaterial& wheel,
                               const HalfSpaceMaterial& rail) {
  const double soft_wheel = 1 / wheel.shear(), soft_rail = 1 / rail.shear(), shear = 2 / (soft_wheel + soft_rail);
  const double poisson = shear * (wheel.poisson * soft_wheel + rail.poisson * soft_rail) / 2;
  return {contact, friction, shear, kalker_coefficients(contact.a / contact.b, poisson)};
}

CreepForce linear_theory(const RollingEllipse& e, const Creepage& c) {
  const double area = e.contact.a * e.contact.b, G = e.shear;
  return {G * area * e.coefficient.c11 * c.x,
          G * area * (e.coefficient.c22 * c.y + std::sqrt(area) * e.coefficient.c23 * c.spin)};
}

CreepForce vermeulen_johnson(const RollingEllipse& e, const Creepage& c) {
  const CreepForce linear = linear_theory(e, c);
  const double size = std::hypot(linear.x, linear.y), bound = e.friction * e.contact.load;
  if (size == 0) return {};
  const double left = std::max(0.0, 1 - size / bound / 3), scale = bound * (1 - left * left * left) / size;
  return {scale * linear.x, scale * linear.y};
}

CreepForce polach(const RollingEllipse& e, const Creepage& c) {
  const double a = e.contact.a, b = e.contact.b, G = e.shear, bound = e.friction * e.contact.load;
  const double with_spin = c.y + c.spin * a, side = std::abs(with_spin) > std::abs(c.y) ? with_spin : c.y;
  const double slip = std::hypot(c.x, c.y), total = std::hypot(c.x, side);
  if (total == 0) return {};
  const double direction_x = slip > 0 ? c.x / slip : 0.0, direction_y = slip > 0 ? c.y / slip : 1.0;
  const double stiffness = std::hypot(e.coefficient.c11 * direction_x, e.coefficient.c22 * direction_y);
  const double epsilon = G * std::numbers::pi * a * b * stiffness * total / (4 * bound);
  const double force = 2 * bound / std::numbers::pi * (epsilon / (1 + epsilon * epsilon) + std::atan(epsilon));
  const double narrow = 1 + 6.3 * (1 - std::exp(-a / b));
  const double epsilon_s = 8.0 / 3 * G * b * std::sqrt(a * b) * e.coefficient.c23 / bound * std::abs(side) / narrow;
  const double delta = (epsilon_s * epsilon_s - 1) / (epsilon_s * epsilon_s + 1);
  const double moment = epsilon_s * (delta * delta * delta / 3 - delta * delta / 2 + 1.0 / 6) -
                        std::sqrt(std::pow(1 - delta * delta, 3)) / 3;
  const double by_spin = -9.0 / 16 * a * bound * moment * narrow * c.spin / total;
  return {force * c.x / total, force * c.y / total + by_spin};
}

CreepForce fastsim(const RollingEllipse& e, const Creepage& c, int strips, int slices) {
  const double a = e.contact.a, b = e.contact.b, G = e.shear;
  const double L1 = 8 * a / (3 * e.coefficient.c11 * G), L2 = 8 * a / (3 * e.coefficient.c22 * G),
               L3 = std::numbers::pi * a * a / (4 * e.coefficient.c23 * G * std::sqrt(a * b));
  const double bound0 = e.friction * 2 * e.contact.load / (std::numbers::pi * a * b);
  CreepForce force;
  const double dy = 2 * b / strips;
  for (int j = 0; j < strips; ++j) {
    const double y = -b + (j + 0.5) * dy, lead = a * std::sqrt(1 - y * y / (b * b)), dx = 2 * lead / slices;
    double qx = 0, qy = 0;
    for (int i = 0; i < slices; ++i) {  // from the leading edge back
      const double x = lead - (i + 0.5) * dx;
      const double step = i == 0 ? 0.5 * dx : dx;
      qx += step * (c.x / L1 - c.spin * y / L3);
      qy += step * (c.y / L2 + c.spin * (x + 0.5 * step) / L3);
      const double bound = bound0 * (1 - x * x / (a * a) - y * y / (b * b)), size = std::hypot(qx, qy);
      if (size > bound) {
        qx *= bound / size;
        qy *= bound / size;
      }
      force.x += qx * dx * dy;
      force.y += qy * dx * dy;
      force.moment += (x * qy - y * qx) * dx * dy;
    }
  }
  return force;
}

}  // namespace railstrata
