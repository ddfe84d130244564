// A bar of square section on pads and sleepers, struck by a hammer.
#include "fem/rail_on_track.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "core/faults.hpp"
#include "mesh/bodies.hpp"
#include "tests/mesh/brick_mesh.hpp"

namespace railstrata {
namespace {

constexpr double kPitch = 50e-3, kEdge = 10e-3;

struct Bar {
  static SweptBody on_pads() {
    SweptBody out = mesh_brick(2, 2, 48, kPitch / 4, kEdge, kEdge);
    out.on_pads = std::exchange(out.prescribed, {});
    return out;
  }
  SweptBody mesh = on_pads();
  Body body{mesh, {elastic(210e9, 0.3, 7850)}, {}};
};

SleeperTrack soft() {
  SleeperTrack out;
  out.spacing = 4 * kPitch;
  out.phase = 0.5;
  out.pad_length = 30e-3;
  out.pad_stiffness = 2e6;
  out.pad_damping = 200;
  out.sleeper_mass = 0.3;
  out.ballast_stiffness = 1e6;
  out.ballast_damping = 300;
  return out;
}

TEST(RailOnTrack, APadsSharesHaveItsResultantAtItsPlace) {
  const Bar bar;
  const RailPads pads = rail_pads(bar.body, soft());
  ASSERT_EQ(pads.x.size(), 3u);
  for (std::size_t k = 0; k < pads.x.size(); ++k) {
    EXPECT_NEAR(pads.x[k], (0.5 + static_cast<double>(k)) * 4 * kPitch, 1e-12);
    double sum = 0, moment = 0;
    for (const NodeShare& n : pads.nodes[k]) {
      const BlockLayout& lay = bar.body.layout.blocks[0];
      sum += n.share;
      moment += n.share * bar.mesh.blocks[0].stations.at[(n.index - lay.offset) % lay.stride];
    }
    EXPECT_NEAR(sum, 1, 1e-12);
    EXPECT_NEAR(moment, pads.x[k], 1e-12);
  }
}

TEST(RailOnTrack, TheEnergyOfABlowIsFoundAgain) {
  const Bar bar;
  const BlowResponse r = strike(bar.body, rail_pads(bar.body, soft()), {0.3, 0.5e-3, 4e-3});
  EXPECT_GT(r.energy.supplied, 0);
  EXPECT_GT(r.energy.pads, 0.01 * r.energy.supplied);
  EXPECT_GT(r.energy.ballast, 0);
  EXPECT_GT(r.energy.ends, 0);
  EXPECT_LT(std::abs(r.energy.closure()), 1e-4 * r.energy.supplied);
}

// Long after a blow everything is at rest; until then the impulse has gone to ground through the ballast: the integral
// of the displacement over that of the force is the static compliance. A beam on three springs.
TEST(RailOnTrack, TheIntegralOfABlowIsTheStaticCompliance) {
  const Bar bar;
  SleeperTrack track = soft();
  track.ballast_stiffness = 2e6;
  track.ballast_damping = 400;
  track.pad_stiffness = 4e6;
  const BlowResponse r = strike(bar.body, rail_pads(bar.body, track), {0.3, 1e-3, 80e-3});
  double force = 0, displacement = 0;
  for (std::size_t n = 0; n < r.force.size(); ++n) {
    force += r.force[n];
    displacement += r.section[n];
  }
  EXPECT_LT(r.energy.kept, 1e-4 * r.energy.supplied);
  // a beam on three springs k = 1/(1/4e6 + 1/2e6), struck over the middle one, ends of half a bay:
  // F_m = F (1 + 2 d)/(3 + 2 d) on the middle one, d = k l^3/(6 E I)
  const double k = 1 / (1 / 4e6 + 1 / 2e6), l = track.spacing, i = std::pow(2 * kEdge, 4) / 12;
  const double d = l * l * l * k / (6 * 210e9 * i);
  const double expected = (1 + 2 * d) / (3 + 2 * d) / k;
  EXPECT_NEAR(displacement / force, expected, 0.01 * expected);
}

TEST(RailOnTrack, PadsThatAreTooStiffForTheStepAreRefused) {
  const Bar bar;
  SleeperTrack track = soft();
  track.pad_damping = 1e6;
  EXPECT_THROW(strike(bar.body, rail_pads(bar.body, track), {0.3, 1e-3, 1e-3}), CaseError);
}

}  // namespace
}  // namespace railstrata
