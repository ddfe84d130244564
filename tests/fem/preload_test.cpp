// Static equilibrium before the rolling.
#include "fem/preload.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "body/aggregates.hpp"
#include "core/parallel.hpp"
#include "reader/case_file.hpp"
#include "small_rolling.hpp"
#include "tests/body/sample_bodies.hpp"

namespace railstrata {
namespace {

using namespace fem_checks;

CaseSpec static_case() {
  CaseSpec s = small_case();
  s.run.rolling = false;
  return s;
}

double largest_pressure(const PreloadResult& r) {
  double p = 0;
  for (const NodeTraction& t : r.tractions.all()) p = std::max(p, t.p);
  return p;
}

double largest_difference(const PreloadResult& a, const PreloadResult& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.tractions.all().size(); ++i)
    worst = std::max(worst, std::abs(a.tractions.all()[i].p - b.tractions.all()[i].p));
  return worst;
}

TEST(Preload, ContactForceIsTheWeight) {
  const RollingSystem sys = small_system(static_case());
  const PreloadResult r = solve_preload(sys, 1e-9);
  EXPECT_LT(r.residual, 1e-9);
  EXPECT_NEAR(r.contact_force.z / sys.model.load, 1.0, 1e-6);
}

// The wheel's polygon is finer under the contact, so its centrifugal forces do not quite cancel.
TEST(Preload, ContactForceOfASpinningWheelIsTheWeightUpToTheMeshsImbalance) {
  const RollingSystem sys = small_system(small_case());
  ASSERT_GT(sys.start_spin, 0);
  double imbalance = 0;
  for (const NodeLine& l : sys.wheel().lines)
    if (l.component == 2) {
      const Block& block = sys.model.wheel.blocks[l.block];
      for (int j = 0; j < l.count; ++j)
        imbalance += sys.start_spin * sys.start_spin * sys.wheel().mass[l.first + j] * block.section.nodes[l.node].z *
                     std::cos(block.stations.at[j]);
    }
  const PreloadResult r = solve_preload(sys, 1e-9);
  EXPECT_NEAR(r.contact_force.z / (sys.model.load - imbalance), 1.0, 1e-6);
}

// Signorini: g >= 0, p >= 0, p g = 0, evaluated afresh from the result.
TEST(Preload, PressuresAndGapsAreComplementary) {
  const RollingSystem sys = small_system(static_case());
  PreloadResult r = solve_preload(sys, 1e-8);
  MortarContact contact(sys.rail_surface(), sys.wheel_surface());
  const AxlePose pose{0, 0, r.axle_z, 0};
  contact.search(r.u[0], r.u[1], pose, 4 * sys.model.hertz.a, sys.model.hertz.approach);
  const double thin = 1e-4 * sys.model.hertz.approach;
  int shut = 0, open = 0;
  for (const ContactRow& row : contact.rows(r.u[0], r.u[1], pose).rows) {
    const double p = r.tractions.at(row.column, row.station).p;
    EXPECT_GE(p, 0);
    EXPECT_GT(row.gap, -thin);
    if (p > 0) {
      EXPECT_LT(row.gap, thin);
      ++shut;
    } else {
      ++open;
    }
  }
  EXPECT_GT(shut, 9);
  EXPECT_GT(open, 9);
}

TEST(Preload, SameBitsForOneTwoAndFourThreads) {
  const RollingSystem sys = small_system(static_case());
  const int before = max_threads();
  set_threads(1);
  const PreloadResult one = solve_preload(sys, 1e-6);
  for (int n : {2, 4}) {
    set_threads(n);
    const PreloadResult many = solve_preload(sys, 1e-6);
    EXPECT_EQ(many.cg_iterations, one.cg_iterations) << n;
    EXPECT_EQ(many.axle_z, one.axle_z) << n;
    EXPECT_TRUE(many.u[0] == one.u[0] && many.u[1] == one.u[1]) << n;
    EXPECT_EQ(largest_difference(many, one), 0) << n;
  }
  set_threads(before);
}

// Equal curvatures both ways: a circular patch of six elements' radius, small beside the bodies. [Johnson1985 sec. 4.2]
TEST(Preload, PeakPressureOfASphereLikePairIsHertzWithin2Percent) {
  CaseSpec s = static_case();
  s.geometry.wheel_radius = 0.15;
  s.geometry.wheel_profile = "arc:R=150 mm";
  s.geometry.wheel_section.bore_radius = 0.05;
  s.vehicle.set_load(0.2925586 * s.vehicle.load());
  s.mesh.element_size = 0.5e-3;
  s.mesh.fine_width = 9e-3;
  s.mesh.fine_depth = 3.5e-3;
  s.mesh.coarse_ratio = 4;
  s.mesh.end_length = 0.04;
  const RollingSystem sys = small_system(s);
  const HertzContact& hertz = sys.model.hertz;
  ASSERT_NEAR(hertz.a / hertz.b, 1.0, 1e-3);
  ASSERT_NEAR(hertz.a / s.mesh.element_size, 6.0, 0.3);
  EXPECT_NEAR(largest_pressure(solve_preload(sys, 1e-5)) / hertz.p0, 1.0, 0.02);
}

TEST(SlowPreload, ALayerFourTimesAsStiffAndThinIsReachedToo) {
  CaseSpec s = static_case();
  LayerSpec layer;
  layer.thickness = 0.2e-3;
  layer.elements = 2;
  layer.material.young = 840e9;
  s.layers = {layer};
  const RollingSystem sys = small_system(s);
  const PreloadResult r = solve_preload(sys, 1e-6);
  EXPECT_LT(r.residual, 1e-6);
  EXPECT_LT(r.newton_steps, 20);
}

// Independent half-spaces under 85 kN, a cylinder of 430 mm on a crown of 300 mm over a cosine hollow of 20 mm x 0.2
// mm: lowering over that on the flat rail 81.0, 69.9 and 21.0 um at 0, 3 and 8 mm from its middle, p_max 2033 MPa at 3
// mm. Elements of 2 mm.
TEST(SlowPreload, OverAHollowTheWheelComesDownAsHalfSpacesHaveIt) {
  const auto solve = [](double at, BodyId on) {
    const CaseSpec spec =
        parse_case(
            fmt::format("[geometry]\nrail_profile = \"arc:R=300 mm\"\nwheel_profile = \"flat\"\nwheel_radius = "
                        "\"430 mm\"\nrail_shape = \"block\"\nblock_width = \"50 mm\"\nwheel_shape = \"disc\"\n"
                        "bore_radius = \"300 mm\"\ncant = 0.0\n[vehicle]\nwheel_mass = \"600 kg\"\nwheel_load = "
                        "\"85 kN\"\n[drive]\ntraction_coefficient = 0.0\n[mesh]\nelement_size = \"2 mm\"\n[run]\n"
                        "rolling = false\n[[irregularity]]\non = \"{}\"\nat = \"{} mm\"\nlength = \"20 mm\"\n"
                        "depth = \"0.2 mm\"\n",
                        body_word(on), at),
            "a.toml")
            .spec;
    const RollingSystem sys(build_model(spec, {}));
    return solve_preload(sys, 1e-6);
  };
  const PreloadResult flat = solve(200, BodyId::rail), hollow = solve(3, BodyId::rail);
  const auto lower = [&](const PreloadResult& r) { return 1e6 * (flat.axle_z - r.axle_z); };
  EXPECT_NEAR(lower(solve(0, BodyId::rail)), 81.0, 1.5);
  EXPECT_NEAR(lower(hollow), 69.9, 1.5);
  EXPECT_NEAR(lower(solve(8, BodyId::rail)), 21.0, 1.5);
  EXPECT_NEAR(lower(solve(3, BodyId::wheel)), 69.9, 1.5) << "of the wheel's arc";
  EXPECT_NEAR(largest_pressure(hollow), 2033e6, 0.04 * 2033e6);
  EXPECT_NEAR(hollow.contact_force.z / flat.contact_force.z, 1.0, 1e-5);
}

// The modes of a cluster are orthonormal, so P P^T leaves what they span unchanged.
TEST(Aggregates, ProjectionKeepsARigidMotion) {
  const Body body{coarse_lma_wheel(), {kSteel}, {}};
  const Aggregates clusters(body, {0, -0.43});
  const Field motion = nodal_field(body, [](Vec3 x) { return Vec3{1, -2, 3} + cross(Vec3{4, 5, -6}, x); });
  std::vector<double> forces(static_cast<std::size_t>(Aggregates::kPartNumbers) * clusters.parts()),
      c(clusters.modes());
  Field back = body.layout.field();
  clusters.restrict_parts(motion, 0, clusters.parts(), forces.data());
  clusters.gather_parts(forces.data(), c.data());
  clusters.prolong(c.data(), back, kept_values(body, {}, no_nodes(body.mesh)));
  double worst = 0;
  for (const NodeLine& l : body.lines)
    for (int j = 0; j < l.count; ++j) worst = std::max(worst, std::abs(back[l.first + j] - motion[l.first + j]));
  EXPECT_LT(worst, 1e-9);
}

}  // namespace
}  // namespace railstrata
