#include "halfspace/interior.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "halfspace/boussinesq_cerruti.hpp"

namespace railstrata {
namespace {

const HalfSpaceMaterial kBody{70e9, 0.27};

// Far from a small square the fields are those of point forces [Johnson1985 eqs. 3.19, 3.77].
TEST(Interior, FarFieldIsBoussinesqAndCerruti) {
  const double x = 0.3, y = -0.5, z = 0.7, s = 1e-3, P = s * s;
  const double r2 = x * x + y * y, rho = std::sqrt(r2 + z * z), nu = kBody.poisson, pi = std::numbers::pi;
  const InteriorInfluence i = rectangle_interior(kBody, x, y, z, s, s);
  const Sym3 n = stress_of(i[0], kBody), t = stress_of(i[1], kBody);
  const double tolerance = 2e-6 * P;
  EXPECT_NEAR(n.zz, -3 * P * z * z * z / (2 * pi * std::pow(rho, 5)), tolerance);
  EXPECT_NEAR(n.xz, -3 * P * x * z * z / (2 * pi * std::pow(rho, 5)), tolerance);
  EXPECT_NEAR(n.xx,
              P / (2 * pi) *
                  ((1 - 2 * nu) / r2 * ((1 - z / rho) * (x * x - y * y) / r2 + z * y * y / (rho * rho * rho)) -
                   3 * z * x * x / std::pow(rho, 5)),
              tolerance);
  EXPECT_NEAR(n.xx + n.yy + n.zz, -P / pi * (1 + nu) * z / (rho * rho * rho), tolerance);
  EXPECT_NEAR(t.zz, -3 * P * x * z * z / (2 * pi * std::pow(rho, 5)), tolerance);
  EXPECT_NEAR(t.yz, -3 * P * x * y * z / (2 * pi * std::pow(rho, 5)), tolerance);
  EXPECT_NEAR(t.xz, -3 * P * x * x * z / (2 * pi * std::pow(rho, 5)), tolerance);
  EXPECT_NEAR(t.xx + t.yy + t.zz, -P / pi * (1 + nu) * x / (rho * rho * rho), tolerance);
}

TEST(Interior, SurfaceTractionsAreTheLoads) {
  const InteriorInfluence inside = rectangle_interior(kBody, 0.1, 0.05, 0, 1, 1),
                          outside = rectangle_interior(kBody, 0.8, 0.05, 0, 1, 1);
  EXPECT_NEAR(inside[0].s_zz, -1, 1e-14);
  EXPECT_NEAR(inside[1].s_xz, -1, 1e-14);
  EXPECT_NEAR(inside[2].s_yz, -1, 1e-14);
  EXPECT_NEAR(inside[1].s_zz, 0, 1e-14);
  for (std::size_t l = 0; l < 3; ++l)
    EXPECT_NEAR(std::abs(outside[l].s_xz) + std::abs(outside[l].s_yz) + std::abs(outside[l].s_zz), 0, 1e-14);
}

TEST(Interior, EquilibriumHoldsByFiniteDifferencesForEveryLoad) {
  const double e = 1e-4;
  for (std::size_t load = 0; load < 3; ++load) {
    const auto at = [&](double x, double y, double z) {
      return stress_of(rectangle_interior(kBody, x, y, z, 1, 0.6)[load], kBody);
    };
    for (const Vec3 p : {Vec3{0.2, 0.1, 0.3}, Vec3{-0.9, 0.5, 0.15}, Vec3{0.45, -0.31, 1.2}}) {
      const auto d = [&](double Sym3::*m, int axis) {
        const Vec3 h{axis == 0 ? e : 0, axis == 1 ? e : 0, axis == 2 ? e : 0};
        return (at(p.x + h.x, p.y + h.y, p.z + h.z).*m - at(p.x - h.x, p.y - h.y, p.z - h.z).*m) / (2 * e);
      };
      EXPECT_NEAR(d(&Sym3::xx, 0) + d(&Sym3::xy, 1) + d(&Sym3::xz, 2), 0, 1e-6);
      EXPECT_NEAR(d(&Sym3::xy, 0) + d(&Sym3::yy, 1) + d(&Sym3::yz, 2), 0, 1e-6);
      EXPECT_NEAR(d(&Sym3::xz, 0) + d(&Sym3::yz, 1) + d(&Sym3::zz, 2), 0, 1e-6);
    }
  }
}

TEST(Interior, SurfaceStrainsAreTheDerivativesOfTheSurfaceDisplacements) {
  const SurfaceCompliance c = homogeneous_compliance(kBody);
  const double x = 0.2, y = 0.13, e = 1e-5;
  const auto u = [&](double px, double py) { return rectangle_influence(c, px, py, 1, 0.6); };
  const InteriorInfluence s = rectangle_interior(kBody, x, y, 0, 1, 0.6);
  const double scale = 1 / kBody.shear(), h = 2 * e;
  EXPECT_NEAR(s[1].e_xx, (u(x + e, y).xx - u(x - e, y).xx) / h, 1e-8 * scale);
  EXPECT_NEAR(s[1].e_yy, (u(x, y + e).xy - u(x, y - e).xy) / h, 1e-8 * scale);
  EXPECT_NEAR(s[2].e_xx, (u(x + e, y).xy - u(x - e, y).xy) / h, 1e-8 * scale);
  EXPECT_NEAR(s[2].e_xy, 0.5 * ((u(x + e, y).yy - u(x - e, y).yy) + (u(x, y + e).xy - u(x, y - e).xy)) / h,
              1e-8 * scale);
  EXPECT_NEAR(s[0].e_xx, -(u(x + e, y).nx - u(x - e, y).nx) / h, 1e-8 * scale);
  EXPECT_NEAR(s[0].e_xy, -0.5 * ((u(x + e, y).ny - u(x - e, y).ny) + (u(x, y + e).nx - u(x, y - e).nx)) / h,
              1e-8 * scale);
}

// [Johnson1985 eqs. 3.18, 3.75]: displacements of point forces.
TEST(Interior, FarDisplacementIsBoussinesqsAndCerrutis) {
  const double x = 0.3, y = -0.5, z = 0.7, s = 1e-3;
  const double rho = std::sqrt(x * x + y * y + z * z), nu = kBody.poisson;
  const double f = s * s / (4 * std::numbers::pi * kBody.shear());
  const InteriorDisplacement u = rectangle_displacement(kBody, x, y, z, s, s);
  const double tolerance = 2e-6 * f;
  EXPECT_NEAR(u[0].x, f * (x * z / std::pow(rho, 3) - (1 - 2 * nu) * x / (rho * (rho + z))), tolerance);
  EXPECT_NEAR(u[0].y, f * (y * z / std::pow(rho, 3) - (1 - 2 * nu) * y / (rho * (rho + z))), tolerance);
  EXPECT_NEAR(u[0].z, f * (z * z / std::pow(rho, 3) + 2 * (1 - nu) / rho), tolerance);
  EXPECT_NEAR(
      u[1].x,
      f * (1 / rho + x * x / std::pow(rho, 3) + (1 - 2 * nu) * (1 / (rho + z) - x * x / (rho * std::pow(rho + z, 2)))),
      tolerance);
  EXPECT_NEAR(u[1].y, f * (x * y / std::pow(rho, 3) - (1 - 2 * nu) * x * y / (rho * std::pow(rho + z, 2))), tolerance);
  EXPECT_NEAR(u[1].z, f * (x * z / std::pow(rho, 3) + (1 - 2 * nu) * x / (rho * (rho + z))), tolerance);
}

TEST(Interior, DisplacementAtTheSurfaceIsThatOfTheSurfaceInfluence) {
  const RectangleInfluence s = rectangle_influence(homogeneous_compliance(kBody), 0.4, -0.7, 1, 0.6);
  const InteriorDisplacement u = rectangle_displacement(kBody, 0.4, -0.7, 0, 1, 0.6),
                             below = rectangle_displacement(kBody, 0.4, -0.7, 1e-9, 1, 0.6);
  const double expected[3][3] = {{-s.nx, -s.ny, s.nn}, {s.xx, s.xy, s.nx}, {s.xy, s.yy, s.ny}};
  for (std::size_t l = 0; l < 3; ++l) {
    EXPECT_NEAR(u[l].x, expected[l][0], 1e-12 * s.nn);
    EXPECT_NEAR(u[l].y, expected[l][1], 1e-12 * s.nn);
    EXPECT_NEAR(u[l].z, expected[l][2], 1e-12 * s.nn);
    EXPECT_NEAR(norm(below[l] - u[l]), 0, 1e-7 * s.nn) << "and continuous down to it";
  }
}

// Two closed forms of one field: the derivatives of the displacements, by Hooke's law, are the stresses.
TEST(Interior, StressesFollowFromTheDisplacementsByHookesLaw) {
  const double e = 1e-4, G = kBody.shear(), lambda = 2 * G * kBody.poisson / (1 - 2 * kBody.poisson);
  for (std::size_t load = 0; load < 3; ++load)
    for (const Vec3 p : {Vec3{0.2, 0.1, 0.3}, Vec3{-0.9, 0.5, 0.15}, Vec3{0.45, -0.31, 1.2}}) {
      const auto u = [&](Vec3 at) { return rectangle_displacement(kBody, at.x, at.y, at.z, 1, 0.6)[load]; };
      const Vec3 dx = (0.5 / e) * (u(p + Vec3{e, 0, 0}) - u(p - Vec3{e, 0, 0})),
                 dy = (0.5 / e) * (u(p + Vec3{0, e, 0}) - u(p - Vec3{0, e, 0})),
                 dz = (0.5 / e) * (u(p + Vec3{0, 0, e}) - u(p - Vec3{0, 0, e}));
      const Sym3 s = stress_of(rectangle_interior(kBody, p.x, p.y, p.z, 1, 0.6)[load], kBody);
      const double spread = lambda * (dx.x + dy.y + dz.z);
      EXPECT_NEAR(s.xx, spread + 2 * G * dx.x, 1e-6);
      EXPECT_NEAR(s.yy, spread + 2 * G * dy.y, 1e-6);
      EXPECT_NEAR(s.zz, spread + 2 * G * dz.z, 1e-6);
      EXPECT_NEAR(s.xy, G * (dx.y + dy.x), 1e-6);
      EXPECT_NEAR(s.yz, G * (dy.z + dz.y), 1e-6);
      EXPECT_NEAR(s.xz, G * (dx.z + dz.x), 1e-6);
    }
}

TEST(Interior, TableEqualsSingleRectangles) {
  const auto table = rectangle_interior_table(kBody, 0.2, 3, 4, 0.3, 0.2);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 4; ++j)
      for (std::size_t l = 0; l < 3; ++l) {
        const InteriorState one = rectangle_interior(kBody, i * 0.3, j * 0.2, 0.2, 0.3, 0.2)[l],
                            &t = table[static_cast<std::size_t>(4 * i + j)][l];
        EXPECT_NEAR(t.s_zz, one.s_zz, 1e-14);
        EXPECT_NEAR(t.s_xz, one.s_xz, 1e-14);
        EXPECT_NEAR(t.e_xy * kBody.shear(), one.e_xy * kBody.shear(), 1e-14);
        EXPECT_NEAR(
            norm(rectangle_displacement_table(kBody, 0.2, 3, 4, 0.3, 0.2)[static_cast<std::size_t>(4 * i + j)][l] -
                 rectangle_displacement(kBody, i * 0.3, j * 0.2, 0.2, 0.3, 0.2)[l]) *
                kBody.shear(),
            0, 1e-14);
      }
}

}  // namespace
}  // namespace railstrata
