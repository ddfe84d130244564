#include "fem/step_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "body/stable_step.hpp"

namespace railstrata {
namespace {

void find_element_bound(const RollingSystem& sys, StepLimits& limits) {
  limits.element = HUGE_VAL;
  for (const Body& body : sys.bodies) {
    const StepBound bound = element_step_bound(body);
    if (bound.step >= limits.element) continue;
    limits.element = bound.step;
    limits.where = fmt::format("{} {}", body.mesh.name, body.mesh.blocks[bound.block].name);
  }
}

// The step that thin or stiff elements are to allow.
double wanted_step(const Body& body, const CaseSpec& spec) {
  const Elastic& matrix = body.materials.front();
  return spec.run.mass_scaling_step * spec.mesh.element_size / std::sqrt(matrix.p_wave_modulus() / matrix.density);
}

// To six digits: an estimate by Lanczos steps differs between compilers in the ninth, and with another step samples are
// taken elsewhere.
double rounded_down(double step) {
  const double unit = std::pow(10.0, std::floor(std::log10(step)) - 5);
  return unit * std::floor(step / unit);
}

double block_mass(const Body& body, int block) {
  const BlockLayout& lay = body.layout.blocks[block];
  double sum = 0;
  for (int n = 0; n < lay.nodes; ++n)
    for (int j = 0; j < lay.stations; ++j) sum += body.element_mass[lay.line(n, 0) + j];
  return sum;
}

void note_scaled_blocks(const Body& body, const MassScaling& scaling, StepLimits& limits) {
  for (const auto& [block, added] : scaling.report().added_in_block)
    limits.scaled_blocks.push_back(
        {fmt::format("{} {}", body.mesh.name, body.mesh.blocks[block].name), block_mass(body, block), added});
}

}  // namespace

StepPlan::StepPlan(const RollingSystem& sys) {
  const CaseSpec& spec = sys.model.spec;
  find_element_bound(sys, limits);
  limits.unscaled = limits.lanczos = HUGE_VAL;
  for (std::size_t k = 0; k < scaling.size(); ++k) {
    const Body& body = sys.bodies[k];
    const double own = lanczos_stable_step(body);
    double step = own;
    if (spec.run.mass_scaling_step > 0 && sys.rail().mesh.interfaces.empty()) {
      MassScaling& added = scaling[k];
      added = {body, wanted_step(body, spec)};
      if (!added.empty()) step = lanczos_stable_step(body, added);
      if (step < kWorthwhile * own) {
        added = {};
        step = own;
      }
      limits.added_mass += added.report().added_mass;
      limits.scaled_mass += added.report().scaled_mass;
      note_scaled_blocks(body, added, limits);
    }
    limits.unscaled = std::min(limits.unscaled, own);
    limits.lanczos = std::min(limits.lanczos, step);
  }
  limits.chosen = rounded_down(spec.run.step_safety * limits.lanczos);
}

}  // namespace railstrata
