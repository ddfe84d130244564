#include "judge/fem_summary.hpp"

#include <algorithm>
#include <cmath>

#include "judge/check_limits.hpp"
#include "judge/plausibility.hpp"
#include "model/rolling_start.hpp"
#include "model/section_axes.hpp"
#include "model/zone.hpp"
#include "passage/passage.hpp"
#include "result/stress_maxima.hpp"

namespace railstrata {
namespace {

Check fem_check(std::string_view name, double value) { return at_most(name, value, check_row(name).fem_limit); }

/// N m, on the wheel about the contact plane's normal at the reference.
double spin_moment(const RigidContact& contact, const ContactField& f) {
  double sum = 0;
  for (int i = 0; i < f.size(); ++i) {
    const double across =
        (f.y[i] - contact.point.y) * std::cos(contact.angle) + (f.z[i] - contact.point.z) * std::sin(contact.angle);
    sum += f.area[i] * (across * f.q_x[i] - (f.x[i] - contact.x) * f.q_y[i]);
  }
  return sum;
}

ContactSummary contact_summary(const RollingSystem& sys, const RunResult& run, const MeanContact& m) {
  ContactSummary c;
  c.patch = m.patch;
  c.F_x = m.F_x;
  c.F_y = m.F_y;
  c.F_z = m.F_z;
  turn_into_contact_plane(c, sys.model.reference.angle);
  c.lateral_force = m.patch.force_y;
  c.approach = run.preload.foot_z - run.preload.axle_z;
  c.penetration_max = run.penetration;
  if (!sys.model.spec.run.rolling) return c;
  c.creepage_x = m.creepage;
  c.creepage_y = m.lateral_creepage;
  c.spin_per_m = m.spin_per_m;
  c.spin_moment = spin_moment(sys.model.reference, m.field);
  c.p_max_scatter = m.p_max_scatter;
  return c;
}

RunSummary run_summary(const RunResult& run) {
  RunSummary r;
  r.engine = Engine::fem;
  r.wall_s = run.wall_seconds;
  r.preload_wall_s = run.preload_wall_seconds;
  r.output_wall_s = run.output_wall_seconds;
  r.elements = run.elements;
  r.nodes = run.nodes;
  r.steps = run.steps;
  if (run.steps == 0) return r;
  r.dt_s = run.dt;
  r.stable_step = run.limits.lanczos;
  r.unscaled_step = run.limits.unscaled;
  r.added_mass = run.limits.added_mass;
  r.element_steps_per_s = static_cast<double>(run.elements) * static_cast<double>(run.steps) /
                          (run.wall_seconds - run.preload_wall_seconds);
  return r;
}

/// N, what the torque drives with: of a yawed wheel not quite F_x.
double along_wheel(const Model& model, const MeanContact& m) {
  const double yaw = model.placement.contact.yaw;
  return m.F_x * std::cos(yaw) + m.F_y * std::sin(yaw);
}

PatchSurroundings surroundings(const Model& model, const MeanContact& m) {
  const Placement& p = model.placement;
  const Vec2 tangent{std::cos(p.contact.angle), std::sin(p.contact.angle)};
  const double half = 0.5 * model.spec.mesh.fine_width.value();
  SolvedPatch patch{half, -half, -half, half, model.load / tangent.y, model.hertz.approach};
  for (int i = 0; i < m.field.size(); ++i) {
    if (!(m.field.p[i] > m.field.p_noise)) continue;
    const double t = dot(Vec2{m.field.y[i], m.field.z[i]} - p.contact.point, tangent);
    patch.low = std::min(patch.low, t);
    patch.high = std::max(patch.high, t);
  }
  // pressures reach beyond the outermost nodes that bear: up to the width of the patch
  const double beyond = std::max(0.0, 0.5 * (m.patch.width - (patch.high - patch.low)));
  patch.low -= beyond;
  patch.high += beyond;
  PatchSurroundings out = patch_surroundings(model.spec, p, patch);
  out.second = second_contact(model.spec, p, patch);
  return out;
}

/// Of the element with the largest accumulated plastic strain; depth below the surface along its normal in the fine
/// zone, deeper below the rigid contact point.
void add_place(const RollingSystem& sys, BodyId id, const PlasticPeak& peak, PlasticSummary& out) {
  const Model& model = sys.model;
  const SweptBody& body = sys.body(id).mesh;
  const Block& block = body.blocks[peak.block];
  const Section& section = block.section;
  const Vec2 centre = centre_of(section, peak.quad);
  const bool rail = id == BodyId::rail;
  const SectionAxes axes(model, id);
  out.y = centre.y - axes.point.y;
  out.depth = axes.depth(centre);
  if (const ContactBand& band = body.contact; band.block == peak.block) {
    const int row = peak.quad / band.columns;
    out.depth = 0.5 * (band.depth[row] + band.depth[row + 1]);
  }
  if (rail) out.x = 0.5 * (block.stations.at[peak.station] + block.stations.at[peak.station + 1]);
  out.body = body_word(id);
  out.zone = zone_name(model.spec, id, body.layer_of(block.material(peak.quad, peak.station)));
}

PlasticSummary plastic_summary(const RollingSystem& system, const RunResult& run) {
  PlasticSummary out;
  out.strain = run.plastic.strain;
  out.accumulated = run.plastic.accumulated;
  out.elements = static_cast<double>(run.plastic.yielded);
  out.work = run.remains.work;
  out.dissipated = run.remains.work - run.remains.backstress;
  if (run.remains.peak.accumulated > 0) add_place(system, run.remains.body, run.remains.peak, out);
  return out;
}

}  // namespace

std::vector<Check> finite_element_checks(const Model& model, const RunResult& run, const MeanContact& m) {
  const CaseSpec& spec = model.spec;
  std::vector<Check> out;
  out.push_back(at_most("preload_residual", run.preload.residual, spec.run.preload_tolerance));
  // over sleepers, and where rail or wheel change along the way, masses move and no moment is like another
  const bool steady = !changes_on_way(spec);
  if (steady) out.push_back(fem_check("F_z_relative_to_weight", std::abs(m.F_z / model.load - 1)));
  if (const double wanted = spec.drive.traction().value_or(0); spec.run.rolling && steady && wanted != 0)
    out.push_back(fem_check("traction_coefficient_reached", std::abs(along_wheel(model, m) / m.F_z / wanted - 1)));
  if (const double wanted = spec.drive.lateral_traction_coefficient.value_or(0);
      spec.run.rolling && steady && wanted != 0)
    out.push_back(fem_check("lateral_traction_reached", std::abs(m.patch.force_y / model.load / wanted - 1)));
  out.push_back(fem_check("penetration_over_approach", run.penetration / model.hertz.approach));
  if (spec.run.rolling) {
    out.push_back(fem_check("energy_closure", run.closure));
    if (steady) out.push_back(fem_check("p_max_scatter", m.p_max_scatter));
  }
  if (spec.mesh.element == ElementFormulation::one_point)
    out.push_back(fem_check("hourglass_share", run.hourglass_share));
  if (spec.run.plasticity) out.push_back(fem_check("plastic_strain", run.plastic.strain));
  out.push_back(fem_check("patch_reaches_edge_of_fine_zone", run.reached_edge ? 1 : 0));
  return out;
}

Summary fem_summary(const RollingSystem& sys, const RunResult& run, const MeanContact& m) {
  Summary s;
  const CaseSpec& spec = sys.model.spec;
  s.title = spec.title;
  s.position = m.position;
  s.contact = contact_summary(sys, run, m);
  s.rail = band_stress_summary(sys, BodyId::rail, m);
  s.wheel = band_stress_summary(sys, BodyId::wheel, m);
  s.energy = {.closure = spec.run.rolling ? run.closure : kNotApplicable, .hourglass_share = run.hourglass_share};
  if (spec.run.plasticity) s.plastic = plastic_summary(sys, run);
  s.passage = passage_summary(sys, run);
  s.run = run_summary(run);
  s.checks = finite_element_checks(sys.model, run, m);
  s.warnings = implausible(s, spec, surroundings(sys.model, m), spec.mesh.element_size);
  add_run_advice(s, spec, run.limits);
  return s;
}

}  // namespace railstrata
