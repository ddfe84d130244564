#pragma once
// Checks that every device must pass, the emulated one and the card.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "device/engine.hpp"
#include "tests/fem/small_rolling.hpp"

namespace railstrata::device_checks {

using namespace fem_checks;
using namespace device;

template <class Array>
bool same_bits(const Array& a, const Array& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0;
}

inline EngineOf on(Device& device) {
  return [&device](const RollingSystem& system, const RollingBodies& bodies, double dt) {
    return std::make_unique<Engine>(device, system, bodies, dt);
  };
}

// Over all nodes; lines are padded with numbers that mean nothing.
inline double largest_difference(const Body& body, const Field& a, const Field& b) {
  double out = 0;
  for (const BlockLayout& l : body.layout.blocks)
    for (int n = 0; n < l.nodes; ++n)
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < l.stations; ++j) {
          const double d = std::abs(a[l.line(n, i) + j] - b[l.line(n, i) + j]);
          if (!(d <= out)) out = d;
        }
  return out;
}

inline double largest(const Body& body, const Field& a) { return largest_difference(body, a, body.layout.field()); }

// Displacements without pattern, of a size that strains by some 1e-3.
inline Field shaken(const Body& body, double size) {
  Field u = body.layout.field();
  for (const BlockLayout& l : body.layout.blocks)
    for (int n = 0; n < l.nodes; ++n)
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < l.stations; ++j) {
          const auto k = static_cast<std::size_t>(l.line(n, i) + j);
          u[k] = size * (2 * std::fmod(0.6180339887498949 * static_cast<double>(k * k + 7 * k + 1), 1.0) - 1);
        }
  return u;
}

inline CaseSpec layered_case(ArithmeticPrecision precision) {
  CaseSpec s = thinly_layered(small_case());
  s.run.run_up = 0.02;
  s.run.run_up_damping = 2000;
  s.drive.torque_ramp = 1e-4;
  s.run.precision = precision;
  return s;
}

// Worst force of the device against the traversal's, over the largest stress times an element's face.
inline void expect_same_forces(Device& device, ArithmeticPrecision precision, double tolerance) {
  const RollingSystem system = small_system(layered_case(precision));
  Stepper stepper(system, solve_preload(system, 1e-2));
  Engine* engine = nullptr;
  stepper.use([&](const RollingSystem& s, const RollingBodies& bodies, double dt) {
    auto made = std::make_unique<Engine>(device, s, bodies, dt);
    engine = made.get();
    return made;
  });
  for (std::size_t k = 0; k < 2; ++k) {
    const Body& body = system.bodies[k];
    Field u = shaken(body, 4e-6), expected = body.layout.field(), found = body.layout.field();
    const double psi = k == kWheel ? 1e-3 : 0.0;
    Traversal(body).internal_force(u, psi, expected, {});
    engine->internal_force(k, u, psi, found);
    EXPECT_LT(largest_difference(body, expected, found), tolerance * largest(body, expected)) << body.mesh.name;
    EXPECT_GT(largest(body, expected), 1.0);
  }
}

struct Motion {
  explicit Motion(const Stepper& st) : rail(st.state().bodies[kRail]), wheel(st.state().bodies[kWheel]) {}
  BodyState rail, wheel;
};

inline double relative_difference(const RollingSystem& sys, const Motion& a, const Motion& b) {
  return std::max({largest_difference(sys.rail(), a.rail.u, b.rail.u) / largest(sys.rail(), a.rail.u),
                   largest_difference(sys.wheel(), a.wheel.u, b.wheel.u) / largest(sys.wheel(), a.wheel.u),
                   largest_difference(sys.rail(), a.rail.v, b.rail.v) / largest(sys.rail(), a.rail.v),
                   largest_difference(sys.wheel(), a.wheel.v, b.wheel.v) / largest(sys.wheel(), a.wheel.v)});
}

inline double largest_pressure(const Stepper& st) {
  double p = 0;
  for (const NodeTraction& t : st.state().tractions.all()) p = std::max(p, t.p);
  return p;
}

inline void roll(Stepper& st, int steps) {
  for (int k = 0; k < steps; ++k) {
    if (k % 19 == 0) st.want_energy();
    st.step();
  }
  st.complete();
}

inline void expect_same_steps(Device& device) {
  const RollingSystem system = small_system(layered_case(ArithmeticPrecision::double_precision));
  const PreloadResult preload = solve_preload(system, 1e-4);
  Stepper here(system, preload), there(system, preload);
  there.use(on(device));
  ASSERT_GT(here.plan().limits.added_mass, 0);
  roll(here, 60);
  roll(there, 60);
  constexpr double kTolerance = 1e-9;
  EXPECT_LT(relative_difference(system, Motion(here), Motion(there)), kTolerance);
  EXPECT_NEAR(largest_pressure(there), largest_pressure(here), kTolerance * largest_pressure(here));
  EXPECT_NEAR(there.state().axle.z, here.state().axle.z, kTolerance * std::abs(here.state().axle.z));
  EXPECT_NEAR(there.state().axle.vx, here.state().axle.vx, 1e-12 * here.state().axle.vx);
  EXPECT_NEAR(there.energy().total(), here.energy().total(), kTolerance * std::abs(here.energy().strain));
  EXPECT_NEAR(there.energy().damping, here.energy().damping, 1e-6 * std::abs(here.energy().damping));
  EXPECT_NEAR(there.energy().absorbed, here.energy().absorbed, 1e-6 * std::abs(here.energy().absorbed));
}

/// Some steps of a case by both, as near as roundings leave them.
inline void expect_same_contact(Device& device, const CaseSpec& spec, int steps = 24) {
  const RollingSystem system = small_system(spec);
  const PreloadResult preload = solve_preload(system, 1e-4);
  Stepper here(system, preload), there(system, preload);
  there.use(on(device));
  roll(here, steps);
  roll(there, steps);
  constexpr double kTolerance = 1e-9;
  EXPECT_LT(relative_difference(system, Motion(here), Motion(there)), kTolerance);
  const std::vector<NodeTraction>&a = here.state().tractions.all(), &b = there.state().tractions.all();
  const double scale = largest_pressure(here);
  double worst = 0, work = 0, worst_work = 0;
  int slipping = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    worst = std::max({worst, std::abs(a[k].p - b[k].p), std::abs(a[k].q1 - b[k].q1), std::abs(a[k].q2 - b[k].q2)});
    work = std::max(work, std::abs(a[k].friction_work));
    worst_work = std::max(worst_work, std::abs(a[k].friction_work - b[k].friction_work));
    EXPECT_EQ(a[k].stuck, b[k].stuck);
    slipping += a[k].slips();
  }
  EXPECT_LT(worst, kTolerance * scale);
  EXPECT_LE(worst_work, 1e-6 * work);
  EXPECT_GT(scale, 1e8);
  EXPECT_EQ(here.forces().nodes, there.forces().nodes);
  EXPECT_EQ(here.forces().sweeps, there.forces().sweeps);
  EXPECT_NEAR(here.forces().z, there.forces().z, kTolerance * here.forces().z);
  EXPECT_NEAR(here.forces().penetration, there.forces().penetration, 1e-14);
  EXPECT_EQ(here.reached_edge(), there.reached_edge());
  EXPECT_GT(slipping, 0);
}

// Velocities are the rounding's own vibration so soon after the start, and other roundings have another one.
inline void expect_same_steps_in_single_precision(Device& device) {
  const RollingSystem system = small_system(layered_case(ArithmeticPrecision::single_precision));
  const PreloadResult preload = solve_preload(system, 1e-4);
  Stepper here(system, preload), there(system, preload);
  there.use(on(device));
  roll(here, 60);
  roll(there, 60);
  const Motion a(here), b(there);
  EXPECT_LT(largest_difference(system.rail(), a.rail.u, b.rail.u), 1e-4 * largest(system.rail(), a.rail.u));
  EXPECT_LT(largest_difference(system.wheel(), a.wheel.u, b.wheel.u), 1e-4 * largest(system.wheel(), a.wheel.u));
  EXPECT_NEAR(largest_pressure(there), largest_pressure(here), 1e-3 * largest_pressure(here));
}

inline void expect_checkpoints_go_either_way(Device& device) {
  const RollingSystem system = small_system(layered_case(ArithmeticPrecision::double_precision));
  const PreloadResult preload = solve_preload(system, 1e-3);
  Stepper whole(system, preload), here(system, preload), there(system, preload);
  there.use(on(device));
  roll(whole, 64);
  roll(here, 32);
  roll(there, 32);
  Stepper to_device(system, here.restart_state()), to_host(system, there.restart_state());
  to_device.use(on(device));
  roll(to_device, 32);
  roll(to_host, 32);
  EXPECT_LT(relative_difference(system, Motion(whole), Motion(to_device)), 1e-9);
  EXPECT_LT(relative_difference(system, Motion(whole), Motion(to_host)), 1e-9);
  // from its own checkpoint to the bits
  Stepper on_device(system, there.restart_state());
  on_device.use(on(device));
  Stepper without(system, preload);
  without.use(on(device));
  roll(without, 32);
  roll(without, 32);
  roll(on_device, 32);
  for (std::size_t k = 0; k < 2; ++k)
    EXPECT_TRUE(same_bits(without.state().bodies[k].u, on_device.state().bodies[k].u));
}

}  // namespace railstrata::device_checks
