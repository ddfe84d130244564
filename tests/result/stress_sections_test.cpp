#include "result/stress_sections.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "material/elastic.hpp"
#include "mesh/bodies.hpp"
#include "result/patch.hpp"
#include "tests/mesh/brick_mesh.hpp"
#include "tests/result/crossed_cylinders.hpp"

namespace railstrata {
namespace {

using post_checks::crossed_cylinders;

/// Borders of the rows: the first begins at the surface.
std::vector<double> borders(const std::vector<double>& centres) {
  std::vector<double> out{0};
  for (double c : centres) out.push_back(2 * c - out.back());
  return out;
}

// [Johnson1985 eq. 3.45]: on the axis of a circular Hertzian contact s_zz = -p0 / (1 + z²/a²), s_xx = s_yy = -p0 ((1 +
// nu)(1 - z/a atan(a/z)) - 1/(2 (1 + z²/a²))).
TEST(StressSections, HoldTheStressesOnTheAxisOfAHertzianContact) {
  const CaseSpec spec = crossed_cylinders();
  const BemResult r = solve_bem(spec, place(spec, {}), {});
  const double a = std::cbrt(3 * spec.vehicle.load() * 0.42 / (4 * 210e9 / (2 * (1 - 0.09)))),
               p0 = 1.5 * spec.vehicle.load() / (std::numbers::pi * a * a);
  for (const StressSections& s : {rail_sections(r, 0, 0, 2 * a), wheel_sections(r, 0, 0, 2 * a)})
    for (const StressSection* plane : {&s.longitudinal, &s.cross}) {
      const std::size_t n = plane->along.size(), middle = n / 2;
      ASSERT_NEAR(plane->along[middle], 0, 1e-9);
      EXPECT_NEAR(plane->at, 0, 1e-9);
      EXPECT_GE(borders(plane->depth).back(), 2 * a);
      ASSERT_EQ(plane->stress.size(), n * plane->depth.size());
      for (std::size_t row = 0; row < plane->depth.size(); ++row) {
        const double t = plane->depth[row] / a, normal = -1 / (1 + t * t),
                     radial = -(1.3 * (1 - t * std::atan(1 / t)) + 0.5 * normal);
        const Sym3& stress = plane->stress[row * n + middle];
        EXPECT_NEAR(stress.zz / p0, normal, 5e-3) << "depth / a = " << t;
        EXPECT_NEAR(stress.xx / p0, radial, 5e-3) << "depth / a = " << t;
        EXPECT_NEAR(stress.yy / p0, radial, 5e-3) << "depth / a = " << t;
        EXPECT_NEAR(stress.xz / p0, 0, 1e-3);
      }
    }
}

// The slices are cross sections: where they cross a longitudinal one they have its stresses.
TEST(StressSections, SlicesAreCrossSectionsAllAlongThePatch) {
  CaseSpec spec = crossed_cylinders();
  spec.drive.traction_coefficient = 0.2;
  spec.drive.friction_coefficient = 0.5;
  const BemResult r = solve_bem(spec, place(spec, {}), {});
  const std::vector<StressSection> slices = rail_sections(r, 0, 0, 4e-3).slices;
  ASSERT_GE(slices.size(), 9U);
  EXPECT_LE(slices.size(), 17U);
  const std::size_t column = slices.front().along.size() / 2;
  const StressSection along = rail_sections(r, 0, slices.front().along[column], 4e-3).longitudinal;
  for (const StressSection& slice : slices) {
    EXPECT_EQ(slice.depth, along.depth);
    EXPECT_LE(slice.along.size(), 34U);
    ASSERT_EQ(slice.stress.size(), slice.along.size() * slice.depth.size());
    ASSERT_EQ(slice.along[column], along.at);
    const auto i =
        static_cast<std::size_t>(std::find(along.along.begin(), along.along.end(), slice.at) - along.along.begin());
    ASSERT_LT(i, along.along.size());
    for (std::size_t row = 0; row < slice.depth.size(); ++row)
      EXPECT_EQ(slice.stress[row * slice.along.size() + column].xz, along.stress[row * along.along.size() + i].xz);
  }
}

TEST(StressSections, LargestShearIsHalfTheDifferenceOfPrincipalStresses) {
  EXPECT_DOUBLE_EQ(largest_shear(principal_stresses({-100, -300, -1000, 0, 0, 0})), 450);
  EXPECT_NEAR(largest_shear(principal_stresses({0, 0, 0, 0, 0, 70})), 70, 1e-9);
}

// The traction on the rail is sigma n with n up, that on the wheel -sigma n: just below the surface s_xz = q_x and s_zz
// = -p in both.
TEST(StressSections, BeginWithTheTractionsOfTheSurface) {
  CaseSpec spec = crossed_cylinders();
  spec.drive.traction_coefficient = 0.2;
  spec.drive.friction_coefficient = 0.5;
  const BemResult r = solve_bem(spec, place(spec, {}), {});
  const CentreLine line = centre_line(r.field);
  for (const StressSection& s :
       {rail_sections(r, 0, line.y, 1e-3).longitudinal, wheel_sections(r, 0, line.y, 1e-3).longitudinal}) {
    ASSERT_EQ(s.along.size(), line.x.size());
    const auto middle = s.along.size() / 2;
    EXPECT_LT(line.q_x[middle], -0.05 * line.p[middle]) << "a driven wheel pulls the rail backwards";
    EXPECT_NEAR(s.stress[middle].xz / line.q_x[middle], 1, 0.05);
    EXPECT_NEAR(s.stress[middle].zz / -line.p[middle], 1, 0.01);
  }
}

TEST(StressSections, ARowEndsAtEveryInterfaceAndNamesItsMaterial) {
  CaseSpec spec = crossed_cylinders();
  spec.layers.resize(2);
  spec.layers[0].thickness = 0.2e-3;
  spec.layers[0].material.young = 420e9;
  spec.layers[1].thickness = 1.1e-3;
  spec.layers[1].material.young = 300e9;
  const BemResult r = solve_bem(spec, place(spec, {}), {});
  const StressSection s = rail_sections(r, 0, 0, 8e-3).longitudinal;
  const std::vector<double> edge = borders(s.depth);
  for (std::size_t row = 0; row < s.depth.size(); ++row) {
    const int wanted = s.depth[row] < 0.2e-3 ? 1 : s.depth[row] < 1.3e-3 ? 2 : 0;
    EXPECT_EQ(s.material[row * s.along.size()], wanted) << s.depth[row];
    if (row > 0 && s.material[row * s.along.size()] != s.material[(row - 1) * s.along.size()]) {
      EXPECT_NEAR(edge[row], wanted == 2 ? 0.2e-3 : 1.3e-3, 1e-12);
    }
  }
  EXPECT_EQ(rail_sections(r, 0, 0, 8e-3).cross.material.front(), 1);
  EXPECT_EQ(wheel_sections(r, 0, 0, 8e-3).longitudinal.material.front(), 0) << "the layers are the rail's";
}

TEST(StressSections, OfABandAreTheElementsNearestToThePoint) {
  const SweptBody brick = mesh_brick(4, 3, 6, 1e-3, 2e-3, 0.5e-3);
  BandSample sample;
  sample.columns = brick.contact.columns;
  sample.rows = brick.contact.rows;
  sample.stations = 6;
  for (int s = 0; s <= sample.stations; ++s) sample.along.push_back(1e-3 * (s - 3));
  for (int s = 0; s < sample.stations; ++s)
    for (int row = 0; row < sample.rows; ++row)
      for (int c = 0; c < sample.columns; ++c) sample.stress.push_back({100.0 * s + 10 * row + c, 0, 0, 0, 0, 0});
  const BandStress band = band_stress(brick, sample, 0);
  const StressSections s = band_sections(band, 0.4e-3, brick.origin.y + band.centre_y[2] + 0.3e-3);
  EXPECT_DOUBLE_EQ(s.longitudinal.at, brick.origin.y + band.centre_y[2]);
  EXPECT_NEAR(s.cross.at, 0.5e-3, 1e-12) << "the middle of the fourth element";
  ASSERT_EQ(s.longitudinal.stress.size(), 18u);
  ASSERT_EQ(s.cross.stress.size(), 12u);
  for (int row = 0; row < 3; ++row) {
    for (int k = 0; k < 6; ++k) EXPECT_EQ(s.longitudinal.stress[row * 6 + k].xx, 100.0 * k + 10 * row + 2);
    for (int c = 0; c < 4; ++c) EXPECT_EQ(s.cross.stress[row * 4 + c].xx, 300.0 + 10 * row + c);
  }
}

}  // namespace
}  // namespace railstrata
