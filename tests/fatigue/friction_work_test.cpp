// Friction's work of a rolling contact, point by point of the patch, against the book of energies.
#include <gtest/gtest.h>

#include "fatigue/streamlines.hpp"
#include "result/rolling_mean.hpp"
#include "tests/fem/small_rolling.hpp"

namespace railstrata {
namespace {

using namespace fem_checks;

constexpr double kFriction = 0.3;

CaseSpec sliding(double creepage) {
  CaseSpec spec = small_case();
  spec.drive.friction_coefficient = kFriction;
  spec.drive.traction_coefficient = 0;
  spec.drive.creepage_start = creepage;
  return spec;
}

/// Rolls to a position of the axle; what friction has taken until then.
double roll_to(Stepper& stepper, double position) {
  while (stepper.position() < position) stepper.step();
  stepper.want_energy();
  stepper.step();
  return stepper.energy().friction;
}

}  // namespace

TEST(FrictionWork, OfThePointsIsThatOfTheBalanceOfEnergies) {
  const CaseSpec spec = sliding(-0.004);
  const RollingSystem system = small_system(spec);
  Stepper stepper(system, solve_preload(system, 1e-6));
  PositionSamples samples;
  std::vector<double> friction;
  for (int k = 1; k <= 3; ++k) {
    friction.push_back(roll_to(stepper, k * spec.mesh.element_size));
    samples.samples.push_back(take_sample(stepper));
  }
  const ContactField field = mean_contact(system, samples).field;
  ASSERT_FALSE(field.friction_power.empty());
  double power = 0, product = 0;
  for (int i = 0; i < field.size(); ++i) {
    power += field.area[i] * field.friction_power[i];
    product += field.area[i] * (field.q_x[i] * field.slip_x[i] + field.q_y[i] * field.slip_y[i]);
  }
  const double time = samples.samples.back().time - samples.samples.front().time;
  EXPECT_NEAR(power * time / (friction.back() - friction.front()), 1, 2e-3);
  EXPECT_GT(std::abs(product / power - 1), 0.01) << "states of single moments say something else";
  double energy = 0;  // per length
  for (const StreamlineRow& row : streamlines(spec, field)) energy += row.friction_energy * row.width;
  EXPECT_NEAR(energy * spec.drive.speed / power, 1, 2e-3);
}

// Archard's p |s| of what slips is q s/f: the law has |q| = f p there. A step in which a node comes to rest ends
// without slip, but has some in the mean.
TEST(FrictionWork, OfSlipsIsTheirPressureTimesFriction) {
  const RollingSystem system = small_system(sliding(-0.02));
  Stepper stepper(system, solve_preload(system, 1e-6));
  roll_to(stepper, 2e-3);
  double work = 0, pressed = 0;
  for (const NodeTraction& t : stepper.state().tractions.all()) {
    work += t.friction_work;
    pressed += t.pressed_slip;
  }
  EXPECT_GT(work, 0);
  EXPECT_NEAR(kFriction * pressed / work, 1, 0.02);
}

}  // namespace railstrata
