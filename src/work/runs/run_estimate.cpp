#include "runs/run_estimate.hpp"

#include <cmath>
#include <ctime>

#include "core/parallel.hpp"
#include "fem/stepper.hpp"
#include "record/this_process.hpp"

namespace railstrata {
namespace {

/// Wall seconds of a step where nothing else takes the cores: the processor time of steps from the undeformed state,
/// with all that a step does, over the threads.
double step_seconds(Stepper& stepper) {
  constexpr double kTrial = 0.4;  // s
  const std::clock_t begin = std::clock();
  double spent = 0;
  int steps = 0;
  for (; steps < 2 || spent < kTrial * max_threads(); ++steps) {
    stepper.step();
    spent = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  }
  return spent / steps / max_threads();
}

/// The undeformed bodies, in place of a preload.
PreloadResult undeformed(const RollingSystem& system) {
  PreloadResult out;
  out.tractions = SurfaceTractions(system.rail_surface().columns, system.rail_surface().stations.nodes());
  for (const std::size_t body : {kRail, kWheel}) {
    out.u[body].assign(system.bodies[body].mass.size(), 0.0);
    out.history[body] = initial_history(system.bodies[body]);
  }
  return out;
}

// Bytes that a run takes beyond its bodies: vectors and coarse level of the preload, samples. Peaks of runs of 0.05,
// 0.13, 0.31 and 1.06 million nodes were 47, 52, 98 and 166 MB above the bodies' memory; this is 75, 82, 98 and 166.
double preload_memory(const RollingSystem& system) {
  constexpr double kFixed = 70e6, kNode = 90;
  return kFixed + kNode * static_cast<double>(system.rail().mesh.nodes() + system.wheel().mesh.nodes());
}

}  // namespace

RunEstimate estimate_run(const Model& model) {
  constexpr double kPreload = 3000;  // steps; 900 to 3,600 in three cases of 35,000 to 155,000 elements
  const RollingSystem system(model);
  RunEstimate e;
  if (model.spec.run.rolling) {
    Stepper stepper(system, undeformed(system));
    e.limits = stepper.plan().limits;
    e.steps = std::lround(model.likely_end() / (model.spec.drive.speed * e.limits.chosen));
    e.seconds = (kPreload + static_cast<double>(e.steps)) * step_seconds(stepper);
  } else {
    e.limits = StepPlan(system).limits;
  }
  e.memory_bytes = peak_memory() + preload_memory(system);
  return e;
}

}  // namespace railstrata
