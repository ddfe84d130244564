#include "post/fem_summary.hpp"

#include <cmath>

#include "post/plausibility.hpp"
#include "post/run_advice.hpp"
#include "post/stress_maxima.hpp"

namespace railstrata {
namespace {

Check at_most(std::string name, double value, double limit) { return {std::move(name), value <= limit, value, limit}; }

std::vector<Check> checks(const RollingSystem& sys, const RunResult& run, const MeanContact& m) {
  const CaseSpec& spec = sys.model.spec;
  std::vector<Check> out;
  out.push_back(at_most("preload_residual", run.preload.residual, spec.run.preload_tolerance));
  out.push_back(at_most("F_z_relative_to_weight", std::abs(m.F_z / sys.model.load - 1), 5e-3));
  if (spec.run.rolling && spec.drive.traction_coefficient > 0)
    out.push_back(
        at_most("traction_coefficient_reached", std::abs(m.F_x / m.F_z / spec.drive.traction_coefficient - 1), 1e-2));
  out.push_back(at_most("penetration_over_approach", run.penetration / sys.model.hertz.approach, 1e-2));
  if (spec.run.rolling) {
    out.push_back(at_most("energy_closure", run.closure, 1e-2));
    out.push_back(at_most("p_max_scatter", m.p_max_scatter, 1.5e-2));
  }
  if (spec.mesh.element == ElementFormulation::one_point)
    out.push_back(at_most("hourglass_share", run.hourglass_share, 2e-2));
  out.push_back(at_most("patch_reaches_edge_of_fine_zone", run.reached_edge ? 1 : 0, 0));
  return out;
}

}  // namespace

Summary fem_summary(const RollingSystem& sys, const RunResult& run, const MeanContact& m) {
  Summary s;
  const CaseSpec& spec = sys.model.spec;
  s.title = spec.title;
  s.position = m.position;
  s.contact = {m.patch.p_max,
               m.patch.q_max,
               m.patch.length,
               m.patch.width,
               m.patch.area,
               m.patch.slip_area_fraction,
               m.F_x,
               m.F_y,
               m.F_z,
               m.creepage,
               0.0,
               m.spin_per_m,
               -run.preload.axle_z,
               run.penetration,
               m.p_max_scatter};
  turn_into_contact_plane(s.contact, sys.model.placement.contact.angle);
  if (!spec.run.rolling)
    s.contact.creepage_x = s.contact.creepage_y = s.contact.spin_per_m = s.contact.p_max_scatter = kNotApplicable;
  s.rail = rail_stress_summary(sys, m);
  s.wheel = wheel_stress_summary(sys, m);
  s.energy = {spec.run.rolling ? run.closure : kNotApplicable, run.hourglass_share};
  s.run.engine = "fem";
  s.run.wall_s = run.wall_seconds;
  s.run.preload_wall_s = run.preload_wall_seconds;
  s.run.output_wall_s = run.output_wall_seconds;
  s.run.elements = run.elements;
  s.run.nodes = run.nodes;
  s.run.steps = run.steps;
  if (run.steps > 0) {
    s.run.dt_s = run.dt;
    s.run.stable_step = run.limits.lanczos;
    s.run.unscaled_step = run.limits.unscaled;
    s.run.added_mass = run.limits.added_mass;
    s.run.local_stages = run.limits.stages;
    s.run.fine_elements = static_cast<double>(run.limits.fine_elements);
    s.run.element_steps_per_s = static_cast<double>(run.elements) * static_cast<double>(run.steps) /
                                (run.wall_seconds - run.preload_wall_seconds);
  }
  s.checks = checks(sys, run, m);
  s.warnings = implausible(s, spec);
  add_run_advice(s, spec, run.limits);
  return s;
}

}  // namespace railstrata
