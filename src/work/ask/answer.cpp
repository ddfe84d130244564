#include "ask/answer.hpp"

#include <algorithm>
#include <utility>

#include "ask/half_space_need.hpp"
#include "ask/judge.hpp"
#include "ask/profile_errors.hpp"
#include "ask/solve_settings.hpp"
#include "core/stop_request.hpp"
#include "judge/bem_summary.hpp"

namespace railstrata {
namespace {

/// The last state of a transient is judged as what it is in steady rolling: its load and its forces are those wanted.
void summarise(const CaseSpec& spec, const TransientState& last, Answer& out) {
  Summary& s = out.summary;
  s = bem_contact_summary(case_of_moment(spec, last.moment), out.result);
  judge_coarsest_state(out.coarsest, s);
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

void follow(const CaseSpec& spec, const Placement& placement, const AskOptions& how, Answer& out) {
  TransientState last = solve_transient(spec, placement, how.bem, [&](const TransientState& state) {
    out.history.push_back(transient_row(state));
    out.coarsest = std::max(out.coarsest, cell_of_patch(state.result));
    if (how.observer) how.observer(state);
    out.stopped = asked_to_stop(how.control);
    return !out.stopped;
  });
  out.moment = last.moment;
  out.stopped = out.stopped && last.step < last.steps;
  out.result = std::move(last.result);
  summarise(case_at_contact(spec, placement), last, out);
}

}  // namespace

CaseSpec half_space_case(CaseSpec spec) {
  if (spec.run.rolling) return spec;
  spec.drive.creepage = spec.drive.lateral_creepage = spec.drive.lateral_traction_coefficient = std::nullopt;
  spec.drive.traction_coefficient = spec.drive.friction_coefficient = 0;
  return spec;
}

void require_solvable(const CaseSpec& spec, const Placement& placement, const BemOptions& bem) {
  require_cell(bem.cell);
  require_film_carries(spec, placement, bem);
  require_memory(half_space_need(spec, placement, bem.cell), bem.cell);
}

Answer solve_contact(const CaseSpec& spec, const Placement& placement, const AskOptions& how) {
  const CaseSpec solved = half_space_case(spec);
  const ThreadsOfCaller threads(how.threads);
  require_solvable(solved, placement, how.bem);
  Answer out;
  if (solved.transient.kind != TransientKind::none) {
    follow(solved, placement, how, out);
    return out;
  }
  std::optional<StopRequest> stop;
  if (how.control) stop.emplace(&how.control->stop);
  out.result = solve_bem(solved, placement, how.bem);
  out.summary = bem_contact_summary(case_at_contact(solved, placement), out.result);
  return out;
}

Answer ask(const CaseSpec& spec, const Placement& placement, const Wanted& wanted, const AskOptions& how) {
  const ThreadsOfCaller threads(how.threads);
  Answer out = solve_contact(spec, placement, how);
  if (wanted.other_fits && spec.transient.kind == TransientKind::none)
    add_profile_errors(half_space_case(spec), placement, how, out.result.notes, out.summary.contact);
  judge(case_at_contact(spec, placement), wanted, out, how);
  sign(out.summary);
  return out;
}

}  // namespace railstrata
