#include "lives/life_section.hpp"

#include <algorithm>
#include <numbers>

#include "spec/case_spec.hpp"

namespace railstrata {
namespace {

bool has_data(const std::vector<double>& depth) {
  return std::all_of(depth.begin(), depth.end(), [](double v) { return std::isfinite(v); });
}

}  // namespace

double turn_of(const CaseSpec& spec) { return 2 * std::numbers::pi * spec.geometry.wheel_radius; }

LifeAcross across_wheel(const CaseSpec& spec, const WheelDamage& d, double turns) {
  LifeAcross out{.body = BodyId::wheel, .s = d.s, .y = d.y, .passages = d.share, .wear = {}};
  out.law = spec.collective.wear_law;
  const double way = turns * turn_of(spec);
  for (const WearLaw law : kWearLaws)
    if (has_data(d.depth(law)))
      for (const double per_metre : d.depth(law)) out.wear[static_cast<std::size_t>(law)].push_back(way * per_metre);
  return out;
}

LifeAcross across_rail(const CaseSpec& spec, const RailDamage& d, double tonnes) {
  LifeAcross out{.body = BodyId::rail, .s = d.s, .y = d.y, .passages = d.passages, .wear = {}};
  out.law = spec.collective.wear_law;
  for (const WearLaw law : kWearLaws)
    if (has_data(d.depth(law))) out.wear[static_cast<std::size_t>(law)] = smoothed_wear(d, law);
  if (spec.life.grinding.every) {
    out.ground = spec.life.grinding.depth;
    out.every = *spec.life.grinding.every / 1e3 / tonnes;
  }
  return out;
}

const SectionShakedown* section_of(const LifeLoad& load, BodyId body) {
  for (const SectionShakedown& s : *load.sections)
    if (s.body == body) return &s;
  return nullptr;
}

double middle_of(const LifeLoad& load, BodyId body, std::size_t patch) {
  const RigidContact& c = (*load.patches)[std::min(patch, load.patches->size() - 1)].contact;
  return body == BodyId::rail ? c.rail_s : c.wheel_s;
}

std::optional<RowsBeside> rows_beside(const LifeSection& s, int zone, double z) {
  std::optional<RowsBeside> out;
  for (std::size_t r = 0; r < s.depth->size(); ++r) {
    if ((*s.zone)[r] != zone) continue;
    if (!out) out = RowsBeside{r, r, 0};
    out->below = r;
    if ((*s.depth)[r] >= z) break;
    out->above = r;
  }
  if (!out) return out;
  const double top = (*s.depth)[out->above], bottom = (*s.depth)[out->below];
  out->share = bottom > top ? std::clamp((z - top) / (bottom - top), 0.0, 1.0) : 0;
  return out;
}

double value_at(const LifeSection& s, const std::vector<double>& values, const RowsBeside& rows, double place) {
  const double y = place - s.s0;
  const auto columns = s.y->size();
  if (columns == 0 || (columns > 1 && (y < s.y->front() || y > s.y->back()))) return 0;
  const auto right = std::min<std::size_t>(
      columns - 1, static_cast<std::size_t>(std::upper_bound(s.y->begin(), s.y->end(), y) - s.y->begin()));
  const std::size_t left = right > 0 ? right - 1 : 0;
  const double across = right > left ? std::clamp((y - (*s.y)[left]) / ((*s.y)[right] - (*s.y)[left]), 0.0, 1.0) : 0;
  const auto of_row = [&](std::size_t r) {
    return (1 - across) * values[r * columns + left] + across * values[r * columns + right];
  };
  return (1 - rows.share) * of_row(rows.above) + rows.share * of_row(rows.below);
}

}  // namespace railstrata
