#include "judge/bem_summary.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "material/elastic.hpp"
#include "tests/judge/whole_summary.hpp"
#include "tests/result/crossed_cylinders.hpp"

namespace railstrata {
namespace {

using post_checks::crossed_cylinders;

BemOptions cells(double size) {
  BemOptions options;
  options.cell = size;
  return options;
}

bool holds(const Summary& s, const std::string& name) {
  const auto found = std::find_if(s.checks.begin(), s.checks.end(), [&](const Check& k) { return k.name == name; });
  EXPECT_NE(found, s.checks.end()) << name;
  return found != s.checks.end() && found->ok;
}

// [Johnson1985 sec. 4.2, 3.4]: a = (3 F R / 4 E*)^(1/3), p0 = 3 F / 2 pi a², approach a²/R; largest von Mises stress
// 0.62 p0 at 0.48 a for nu = 0.3.
TEST(BemSummary, OfCrossedCylindersIsHertzs) {
  const CaseSpec spec = crossed_cylinders();
  const Summary s = whole_summary(spec, solve_bem(spec, place(spec, {}), cells(0.25e-3)));
  const double load = spec.vehicle.load(), modulus = 210e9 / (2 * (1 - 0.09)),
               a = std::cbrt(3 * load * 0.42 / (4 * modulus)), p0 = 1.5 * load / (std::numbers::pi * a * a);
  EXPECT_NEAR(s.contact.patch.p_max / p0, 1, 2e-3);
  EXPECT_NEAR(s.contact.patch.length / (2 * a), 1, 0.01);
  EXPECT_NEAR(s.contact.patch.width / (2 * a), 1, 0.01);
  EXPECT_NEAR(s.contact.patch.area / (std::numbers::pi * a * a), 1, 0.01);
  EXPECT_NEAR(s.contact.approach / (a * a / 0.42), 1, 2e-3);
  EXPECT_NEAR(s.contact.F_z / load, 1, 1e-9);
  for (const StressSummary* body : {&s.rail, &s.wheel}) {
    EXPECT_NEAR(body->subsurface->von_mises.value / p0, 0.62, 0.005 * 0.62);
    EXPECT_NEAR(body->subsurface->von_mises.depth / a, 0.48, 0.01);
    EXPECT_FALSE(body->layer || body->interface || body->matrix) << "no layer, no interface";
  }
  EXPECT_EQ(s.run.engine, Engine::bem);
  EXPECT_TRUE(std::isnan(s.contact.creepage_x) && std::isnan(s.contact.patch.slip_area_fraction))
      << "without friction neither applies";
  EXPECT_TRUE(std::isnan(s.contact.penetration_max));
  EXPECT_EQ(s.position, 0) << "no position is asked for";
}

// The flange's root in a plane of its own, the two lobes on the tread in one.
TEST(BemSummary, OfPatchesHasThatOfTheLargestPressureAndTheForcesOfAll) {
  CaseSpec spec;
  spec.geometry.rail_profile = "UIC60";
  spec.geometry.wheel_profile = "S1002";
  spec.geometry.cant = 0.05;
  spec.geometry.gauge_depth = 14e-3;
  spec.geometry.lateral_shift = 9.6e-3;
  spec.drive.friction_coefficient = 0.3;
  spec.drive.traction_coefficient = 0.02;
  const BemResult r = solve_bem(spec, place(spec, {}), cells(1e-3));
  const Summary s = bem_contact_summary(spec, r);
  ASSERT_EQ(s.patches.size(), 3U);
  const ContactSummary &first = s.patches[0].contact, &second = s.patches[1].contact;
  const double load = spec.vehicle.load();
  EXPECT_GT(first.patch.p_max, second.patch.p_max);
  EXPECT_EQ(s.contact.patch.p_max, first.patch.p_max);
  EXPECT_EQ(s.contact.contact_angle, first.contact_angle);
  EXPECT_EQ(s.contact.normal_force, first.normal_force);
  EXPECT_NEAR(s.contact.F_x / load, 0.02, 1e-6);
  EXPECT_NEAR(s.contact.F_z / load, 1, 1e-6);
  EXPECT_NEAR((first.F_y + second.F_y + s.patches[2].contact.F_y) / load, s.contact.F_y / load, 1e-12);
  EXPECT_GT(first.contact_angle, 0.35) << "the flange's root";
  EXPECT_LT(s.patches[0].rail_y, -25e-3);
  EXPECT_GT(s.patches[1].rail_y, -15e-3);
  for (const Check& c : s.checks) EXPECT_TRUE(c.ok) << c.name;
  EXPECT_TRUE(std::any_of(s.warnings.begin(), s.warnings.end(),
                          [](const Warning& w) { return w.name == "patches_near_each_other"; }));
}

TEST(BemSummary, ForcesOfADrivingWheelActOnTheWheelAndItsCreepageIsNegative) {
  CaseSpec spec;
  spec.geometry.lateral_shift = 1.5e-3;
  const Summary s = bem_contact_summary(spec, solve_bem(spec, place(spec, {}), cells(0.5e-3)));
  EXPECT_NEAR(s.contact.F_x / (0.2 * spec.vehicle.load()), 1, 1e-5);
  EXPECT_NEAR(s.contact.F_z / spec.vehicle.load(), 1, 1e-5);
  EXPECT_LT(s.contact.creepage_x, 0);
  EXPECT_LT(s.contact.spin_per_m, 0) << "the contact plane rises to the field side";
  EXPECT_TRUE(holds(s, "F_z_relative_to_weight"));
  EXPECT_TRUE(holds(s, "traction_coefficient_reached"));
  EXPECT_TRUE(holds(s, "patch_reaches_edge_of_grid"));
}

// The same force in two frames: along y and z, and along the contact plane's tangent and normal, where pressure and
// friction are apart.
TEST(BemSummary, ForcesInTheContactPlaneAreThePressuresAndTheFrictionsResultants) {
  CaseSpec spec;
  spec.geometry.lateral_shift = 1.5e-3;
  const BemResult r = solve_bem(spec, place(spec, {}), cells(0.5e-3));
  const ContactSummary c = bem_contact_summary(spec, r).contact;
  double normal = 0, lateral = 0;
  for (std::size_t k = 0; k < r.field.p.size(); ++k) {
    normal += r.field.p[k] * r.field.area[k];
    lateral -= r.field.q_y[k] * r.field.area[k];
  }
  EXPECT_NEAR(c.normal_force / normal, 1, 1e-9);
  EXPECT_NEAR(c.lateral_force / lateral, 1, 1e-9);
  EXPECT_GT(std::abs(lateral), 1000) << "spin alone makes a lateral force";
  EXPECT_NEAR(std::hypot(c.F_y, c.F_z) / std::hypot(normal, lateral), 1, 1e-9);
  EXPECT_NEAR(c.contact_angle, 0.0292, 1e-4);
}

// 395.8 MPa in the largest of cells of 0.0625 mm, 399 MPa at the front: the cusp that cells miss.
TEST(BemSummary, TheLargestShearOnCoarseCellsIsThatOfFineOnesWithin1Percent) {
  CaseSpec spec;
  spec.geometry.lateral_shift = 1.5e-3;
  const auto shear = [&](double cell) {
    return bem_contact_summary(spec, solve_bem(spec, place(spec, {}), cells(cell))).contact;
  };
  const double fine = shear(0.125e-3).patch.q_max;
  for (const double cell : {0.5e-3, 0.25e-3}) EXPECT_NEAR(shear(cell).patch.q_max / fine, 1, 1e-2) << cell;
  const ContactSummary coarse = shear(1e-3);  // whose error is that of where the front lies in its cell
  EXPECT_NEAR(coarse.patch.q_max, fine, coarse.error.q_max);
  EXPECT_LT(shear(0.5e-3).patch.q_max_point / fine, 0.95);
}

TEST(BemSummary, ChecksFailForAResultThatMissesItsCase) {
  CaseSpec spec;
  const BemResult good = solve_bem(spec, place(spec, {}), cells(1e-3));
  spec.drive.traction_coefficient = 0.21;
  EXPECT_FALSE(holds(bem_contact_summary(spec, good), "traction_coefficient_reached"));
  spec.vehicle.sprung_mass *= 1.01;
  EXPECT_FALSE(holds(bem_contact_summary(spec, good), "F_z_relative_to_weight"));
  BemResult spread = good;
  spread.field.p.front() = 1e6;
  EXPECT_FALSE(holds(bem_contact_summary(spec, spread), "patch_reaches_edge_of_grid"));
}

TEST(RailDepthLine, StartsAtTheTractionsAndKeepsThemAcrossTheInterface) {
  CaseSpec spec = crossed_cylinders();
  spec.layers.push_back({});
  spec.layers[0].material.young = 2 * 210e9;
  const BemResult r = solve_bem(spec, place(spec, {}), cells(0.5e-3));
  const StressSection line = rail_depth_line(r, 0, 0, 6e-3);
  const double p_here = *std::max_element(r.field.p.begin(), r.field.p.end());
  EXPECT_EQ(line.depth.front(), 0);
  EXPECT_NEAR(line.stress.front().zz / -p_here, 1, 1e-3) << "compression is negative";
  const auto below =
      static_cast<std::size_t>(std::find(line.material.begin(), line.material.end(), 0) - line.material.begin());
  ASSERT_GT(below, 0u);
  ASSERT_LT(below, line.depth.size());
  EXPECT_EQ(line.material[below - 1], 1);
  EXPECT_NEAR(line.depth[below], 1e-3, 1e-12);
  EXPECT_NEAR(line.depth[below - 1], 1e-3, 1e-12);
  const Sym3 layer = line.stress[below - 1], matrix = line.stress[below];
  EXPECT_NEAR(layer.zz / matrix.zz, 1, 1e-9);
  EXPECT_NEAR((layer.xz - matrix.xz) / matrix.zz, 0, 1e-9);
  EXPECT_GT(std::abs(layer.xx - matrix.xx), 0.05 * std::abs(matrix.xx)) << "in-plane stress jumps with the modulus";
  EXPECT_NEAR(line.depth.back(), 6e-3, 1e-12);
}

// Shear in the model frame: a driving wheel pulls the rail's surface backwards, q_x < 0. On the surface with normal +z,
// sigma_xz = q_x.
TEST(RailDepthLine, ShearAtTheSurfaceIsTheTractionOnTheRail) {
  CaseSpec spec = crossed_cylinders();
  spec.drive.traction_coefficient = 0.2;
  spec.drive.friction_coefficient = 0.5;
  const BemResult r = solve_bem(spec, place(spec, {}), cells(0.5e-3));
  const std::size_t k = r.grid.index(r.grid.nx / 2, r.grid.ny / 2);
  const StressSection line = rail_depth_line(r, 0, 0, 6e-3);
  EXPECT_LT(r.field.q_x[k], -1e6);
  EXPECT_NEAR(line.stress.front().xz / r.field.q_x[k], 1, 1e-3);
}

// Rotating the axes changes no invariant: von Mises stress of a line through a contact at 3 degrees, against the
// engine's own.
TEST(RailDepthLine, TurningIntoTheModelFrameKeepsTheInvariants) {
  CaseSpec spec;
  spec.geometry.lateral_shift = 1.5e-3;
  BemResult r = solve_bem(spec, place(spec, {}), cells(1e-3));
  const StressSection tilted = rail_depth_line(r, 0, 0, 4e-3);
  r.contact.angle = 0;
  const StressSection level = rail_depth_line(r, 0, 0, 4e-3);
  for (std::size_t i = 0; i < level.depth.size(); ++i) {
    EXPECT_NEAR(von_mises(tilted.stress[i]) / von_mises(level.stress[i]), 1, 1e-12);
    EXPECT_NEAR(principal_stresses(tilted.stress[i]).x, principal_stresses(level.stress[i]).x, 1e-9 * 1e9);
  }
  EXPECT_GT(std::abs(tilted.stress[1].yz - level.stress[1].yz), 1e6) << "and does turn them";
}

}  // namespace
}  // namespace railstrata
