#include "ask/judge.hpp"

#include <algorithm>

#include "core/faults.hpp"
#include "core/parallel.hpp"
#include "core/stop_request.hpp"
#include "damage/wear_indices.hpp"
#include "fatigue/shakedown_summary.hpp"
#include "fatigue/wheel_damage.hpp"
#include "io/provenance.hpp"
#include "judge/bem_summary.hpp"
#include "record/this_process.hpp"
#include "record/unit.hpp"
#include "spec/case_spec.hpp"

namespace railstrata {
namespace {

void add_wear(const CaseSpec& spec, Answer& out) {
  Summary& s = out.summary;
  const std::vector<const BemPatch*> patches = patches_of(out.result);
  for (std::size_t k = 0; k < patches.size(); ++k) {
    const ContactSummary& contact = s.patches.empty() ? s.contact : s.patches.at(k).contact;
    out.wear.push_back({patches[k]->place, streamlines(spec, patches[k]->field),
                        rcf_damage(rcf_damage_15(), t_gamma(contact).without_spin)});
  }
  s.damage = damage_summary(spec, s, streamlines_of(out.wear));
}

/// A stress that still rises at the rim of what was searched leaves open whether it lasts.
void add_stresses(const Wanted& wanted, Answer& out) {
  Summary& s = out.summary;
  const auto judged = [&](BodyId body) {
    return std::any_of(out.shakedown.begin(), out.shakedown.end(),
                       [&](const SectionShakedown& section) { return section.body == body && section.strength.any(); });
  };
  const auto add = [&](BodyId body, bool asked, StressSummary& stress) {
    if (!stress.subsurface && (asked || judged(body))) stress = bem_stress(out.result, body, s.contact);
  };
  add(BodyId::rail, wanted.rail, s.rail);
  add(BodyId::wheel, wanted.wheel, s.wheel);
}

}  // namespace

void judge(const CaseSpec& given, const Wanted& wanted, Answer& out, const AskOptions& how) {
  const CaseSpec spec = half_space_case(given);
  std::optional<StopRequest> stop;
  if (how.control) stop.emplace(&how.control->stop);
  Summary& s = out.summary;
  if (out.wear.empty()) add_wear(spec, out);
  if (!out.stopped) {
    if (wanted.shakedown && out.shakedown.empty())
      out.shakedown = half_space_shakedown(spec, out.result, wanted.planes);
    add_stresses(wanted, out);
    if (wanted.single_track) add_single_track(spec, out.result, out.shakedown);
    if (wanted.maps) out.sliding = sliding_maps(out.result, out.shakedown);
    judge_sections(spec, out.shakedown, s);
    if (wanted.crack && spec.life.crack.there() && !out.crack) {
      out.crack = half_space_crack(spec, out.result);
      s.crack = crack_summary(spec.life.crack, *out.crack, s.contact.F_z);
      out.result.notes.insert(out.result.notes.end(), out.crack->notes.begin(), out.crack->notes.end());
    }
    const bool alone = spec.loads.empty();  // else a collective is asked
    if (wanted.life && alone && how.life_of && spec.life.until > 0 && spec.run.rolling)
      s.life = how.life_of(spec, how.bem);
  }
  s.warnings = bem_warnings(s, spec, out.result, out.coarsest);
}

void judge_sections(const CaseSpec& spec, const std::vector<SectionShakedown>& sections, Summary& summary) {
  summary.shakedown = shakedown_summary(spec, sections);
  summary.fatigue.clear();
  for (const SectionShakedown& section : sections) summary.fatigue.push_back(section.fatigue);
}

void sign(Summary& summary) {
  summary.run.commit = commit_text();
  summary.run.threads = max_threads();
  summary.run.peak_memory_bytes = peak_memory();
}

std::vector<StreamlineRow> streamlines_of(const std::vector<PatchDamage>& patches) {
  std::vector<StreamlineRow> out;
  for (const PatchDamage& patch : patches) out.insert(out.end(), patch.rows.begin(), patch.rows.end());
  return out;
}

}  // namespace railstrata
