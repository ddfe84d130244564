// A wheel that rolls more than a turn: its fine band is a closed ring, and the contact crosses the place where it
// closes.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>

#include "small_rolling.hpp"

namespace railstrata {
namespace {

using namespace fem_checks;

/// A wheel of 80 mm: a turn is half a metre.
CaseSpec tiny_wheel(std::vector<double> positions) {
  CaseSpec s = small_case();
  s.geometry.wheel_radius = 0.08;
  s.geometry.rim_thickness = 0.03;
  s.geometry.bore_radius = 0.04;
  s.geometry.block_height = 0.03;
  s.vehicle.wheel_mass = 200;
  s.vehicle.sprung_mass = 1800;
  s.drive.speed = 40;
  s.drive.traction_coefficient = 0;
  s.mesh.largest = 12e-3;
  s.mesh.end_length = 0.03;
  s.run.positions = std::move(positions);
  s.run.run_up = 0.05;
  s.run.run_up_damping = 3000;
  s.run.time_step_method = "uniform";
  return s;
}

}  // namespace

TEST(Turns, Probe) {
  const RollingSystem system = small_system(tiny_wheel({0.1, 0.7}));
  const double turn = 2 * std::numbers::pi * system.rolling_radius;
  printf("elements %ld wheel %ld turn %g begin %g end %g\n",
         system.model.rail.elements() + system.model.wheel.elements(), system.model.wheel.elements(), turn,
         system.model.wheel.contact.fine_begin, system.model.wheel.contact.fine_end);
  const RunResult run = run_rolling(system, {});
  printf("steps %ld dt %g wall %g\n", run.steps, run.dt, run.wall_seconds);
  for (std::size_t k = 0; k < run.history.size(); k += 10) {
    const HistoryRow& r = run.history[k];
    printf("%8.2f F_z %8.1f p %8.2f creep %10.3g closure %10.3g\n", 1e3 * r.position, r.forces.z, 1e-6 * r.p_max,
           r.creepage, r.closure);
  }
}

}  // namespace railstrata
