#include <gtest/gtest.h>

#include <cmath>

#include "result/band_surface.hpp"

using namespace railstrata;

namespace {

Sym3 hooke(const Elastic& m, const Sym3& e) {
  const double p = m.lambda * (e.xx + e.yy + e.zz);
  return {p + 2 * m.mu * e.xx, p + 2 * m.mu * e.yy, p + 2 * m.mu * e.zz,
          2 * m.mu * e.xy,     2 * m.mu * e.yz,     2 * m.mu * e.xz};
}
double component(const Sym3& s, Vec3 a, Vec3 b) { return dot(a, s * b); }

}  // namespace

TEST(SurfaceStress, TractionAndOwnStrainsGiveBackAnyHomogeneousStateOnAnyInclination) {  // Hooke's law
  const Elastic steel = elastic(210e9, 0.3, 7800);
  const Sym3 strain{1e-3, -4e-4, 7e-4, 3e-4, -2e-4, 5e-4};
  const Sym3 stress = hooke(steel, strain);
  for (double tilt : {0.0, 0.025, -0.4, 2.9}) {
    const Vec3 n{0, -std::sin(tilt), std::cos(tilt)}, t1{1, 0, 0}, t2 = cross(n, t1);
    const Sym3 back = surface_stress(steel, n, t1, t2, component(strain, t1, t1), component(strain, t2, t2),
                                     2 * component(strain, t1, t2), stress * n);
    EXPECT_NEAR(back.xx, stress.xx, 1e-3);
    EXPECT_NEAR(back.yy, stress.yy, 1e-3);
    EXPECT_NEAR(back.zz, stress.zz, 1e-3);
    EXPECT_NEAR(back.xy, stress.xy, 1e-3);
    EXPECT_NEAR(back.yz, stress.yz, 1e-3);
    EXPECT_NEAR(back.xz, stress.xz, 1e-3);
  }
}
