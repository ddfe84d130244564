#include "fatigue/shakedown_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "model/zone.hpp"
#include "result/stress_cycles.hpp"
#include "result/stress_of_half_space.hpp"
#include "single_track/history_stress.hpp"

namespace railstrata {
namespace {

SectionShakedown section_shakedown(const CaseSpec& spec, BodyId body, const StressHistory& history,
                                   bool planes = true) {
  SectionShakedown out;
  out.body = body;
  out.y = history.y;
  out.depth = history.depth;
  out.zone = history.zone;
  out.x_middle = 0.5 * (history.x.front() + history.x.back());
  out.strength = row_strength(spec, body, history);
  out.found = shakedown({history, out.strength.shear, out.strength.residual_x, out.strength.residual_y});
  out.fatigue = section_fatigue(spec, body, history, out.strength, planes);
  if (out.fatigue.dang_van) out.notes = out.strength.endurance_notes;
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
SectionShakedown least_of_patches(const CaseSpec& spec, BodyId body, const BemResult& r, bool planes) {
  const std::vector<const BemPatch*> patches = patches_of(r);
  std::optional<SectionShakedown> least;
  for (std::size_t k = 0; k < patches.size(); ++k) {
    const BemPatch* patch = patches[k];
    const PatchMeasures m = measure_patch(patch->field);
    const LayeredHalfSpace& half_space = body == BodyId::rail ? r.rail : r.wheel;
    const std::vector<CycleRow> rows = cycle_rows(half_space, 0.5 * (patch->grid.line ? m.length : shorter_axis(m)));
    SectionShakedown section = section_shakedown(spec, body, half_space_cycles(r, body, *patch, rows), planes);
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

/// The levels of a section, or of a zone of it; single_track is left open.
template <class Found>
ShakedownFactors factors_of(const Found& found) {
  ShakedownFactors f;
  f.first_yield = found.first_yield.value;
  f.wandering = found.wandering.value;
  f.upper = found.upper.value;
  f.kinematic = found.kinematic.value;
  return f;
}

BodyShakedown body_shakedown(const CaseSpec& spec, const SectionShakedown& section) {
  const Shakedown& s = section.found;
  BodyShakedown out;
  out.body = std::string(body_word(section.body));
  out.factors = factors_of(s);
  out.factors.single_track = section.single_track;
  out.zone = zone_name(spec, section.body, s.wandering.zone);
  out.depth = s.wandering.depth;
  out.y = s.wandering.y;
  for (const ZoneFactors& z : s.zones)
    if (std::isfinite(z.wandering.value)) {
      out.zones.push_back({zone_name(spec, section.body, z.zone), factors_of(z), z.wandering.depth});
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

constexpr double kBox = 6;  // half-widths and half-lengths that the residual stress reaches

/// First and last place with pressure of every column of a patch.
class PatchEnds {
 public:
  explicit PatchEnds(const BemPatch& patch) : grid_(patch.grid) {
    for (int j = 0; j < grid_.ny; ++j) {
      ends_.push_back({0, 0});
      bool touched = false;
      for (int i = 0; i < grid_.nx; ++i) {
        if (!(patch.field.p[grid_.index(i, j)] > 0)) continue;
        if (!touched) ends_.back()[0] = grid_.x(i) - 0.5 * grid_.dx;
        ends_.back()[1] = grid_.x(i) + 0.5 * grid_.dx;
        touched = true;
      }
    }
  }
  std::array<double, 2> operator()(double y) const {
    const double v = std::clamp((y - grid_.y0) / grid_.dy, 0.0, grid_.ny - 1.001);
    const auto j = static_cast<std::size_t>(v);
    const double t = v - static_cast<double>(j);
    return {(1 - t) * ends_[j][0] + t * ends_[j + 1][0], (1 - t) * ends_[j][1] + t * ends_[j + 1][1]};
  }

 private:
  PatchGrid grid_;
  std::vector<std::array<double, 2>> ends_;
};

SingleTrackInput track_input(const CaseSpec& spec, const BemResult& r, const SectionShakedown& section) {
  const BemPatch& patch = *patches_of(r).at(section.patch);
  const LayeredHalfSpace& body = section.body == BodyId::rail ? r.rail : r.wheel;
  const PatchMeasures m = measure_patch(patch.field);
  SingleTrackInput in;
  in.half_length = 0.5 * m.length;
  in.half_width = 0.5 * m.width;
  in.centre_x = section.x_middle;
  in.centre_y = 0.5 * (section.y.front() + section.y.back());
  for (const LayerExtent& layer : layer_extents(body)) in.interfaces.push_back(layer.bottom);
  const auto stress = std::make_shared<StressOfHalfSpace>(
      section.body == BodyId::rail ? rail_interior(body, patch) : wheel_interior(body, patch), in.interfaces,
      4.2 * in.half_length + std::abs(in.centre_x), kBox * in.half_width + std::abs(in.centre_y));
  in.stress = [stress](const std::vector<Vec3>& points, bool below) { return (*stress)(points, below); };
  in.shear_strength = shear_strength_by_depth(spec, section.body);
  in.ends = PatchEnds(patch);
  return in;
}

/// The patch with its pressure, sliding everywhere with q_x = mu p.
BemPatch sliding(const BemPatch& patch, double mu) {
  BemPatch out = patch;
  ContactField& f = out.field;
  for (std::size_t k = 0; k < f.p.size(); ++k) {
    f.q_x[k] = mu * f.p[k];
    f.q_y[k] = 0;
    if (f.p[k] > 0) f.state[k] = ContactState::slip;
  }
  return out;
}

SlidingMap map_of(const BemResult& result, const SectionShakedown& section) {
  const BemPatch& patch = *patches_of(result).at(section.patch);
  std::vector<CycleRow> rows;
  for (std::size_t r = 0; r < section.depth.size(); ++r) rows.push_back({section.depth[r], section.zone[r]});
  const double way = result.force.x < 0 ? -1 : 1;  // as in the case
  const StressHistory pressed = half_space_cycles(result, section.body, sliding(patch, 0), rows),
                      sheared = half_space_cycles(result, section.body, sliding(patch, way), rows);
  SlidingMap out{section.body, *std::max_element(patch.field.p.begin(), patch.field.p.end()), {}};
  constexpr int kSteps = 12;
  constexpr double kPerUnit = 20;
  StressHistory history = pressed;
  for (int i = 0; i <= kSteps; ++i) {
    const double mu = i / kPerUnit;
    for (std::size_t k = 0; k < history.stress.size(); ++k)
      history.stress[k] = pressed.stress[k] + mu * (sheared.stress[k] - pressed.stress[k]);
    const Shakedown s =
        shakedown({history, section.strength.shear, section.strength.residual_x, section.strength.residual_y});
    out.limits.push_back({mu, factors_of(s)});
  }
  return out;
}

}  // namespace

std::vector<SectionShakedown> half_space_shakedown(const CaseSpec& spec, const BemResult& result, bool planes) {
  std::vector<SectionShakedown> out;
  for (const BodyId body : {BodyId::rail, BodyId::wheel})
    if (wanted(spec, body)) out.push_back(least_of_patches(spec, body, result, planes));
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

double one_track(const Shakedown& found, const std::function<SingleTrackInput()>& input) {
  constexpr double kNearEnough = 1.02;
  const double safe = found.wandering.value, most = found.upper.value;
  if (most <= kNearEnough * safe) return safe;
  return std::clamp(single_track(input()).factor, safe, most);
}

void add_single_track(const CaseSpec& spec, const BemResult& result, std::vector<SectionShakedown>& sections) {
  for (SectionShakedown& section : sections) {
    if (!section.strength.any()) continue;
    section.single_track = result.grid.line
                               ? section.found.wandering.value
                               : one_track(section.found, [&] { return track_input(spec, result, section); });
  }
}

ShakedownSummary shakedown_summary(const CaseSpec& spec, const std::vector<SectionShakedown>& sections) {
  ShakedownSummary out;
  for (const SectionShakedown& section : sections)
    if (section.strength.any()) out.bodies.push_back(body_shakedown(spec, section));
  return out;
}

std::vector<SlidingMap> sliding_maps(const BemResult& result, const std::vector<SectionShakedown>& sections) {
  std::vector<SlidingMap> out;
  for (const SectionShakedown& section : sections)
    if (section.strength.any()) out.push_back(map_of(result, section));
  return out;
}

}  // namespace railstrata
