#include "halfspace/interior.hpp"

#include <cassert>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "halfspace/boussinesq_cerruti.hpp"
#include "halfspace/corner_table.hpp"

namespace railstrata {

namespace {

constexpr std::size_t kStates = 6;
constexpr std::array<double InteriorState::*, kStates> kMembers{&InteriorState::e_xx, &InteriorState::e_yy,
                                                                &InteriorState::e_xy, &InteriorState::s_xz,
                                                                &InteriorState::s_yz, &InteriorState::s_zz};

/// Double primitives in (x, y) at a corner. With E = exp(-kz), R² = x² + y² + z², k^ the unit wave vector, the
/// transforms are
///   E (area): z/R³   i k^x E (bx): d/dx 1/R   k^x k^y E (axy): d²/dxdy ln(R + z)   i k^x k^y k^c E: -d³/dxdydc (z ln(R
///   + z) - R).
struct Corner {
  double R, xz, yz, Rz;
  double area, bx, by, ax, ay, axy;
  Corner(double x, double y, double z)
      : R(std::sqrt(x * x + y * y + z * z)), xz(x * x + z * z), yz(y * y + z * z), Rz(R + z) {
    area = std::atan2(x * y, z * R);
    bx = y >= 0 ? std::log(y + R) : std::log(xz / (R - y));
    by = x >= 0 ? std::log(x + R) : std::log(yz / (R - x));
    const double plan = (x * x + y * y) / Rz;
    ax = std::atan2(x * y * plan, R * x * x + z * y * y);
    ay = std::atan2(x * y * plan, R * y * y + z * x * x);
    axy = std::log(Rz);
  }
};

/// In each pair f, f1 the second belongs to kz E = -z dE/dz.
InteriorInfluence corner(double nu, double c, double x, double y, double z) {
  const auto [R, xz, yz, Rz, area, bx, by, ax, ay, axy] = Corner(x, y, z);
  const double area1 = z > 0 ? z * x * y * (R * R + z * z) / (R * xz * yz) : 0.0;
  const double bx1 = z > 0 ? z * z * y / (R * xz) : 0.0, by1 = z > 0 ? z * z * x / (R * yz) : 0.0;
  const double ax1 = z > 0 ? z * x * y / (xz * R) : 0.0, ay1 = z > 0 ? z * x * y / (yz * R) : 0.0;
  const double axy1 = -z / R;
  const double xyy = y / Rz, xyy1 = z * y / (R * Rz), xxy = x / Rz, xxy1 = z * x / (R * Rz);
  const double xxx = bx - xyy, xxx1 = bx1 - xyy1, yyy = by - xxy, yyy1 = by1 - xxy1;
  const auto by_p = [&](double f, double f1) { return -c * ((1 - 2 * nu) * f - f1); };
  const auto by_q = [&](double f, double f1) { return -c * (2 * nu * f + f1); };
  return {
      InteriorState{by_p(ax, ax1), by_p(ay, ay1), by_p(axy, axy1), bx1, by1, -(area + area1)},
      InteriorState{by_q(xxx, xxx1) + 2 * c * bx, by_q(xyy, xyy1), by_q(xxy, xxy1) + c * by, ax1 - area, axy1, bx1},
      InteriorState{by_q(xxy, xxy1), by_q(yyy, yyy1) + 2 * c * by, by_q(xyy, xyy1) + c * bx, axy1, ay1 - area, by1}};
}

InteriorInfluence difference(const InteriorInfluence& pp, const InteriorInfluence& mp, const InteriorInfluence& pm,
                             const InteriorInfluence& mm) {
  constexpr double s = 1 / (2 * std::numbers::pi);
  InteriorInfluence out;
  for (std::size_t load = 0; load < 3; ++load)
    for (auto m : kMembers) out[load].*m = s * ((pp[load].*m - mp[load].*m) - (pm[load].*m - mm[load].*m));
  return out;
}

/// The part of the displacement beside exp(-kz)/k times the surface's: z exp(-kz)/(2G).
InteriorDisplacement corner_beside_surface(double c, double x, double y, double z) {
  if (z == 0) return {};
  const Corner at(x, y, z);
  const double f = c * z / (2 * std::numbers::pi);
  return {f * Vec3{-at.bx, -at.by, at.area}, f * Vec3{-at.ax, -at.axy, -at.bx}, f * Vec3{-at.axy, -at.ay, -at.by}};
}

InteriorDisplacement displacement(const RectangleInfluence& s, const InteriorDisplacement& pp,
                                  const InteriorDisplacement& mp, const InteriorDisplacement& pm,
                                  const InteriorDisplacement& mm) {
  InteriorDisplacement out{Vec3{-s.nx, -s.ny, s.nn}, Vec3{s.xx, s.xy, s.nx}, Vec3{s.xy, s.yy, s.ny}};
  for (std::size_t load = 0; load < 3; ++load) out[load] += (pp[load] - mp[load]) - (pm[load] - mm[load]);
  return out;
}

/// The surface's compliance seen through the depth z.
SurfaceCompliance at_depth(const HalfSpaceMaterial& m, double z) {
  SurfaceCompliance out = homogeneous_compliance(m);
  out[0].depth = z;
  return out;
}

}  // namespace

Sym3 stress_of(const InteriorState& e, const HalfSpaceMaterial& m) {
  const double G2 = 2 * m.shear(), r = m.poisson / (1 - m.poisson);
  const double common = r * (G2 * (e.e_xx + e.e_yy) + e.s_zz);
  return {.xx = G2 * e.e_xx + common,
          .yy = G2 * e.e_yy + common,
          .zz = e.s_zz,
          .xy = G2 * e.e_xy,
          .yz = e.s_yz,
          .xz = e.s_xz};
}

InteriorInfluence rectangle_interior(const HalfSpaceMaterial& m, double x, double y, double z, double dx, double dy) {
  const double nu = m.poisson, c = 1 / (2 * m.shear()), x1 = x - dx / 2, x2 = x + dx / 2, y1 = y - dy / 2,
               y2 = y + dy / 2;
  return difference(corner(nu, c, x2, y2, z), corner(nu, c, x1, y2, z), corner(nu, c, x2, y1, z),
                    corner(nu, c, x1, y1, z));
}

std::vector<InteriorInfluence> rectangle_interior_table(const HalfSpaceMaterial& m, double z, int nx, int ny, double dx,
                                                        double dy) {
  assert(z >= 0);
  const double nu = m.poisson, c = 1 / (2 * m.shear());
  return corner_table(
      nx, ny, dx, dy, [&](double x, double y) { return corner(nu, c, x, y, z); },
      [](std::size_t, const auto&... corners) { return difference(corners...); });
}

InteriorDisplacement rectangle_displacement(const HalfSpaceMaterial& m, double x, double y, double z, double dx,
                                            double dy) {
  const double c = 1 / (2 * m.shear()), x1 = x - dx / 2, x2 = x + dx / 2, y1 = y - dy / 2, y2 = y + dy / 2;
  const auto at = [&](double px, double py) { return corner_beside_surface(c, px, py, z); };
  return displacement(rectangle_influence(at_depth(m, z), x, y, dx, dy), at(x2, y2), at(x1, y2), at(x2, y1),
                      at(x1, y1));
}

std::vector<InteriorDisplacement> rectangle_displacement_table(const HalfSpaceMaterial& m, double z, int nx, int ny,
                                                               double dx, double dy) {
  assert(z >= 0);
  const double c = 1 / (2 * m.shear());
  const auto surface = rectangle_influence_table(at_depth(m, z), nx, ny, dx, dy);
  return corner_table(
      nx, ny, dx, dy, [&](double x, double y) { return corner_beside_surface(c, x, y, z); },
      [&](std::size_t k, const auto&... corners) { return displacement(surface[k], corners...); });
}

}  // namespace railstrata
