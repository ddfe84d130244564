#include "fatigue/sliding_map.hpp"

#include <algorithm>
#include <cmath>

#include "result/patch.hpp"
#include "result/stress_cycles.hpp"

namespace railstrata {
namespace {

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

StressHistory cycles(const BemResult& result, const BemPatch& patch, BodyId body, const std::vector<CycleRow>& rows) {
  return body == BodyId::rail ? rail_cycles(result, patch, rows) : wheel_cycles(result, patch, rows);
}

SlidingMap map_of(const BemResult& result, const SectionShakedown& section) {
  const BemPatch& patch = section.patch == 0 ? result : result.further.at(section.patch - 1);
  std::vector<CycleRow> rows;
  for (std::size_t r = 0; r < section.depth.size(); ++r) rows.push_back({section.depth[r], section.zone[r]});
  const double way = result.force.x < 0 ? -1 : 1;  // as in the case
  const StressHistory pressed = cycles(result, sliding(patch, 0), section.body, rows),
                      sheared = cycles(result, sliding(patch, way), section.body, rows);
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
    SlidingLimit limit{mu, {}};
    limit.factors.first_yield = s.first_yield.value;
    limit.factors.wandering = s.wandering.value;
    limit.factors.upper = s.upper.value;
    limit.factors.kinematic = s.kinematic.value;
    out.limits.push_back(limit);
  }
  return out;
}

}  // namespace

std::vector<SlidingMap> sliding_maps(const BemResult& result, const std::vector<SectionShakedown>& sections) {
  std::vector<SlidingMap> out;
  for (const SectionShakedown& section : sections)
    if (section.strength.any()) out.push_back(map_of(result, section));
  return out;
}

}  // namespace railstrata
