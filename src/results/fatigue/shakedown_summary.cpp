#include "fatigue/shakedown_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "fatigue/one_track.hpp"
#include "material/elastic.hpp"
#include "model/zone.hpp"
#include "result/patch.hpp"
#include "result/stress_cycles.hpp"
#include "single_track/history_stress.hpp"

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

bool wanted(const CaseSpec& spec, BodyId body) {
  return judged(spec, body) && (strength_given(spec, body) || fatigue_given(spec, body));
}

/// Cells of the strip of slip behind the sticking ones, in the column at y; 0 without such a strip.
int strip_of_slip(const BemPatch& patch, double y) {
  const ContactField& f = patch.field;
  const int nearest = static_cast<int>(std::lround((y - patch.grid.y0) / patch.grid.dy)),
            column = patch.grid.line ? 0 : std::clamp(nearest, 0, f.columns - 1);
  int slips = 0;
  for (int i = 0; i < f.stations; ++i) {
    const ContactState state = f.state[static_cast<std::size_t>(i) * f.columns + column];
    if (state == ContactState::stick) return slips;
    if (state == ContactState::slip) ++slips;
  }
  return 0;
}

/// Where the surface decides and the strip of slip is too short for result/surface_peaks.hpp.
void note_short_strip(const BemPatch& patch, SectionShakedown& section) {
  constexpr int kResolved = 7;
  const LoadFactor& decides = section.found.wandering;
  if (!section.strength.any() || decides.depth != 0) return;
  if (const int cells = strip_of_slip(patch, decides.y); cells > 0 && cells < kResolved)
    section.notes.push_back(
        fmt::format("the surface decides where the slip zone is {} cells long: smaller cells (--cell) change the "
                    "factors, by about 3 % with 3 cells",
                    cells));
}

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
    note_short_strip(*patch, section);
    if (!least || section.found.wandering.value < least->found.wandering.value) least = std::move(section);
  }
  return std::move(*least);
}

/// m, of what bears pressure.
struct Middle {
  double x = 0, y = 0;
};
Middle middle_of(const ContactField& f) {
  double x[2] = {HUGE_VAL, -HUGE_VAL}, y[2] = {HUGE_VAL, -HUGE_VAL};
  for (int i = 0; i < f.size(); ++i) {
    if (!(f.p[i] > f.p_noise)) continue;
    x[0] = std::min(x[0], f.x[i]);
    x[1] = std::max(x[1], f.x[i]);
    y[0] = std::min(y[0], f.y[i]);
    y[1] = std::max(y[1], f.y[i]);
  }
  return {0.5 * (x[0] + x[1]), 0.5 * (y[0] + y[1])};
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
    if (std::isfinite(z.wandering.value)) {
      out.zones.push_back({zone_name(spec, section.body, z.zone),
                           factors_of(z.first_yield, z.wandering, z.upper, z.kinematic), z.wandering.depth});
      // The section's factor holds for all its zones, so for this one: on the safe side.
      if (std::isfinite(section.single_track))
        out.zones.back().factors.single_track = std::clamp(section.single_track, z.wandering.value, z.upper.value);
    }
  const BodyId other = section.body == BodyId::rail ? BodyId::wheel : BodyId::rail;
  if (!judged(spec, other))
    out.notes.push_back(fmt::format("the {} is not judged: run.judged = \"{}\"", body_word(other), out.body));
  out.notes.insert(out.notes.end(), section.strength.notes.begin(), section.strength.notes.end());
  out.notes.insert(out.notes.end(), section.notes.begin(), section.notes.end());
  return out;
}

}  // namespace

std::vector<SectionShakedown> half_space_shakedown(const CaseSpec& spec, const BemResult& result) {
  std::vector<SectionShakedown> out;
  for (const BodyId body : {BodyId::rail, BodyId::wheel})
    if (wanted(spec, body)) out.push_back(least_of_patches(spec, body, result));
  return out;
}

std::vector<SectionShakedown> fem_shakedown(const Model& model, const PatchMeasures& patch, const BandBody& rail,
                                            const BandBody& wheel) {
  std::vector<SectionShakedown> out;
  const auto add = [&](BodyId body, const BandBody& band) {
    if (!wanted(model.spec, body)) return;
    const StressHistory history = band_cycles(band.below, band.surface);
    out.push_back(section_shakedown(model.spec, body, history));
    SectionShakedown& section = out.back();
    if (!section.strength.any() || !(patch.length > 0 && patch.width > 0)) return;
    section.single_track = one_track(section.found, [&] {
      const Middle middle = middle_of(band.surface.field);
      SingleTrackInput in = single_track_input(history, section.strength.shear, 0.5 * patch.length, 0.5 * patch.width,
                                               middle.x, middle.y - model.placement.contact.point.y);
      in.shear_strength = shear_strength_by_depth(model.spec, body);
      return in;
    });
  };
  add(BodyId::rail, rail);
  add(BodyId::wheel, wheel);
  return out;
}

ShakedownSummary shakedown_summary(const CaseSpec& spec, const std::vector<SectionShakedown>& sections) {
  ShakedownSummary out;
  for (const SectionShakedown& section : sections)
    if (section.strength.any()) out.bodies.push_back(body_shakedown(spec, section));
  return out;
}

}  // namespace railstrata
