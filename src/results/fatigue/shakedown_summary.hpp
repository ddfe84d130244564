#pragma once
// Does it last? Shakedown of rail and wheel (damage/shakedown.hpp) under a contact, from either engine.
#include <string>
#include <vector>

#include "bem/solve_bem.hpp"
#include "damage/shakedown.hpp"
#include "fatigue/row_strength.hpp"
#include "fatigue/section_fatigue.hpp"
#include "model/model.hpp"
#include "result/band_stress.hpp"
#include "result/patch.hpp"
#include "result/summary.hpp"
#include "spec/case_fwd.hpp"

namespace railstrata {

/// A body's section: its rows, what they bear and the factors.
struct SectionShakedown {
  BodyId body = BodyId::rail;
  std::vector<double> y, depth;  ///< m, of columns and rows
  std::vector<int> zone;         ///< of rows
  RowStrength strength;
  Shakedown found;  ///< without a strength: no factors
  BodyFatigue fatigue;
  double single_track = kNotApplicable;
  std::vector<std::string> notes;  ///< what the cells leave uncertain
  std::size_t patch = 0;           ///< of several patches the one that decides; 0: the largest pressure's
  double x_first = 0, x_last = 0;  ///< m, of the cycle
};

/// Judged bodies whose strength or fatigue limits the case gives; of several patches the one that decides. Throws
/// CaseError where a table of strengths ends too early.
std::vector<SectionShakedown> half_space_shakedown(const CaseSpec& spec, const BemResult& result);
/// The same of a finite element body, from its contact band, below the surface and at it.
struct BandBody {
  const BandStress& below;
  BandSurface surface;
};
/// patch: of the field of both surfaces.
std::vector<SectionShakedown> fem_shakedown(const Model& model, const PatchMeasures& patch, const BandBody& rail,
                                            const BandBody& wheel);

/// Summary of the sections that have a strength.
ShakedownSummary shakedown_summary(const CaseSpec& spec, const std::vector<SectionShakedown>& sections);

}  // namespace railstrata
