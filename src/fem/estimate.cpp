#include "fem/estimate.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>

#include "fem/stepper.hpp"

namespace railstrata {
namespace {

// Contact, constraints and the update of the nodes on top of the element work, from whole steps of the paper's base case.
constexpr double kStepOverElements = 1.5;

struct Limit {
  double step;
  std::string where;
};

Limit worst_element(const DeformableBody& d) {
  const Solid::StepBound bound = d.solid.element_step_bound();
  const SweptBody& body = d.solid.body();
  const Block& block = body.blocks[bound.block];
  const auto& q = block.section.quads[bound.quad];
  const Vec3 x = swept_point(body.kind, body.origin, 0.25 * (block.section.nodes[q[0]] + block.section.nodes[q[1]] + block.section.nodes[q[2]] + block.section.nodes[q[3]]),
                             block.stations.at[bound.station]);
  return {bound.step, fmt::format("{} {}, quadrilateral {} at x = {:.1f} mm, y = {:.1f} mm, z = {:.1f} mm ({})", body.name, block.name, bound.quad, 1e3 * x.x, 1e3 * x.y, 1e3 * x.z,
                                  body.materials[block.section.quad_material[bound.quad]])};
}

}  // namespace

RunEstimate estimate_run(const RollingSystem& sys) {
  RunEstimate e;
  e.elements = sys.model.rail.elements() + sys.model.wheel.elements();
  e.nodes = sys.model.rail.nodes() + sys.model.wheel.nodes();
  const Limit rail = worst_element(sys.rail), wheel = worst_element(sys.wheel);
  e.element_bound = std::min(rail.step, wheel.step);
  e.limiting_element = rail.step < wheel.step ? rail.where : wheel.where;
  e.stable_step = std::min(lanczos_stable_step(sys.rail), lanczos_stable_step(sys.wheel));
  e.memory_bytes = kBytesPerElement * static_cast<double>(e.elements);
  const double dt = sys.model.spec.run.step_safety * e.stable_step;
  if (sys.model.spec.run.rolling) e.steps = std::lround(std::ceil(sys.model.x_end / (sys.model.spec.drive.speed * dt)));
  Field u = sys.wheel.solid.layout().field(), f = u;
  sys.wheel.solid.internal_force(u, 0, f);
  const auto start = std::chrono::steady_clock::now();
  constexpr int repeats = 5;
  for (int i = 0; i < repeats; ++i) sys.wheel.solid.internal_force(u, 0, f);
  const double each = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() / repeats;
  e.element_steps_per_s = static_cast<double>(sys.model.wheel.elements()) / each;
  e.seconds = kStepOverElements * static_cast<double>(e.elements) * static_cast<double>(e.steps) / e.element_steps_per_s;
  return e;
}

}  // namespace railstrata
