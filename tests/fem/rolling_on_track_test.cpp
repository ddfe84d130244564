// A wheel on a rail on pads, sleepers and ballast.
#include <gtest/gtest.h>

#include <cmath>

#include "small_rolling.hpp"

namespace railstrata {
namespace {

using namespace fem_checks;

double rail_weight(const RollingSystem& sys) {
  double mass = 0;
  for (const NodeLine& l : sys.rail().lines)
    if (l.component == 2)
      for (int j = 0; j < l.count; ++j) mass += sys.rail().mass[l.first + j];
  return sys.gravity * mass;
}

TEST(RollingOnTrack, AtRestBallastCarriesWheelAndRailWhereTheyAre) {
  const RollingSystem sys = small_system(on_track(small_case()));
  ASSERT_EQ(sys.pads.x.size(), 3u);
  const PreloadResult r = solve_preload(sys, 1e-9);
  const std::vector<double>& at = sys.model.rail.blocks[0].stations.at;
  const double middle = 0.5 * (at.front() + at.back()), load = r.contact_force.z, weight = rail_weight(sys);
  double force = 0, moment = 0;
  const std::vector<MassGroup> sleepers = sleepers_below(sys.pads, r.u[kRail], r.u[kRail]);
  for (std::size_t k = 0; k < sleepers.size(); ++k) {
    force -= sys.pads.track.ballast_stiffness * sleepers[k].z;
    moment -= sys.pads.track.ballast_stiffness * sleepers[k].z * sys.pads.x[k];
  }
  EXPECT_NEAR(force, load + weight, 1e-6 * load);
  // pads that hold along the rail carry moments too: pad_shear of k at the foot, 60 mm below the contact
  EXPECT_NEAR(moment, weight * middle, 0.02 * load * sys.pads.track.spacing);
  EXPECT_LT(r.foot_z, -0.1e-3);
}

TEST(RollingOnTrack, TheEnergyIsFoundAgain) {
  CaseSpec spec = on_track(small_case());
  spec.track.support.pad_damping = 100e3;  // so that there is something to be found
  const RollingSystem sys = small_system(spec);
  Stepper st(sys, solve_preload(sys, 1e-6));
  double first = 0, worst = 0;
  for (int k = 0; k < 1200; ++k) {
    st.want_energy();
    st.step();
    if (k == 0) first = st.energy().total();
    worst = std::max(worst, std::abs(st.energy().total() - first));
  }
  EXPECT_GT(st.energy().dashpot, 1e-2 * st.energy().strain);
  EXPECT_LT(worst, 1e-4 * st.energy().strain);
}

// No force acts sideways on a symmetric wheel, and the sleepers keep below the foot.
TEST(RollingOnTrack, SleepersStartWithTheFoot) {
  const RollingSystem sys = small_system(on_track(small_case()));
  const PreloadResult preload = solve_preload(sys, 1e-9);
  Stepper st(sys, preload);
  const RollingState& start = st.state();
  const std::size_t near = sleeper_near(sys.pads, 0);
  EXPECT_NEAR(start.sleepers[near].z / preload.foot_z, sys.pads.follows(), 0.05);
  // ahead of the wheel the foot goes down, V du/dx per time
  EXPECT_LT(start.sleepers.back().vz, 0);
}

}  // namespace
}  // namespace railstrata
