#include "ask/load_life.hpp"

#include "ask/life_passes.hpp"
#include "core/faults.hpp"
#include "damage/wear_indices.hpp"
#include "fatigue/traffic_damage.hpp"
#include "record/unit.hpp"
#include "spec/case_spec.hpp"

namespace railstrata {
namespace {

PatchDamage patch_damage(const CaseSpec& spec, const BemPatch& patch, const ContactSummary& contact) {
  return {patch.place, streamlines(spec, patch.field), rcf_damage(rcf_damage_15(), t_gamma(contact).without_spin)};
}

}  // namespace

std::vector<PatchDamage> patch_damages(const CaseSpec& spec, const HalfSpaceSolution& solution) {
  const Summary& s = solution.summary;
  std::vector<PatchDamage> out{
      patch_damage(spec, solution.result, s.patches.empty() ? s.contact : s.patches.front().contact)};
  for (std::size_t k = 0; k < solution.result.further.size(); ++k)
    out.push_back(patch_damage(spec, solution.result.further[k], s.patches.at(k + 1).contact));
  return out;
}

Lives life_of_load(const CaseSpec& spec, const Placement& placement, const HalfSpaceSolution& solution,
                   const BemOptions& bem, const Control* control) {
  const std::vector<PatchDamage> patches = patch_damages(spec, solution);
  const std::vector<WheelKind> kinds{{1, patches}};
  const PassedSections passed = passed_sections(spec, placement, solution.result, bem, control);
  return zone_lives(spec, {{1, solution.summary.contact.F_z, &patches, &solution.shakedown, &passed}},
                    rail_damage(spec, kinds, placement, bem.cell), wheel_damage(spec, kinds, placement, bem.cell));
}

LifeSummary life_summary(const CaseSpec& spec, const Placement& placement, const HalfSpaceSolution& solution,
                         const BemOptions& bem, const Control* control) {
  LifeSummary out;
  try {
    const Lives lives = life_of_load(spec, placement, solution, bem, control);
    out.text = life_text(lives.rows);
    if (const LifeRow* row = shortest(lives.rows)) {
      constexpr double kOfKilogram = unit::kMGT.factor;
      out.best = row->mgt.best / kOfKilogram;
      out.low = row->mgt.low / kOfKilogram;
      out.high = row->mgt.high / kOfKilogram;
    }
  } catch (const CaseError& e) {
    out.text = std::string("not known: ") + e.what();
  } catch (const NumericalError& e) {
    out.text = std::string("not known: ") + e.what();
  }
  return out;
}

}  // namespace railstrata
