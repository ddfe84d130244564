#include "traffic/uncertain_inputs.hpp"

#include <fmt/format.h>

#include <functional>
#include <optional>

#include "model/material_strength.hpp"
#include "model/zone.hpp"
#include "record/unit.hpp"
#include "spec/layer_spec.hpp"

namespace railstrata {
namespace {

constexpr double kDeviations = 2;  // from the best value to an end
constexpr double kBelow = 1;       // m, that a table goes on below its last row

void scale(std::optional<double>& value, double factor) {
  if (value) *value *= factor;
}

bool has_law(const MaterialSpec& material) { return plastic_law(material, "", "").has_value(); }

void scale_friction(CaseSpec& spec, double factor) {
  spec.drive.friction_coefficient *= factor;
  scale(spec.friction.lateral_coefficient, factor);
  scale(spec.friction.kinetic_coefficient, factor);
  for (TablePoint& point : spec.friction.lateral_table) point.value *= factor;
  for (LoadSpec& load : spec.loads) scale(load.friction_coefficient, factor);
}

void scale_strength(CaseSpec& spec, double factor) {
  spec.rail_material = with_strength(spec.rail_material, factor);
  for (const std::size_t layer : layers_on(spec, BodyId::rail))
    spec.layers[layer].material = with_strength(spec.layers[layer].material, factor);
}

void shift_wheels(CaseSpec& spec, double shift) {
  spec.geometry.lateral_shift += shift;
  for (LoadSpec& load : spec.loads)
    if (load.lateral_shift) *load.lateral_shift += shift;
}

/// best: the number of the case; none: shown as a factor.
UncertainInput factor_of(const CaseSpec& spec, const char* name, const char* key, double scatter,
                         std::optional<double> best, const std::function<void(CaseSpec&, double)>& scaled_by) {
  UncertainInput out{name, key, {}};
  for (std::size_t end = 0; end < out.ends.size(); ++end) {
    const double factor = 1 + (end == 0 ? -1 : 1) * kDeviations * scatter;
    out.ends[end] = {best ? fmt::format("{:.3g}", factor * *best) : fmt::format("× {:.3g}", factor), spec};
    scaled_by(out.ends[end].spec, factor);
  }
  return out;
}

UncertainInput place_of(const CaseSpec& spec) {
  const double away = kDeviations * spec.life.place_scatter, mm = unit::kMillimetres.factor * away;
  UncertainInput out{
      "place", "life.place_scatter", {{{fmt::format("-{:.3g} mm", mm), spec}, {fmt::format("+{:.3g} mm", mm), spec}}}};
  shift_wheels(out.ends[0].spec, -away);
  shift_wheels(out.ends[1].spec, away);
  return out;
}

/// Of all wheels; none where they have several.
std::optional<double> one_friction(const CaseSpec& spec) {
  for (const LoadSpec& load : spec.loads)
    if (load.friction_coefficient.value_or(spec.drive.friction_coefficient) != spec.drive.friction_coefficient)
      return std::nullopt;
  return spec.drive.friction_coefficient;
}

bool rail_yields(const CaseSpec& spec) {
  bool out = has_law(spec.rail_material);
  for (const std::size_t layer : layers_on(spec, BodyId::rail)) out = out || has_law(spec.layers[layer].material);
  return out;
}

}  // namespace

MaterialSpec with_strength(const MaterialSpec& material, double factor) {
  MaterialSpec out = material;
  StrengthSpec& s = out.strength;
  scale(s.fatigue.limit, factor);
  const std::optional<PlasticLaw> law = plastic_law(material, "", "");
  if (!law) return out;
  const PlasticParameters<double>& p = law->top.plastic;
  s.hardening.clear();
  s.yield_strength.reset();
  s.strength_table.clear();
  s.isotropic_hardening.reset();
  s.kinematic_hardening.clear();
  // a law that is given follows its strength by depth over that at the top, so Q and C_i are those of the top
  const double top = law->factor.empty() ? 1 : law->factor.front().value;
  if (law->factor.empty()) s.yield_strength = factor * p.yield;
  std::vector<DepthPoint> rows = law->factor;
  if (!rows.empty()) rows.push_back({rows.back().depth + kBelow, rows.back().value});
  for (const DepthPoint& row : rows) s.strength_table.push_back({row.depth, factor * row.value * p.yield});
  if (p.saturation != 0) s.isotropic_hardening = IsotropicHardening{factor * top * p.saturation, p.rate};
  for (int k = 0; k < kMostBackstresses; ++k)
    if (p.modulus[k] > 0) s.kinematic_hardening.push_back({factor * top * p.modulus[k], p.recall[k]});
  return out;
}

std::vector<UncertainInput> uncertain_inputs(const CaseSpec& spec) {
  const LifeSpec& life = spec.life;
  const double strength = life.strength_scatter.value_or(kStrengthScatter);
  std::vector<UncertainInput> out;
  if (spec.passes.ductility && life.ductility_scatter > 0)
    out.push_back(factor_of(spec, "ductility", "life.ductility_scatter", life.ductility_scatter, spec.passes.ductility,
                            [](CaseSpec& s, double factor) { scale(s.passes.ductility, factor); }));
  if (spec.drive.friction_coefficient > 0 && life.friction_scatter > 0)
    out.push_back(factor_of(spec, "friction", "life.friction_scatter", life.friction_scatter, one_friction(spec),
                            scale_friction));
  if (rail_yields(spec) && strength > 0)
    out.push_back(factor_of(spec, "strength", "life.strength_scatter", strength, std::nullopt, scale_strength));
  if (life.wear_scatter > 0)
    out.push_back(factor_of(spec, "wear factor", "life.wear_scatter", life.wear_scatter, spec.collective.wear_factor,
                            [](CaseSpec& s, double factor) { s.collective.wear_factor *= factor; }));
  if (life.place_scatter > 0) out.push_back(place_of(spec));
  return out;
}

}  // namespace railstrata
