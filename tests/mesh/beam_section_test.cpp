#include "mesh/beam_section.hpp"

#include <gtest/gtest.h>

#include "geometry/profile_names.hpp"
#include "mesh/bodies.hpp"
#include "mesh_checks.hpp"
#include "tests/mesh/brick_mesh.hpp"

namespace railstrata {
namespace {

TEST(BeamSection, OfARectangleHasItsClosedForms) {
  const BeamSection s = beam_section(mesh_brick(3, 5, 2, 0.1, 0.02, 0.03));
  const double width = 3 * 0.02, height = 5 * 0.03;
  EXPECT_NEAR(s.area, width * height, 1e-9 * s.area);
  EXPECT_NEAR(s.inertia, width * height * height * height / 12, 1e-6 * s.inertia);
  EXPECT_NEAR(s.shear_share, 5.0 / 6, 1e-4);
}

// CN60: 77.45 cm², 3217 cm⁴ [TG01].
TEST(BeamSection, OfAMeshedRailIsThatOfTheStandardWithinSomePercent) {
  const SweptBody rail =
      mesh_rail(builtin_profile(ProfileKind::rail, "CN60"), mesh_checks::kTrack, mesh_checks::rail_spec(), {});
  const BeamSection s = beam_section(rail);
  EXPECT_NEAR(s.area, 77.45e-4, 0.01 * 77.45e-4);
  EXPECT_NEAR(s.inertia, 3217e-8, 0.02 * 3217e-8);
  EXPECT_GT(s.shear_share, 0.3);
  EXPECT_LT(s.shear_share, 0.5);
}

}  // namespace
}  // namespace railstrata
