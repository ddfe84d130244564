// Every option that steps read, by both: on the processor and on the emulated device. An option that is new must be put
// into one of the lists here.
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "device/emulated_device.hpp"
#include "extras/device/tests/engine_checks.hpp"
#include "options/option_table.hpp"
#include "reader/case_file.hpp"

namespace railstrata::device {
namespace {

using namespace device_checks;

using Overrides = std::vector<std::string>;

const Overrides kLayer{"layer.0.thickness=1 mm", "layer.0.width=20 mm", "layer.0.young_ratio=2"};

Overrides layered(Overrides more) {
  more.insert(more.begin(), kLayer.begin(), kLayer.end());
  return more;
}

// Options set together; none of them hides another one.
const std::vector<Overrides>& taken() {
  static const std::vector<Overrides> sets{
      {"geometry.yaw=5 mrad", "geometry.rail_profile=arc:R=200 mm", "geometry.block_width=50 mm",
       "geometry.lateral_shift=3 mm", "geometry.cant=0.01"},
      {"vehicle.wheel_mass=1000 kg", "vehicle.sprung_mass=5000 kg", "vehicle.suspension_stiffness=9 MN/m",
       "vehicle.suspension_damping=90 kN s/m"},
      {"vehicle.couple_sprung_mass=false", "vehicle.axle_load=150 kN", "drive.lateral_traction_coefficient=-0.2"},
      {"vehicle.wheel_load=60 kN", "drive.tractive_force=-20 kN", "run.run_up=20 mm", "run.run_up_damping=5000 1/s"},
      {"drive.speed=50 m/s", "drive.traction_coefficient=-0.3", "drive.torque_ramp=0.02 ms",
       "drive.friction_coefficient=0.4"},
      {"drive.creepage=-0.01", "drive.lateral_creepage=0.005"},
      {"drive.creepage_start=-0.002", "drive.lateral_force=20 kN"},
      {"drive.friction_coefficient=0.3", "drive.creepage=-0.01", "friction.law=falling_rational",
       "friction.kinetic_coefficient=0.1", "friction.half_velocity=0.3 m/s", "friction.memory_distance=0.05 mm",
       "friction.memory_velocity=0.1 m/s"},
      {"drive.friction_coefficient=0.3", "drive.creepage=-0.01", "third_body.thickness=0.02 mm",
       "third_body.shear_modulus=1 GPa", "third_body.yield_shear=50 MPa", "third_body.hardening=10000 MPa/mm"},
      {"drive.friction_coefficient=0.3", "drive.creepage=-0.01", "friction.lateral_coefficient=0.2"},
      {"mesh.element=one_point"},
      layered({"layer.0.elements=1", "run.mass_scaling_step=0.7"}),
      layered({"run.mass_scaling_step=0", "run.step_safety=0.5", "layer.0.on=wheel"}),
      {"layer.0.width=20 mm", "layer.0.young_table=[[\"0 mm\", \"300 GPa\"], [\"4 mm\", \"210 GPa\"]]",
       "layer.0.initial_stress=[\"-300 MPa\", \"-100 MPa\"]", "layer.0.poisson=0.25", "layer.0.density=6000 kg/m^3"},
  };
  return sets;
}

// Tables whose options steps read, and those of them that these sets do not vary, with the reason.
const std::map<std::string, std::string>& others() {
  static const std::map<std::string, std::string> all{
      {"vehicle.approach", "half-space engine"},
      {"drive.spin", "half-space engine"},
      {"geometry.rail_radius", "refused: CaseFile.TellsWhatTheFiniteElementsDoNotDoWithItsPlace"},
      {"drive.creepage_of", "the model's"},
      {"drive.rail_rotation", "another word for drive.speed"},
      {"drive.wheel_rotation", "another word for drive.creepage"},
      {"third_body.residual_shear", "half-space engine"},
      {"third_body.yield_by_pressure", "half-space engine"},
      {"third_body.modulus_by_pressure", "half-space engine"},
      {"third_body.temperature_table", "half-space engine"},
      {"friction.condition", "a name for other options"},
      {"friction.lateral_table", "refused: DeviceCase.WhatADeviceDoesNotTakeIsRefusedWithARemedy"},
      {"friction.temperature_table", "half-space engine"},
      {"friction.rail_temperature", "half-space engine"},
      {"friction.wheel_temperature", "half-space engine"},
      {"mesh.element_size", "the model's"},
      {"mesh.fine_width", "the model's"},
      {"mesh.fine_depth", "the model's"},
      {"mesh.largest", "the model's"},
      {"mesh.coarse_ratio", "the model's"},
      {"mesh.end_length", "the model's"},
      {"run.start", "the preload's, on the processor"},
      {"run.positions", "AWholeRunHasTheHistoryAndSamplesOfTheProcessor"},
      {"run.window", "AWholeRunHasTheHistoryAndSamplesOfTheProcessor"},
      {"run.history_interval", "AWholeRunHasTheHistoryAndSamplesOfTheProcessor"},
      {"run.precision", "InSinglePrecisionDisplacementsAndPressuresAre"},
      {"run.device", "device_of"},
      {"run.preload_tolerance", "the preload's, on the processor"},
      {"run.rolling", "nothing is computed on a device: ACaseWithoutACardIsToldWhatToDo"},
      {"run.plasticity", "refused: DeviceCase.WhatADeviceDoesNotTakeIsRefusedWithARemedy"},
      {"run.judged", "of results, not of steps"},
  };
  return all;
}

CaseSpec spec_with(const Overrides& overrides) {
  CaseSpec base = small_case();
  base.drive.torque_ramp = 1e-4;
  const std::string text = resolved_case(base);
  return parse_case(text, "a.toml", overrides).spec;
}

struct BothRolled {
  explicit BothRolled(const CaseSpec& spec, int steps)
      : system(small_system(spec)),
        preload(solve_preload(system, 1e-4)),
        here(system, preload),
        there(system, preload) {
    there.use(on(device));
    roll(here, steps);
    roll(there, steps);
  }
  RollingSystem system;
  PreloadResult preload;
  EmulatedDevice device{Protection::open};
  Stepper here, there;
};

constexpr int kSteps = 24;
constexpr double kTolerance = 1e-9;

TEST(SlowDeviceOptions, EveryOneThatStepsReadGivesTheProcessorsPressure) {
  const BothRolled base(spec_with({}), kSteps);
  for (const Overrides& set : taken()) {
    std::string name;
    for (const std::string& o : set) name += o + "; ";
    SCOPED_TRACE(name);
    const BothRolled both(spec_with(set), kSteps);
    const double p = largest_pressure(both.here);
    EXPECT_GT(p, 1e8);
    EXPECT_NEAR(largest_pressure(both.there), p, kTolerance * p);
    for (std::size_t k = 0; k < 2; ++k) {  // velocities are vibration alone, a small part of which is rounding's
      const Field &u = both.here.state().bodies[k].u, &v = both.there.state().bodies[k].u;
      EXPECT_LT(largest_difference(both.system.bodies[k], u, v), kTolerance * largest(both.system.bodies[k], u));
    }
    EXPECT_EQ(both.there.forces().nodes, both.here.forces().nodes);
    EXPECT_NEAR(both.there.forces().x, both.here.forces().x, kTolerance * both.here.forces().z);
    EXPECT_NEAR(both.there.forces().y, both.here.forces().y, kTolerance * both.here.forces().z);
    // options without effect would be tested in vain
    EXPECT_NE(p, largest_pressure(base.here));
  }
}

TEST(DeviceOptions, NoneIsForgotten) {
  std::set<std::string> varied;
  for (const Overrides& set : taken())
    for (const std::string& o : set) varied.insert(o.substr(0, o.find('=')));
  for (const char* name : {"vehicle", "drive", "friction", "third_body", "mesh", "run"})
    for (const Option& option : find_table(name)->options) {
      const std::string key = std::string(name) + "." + std::string(option.key);
      EXPECT_TRUE(varied.contains(key) != others().contains(key)) << key;
    }
}

}  // namespace
}  // namespace railstrata::device
