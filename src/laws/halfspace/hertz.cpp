#include "halfspace/hertz.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace railstrata {

namespace {

/// B = (E - k'²K)/k² and D = (K - E)/k² of modulus k, in terms of the axis ratio k' = minor/major. Series near the
/// circle, where the quotients cancel.
struct EllipticBD {
  double B, D;
};
EllipticBD elliptic_bd(double axis_ratio) {
  const double m = (1 - axis_ratio) * (1 + axis_ratio);
  if (m < 1e-3) {
    constexpr double quarter_pi = std::numbers::pi / 4;
    return {quarter_pi * (1 + m * (1.0 / 8 + m * (3.0 / 64 + m * (25.0 / 1024 + m * (245.0 / 16384))))),
            quarter_pi * (1 + m * (3.0 / 8 + m * (15.0 / 64 + m * (175.0 / 1024 + m * (2205.0 / 16384)))))};
  }
  const double K = std::comp_ellint_1(std::sqrt(m)), E = std::comp_ellint_2(std::sqrt(m));
  return {(E - axis_ratio * axis_ratio * K) / m, (K - E) / m};
}

/// Curvature along the major axis over curvature along the minor one, for an axis ratio g = minor/major in (0, 1].
double curvature_ratio(double g) {
  const EllipticBD e = elliptic_bd(g);
  return g * g * e.D / e.B;
}

double axis_ratio_of(double ratio) {
  double low = std::log(1e-12), high = 0;  // curvature_ratio grows with g
  double t = 0.6 * std::log(ratio);        // g ~ ratio^(0.6…0.67)
  for (int i = 0; i < 200 && high - low > 1e-15; ++i) {
    if (t <= low || t >= high) t = 0.5 * (low + high);
    const double f = std::log(curvature_ratio(std::exp(t)) / ratio);
    (f > 0 ? high : low) = t;
    constexpr double step = 1e-5;
    const double slope =
        (std::log(curvature_ratio(std::exp(t - step))) - std::log(curvature_ratio(std::exp(t)))) / -step;
    const double next = t - f / slope;
    if (std::abs(next - t) < 1e-15) return std::exp(next < 0 ? next : 0.0);
    t = next;
  }
  return std::exp(0.5 * (low + high));
}

}  // namespace

double contact_modulus(const HalfSpaceMaterial& wheel, const HalfSpaceMaterial& rail) {
  return 1 / ((1 - wheel.poisson * wheel.poisson) / wheel.young + (1 - rail.poisson * rail.poisson) / rail.young);
}

double HertzContact::pressure(double x, double y) const {
  const double s = 1 - x * x / (a * a) - y * y / (b * b);
  return s > 0 ? p0 * std::sqrt(s) : 0.0;
}

HertzContact hertz_contact(double A, double B, double contact_modulus, double load) {
  if (!(A > 0 && B > 0 && contact_modulus > 0 && load >= 0))
    throw std::invalid_argument("hertz_contact: A, B and the contact modulus must be positive, the load not negative");
  if (load == 0) return {};
  const bool x_is_major = A <= B;
  const double along_major = x_is_major ? A : B, along_minor = x_is_major ? B : A;
  const double g = axis_ratio_of(along_major / along_minor);
  const EllipticBD e = elliptic_bd(g);
  // p0 = 3 F/(2 pi a b) in A = (p0/E*) (b/a²) D
  const double major = std::cbrt(3 * load * e.D / (2 * std::numbers::pi * contact_modulus * along_major)),
               minor = g * major;
  HertzContact c;
  c.p0 = 3 * load / (2 * std::numbers::pi * major * minor);
  c.approach = c.p0 / contact_modulus * minor * (e.B + e.D);
  c.load = load;
  c.a = major;
  c.b = minor;
  if (!x_is_major) std::swap(c.a, c.b);
  return c;
}

HertzGap hertz_gap(double a, double b, double contact_modulus, double load) {
  const double major = a > b ? a : b, minor = a > b ? b : a, g = minor / major;
  const EllipticBD e = elliptic_bd(g);
  const double scale = 3 * load / (2 * std::numbers::pi * contact_modulus * major * major * major);
  const double along_major = scale * e.D, along_minor = scale * e.B / (g * g);
  return a > b ? HertzGap{along_major, along_minor} : HertzGap{along_minor, along_major};
}

}  // namespace railstrata
