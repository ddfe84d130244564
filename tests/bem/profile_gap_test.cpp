#include "bem/profile_gap.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bem/normal_problem.hpp"

namespace railstrata {
namespace {

const HalfSpaceMaterial kSteel{210e9, 0.3};

TEST(ProfileGap, LmaOnCn60TouchesAtTheOriginAndIsSymmetricInX) {
  const Profile wheel = builtin_profile(ProfileKind::wheel, "LMA"), rail = builtin_profile(ProfileKind::rail, "CN60");
  const TrackGeometry track;
  const PatchGrid g = centred_grid(20, 20, 0.5e-3, 0.5e-3);
  const ProfileGap gap = profile_gap(wheel, rail, track, place_wheel(wheel, rail, track), g);
  EXPECT_NEAR(gap.gap[g.index(20, 20)], 0, 1e-12);
  for (double v : gap.gap) EXPECT_GT(v, -1e-12);
  EXPECT_DOUBLE_EQ(gap.gap[g.index(3, 7)], gap.gap[g.index(37, 7)]);
  // curvature along x: 1/(2 r)
  EXPECT_NEAR(gap.gap[g.index(40, 20)] / (0.01 * 0.01 / (2 * 0.43)), 1, 2e-3);
}

// notes of the project: half-space solution of the exact profiles, E = 210 GPa, nu = 0.3, 84.95 kN, wheel radius 430 mm.
TEST(ProfileGap, LmaOnCn60PeakPressureAtFourLateralShifts) {
  const Profile wheel = builtin_profile(ProfileKind::wheel, "LMA"), rail = builtin_profile(ProfileKind::rail, "CN60");
  const SurfaceCompliance pair = combined_compliance(homogeneous_compliance(kSteel), homogeneous_compliance(kSteel));
  struct Row {
    double shift, p_max;
  };
  for (const Row r : {Row{0, 1162e6}, Row{1e-3, 1112e6}, Row{1.5e-3, 1074e6}, Row{2e-3, 1023e6}}) {
    TrackGeometry track;
    track.lateral_shift = r.shift;
    const PatchGrid g = centred_grid(32, 64, 0.25e-3, 0.25e-3);
    const InfluenceOperator op(pair, g.nx, g.ny, g.dx, g.dy);
    const NormalSolution s = solve_normal(op, g, profile_gap(wheel, rail, track, place_wheel(wheel, rail, track), g).gap, {.load = 8660 * 9.81, .approach = {}});
    EXPECT_FALSE(s.touches_edge);
    EXPECT_NEAR(*std::max_element(s.pressure.begin(), s.pressure.end()) / r.p_max, 1, 0.007) << r.shift;
  }
}

}  // namespace
}  // namespace railstrata
