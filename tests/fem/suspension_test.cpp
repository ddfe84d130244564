#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "fem/axle_step.hpp"
#include "spec/case_spec.hpp"

namespace railstrata {
namespace {

// Height of the sprung mass on an axle that is held, released from 1 mm above its equilibrium: period and logarithmic
// decrement of the free vibration.
struct Vibration {
  double period, decrement;
};
Vibration free_vibration(const VehicleSpec& vehicle, std::size_t count, double dt) {
  std::vector<MassGroup> groups(count, MassGroup{1e-3, 0});
  double before = 0, first_crossing = -1, last_peak = 0, first_peak = 0, crossing = 0;
  int crossings = 0;
  double peak = 0;
  for (long s = 0; crossings < 9 && s < 10'000'000;
       ++s) {  // zeros from above and below alternate; between two of them stands one extreme
    before = groups[0].z;
    step_suspension(suspension_law(vehicle), 0, 0, dt, groups);
    peak = std::max(peak, std::abs(groups[0].z));
    if ((groups[0].z < 0) == (before < 0)) continue;
    crossing = (static_cast<double>(s) + before / (before - groups[0].z)) * dt;
    if (crossings == 0) first_crossing = crossing;
    if (crossings == 1) first_peak = peak;
    last_peak = peak;
    peak = 0;
    ++crossings;
  }
  return {(crossing - first_crossing) / 4, std::log(first_peak / last_peak) / 3.5};
}

}  // namespace

// omega = sqrt(k/m - (c/2m)^2), decrement = pi c / (m omega): the textbook's damped oscillator.
TEST(Suspension, PeriodAndDampingAreThoseOfTheDampedOscillatorWithinHalfAPercent) {
  for (std::size_t groups : {1, kSuspensionGroups}) {
    const VehicleSpec v;
    const double rate = v.suspension_damping / (2 * v.sprung_mass),
                 omega = std::sqrt(v.suspension_stiffness / v.sprung_mass - rate * rate),
                 period = 2 * std::numbers::pi / omega;
    for (double dt : {1e-5, 1e-4}) {
      const Vibration vibration = free_vibration(v, groups, dt);
      EXPECT_NEAR(vibration.period / period, 1.0, 0.005);
      EXPECT_NEAR(vibration.decrement / (rate * period), 1.0, 0.005);
    }
  }
}

TEST(Suspension, ForceIsSpringPlusDashpotAndDissipatesItsSquareOverTheDashpot) {
  const VehicleSpec v;
  std::vector<MassGroup> groups(8);
  const SuspensionForce f = step_suspension(suspension_law(v), -2e-3, 0.1, 1e-6, groups);
  EXPECT_NEAR(f.on_masses, v.suspension_stiffness * -2e-3 + v.suspension_damping * 0.1, 1e-9 * v.suspension_stiffness);
  EXPECT_NEAR(f.dashpot_power, v.suspension_damping * 0.01, 1e-9);
}

TEST(Suspension, GroupsActAsOneMassWhateverTheirNumber) {
  VehicleSpec v;
  std::vector<MassGroup> one(1), eight(8);
  for (int s = 0; s < 1000; ++s) {
    const double t = 1e-4 * s, z = 1e-3 * std::sin(30 * t), vz = 0.03 * std::cos(30 * t);
    EXPECT_NEAR(step_suspension(suspension_law(v), z, vz, 1e-4, one).on_masses,
                step_suspension(suspension_law(v), z, vz, 1e-4, eight).on_masses, 1e-9);
  }
  for (const MassGroup& m : eight) EXPECT_NEAR(m.z, one[0].z, 1e-15);
}

}  // namespace railstrata
