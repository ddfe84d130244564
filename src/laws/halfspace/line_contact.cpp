#include "halfspace/line_contact.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace railstrata {

namespace {

constexpr double kPi = std::numbers::pi;

/// Primitives in x (times pi) of the Green's functions of exp(-k d)/k and -i sgn(k) exp(-k d)/k:
///   -ln(R/far) and atan(x/d), R² = x² + d².
RectangleInfluence edge(const ComplianceImage& image, double x, double far) {
  const double d = image.depth, log_R = std::log(std::hypot(x, d)), angle = std::atan2(x, d);
  const double even = x - x * (log_R - std::log(far)) - d * angle, odd = x * angle - d * log_R;
  const CompliancePoint& c = image.c;
  return {.nn = c.zz * even, .xx = c.rr * even, .yy = c.tt * even, .nx = c.rz * odd};
}

/// Primitives in x (times pi) of Flamant's solutions: stresses xx, zz, xz by p and by q_x, xy and yz by q_y.
struct FlamantEdge {
  double xx_p, zz_p, xz_p;
  double xx_q, zz_q, xz_q;
  double xy, yz;
};
FlamantEdge flamant(double x, double z) {
  const double square = x * x + z * z, angle = std::atan2(x, z), lean = x * z / square, steep = z * z / square,
               log_R = 0.5 * std::log(square);
  return {lean - angle, -lean - angle, steep, -2 * log_R - steep, steep, lean - angle, -log_R, -angle};
}

}  // namespace

LineHertz hertz_line(double A, double contact_modulus, double load_per_length) {
  const double a = std::sqrt(2 * load_per_length / (kPi * contact_modulus * A));
  return {a, 2 * load_per_length / (kPi * a)};
}

RectangleInfluence strip_influence(const SurfaceCompliance& compliance, double x, double dx, double far) {
  RectangleInfluence sum;
  for (const ComplianceImage& image : compliance) {
    const RectangleInfluence high = edge(image, x + 0.5 * dx, far), low = edge(image, x - 0.5 * dx, far);
    sum.nn += (high.nn - low.nn) / kPi;
    sum.xx += (high.xx - low.xx) / kPi;
    sum.yy += (high.yy - low.yy) / kPi;
    sum.nx += (high.nx - low.nx) / kPi;
  }
  return sum;
}

std::vector<RectangleInfluence> strip_influence_table(const SurfaceCompliance& compliance, int nx, double dx) {
  assert(nx > 0 && dx > 0);
  double far = nx * dx;
  for (const ComplianceImage& image : compliance) far = std::max(far, image.depth);
  std::vector<RectangleInfluence> table;
  for (int i = 0; i < nx; ++i) table.push_back(strip_influence(compliance, i * dx, dx, far));
  return table;
}

InteriorInfluence strip_interior(const HalfSpaceMaterial& material, double x, double z, double dx) {
  const FlamantEdge high = flamant(x + 0.5 * dx, z), low = flamant(x - 0.5 * dx, z);
  const auto stress = [&](double FlamantEdge::*m) { return (high.*m - low.*m) / kPi; };
  const double G = material.shear(), nu = material.poisson;
  const auto in_plane = [&](double xx, double zz, double xz) {
    InteriorState s;
    s.e_xx = ((1 - nu) * xx - nu * zz) / (2 * G);
    s.s_xz = xz;
    s.s_zz = zz;
    return s;
  };
  using F = FlamantEdge;
  InteriorInfluence out{in_plane(stress(&F::xx_p), stress(&F::zz_p), stress(&F::xz_p)),
                        in_plane(stress(&F::xx_q), stress(&F::zz_q), stress(&F::xz_q)),
                        {}};
  out[2].e_xy = stress(&F::xy) / (2 * G);
  out[2].s_yz = stress(&F::yz);
  return out;
}

std::vector<InteriorInfluence> strip_interior_table(const HalfSpaceMaterial& material, double z, int nx, double dx) {
  assert(z >= 0 && nx > 0 && dx > 0);
  std::vector<InteriorInfluence> table;
  for (int i = 0; i < nx; ++i) table.push_back(strip_interior(material, i * dx, z, dx));
  return table;
}

}  // namespace railstrata
