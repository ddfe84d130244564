#include "fem/rolling_run.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "small_rolling.hpp"
#include "tests/body/same_bits.hpp"

namespace railstrata {
namespace {

using namespace fem_checks;

EnergyBalance energy_now(Stepper& st) {
  st.want_energy();
  st.step();
  return st.energy();
}

}  // namespace

// No torque, friction, damping: the balance's total must stand still. A revolution is 2.7 m; 15 mm of it are rolled and
// the drift is scaled up linearly, which overstates a drift that grows like a random walk.
TEST(Rolling, AFreeWheelKeepsItsEnergyToOneInTenMillionPerRevolution) {
  CaseSpec spec = small_case();
  spec.drive.traction_coefficient = 0;
  spec.drive.friction_coefficient = 0;
  spec.vehicle.suspension_damping = 0;
  const RollingSystem system = small_system(spec);
  Stepper st(system, solve_preload(system, 1e-7));
  const EnergyBalance start = energy_now(st);
  double drift = 0;
  while (st.position() < 0.015) {
    for (int k = 0; k < 200; ++k) st.step();
    const EnergyBalance now = energy_now(st);
    drift = std::max(drift, std::abs(now.total() - start.total()));
  }
  const double revolutions = st.position() / (2 * std::numbers::pi * system.rolling_radius);
  EXPECT_LT(drift / revolutions, 1e-7 * start.kinetic);
}

// Elements in single precision see displacements relative to the uniformly turning frame. Tractions after 1.5 mm of
// rolling with a creepage that slides a part of the patch, against those of double precision.
TEST(Rolling, ElementsInSinglePrecisionChangeTractionsByLessThanAFifthOfAPercentOfTheirMaximum) {
  CaseSpec spec = small_case();
  spec.drive.traction_coefficient = 0;
  spec.drive.creepage_start = -0.02;
  const PreloadResult preload = solve_preload(small_system(spec), 1e-5);
  auto roll = [&](ArithmeticPrecision precision) {
    spec.run.precision = precision;
    const RollingSystem system = small_system(spec);
    Stepper st(system, preload);
    const EnergyBalance start = energy_now(st);
    while (st.position() < 0.0015) st.step();
    const EnergyBalance end = energy_now(st);
    EXPECT_LT(std::abs(end.total() - start.total()), 2e-5 * end.strain)
        << static_cast<int>(precision);  // the preload's tolerance is 1e-5
    return st.state().tractions.all();
  };
  const std::vector<NodeTraction> exact = roll(ArithmeticPrecision::double_precision),
                                  rounded = roll(ArithmeticPrecision::single_precision);
  ASSERT_EQ(exact.size(), rounded.size());
  double p_max = 0, q_max = 0, p_difference = 0, q_difference = 0;
  for (std::size_t k = 0; k < exact.size(); ++k) {
    p_max = std::max(p_max, exact[k].p);
    q_max = std::max(q_max, std::hypot(exact[k].q1, exact[k].q2));
    p_difference = std::max(p_difference, std::abs(rounded[k].p - exact[k].p));
    q_difference = std::max(q_difference, std::hypot(rounded[k].q1 - exact[k].q1, rounded[k].q2 - exact[k].q2));
  }
  EXPECT_GT(q_max, 0.1 * p_max);
  EXPECT_LT(p_difference, 2e-3 * p_max);
  EXPECT_LT(q_difference, 2e-3 * q_max);
  EXPECT_GT(p_difference, 0);  // it is another arithmetic
}

TEST(Rolling, SameBitsOnOneTwoAndFourThreads) {
  CaseSpec spec = small_case();
  spec.run.run_up = 0.02;
  spec.run.run_up_damping = 2000;
  const RollingSystem system = small_system(spec);
  const PreloadResult preload = solve_preload(system, 1e-5);
  expect_same_bits_on_one_two_and_four_threads([&] {
    Stepper st(system, preload);
    for (int k = 0; k < 60; ++k) st.step();
    const EnergyBalance e = energy_now(st);
    std::vector<double> bits{
        st.dt(),   st.forces().x, st.forces().y, st.forces().z, st.state().axle.x, st.state().axle.psi,
        e.total(), e.kinetic,     e.friction,    e.damping};
    for (const auto& [body, u] :
         {std::pair{&system.rail(), &st.state().bodies[0].u}, std::pair{&system.wheel(), &st.state().bodies[1].u}})
      for (const NodeLine& l : body->lines)
        bits.insert(bits.end(), u->begin() + l.first, u->begin() + l.first + l.count);
    return bits;
  });
}

// A rigid wheel under the torque M = F (r + I/(m r)) is driven by F = m a. The wheel's inertia swings on the tangential
// stiffness of its contact with a period of about 2.3 ms; the torque rises over about one period and F_x is averaged
// over another.
TEST(SlowRolling, ThePoweredWheelReachesTheWantedTractionAndItsEnergyClosesToATenthOfAThousandthOfTheWork) {
  CaseSpec spec = small_case();
  spec.vehicle.wheel_mass = 300;
  spec.vehicle.sprung_mass = 8200;
  spec.drive.speed = 10;
  spec.drive.torque_ramp = 2.5e-3;
  spec.run.positions = {0.045};
  spec.run.run_up = 0.02;
  spec.run.run_up_damping = 3000;
  const RollingSystem system = small_system(spec);
  Stepper st(system, solve_preload(system, 1e-6));
  const EnergyBalance start = energy_now(st);
  const double window_begin = 2.6e-3, window_end = window_begin + 2.3e-3;
  double sum = 0, vertical = 0, worst = 0, v0 = 0, t0 = 0;
  long count = 0;
  while (st.state().time < window_end) {
    for (int k = 0; k < 100; ++k) {
      st.step();
      if (st.state().time < window_begin) continue;
      if (count++ == 0) {
        v0 = st.state().axle.vx;
        t0 = st.state().time;
      }
      sum += st.forces().x;
      vertical += st.forces().z;
    }
    const EnergyBalance now = energy_now(st);
    worst = std::max(worst, std::abs(now.total() - start.total()));
  }
  EXPECT_LT(worst, 1e-4 * st.energy().torque_work);
  const double wanted = spec.drive.traction_coefficient * system.model.load;
  EXPECT_NEAR(sum / static_cast<double>(count) / wanted, 1.0, 0.01);
  EXPECT_NEAR(vertical / static_cast<double>(count) / system.model.load, 1.0, 0.01);
  EXPECT_NEAR((st.state().axle.vx - v0) / (st.state().time - t0) * system.travel_mass / wanted, 1.0, 0.01);
  EXPECT_FALSE(st.reached_edge());
}

}  // namespace railstrata
