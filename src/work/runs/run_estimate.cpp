#include "runs/run_estimate.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "body/traversal.hpp"
#include "record/this_process.hpp"

namespace railstrata {
namespace {

/// Seconds of one evaluation of the internal forces of a body: the best of a quarter of a second, because other
/// programs may hold the cores.
double force_seconds(const Body& body) {
  Field u(body.mass.size(), 0.0), f(body.mass.size(), 0.0);
  const PlasticHistory history = initial_history(body);
  Traversal elements(body);
  double best = 1e9;
  for (double spent = 0, last = 0; spent < 0.25; spent += last, best = std::min(best, last)) {
    const auto start = std::chrono::steady_clock::now();
    elements.internal_force(u, 0.0, f, history);
    last = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
  return best;
}

// Bytes that a run takes beyond its bodies: vectors and coarse level of the preload, samples. Peaks of runs of 0.05,
// 0.13, 0.31 and 1.06 million nodes were 47, 52, 98 and 166 MB above the bodies' memory; this is 75, 82, 98 and 166.
double preload_memory(const RollingSystem& system) {
  constexpr double kFixed = 70e6, kNode = 90;
  return kFixed + kNode * static_cast<double>(system.rail().mesh.nodes() + system.wheel().mesh.nodes());
}

}  // namespace

RunEstimate estimate_run(const Model& model) {
  // Node update, ties and contact, which leave less of the elements in the caches than there is here: the steps of five
  // cases of 37,000 to 152,000 elements took 2.15, 1.41, 1.66, 1.70 and 1.79 times these forces on two cores.
  constexpr double kWholeStep = 1.7;
  const RollingSystem system(model);
  RunEstimate e;
  StepPlan plan(system);
  e.limits = plan.limits;
  e.steps = std::lround(model.likely_end() / (model.spec.drive.speed * e.limits.chosen));
  e.seconds =
      kWholeStep * static_cast<double>(e.steps) * (force_seconds(system.rail()) + force_seconds(system.wheel()));
  e.memory_bytes = peak_memory() + preload_memory(system);
  return e;
}

}  // namespace railstrata
