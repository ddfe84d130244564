#include "fem/step_plan.hpp"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "fem/stable_step.hpp"

namespace railstrata {
namespace {

void find_element_bound(const RollingSystem& sys, StepLimits& limits) {
  const auto rail = sys.rail.solid.element_step_bound(), wheel = sys.wheel.solid.element_step_bound();
  const auto& least = rail.step < wheel.step ? rail : wheel;
  const SweptBody& body = rail.step < wheel.step ? sys.model.rail : sys.model.wheel;
  limits.element = least.step;
  limits.where = fmt::format("{} {}", body.name, body.blocks[least.block].name);
}

// The step that thin or stiff elements are to allow, in units of a matrix element's.
double wanted_step(const DeformableBody& body, const CaseSpec& spec, double units) {
  const Elastic& matrix = body.solid.materials().front();
  return units * spec.mesh.element_size / std::sqrt(matrix.p_wave_modulus() / matrix.density);
}

// To six digits: an estimate by Lanczos steps tells compilers apart in the ninth, and with another step samples are taken elsewhere.
double rounded_down(double step) {
  const double unit = std::pow(10.0, std::floor(std::log10(step)) - 5);
  return unit * std::floor(step / unit);
}

// A penalty spring k a_A between a rail node and a wheel node of like mass.
double penalty_step(const RollingSystem& sys, const MassScaling& rail) {
  const ContactSurface& r = sys.rail_surface;
  const int c = r.columns / 2, j = r.stations.nodes() / 2;
  const double area = r.width[c] * (r.stations.at[j + 1] - r.stations.at[j]);
  return 2 / std::sqrt(2 * sys.penalty_stiffness * area * sys.rail.inverse_mass[r.index(c, j)] * rail.share(r.index(c, j)));
}

}  // namespace

StepPlan::StepPlan(const RollingSystem& sys) {
  const CaseSpec& spec = sys.model.spec;
  find_element_bound(sys, limits);
  limits.unscaled = limits.lanczos = std::min(lanczos_stable_step(sys.rail), lanczos_stable_step(sys.wheel));
  if (spec.run.time_step_method == "local") refine_steps(sys);
  else if (spec.run.time_step_method != "uniform") scale_masses(sys, spec.run.time_step_method == "auto");
  double least = limits.lanczos;
  if (spec.contact.method == "penalty") {
    limits.contact = penalty_step(sys, rail);
    least = 1 / std::sqrt(1 / (least * least) + 1 / (limits.contact * limits.contact));
  }
  limits.chosen = rounded_down(spec.run.step_safety * least);
  if (limits.fine_elements > 0) settle_stages(sys);
}

void StepPlan::scale_masses(const RollingSystem& sys, bool if_worthwhile) {
  limits.lanczos = HUGE_VAL;
  for (const auto& [body, scaling] : {std::pair{&sys.rail, &rail}, std::pair{&sys.wheel, &wheel}}) {
    const double unscaled = lanczos_stable_step(*body);
    double step = unscaled;
    *scaling = {*body, wanted_step(*body, sys.model.spec, sys.model.spec.run.mass_scaling_step)};
    if (!scaling->empty()) step = lanczos_stable_step(*body, *scaling);
    if (if_worthwhile && step < kWorthwhile * unscaled) *scaling = {}, step = unscaled;
    limits.added_mass += scaling->report().added_mass;
    limits.scaled_mass += scaling->report().scaled_mass;
    if (!scaling->empty()) limits.scaled_where += (limits.scaled_where.empty() ? "" : ", ") + scaling->report().where;
    limits.lanczos = std::min(limits.lanczos, step);
  }
}

void StepPlan::refine_steps(const RollingSystem& sys) {
  limits.lanczos = HUGE_VAL;
  for (const auto& [body, steps] : {std::pair{&sys.rail, &rail_steps}, std::pair{&sys.wheel, &wheel_steps}}) {
    *steps = {*body, solid_options(sys.model.spec), wanted_step(*body, sys.model.spec, 1)};
    limits.lanczos = std::min(limits.lanczos, steps->empty() ? lanczos_stable_step(*body) : lanczos_coarse_step(*body, *steps));
    limits.fine_elements += steps->fine_elements();
  }
}

// Fine and coarse nodes together may stand a little less than the coarse ones alone.
void StepPlan::settle_stages(const RollingSystem& sys) {
  constexpr double kEdge = 3.8, kShorter = 0.95;
  struct Part {
    const DeformableBody& body;
    LocalSteps& steps;
    const ContactSurface& surface;
    SurfaceResponse& response;
    double own;  // stable step, s
  };
  std::vector<Part> parts;
  if (!rail_steps.empty()) parts.push_back({sys.rail, rail_steps, sys.rail_surface, rail_response, lanczos_stable_step(sys.rail)});
  if (!wheel_steps.empty()) parts.push_back({sys.wheel, wheel_steps, sys.wheel_surface, wheel_response, lanczos_stable_step(sys.wheel)});
  for (const Part& p : parts)
    for (;; limits.chosen *= kShorter) {
      p.steps.set_step(limits.chosen, p.own);
      const StepSpectrum s = lanczos_spectrum(p.body, p.steps);
      if (s.least > 0 && s.largest < kEdge) break;
    }
  for (const Part& p : parts) {
    p.steps.set_step(limits.chosen, p.own);
    limits.stages = std::max(limits.stages, p.steps.stages());
    p.response = surface_response(p.body, p.surface, p.steps);
  }
}

}  // namespace railstrata
