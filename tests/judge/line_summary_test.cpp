// A case of a line contact as the summary has it.
#include <gtest/gtest.h>

#include <cmath>

#include "bem/transient.hpp"
#include "core/faults.hpp"
#include "result/patch.hpp"
#include "result/transient_row.hpp"
#include "tests/judge/whole_summary.hpp"

namespace railstrata {
namespace {

/// Hertz's a = 5 mm and p0 = 576.92 MPa, driven at 0.4 of the friction bound: carter2d.csv.
CaseSpec cylinder() {
  CaseSpec spec;
  GeometrySpec& g = spec.geometry;
  g.contact = ContactShape::line;
  g.line_length = 20e-3;
  g.wheel_profile = g.rail_profile = "flat";
  g.rail_shape = RailShape::block;
  g.wheel_radius = 0.5;
  g.cant = 0;
  spec.vehicle.set_load(90622.865);
  spec.drive.traction_coefficient = 0.2;
  return spec;
}
constexpr double kP0 = 576.9231e6;

TEST(LineSummary, HasHertzAndCarterAndNoApproachNorWidth) {
  const CaseSpec spec = cylinder();
  const BemResult r = solve_bem(spec, place(spec, {}));
  const Summary s = whole_summary(spec, r);
  const PatchMeasures& m = s.contact.patch;
  EXPECT_NEAR(m.p_max / kP0, 1, 1e-3);
  EXPECT_NEAR(m.length / 10e-3, 1, 3e-3);
  EXPECT_NEAR(m.area / (10e-3 * 20e-3), 1, 3e-3);
  EXPECT_TRUE(std::isnan(m.width));
  EXPECT_TRUE(std::isnan(s.contact.approach));
  EXPECT_NEAR(s.contact.creepage_x / -0.0011270167, 1, 3e-3);
  EXPECT_NEAR(s.contact.F_z / 90622.865, 1, 1e-5);
  EXPECT_NEAR(m.force_z / 90622.865, 1, 1e-5);
  EXPECT_EQ(s.contact.spin_moment, 0);
  for (const Check& check : s.checks) EXPECT_TRUE(check.ok) << check.name;
  EXPECT_TRUE(s.warnings.empty()) << s.warnings.front().text;
  EXPECT_EQ(centre_line(r.field).y, 0);
}

// Without friction: 0.5577 p0 at 0.704 a, both bodies alike.
TEST(LineSummary, LargestVonMisesStressIsTheClosedForms) {
  CaseSpec spec = cylinder();
  spec.drive.friction_coefficient = spec.drive.traction_coefficient = 0;
  const Summary s = whole_summary(spec, solve_bem(spec, place(spec, {})));
  for (const StressSummary* body : {&s.rail, &s.wheel}) {
    EXPECT_NEAR(body->subsurface->von_mises.value / kP0, 0.5577, 2e-3);
    EXPECT_NEAR(body->subsurface->von_mises.depth / 5e-3, 0.704, 0.01);
  }
}

TEST(LineSummary, FewCellsOverTheLineAreTold) {
  const CaseSpec spec = cylinder();
  BemOptions options;
  options.cell = 2e-3;
  const Summary s = bem_contact_summary(spec, solve_bem(spec, place(spec, {}), options));
  ASSERT_EQ(s.warnings.size(), 1u);
  EXPECT_EQ(s.warnings[0].name, "few_cells_over_patch");
}

// What a force that changes does to distant points nobody knows; at constant force the creepage is Carter's.
TEST(LineSummary, AHistoryOfForcesSaysWhatIsKnown) {
  CaseSpec spec = cylinder();
  spec.transient.kind = TransientKind::rolling;
  spec.transient.at_distance = {0, 10e-3, 60e-3};
  spec.transient.traction_coefficient = {0, 0.2, 0.2};
  BemOptions options;
  options.cell = 0.5e-3;
  const Placement placement = place(spec, {});
  std::vector<TransientRow> rows;
  solve_transient(spec, placement, options, [&](const TransientState& state) {
    rows.push_back(transient_row(state));
    return true;
  });
  EXPECT_TRUE(std::isnan(rows[10].creepage_x));
  EXPECT_NEAR(rows.back().creepage_x / -0.0011270167, 1, 0.01);
  EXPECT_TRUE(std::isnan(rows.back().approach));
  spec.transient = {};
  spec.transient.kind = TransientKind::shift;
  spec.transient.traction_coefficient = {0.2};
  const TransientState shifted = solve_transient(spec, placement, options);
  EXPECT_TRUE(std::isnan(shifted.displacement_x));
  EXPECT_NEAR(shifted.result.force.x / (-0.2 * 90622.865), 1, 1e-5);
}

TEST(TransientDistance, OfLessThanHalfACellIsRefused) {
  CaseSpec spec = cylinder();
  spec.transient.kind = TransientKind::rolling;
  spec.transient.distance = 0.1e-3;
  try {
    solve_transient(spec, place(spec, {}));
    FAIL();
  } catch (const CaseError& e) {
    EXPECT_NE(std::string(e.what()).find("0.1 mm of rolling are less than half a cell of 0.25 mm"), std::string::npos)
        << e.what();
  }
}

}  // namespace
}  // namespace railstrata
