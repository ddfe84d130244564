#include "post/shakedown_summary.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "post/patch.hpp"
#include "post/stress_cycles.hpp"

namespace railstrata {
namespace {

SectionShakedown section_shakedown(const CaseSpec& spec, BodyId body, const StressHistory& history) {
  SectionShakedown out;
  out.body = body;
  out.y = history.y;
  out.depth = history.depth;
  out.zone = history.zone;
  out.x_first = history.x.front();
  out.x_last = history.x.back();
  out.strength = row_strength(spec, body, history);
  out.found = shakedown({history, out.strength.shear, out.strength.residual_x, out.strength.residual_y});
  out.fatigue = section_fatigue(spec, body, history, out.strength);
  return out;
}

bool wanted(const CaseSpec& spec, BodyId body) { return strength_given(spec, body) || fatigue_given(spec, body); }

/// The same of every patch: the one that bears least.
SectionShakedown least_of_patches(const CaseSpec& spec, BodyId body, const BemResult& r) {
  std::vector<const BemPatch*> patches{&r};
  for (const BemPatch& p : r.further) patches.push_back(&p);
  std::optional<SectionShakedown> least;
  for (std::size_t k = 0; k < patches.size(); ++k) {
    const BemPatch* patch = patches[k];
    const PatchMeasures m = measure_patch(patch->field);
    const LayeredHalfSpace& half_space = body == BodyId::rail ? r.rail : r.wheel;
    const std::vector<CycleRow> rows = cycle_rows(half_space, 0.5 * (patch->grid.line ? m.length : shorter_axis(m)));
    SectionShakedown section = section_shakedown(
        spec, body, body == BodyId::rail ? rail_cycles(r, *patch, rows) : wheel_cycles(r, *patch, rows));
    section.patch = k;
    if (!least || section.found.wandering.value < least->found.wandering.value) least = std::move(section);
  }
  return std::move(*least);
}

ShakedownFactors factors_of(const LoadFactor& first_yield, const LoadFactor& wandering, const LoadFactor& upper,
                            const LoadFactor& kinematic) {
  ShakedownFactors f;
  f.first_yield = first_yield.value;
  f.wandering = wandering.value;
  f.upper = upper.value;
  f.kinematic = kinematic.value;
  return f;
}

BodyShakedown body_shakedown(const CaseSpec& spec, const SectionShakedown& section) {
  const Shakedown& s = section.found;
  BodyShakedown out;
  out.body = std::string(body_word(section.body));
  out.factors = factors_of(s.first_yield, s.wandering, s.upper, s.kinematic);
  out.factors.single_track = section.single_track;
  out.zone = zone_name(spec, section.body, s.wandering.zone);
  out.depth = s.wandering.depth;
  out.y = s.wandering.y;
  for (const ZoneFactors& z : s.zones)
    if (std::isfinite(z.wandering.value))
      out.zones.push_back({zone_name(spec, section.body, z.zone),
                           factors_of(z.first_yield, z.wandering, z.upper, z.kinematic), z.wandering.depth});
  out.notes = section.strength.notes;
  return out;
}

}  // namespace

std::vector<SectionShakedown> half_space_shakedown(const CaseSpec& spec, const BemResult& result) {
  std::vector<SectionShakedown> out;
  for (const BodyId body : {BodyId::rail, BodyId::wheel})
    if (wanted(spec, body)) out.push_back(least_of_patches(spec, body, result));
  return out;
}

std::vector<SectionShakedown> fem_shakedown(const RollingSystem& system, const MeanContact& contact,
                                            const BandStress& rail, const BandStress& wheel) {
  const CaseSpec& spec = system.model.spec;
  std::vector<SectionShakedown> out;
  if (wanted(spec, BodyId::rail))
    out.push_back(section_shakedown(spec, BodyId::rail, band_cycles(rail, rail_surface_stress(system, contact), 0)));
  if (wanted(spec, BodyId::wheel))
    out.push_back(section_shakedown(spec, BodyId::wheel,
                                    band_cycles(wheel, wheel_surface_stress(system, contact), system.rolling_radius)));
  return out;
}

ShakedownSummary shakedown_summary(const CaseSpec& spec, const std::vector<SectionShakedown>& sections) {
  ShakedownSummary out;
  for (const SectionShakedown& section : sections)
    if (section.strength.any()) out.bodies.push_back(body_shakedown(spec, section));
  return out;
}

}  // namespace railstrata
