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

// The step that thin or stiff elements are to allow, in units of a matrix element's.
double wanted_step(const Body& body, const CaseSpec& spec, double units) {
  const Elastic& matrix = body.materials.front();
  return units * spec.mesh.element_size / std::sqrt(matrix.p_wave_modulus() / matrix.density);
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

// A penalty spring k a_A between a rail node and a wheel node of like mass.
double penalty_step(const RollingSystem& sys, const MassScaling& rail) {
  const ContactSurface& r = sys.rail_surface();
  const int c = r.columns / 2, j = r.stations.nodes() / 2;
  const double area = r.radius * r.width[c] * (r.stations.at[j + 1] - r.stations.at[j]);
  return 2 / std::sqrt(2 * sys.options.contact.penalty_stiffness * area * sys.rail().inverse_mass[r.index(c, j)] *
                       rail.share(r.index(c, j)));
}

}  // namespace

struct StepPlan::Part {
  const Body& body;
  const ContactSurface& surface;
  BodySteps& steps;
  double own;  // stable step of the real masses, s
};

StepPlan::StepPlan(const RollingSystem& sys) {
  const CaseSpec& spec = sys.model.spec;
  find_element_bound(sys, limits);
  std::vector<Part> parts;
  for (std::size_t k = 0; k < sys.bodies.size(); ++k)
    parts.push_back({sys.bodies[k], sys.surfaces[k], bodies[k], lanczos_stable_step(sys.bodies[k])});
  limits.unscaled = limits.lanczos = std::min(parts[0].own, parts[1].own);
  if (spec.run.time_step_method == TimeStepMethod::local)
    refine_steps(parts, spec);
  else if (spec.run.time_step_method != TimeStepMethod::uniform && sys.rail().mesh.interfaces.empty())
    scale_masses(parts, spec);
  double least = limits.lanczos;
  if (spec.contact.method == ContactMethod::penalty) {
    limits.contact = penalty_step(sys, bodies[kRail].scaling);
    least = 1 / std::sqrt(1 / (least * least) + 1 / (limits.contact * limits.contact));
  }
  limits.chosen = rounded_down(spec.run.step_safety * least);
  if (limits.fine_elements > 0) settle_stages(parts);
}

void StepPlan::scale_masses(const std::vector<Part>& parts, const CaseSpec& spec) {
  limits.lanczos = HUGE_VAL;
  for (const auto& [body, surface, steps, own] : parts) {
    MassScaling& scaling = steps.scaling;
    scaling = {body, wanted_step(body, spec, spec.run.mass_scaling_step)};
    double step = scaling.empty() ? own : lanczos_stable_step(body, scaling);
    if (spec.run.time_step_method == TimeStepMethod::automatic && step < kWorthwhile * own) {
      scaling = {};
      step = own;
    }
    limits.added_mass += scaling.report().added_mass;
    limits.scaled_mass += scaling.report().scaled_mass;
    note_scaled_blocks(body, scaling, limits);
    if (!scaling.empty()) limits.scaled_where += (limits.scaled_where.empty() ? "" : ", ") + scaling.report().where;
    limits.lanczos = std::min(limits.lanczos, step);
  }
}

void StepPlan::refine_steps(const std::vector<Part>& parts, const CaseSpec& spec) {
  limits.lanczos = HUGE_VAL;
  for (const auto& [body, surface, steps, own] : parts) {
    steps.local = {body, element_options(spec), wanted_step(body, spec, 1)};
    limits.lanczos = std::min(limits.lanczos, steps.local.empty() ? own : lanczos_coarse_step(body, steps.local));
    limits.fine_elements += steps.local.fine_elements();
  }
}

// Fine and coarse nodes together may stand a little less than the coarse ones alone.
void StepPlan::settle_stages(const std::vector<Part>& parts) {
  constexpr double kEdge = 3.8, kShorter = 0.95;
  for (const auto& [body, surface, steps, own] : parts)
    for (; !steps.local.empty(); limits.chosen *= kShorter) {
      steps.local.set_step(limits.chosen, own);
      const StepSpectrum s = lanczos_spectrum(body, steps.local);
      if (s.least > 0 && s.largest < kEdge) break;
    }
  for (const auto& [body, surface, steps, own] : parts) {
    if (steps.local.empty()) continue;
    steps.local.set_step(limits.chosen, own);
    limits.stages = std::max(limits.stages, steps.local.stages());
    steps.response = surface_response(body, surface, steps.local);
  }
}

}  // namespace railstrata
