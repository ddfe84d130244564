#include "halfspace/line_contact.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "halfspace/layered.hpp"

namespace railstrata {
namespace {

const HalfSpaceMaterial kSteel{210e9, 0.3}, kOther{70e9, 0.2};
constexpr double kLong = 20;  // m; more costs digits

// carter2d.csv: 5 mm and 576.9231 MPa of the relative radius 0.5 m.
TEST(LineContact, HertzOfTheReferenceTable) {
  const double p0 = 576.9231e6, a = 5e-3;
  const LineHertz line = hertz_line(1.0, contact_modulus(kSteel, kSteel), 0.5 * std::numbers::pi * a * p0);
  EXPECT_NEAR(line.a / a, 1, 1e-7);
  EXPECT_NEAR(line.p0 / p0, 1, 1e-7);
}

// A strip is a rectangle without ends; displacements up to a constant.
TEST(LineContact, StripMovesTheSurfaceAsAVeryLongRectangleDoes) {
  const LayeredHalfSpace layered{{{1e-3, {840e9, 0.25}}, {0.5e-3, {50e9, 0.45}}}, kSteel};
  const double dx = 0.7e-3, far = 0.3;
  for (const SurfaceCompliance& pair :
       {combined_compliance(homogeneous_compliance(kSteel), homogeneous_compliance(kOther)),
        combined_compliance(homogeneous_compliance(kOther), layered_compliance(layered))}) {
    const RectangleInfluence first = strip_influence(pair, 0, dx, far),
                             first_long = rectangle_influence(pair, 0, 0, dx, kLong);
    for (const double x : {0.1e-3, 0.7e-3, -1.4e-3, 5e-3}) {
      const RectangleInfluence s = strip_influence(pair, x, dx, far), l = rectangle_influence(pair, x, 0, dx, kLong);
      EXPECT_NEAR((s.nn - first.nn) / (l.nn - first_long.nn), 1, 1e-6) << x;
      EXPECT_NEAR((s.xx - first.xx) / (l.xx - first_long.xx), 1, 1e-6) << x;
      EXPECT_NEAR((s.yy - first.yy) / (l.yy - first_long.yy), 1, 1e-6) << x;
      EXPECT_NEAR(s.nx / l.nx, 1, 2 * std::abs(x) / kLong + 2e-5) << x;  // what the ends take away
      EXPECT_EQ(s.xy, 0);
      EXPECT_EQ(s.ny, 0);
    }
  }
}

TEST(LineContact, StripStressesAreThoseOfAVeryLongRectangle) {
  const double dx = 1.3e-3;
  for (const double z : {0.0, 0.2e-3, 3e-3})
    for (const double x : {0.2e-3, -0.9e-3, 4e-3}) {
      const InteriorInfluence s = strip_interior(kOther, x, z, dx), l = rectangle_interior(kOther, x, 0, z, dx, kLong);
      for (std::size_t load = 0; load < 3; ++load) {
        const Sym3 a = stress_of(s[load], kOther), b = stress_of(l[load], kOther);
        EXPECT_NEAR(a.xx, b.xx, dx / kLong) << x << ' ' << z;
        EXPECT_NEAR(a.yy, b.yy, dx / kLong) << x << ' ' << z;
        EXPECT_NEAR(a.zz, b.zz, dx / kLong) << x << ' ' << z;
        EXPECT_NEAR(a.xy, b.xy, dx / kLong) << x << ' ' << z;
        EXPECT_NEAR(a.xz, b.xz, dx / kLong) << x << ' ' << z;
        EXPECT_NEAR(a.yz, b.yz, dx / kLong) << x << ' ' << z;
        EXPECT_EQ(s[load].e_yy, 0);
      }
    }
}

}  // namespace
}  // namespace railstrata
