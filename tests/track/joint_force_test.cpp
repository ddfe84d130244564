#include "track/joint_force.hpp"

#include <gtest/gtest.h>

#include "track/sleeper_track.hpp"

namespace railstrata {
namespace {

// The formulas by hand: 660 and 1000 kg, a dip of 10 mrad at 100 km/h, 1.348 GN/m, UIC60 and CN60; the set `cn60` has
// two layers of its source in series and 0.6 m here.
TEST(JointForce, JenkinsFormulasGiveWhatTheyGiveByHand) {
  const RailBeam uic60{210e9 * 3.038e-5, 0, 7850 * 7.67e-3, 0, 0}, cn60{210e9 * 3.217e-5, 0, 7830 * 7.745e-3, 0, 0};
  const SleeperTrack delft{
      .pad_stiffness = 1300e6, .sleeper_mass = 140, .ballast_stiffness = 45e6, .ballast_damping = 32e3},
      medium{.pad_stiffness = 200e6, .sleeper_mass = 140, .ballast_stiffness = 40e6, .ballast_damping = 47e3},
      soft{.pad_stiffness = 65e6, .sleeper_mass = 125.5, .ballast_stiffness = 50e6, .ballast_damping = 30e3};
  struct Row {
    const RailBeam& rail;
    const SleeperTrack& track;
    double mass, P1_low, P1_high, P2;  // kg, kN
  };
  for (const Row& r : {Row{uic60, delft, 660, 134.1, 160.7, 137.4}, Row{uic60, delft, 1000, 137.8, 165.2, 158.5},
                       Row{uic60, medium, 660, 134.1, 160.7, 126.2}, Row{cn60, soft, 660, 134.3, 161.0, 127.8}}) {
    const double weight = (r.mass + 8000) * 9.81;
    const JointForces f = joint_forces({weight, 0.01, 27.7778, r.mass, 1.348e9}, r.rail, r.track);
    EXPECT_NEAR(1e-3 * f.P1_low, r.P1_low, 0.15);
    EXPECT_NEAR(1e-3 * f.P1_high, r.P1_high, 0.15);
    EXPECT_NEAR(1e-3 * f.P2_low * kJenkinsHigh, r.P2, 0.15);
    EXPECT_NEAR(f.P2_high / f.P2_low, kJenkinsHigh / kJenkinsLow, 1e-12);
  }
}

}  // namespace
}  // namespace railstrata
