#include "fatigue/crack_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "crack/crack_growth.hpp"
#include "crack/level_crack.hpp"
#include "fatigue/row_strength.hpp"
#include "result/patch.hpp"
#include "result/stress_cycles.hpp"
#include "spec/case_spec.hpp"

namespace railstrata {
namespace {

constexpr double kTop = 0.1e-3;  // m, the first of the depths that are shown
constexpr int kDepths = 14;

/// Where a patch's pressure is largest, across.
double loaded_line(const BemPatch& patch) {
  const std::vector<double>& p = patch.field.p;
  const auto most = static_cast<int>(std::max_element(p.begin(), p.end()) - p.begin());
  return patch.grid.y(patch.grid.line ? 0 : most % patch.field.columns);
}

/// Of a crack along an interface: what its phase is of, and what the layer's tension would add.
std::vector<std::string> level_notes(const CaseSpec& spec, const CrackResult& found, const LayeredHalfSpace& body) {
  std::vector<std::string> out;
  const CrackSpec& crack = spec.life.crack;
  const double depth = found.state.depth;
  if (!(material_at(body, depth) == material_at(body, depth * (1 + 1e-9))))
    out.push_back(fmt::format("crack: K_I, K_II and the phase angle are those at {:.2g} um from the end",
                              1e6 * reference_length(crack_line(crack, 0, body))));
  const auto top = std::find_if(spec.layers.begin(), spec.layers.end(),
                                [](const LayerSpec& layer) { return layer.on == BodyId::rail; });
  const double c = std::cos(found.azimuth), s = std::sin(found.azimuth);
  const std::vector<double>& process = top->material.strength.initial_stress;
  const double tension = process.empty() ? 0 : c * c * process[0] + s * s * process[1];
  if (tension > 0 && crack.layer == 1)
    out.push_back(
        fmt::format("crack: where the layer is cut through, its tension of {:.0f} MPa alone releases {:.3g} "
                    "J/m2 along a long crack; below an uncut layer it releases nothing",
                    1e-6 * tension, strip_release(body.layers.front().material, depth, tension)));
  return out;
}

/// What the numbers do not say.
std::vector<std::string> notes_of(const CaseSpec& spec, const CrackResult& found, const LayeredHalfSpace& body) {
  const CrackSpec& crack = spec.life.crack;
  std::vector<std::string> out;
  if (crack.level()) out = level_notes(spec, found, body);
  if (!found.state.settled)
    out.push_back("crack: the faces do not come to the same cycle in each passage; K is that of the last one");
  if (crack.level()) return out;
  const double down = found.state.kink.angle + crack.angle;
  const double kinked = growth_rate(crack.law, {found.state.kink.range, 0}, crack.threshold);
  if (kinked > found.state.growth) {
    const std::string times = found.state.growth > 0 ? fmt::format("{:.2g} times as fast", kinked / found.state.growth)
                                                     : "while the crack itself does not grow";
    out.push_back(fmt::format("crack: a branch at {:.0f} deg from the surface would grow {}: it turns {}",
                              down * 180 / std::numbers::pi, times,
                              std::sin(down) > std::sin(crack.angle) ? "down" : "towards the surface"));
  }
  return out;
}

/// Wheels in which a crack grows from one depth to another: the sum of Δa over the growth, trapezoids in depth.
double wheels_between(const CrackSpec& crack, const CrackResult& result, double to) {
  if (result.depths.empty() || !(to > crack.depth)) return kNotApplicable;
  std::vector<CrackState> way{result.state};
  for (const CrackState& state : result.depths)
    if (state.depth > crack.depth && state.depth <= to * (1 + 1e-9)) way.push_back(state);
  double wheels = 0;
  for (std::size_t i = 1; i < way.size(); ++i)
    wheels +=
        (way[i].depth - way[i - 1].depth) / std::sin(crack.angle) * 0.5 * (1 / way[i].growth + 1 / way[i - 1].growth);
  return wheels;
}

}  // namespace

CrackLine crack_line(const CrackSpec& crack, double depth, const LayeredHalfSpace& body) {
  if (crack.level())
    return {.kind = CrackKind::inside,
            .length = crack.length,
            .depth = layer_extents(body)[static_cast<std::size_t>(crack.layer) - 1].bottom};
  return {.kind = crack.top > 0 ? CrackKind::inside : CrackKind::mouth,
          .angle = crack.angle,
          .length = (depth - crack.top) / std::sin(crack.angle),
          .depth = crack.top};
}

CrackState crack_state(const CrackSpec& crack, double depth, const LayeredHalfSpace& body, const PlaneOfRolling& plane,
                       CrackPassage* passage) {
  const CrackLine line = crack_line(crack, depth, body);
  CrackPassage now = pass_over(line, body, plane, {.friction = crack.face_friction, .fluid = crack.fluid});
  const FrontFactors front =
      line.level() ? FrontFactors{} : front_factors(crack.aspect, material_at(body, depth).poisson);
  for (std::vector<StressIntensity>* end : {&now.end, &now.start})
    for (StressIntensity& k : *end) k = {front.I * k.I, front.II * k.II};
  CrackState out{.depth = line.z(line.length),
                 .range = range_of(now.end),
                 .kink = worst_kink(now.end),
                 .release = {},
                 .settled = now.settled};
  out.equivalent = equivalent_range(crack.law, out.range);
  out.growth = growth_rate(crack.law, out.range, crack.threshold);
  for (std::size_t i = 0; i < now.place.size(); ++i)
    if (const Release at = release_at(now, i); at.rate > out.release.rate) out.release = at;
  if (line.level()) {
    out.equivalent = out.growth = kNotApplicable;
    out.kink = {kNotApplicable, kNotApplicable};
  }
  if (passage) *passage = std::move(now);
  return out;
}

PlaneOfRolling crack_plane(const CaseSpec& spec, const BemResult& result, const BemPatch& patch, const CrackPlace& at) {
  constexpr int kEvery = 3;  // of the rows of a section
  const PatchMeasures m = measure_patch(patch.field);
  const std::vector<CycleRow> all = cycle_rows(result.rail, 0.5 * (patch.grid.line ? m.length : shorter_axis(m)));
  std::vector<CycleRow> rows;
  for (std::size_t r = 0; r < all.size(); ++r) {
    const bool top = r > 0 && all[r].zone != all[r - 1].zone, last = all[r].depth > at.deepest || r + 1 == all.size();
    if (r % kEvery == 0 || top || last || all[r].zone != all[r + 1].zone) rows.push_back(all[r]);
    if (last) break;
  }
  // as far across as a crack in any direction reaches, or in the given one
  const CrackSpec& crack = spec.life.crack;
  const double reach = crack.level() ? crack.length : at.deepest / std::tan(crack.angle);
  const double across = at.azimuth ? reach * std::sin(*at.azimuth) : reach;
  StressHistory history =
      half_space_cycles(result, BodyId::rail, patch, rows,
                        AcrossRange{at.y + std::min(across, at.azimuth ? 0 : -reach), at.y + std::max(across, 0.0)});
  const RowStrength strength = row_strength(spec, BodyId::rail, history);
  std::vector<Sym3> residual = residual_rows(strength.residual_x, strength.residual_y);
  residual.resize(rows.size());
  if (at.further)
    for (std::size_t r = 0; r < rows.size(); ++r) residual[r] = residual[r] + at.further(rows[r].depth);
  return {std::move(history), at.y, at.azimuth.value_or(0), std::move(residual)};
}

double fastest_azimuth(const std::function<double(double azimuth)>& growth) {
  constexpr int kDirections = 12;  // then half a step to either side of the fastest
  const double step = 2 * std::numbers::pi / kDirections;
  double most = -1, out = 0;
  const auto attempt = [&](double azimuth) {
    const double rate = growth(azimuth);
    if (rate > most) out = azimuth;
    most = std::max(most, rate);
  };
  for (int i = 0; i < kDirections; ++i) attempt(step * (i <= kDirections / 2 ? i : i - kDirections));
  const double coarse = out;
  if (most > 0)
    for (const double half : {-0.5 * step, 0.5 * step}) attempt(std::remainder(coarse + half, 2 * std::numbers::pi));
  return out;
}

CrackResult half_space_crack(const CaseSpec& spec, const BemResult& result) {
  const CrackSpec& crack = spec.life.crack;
  const auto patches = patches_of(result);
  const BemPatch& patch = **std::max_element(patches.begin(), patches.end(), [](const BemPatch* a, const BemPatch* b) {
    return measure_patch(a->field).p_max < measure_patch(b->field).p_max;
  });
  const bool inside = crack.top > 0 || crack.level();
  const double end = crack.level() ? crack_line(crack, 0, result.rail).depth : crack.depth;
  const double deepest = inside ? end : std::max(crack.allowable, end);
  CrackResult out;
  out.y = loaded_line(patch) + crack.lateral;
  PlaneOfRolling plane = crack_plane(spec, result, patch, {.y = out.y, .deepest = deepest});
  const auto in_direction = [&](double azimuth) {
    plane.turn(azimuth);
    const CrackState state = crack_state(crack, end, result.rail, plane);
    return crack.level() ? state.release.rate : state.growth;
  };
  out.azimuth = crack.azimuth ? *crack.azimuth : fastest_azimuth(in_direction);
  plane.turn(out.azimuth);
  out.state = crack_state(crack, end, result.rail, plane, &out.passage);
  for (int i = 0; i < kDepths && !inside; ++i)
    out.depths.push_back(crack_state(crack, kTop * std::pow(deepest / kTop, i / (kDepths - 1.0)), result.rail, plane));
  out.notes = notes_of(spec, out, result.rail);
  return out;
}

CrackSummary crack_summary(const CrackSpec& crack, const CrackResult& result, double wheel_force) {
  CrackSummary out;
  out.depth = result.state.depth;
  out.K_I_range = result.state.range.I;
  out.K_II_range = result.state.range.II;
  out.equivalent_range = result.state.equivalent;
  out.growth = result.state.growth;
  out.release = result.state.release.rate;
  out.phase = result.state.release.phase;
  out.kink_range = result.state.kink.range;
  out.kink_angle = crack.angle + result.state.kink.angle;
  out.azimuth = result.azimuth;
  out.life = wheels_between(crack, result, crack.allowable) * 1e3 * gross_tonnes(wheel_force);
  out.slipping = *std::max_element(result.passage.slipping.begin(), result.passage.slipping.end());
  return out;
}

}  // namespace railstrata
