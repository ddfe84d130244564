#include "ask/solve_half_space.hpp"

#include <algorithm>
#include <utility>

#include "ask/load_life.hpp"
#include "core/parallel.hpp"
#include "core/process_memory.hpp"
#include "fatigue/half_space_track.hpp"
#include "io/provenance.hpp"
#include "judge/bem_summary.hpp"

namespace railstrata {
namespace {

/// The last state of a transient is judged as what it is in steady rolling: its load and its forces are those wanted.
void summarise(const CaseSpec& spec, const TransientState& last, HalfSpaceSolution& out) {
  Summary& s = out.summary;
  s = bem_contact_summary(case_of_moment(spec, last.moment), out.result);
  judge_coarsest_state(out.coarsest, s);
  s.warnings = bem_warnings(s, spec, out.result, out.coarsest);
  s.state = state_text(spec, last);
  s.position = last.distance;
  s.run.steps = last.step;
  ContactSummary& c = s.contact;
  c.error = {};  // the laws are those of steady rolling
  c.friction_work = last.friction_work;
  if (spec.transient.kind != TransientKind::shift) return;
  c.creepage_x = c.creepage_y = c.spin_per_m = kNotApplicable;
  c.displacement_x = last.displacement_x;
  c.displacement_y = last.displacement_y;
}

void follow(const CaseSpec& spec, const Placement& placement, const BemOptions& options,
            const TransientObserver& observer, HalfSpaceSolution& out) {
  TransientState last = solve_transient(spec, placement, options, [&](const TransientState& state) {
    out.history.push_back(transient_row(state));
    out.coarsest = std::max(out.coarsest, cell_of_patch(state.result));
    out.stopped = observer && !observer(state);
    return !out.stopped;
  });
  out.moment = last.moment;
  out.stopped = out.stopped && last.step < last.steps;
  out.result = std::move(last.result);
  summarise(spec, last, out);
}

void add_streamlines(const CaseSpec& spec, HalfSpaceSolution& out) {
  out.streamlines = streamlines(spec, out.result.field);
  for (const BemPatch& p : out.result.further)
    for (const StreamlineRow& row : streamlines(spec, p.field)) out.streamlines.push_back(row);
  out.summary.damage = damage_summary(spec, out.summary, out.streamlines);
}

}  // namespace

CaseSpec half_space_case(CaseSpec spec) {
  if (spec.run.rolling) return spec;
  spec.drive.creepage = spec.drive.lateral_creepage = spec.drive.lateral_traction_coefficient = std::nullopt;
  spec.drive.traction_coefficient = spec.drive.friction_coefficient = 0;
  return spec;
}

HalfSpaceSolution solve_half_space_contact(const CaseSpec& spec, const Placement& placement, const BemOptions& options,
                                           const TransientObserver& observer) {
  const CaseSpec solved = half_space_case(spec);
  HalfSpaceSolution out;
  if (solved.transient.kind == TransientKind::none) {
    out.result = solve_bem(solved, placement, options);
    out.summary = bem_contact_summary(solved, out.result);
  } else {
    follow(solved, placement, options, observer, out);
  }
  add_streamlines(solved, out);
  return out;
}

void complete_shakedown(const CaseSpec& spec, HalfSpaceSolution& solution, bool with_maps) {
  if (solution.shakedown.empty()) return;
  add_single_track(spec, solution.result, solution.shakedown);
  solution.summary.shakedown = shakedown_summary(spec, solution.shakedown);
  if (with_maps) solution.sliding = sliding_maps(solution.result, solution.shakedown);
}

HalfSpaceSolution solve_half_space(const CaseSpec& spec, const Placement& placement, const BemOptions& options,
                                   const TransientObserver& observer) {
  HalfSpaceSolution out = solve_half_space_contact(spec, placement, options, observer);
  if (out.stopped) return out;
  Summary& s = out.summary;
  s.rail = bem_rail_stress(out.result, s.contact);
  s.wheel = bem_wheel_stress(out.result, s.contact);
  s.warnings = bem_warnings(s, spec, out.result, out.coarsest);
  out.shakedown = half_space_shakedown(spec, out.result);
  s.shakedown = shakedown_summary(spec, out.shakedown);
  for (const SectionShakedown& section : out.shakedown) s.fatigue.push_back(section.fatigue);
  if (spec.life.passes > 0) s.life = life_summary(spec, placement, out, options);
  s.run.commit = commit_text();
  s.run.threads = max_threads();
  s.run.peak_memory_bytes = peak_memory();
  return out;
}

}  // namespace railstrata
