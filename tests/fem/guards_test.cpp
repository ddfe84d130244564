#include "fem/guards.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/faults.hpp"
#include "small_rolling.hpp"

namespace railstrata {
namespace {

using namespace fem_checks;

// Two cubes of 1 mm side by side along the rail.
BandSample two_cubes() {
  BandSample s;
  s.columns = s.rows = 1;
  s.stations = 2;
  s.along = {0, 1e-3, 2e-3};
  s.displacement.assign(12, Vec3{});
  return s;
}
const std::vector<Vec2> kSection{{0, 0}, {1e-3, 0}, {0, -1e-3}, {1e-3, -1e-3}};

struct Rolling {
  RollingSystem system = small_system(small_case());
  Stepper st{system, solve_preload(system, 1e-3)};
  HistoryRow row{};
  Rolling() {
    st.want_energy();
    st.step();
    row.forces = st.forces();
    row.energy = st.energy();
  }
  std::string verdict(const GuardLimits& limits = {}) {
    try {
      require_within_bounds(st, row, row.energy.strain, 0, limits);
    } catch (const NumericalError& e) {
      return e.what();
    }
    return "sound";
  }
};

}  // namespace

TEST(Guards, AnElementIsInvertedWhenANodePassesThroughTheFacesOppositeIt) {
  BandSample s = two_cubes();
  EXPECT_FALSE(inverted_element(s, kSection));
  s.displacement[8].x = -0.99e-3;
  EXPECT_FALSE(inverted_element(s, kSection));
  s.displacement[8].x = -1.5e-3;  // of the last plane: half an element beyond the plane before it
  const auto worst = inverted_element(s, kSection);
  ASSERT_TRUE(worst);
  EXPECT_NEAR(worst->centre.x, 1.5e-3, 1e-12);
  EXPECT_NEAR(worst->jacobian, -0.5, 1e-9);
}

TEST(Guards, ASoundRunPassesThemAllAndEachSaysWhatWentWrong) {
  Rolling r;
  EXPECT_EQ(r.verdict(), "sound");
  const HistoryRow sound = r.row;
  r.row.forces.z = 0.01 * r.system.model.load;
  EXPECT_NE(r.verdict().find("the wheel lost contact with the rail at t = "), std::string::npos);
  r.row = sound;
  r.row.closure = 0.3 * sound.energy.strain;
  EXPECT_NE(r.verdict().find("the energy balance drifts"), std::string::npos);
  r.row.closure = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(r.verdict().find("the energy balance drifts"), std::string::npos);
  r.row = sound;
  r.row.forces.penetration = 1.1 * r.system.model.hertz.approach;
  EXPECT_NE(r.verdict().find("the wheel sinks into the rail"), std::string::npos);
  r.row = sound;
  r.row.energy.hourglass = 0.3 * sound.energy.strain;
  EXPECT_NE(r.verdict().find("hourglass modes hold too much energy at t = "), std::string::npos);
  EXPECT_NE(r.verdict().find("try a smaller mesh.element_size, more elements through the layers"), std::string::npos);
  EXPECT_EQ(r.verdict().find("mesh.element = "), std::string::npos);  // these are full elements
  r.system.model.spec.mesh.element = ElementFormulation::one_point;
  EXPECT_NE(r.verdict().find("try mesh.element = \"full\""), std::string::npos);
  r.system.model.spec.mesh.element = ElementFormulation::full;
  r.system.model.spec.run.plasticity = true;  // bending that stays
  EXPECT_EQ(r.verdict(), "sound");
  r.system.model.spec.run.plasticity = false;

  // over heights it may fly, not away
  r.row = sound;
  r.row.forces.z = 0;
  r.system.model.spec.irregularities.emplace_back();
  r.row.way.lowering = -4e-3;
  EXPECT_EQ(r.verdict(), "sound");
  r.row.way.lowering = -6e-3;
  EXPECT_NE(r.verdict().find("the wheel lost contact with the rail at t = "), std::string::npos);
  r.system.model.spec.irregularities.clear();

  // a state that is not finite is not kept
  while (!r.st.is_restart_point()) r.st.step();
  EXPECT_NO_THROW(require_finite(r.st));
  RestartState memory = r.st.restart_state();
  const NodeLine& line = r.system.rail().lines.back();
  memory.state.bodies[0].u[line.first] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(require_finite(Stepper(r.system, memory)), NumericalError);
}

// Deeper than it falls while it passes: for some millimetres nothing bears it, then it lands.
TEST(Guards, AWheelFliesOverAHollowAndComesDown) {
  CaseSpec spec = small_case();
  spec.drive.traction_coefficient = 0;
  spec.run.window = 0;
  spec.run.positions = {0.14};
  spec.irregularities.emplace_back();
  spec.irregularities.back().at = 0.07;
  Indentation hollow;
  hollow.length = 0.04;
  hollow.depth = 1e-3;
  spec.irregularities.back().shape = hollow;
  const RunResult run = run_rolling(small_system(spec), {});
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (const HistoryRow& row : run.history) {
    least = std::min(least, std::abs(row.forces.z));
    most = std::max(most, std::abs(row.forces.z));
  }
  const double load = spec.vehicle.load();
  EXPECT_EQ(least, 0);
  EXPECT_GT(most, 1.3 * load);
  EXPECT_GT(std::abs(run.history.back().forces.z), 0.3 * load) << "it has landed";
  EXPECT_LT(run.closure, 1e-4);
}

}  // namespace railstrata
