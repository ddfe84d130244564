#include "fem/step_plan.hpp"

#include <fmt/format.h>

#include <cmath>

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

double wanted_step(const DeformableBody& body, const CaseSpec& spec) {
  const Elastic& matrix = body.solid.materials().front();
  return spec.run.mass_scaling_step * spec.mesh.element_size / std::sqrt(matrix.p_wave_modulus() / matrix.density);
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
  limits.lanczos = limits.unscaled = HUGE_VAL;
  for (const auto& [body, scaling] : {std::pair{&sys.rail, &rail}, std::pair{&sys.wheel, &wheel}}) {
    const double unscaled = lanczos_stable_step(*body);
    double step = unscaled;
    if (spec.run.time_step_method != "uniform") {
      *scaling = {*body, wanted_step(*body, spec)};
      if (!scaling->empty()) step = lanczos_stable_step(*body, *scaling);
      if (spec.run.time_step_method == "auto" && step < kWorthwhile * unscaled) *scaling = {}, step = unscaled;
    }
    limits.added_mass += scaling->report().added_mass;
    limits.scaled_mass += scaling->report().scaled_mass;
    if (!scaling->empty()) limits.scaled_where += (limits.scaled_where.empty() ? "" : ", ") + scaling->report().where;
    limits.unscaled = std::min(limits.unscaled, unscaled);
    limits.lanczos = std::min(limits.lanczos, step);
  }
  double least = limits.lanczos;
  if (spec.contact.method == "penalty") {
    limits.contact = penalty_step(sys, rail);
    least = 1 / std::sqrt(1 / (least * least) + 1 / (limits.contact * limits.contact));
  }
  limits.chosen = spec.run.step_safety * least;
}

}  // namespace railstrata
