// Rolling over a rail whose layer has a stress of its own.
#include <gtest/gtest.h>

#include "body/plastic_field.hpp"
#include "body/stress.hpp"
#include "small_rolling.hpp"
#include "tests/body/plastic_state.hpp"

namespace railstrata {
namespace {

using namespace fem_checks;

constexpr double kLongitudinal = -344e6, kLateral = -200e6, kNever = 1e20;

CaseSpec stressed_case(double yield) {
  CaseSpec spec = small_case();
  spec.run.plasticity = true;
  spec.mesh.largest = 8e-3;
  LayerSpec layer;
  layer.name = "clad";
  layer.thickness = 4e-3;
  layer.material = spec.rail_material;
  layer.material.strength.initial_stress = {kLongitudinal, kLateral};
  layer.material.strength.yield_strength = yield;
  spec.rail_material.strength.yield_strength = yield;
  spec.layers = {layer};
  return spec;
}

double largest_pressure(const PreloadResult& r) {
  double p = 0;
  for (const NodeTraction& t : r.tractions.all()) p = std::max(p, t.p);
  return p;
}

/// Of the element in the middle of the running surface that is next to a place along the rail.
Sym3 surface_stress(const RollingSystem& sys, const Field& u, const PlasticHistory& history, double x, int row) {
  const ContactBand& band = sys.rail().mesh.contact;
  const std::vector<double>& at = sys.rail().mesh.blocks[band.block].stations.at;
  const int e = static_cast<int>(std::lower_bound(at.begin(), at.end(), x) - at.begin());
  return element_stress(sys.rail(), u, history, band.block, row * band.columns + band.columns / 2, e);
}

TEST(InitialStress, StandsInTheLayerBesideTheContactAndLeavesThePressureAsItIs) {
  CaseSpec plain = stressed_case(kNever);
  plain.layers[0].material.strength.initial_stress.clear();
  CaseSpec stressed = stressed_case(kNever);
  stressed.layers[0].material.strength.initial_stress = {kLongitudinal, 0};  // across, the sides would give way
  const RollingSystem without = small_system(plain), sys = small_system(stressed);
  const PreloadResult a = solve_preload(without, 1e-6), b = solve_preload(sys, 1e-6);
  EXPECT_NEAR(largest_pressure(b), largest_pressure(a), 0.01 * largest_pressure(a));
  EXPECT_NEAR(b.contact_force.z, a.contact_force.z, 1e-4 * a.contact_force.z);
  const double far = 0.06;  // the contact's own stress is taken off
  const Sym3 s = surface_stress(sys, b.u[kRail], b.history[kRail], far, 0),
             own = surface_stress(without, a.u[kRail], a.history[kRail], far, 0);
  EXPECT_NEAR(s.xx - own.xx, kLongitudinal, 0.005 * std::abs(kLongitudinal));
  EXPECT_NEAR(s.yy - own.yy, 0, 0.005 * std::abs(kLongitudinal));
  EXPECT_NEAR(s.zz - own.zz, 0, 0.005 * std::abs(kLongitudinal));
}

TEST(SlowInitialStress, StartsTheRollingWithoutAJoltAndClosesTheEnergyBalance) {
  double closure[2], fastest[2];
  for (int k : {0, 1}) {
    CaseSpec spec = stressed_case(kNever);
    if (k == 0) spec.layers[0].material.strength.initial_stress.clear();
    const RollingSystem sys = small_system(spec);
    Stepper st(sys, solve_preload(sys, 1e-5));
    fastest[k] = 0;
    for (double v : st.state().bodies[kRail].v) fastest[k] = std::max(fastest[k], std::abs(v));
    EnergyBalance start;
    closure[k] = 0;
    for (int n = 0; n < 200; ++n) {
      if (n % 20 == 0) st.want_energy();
      st.step();
      if (n == 0) start = st.energy();
      if (n % 20 == 0) closure[k] = std::max(closure[k], std::abs(st.energy().total() - start.total()));
    }
  }
  EXPECT_LT(fastest[1], 1.02 * fastest[0]);
  EXPECT_LT(closure[1], 2 * closure[0]);
}

TEST(SlowInitialStress, OfALayerThatYieldsGoesOnFromARestartWithTheSameBits) {
  const RollingSystem sys = small_system(stressed_case(450e6));
  const PreloadResult preload = solve_preload(sys, 1e-3);
  Stepper whole(sys, preload), first(sys, preload);
  for (int n = 0; n < 48; ++n) first.step();
  Stepper second(sys, first.restart_state());
  for (int n = 0; n < 30; ++n) second.step();
  for (int n = 0; n < 78; ++n) whole.step();
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_TRUE(whole.state().bodies[k].u == second.state().bodies[k].u);
    EXPECT_TRUE(whole.state().bodies[k].history == second.state().bodies[k].history);
  }
  EXPECT_GT(plastic_extent(sys.rail(), second.state().bodies[kRail].history).yielded, 0);
}

// A hard skin of 4 mm over what yields at 250 MPa.
TEST(StrengthByDepth, DecidesWhereElementsYield) {
  CaseSpec spec = small_case();
  spec.run.plasticity = true;
  spec.rail_material.strength.strength_table = {{0, 1200e6}, {4e-3, 1200e6}, {4.1e-3, 250e6}, {0.5, 250e6}};
  const RollingSystem sys = small_system(spec);
  const PreloadResult preload = solve_preload(sys, 1e-4);
  const ContactBand& band = sys.rail().mesh.contact;
  const std::vector<double>& at = sys.rail().mesh.blocks[band.block].stations.at;
  double skin = 0, below = 0;
  for (int row = 0; row < band.rows; ++row)
    for (int c = 0; c < band.columns; ++c)
      for (int e = 0; e + 1 < static_cast<int>(at.size()); ++e)
        if (const auto s = plastic_state(sys.rail(), preload.history[kRail], band.block, row * band.columns + c, e))
          (band.depth[row + 1] < 4.05e-3 ? skin : below) += s->accumulated;
  EXPECT_EQ(skin, 0);
  EXPECT_GT(below, 1e-4);
}

}  // namespace
}  // namespace railstrata
