#include "halfspace/boussinesq_cerruti.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>

#include "halfspace/corner_table.hpp"

namespace railstrata {

namespace {

/// Double primitives in (x, y) at one corner of the Green's functions (times 2 pi) of exp(-k d)/k, i k^x …, k^x k^x …,
/// k^x k^y …, with R² = x² + y² + d²:
///   1/R,  x/(R (R + d)),  y/(R (R + d)),  and -d²/dx² , -d²/dxdy of d ln(R + d) - R.
RectangleInfluence corner(const ComplianceImage& image, double x, double y) {
  const double d = image.depth, R = std::sqrt(x * x + y * y + d * d);
  // ln(y + R) without cancellation for y < 0
  const double log_y = y >= 0 ? std::log(y + R) : std::log((x * x + d * d) / (R - y));
  const double log_x = x >= 0 ? std::log(x + R) : std::log((y * y + d * d) / (R - x));
  const double plan = x * x + y * y, log_d = std::log(R + d);
  // atan(y/x) - atan(d y/(x R)) in one continuous piece, and its mirror
  const double factor = R + d > 0 ? plan / (R + d) : 0.0;
  const double angle_x = std::atan2(x * y * factor, R * x * x + d * y * y);
  const double angle_y = std::atan2(x * y * factor, R * y * y + d * x * x);
  const double kxx = x * log_y - d * angle_x, kyy = y * log_x - d * angle_y, kxy = R - d * log_d;
  const double slope_x = y * log_d + d * log_y + x * angle_x, slope_y = x * log_d + d * log_x + y * angle_y;
  const CompliancePoint& c = image.c;
  return {.nn = c.zz * (kxx + kyy),
          .xx = c.rr * kxx + c.tt * kyy,
          .xy = (c.rr - c.tt) * kxy,
          .yy = c.rr * kyy + c.tt * kxx,
          .nx = c.rz * slope_x,
          .ny = c.rz * slope_y};
}

RectangleInfluence& operator+=(RectangleInfluence& a, const RectangleInfluence& b) {
  a.nn += b.nn;
  a.xx += b.xx;
  a.xy += b.xy;
  a.yy += b.yy;
  a.nx += b.nx;
  a.ny += b.ny;
  return a;
}

RectangleInfluence corner_sum(const SurfaceCompliance& compliance, double x, double y) {
  RectangleInfluence sum;
  for (const ComplianceImage& image : compliance) sum += corner(image, x, y);
  return sum;
}

RectangleInfluence difference(const RectangleInfluence& pp, const RectangleInfluence& mp, const RectangleInfluence& pm,
                              const RectangleInfluence& mm) {
  constexpr double s = 1 / (2 * std::numbers::pi);
  const auto four = [&](auto member) { return s * ((pp.*member - mp.*member) - (pm.*member - mm.*member)); };
  using I = RectangleInfluence;
  return {four(&I::nn), four(&I::xx), four(&I::xy), four(&I::yy), four(&I::nx), four(&I::ny)};
}

}  // namespace

SurfaceCompliance homogeneous_compliance(const HalfSpaceMaterial& m) {
  const double G = m.shear(), nu = m.poisson;
  return {{0, {(1 - nu) / G, (1 - 2 * nu) / (2 * G), (1 - nu) / G, 1 / G}}};
}

SurfaceCompliance combined_compliance(const SurfaceCompliance& wheel, const SurfaceCompliance& rail) {
  SurfaceCompliance sum = rail;
  for (ComplianceImage image : wheel) {
    image.c.rz = -image.c.rz;
    bool merged = false;
    for (ComplianceImage& s : sum) {
      if (s.depth != image.depth) continue;
      s.c = {s.c.zz + image.c.zz, s.c.rz + image.c.rz, s.c.rr + image.c.rr, s.c.tt + image.c.tt};
      merged = true;
      break;
    }
    if (!merged) sum.push_back(image);
  }
  return sum;
}

RectangleInfluence rectangle_influence(const SurfaceCompliance& compliance, double x, double y, double dx, double dy) {
  const double x1 = x - dx / 2, x2 = x + dx / 2, y1 = y - dy / 2, y2 = y + dy / 2;
  return difference(corner_sum(compliance, x2, y2), corner_sum(compliance, x1, y2), corner_sum(compliance, x2, y1),
                    corner_sum(compliance, x1, y1));
}

std::vector<RectangleInfluence> rectangle_influence_table(const SurfaceCompliance& compliance, int nx, int ny,
                                                          double dx, double dy) {
  return corner_table(
      nx, ny, dx, dy, [&](double x, double y) { return corner_sum(compliance, x, y); },
      [](std::size_t, const auto&... corners) { return difference(corners...); });
}

}  // namespace railstrata
