#pragma once
// Load factors of shakedown of rail and wheel (damage/shakedown.hpp) under a contact, from either engine.
#include <functional>
#include <string>
#include <vector>

#include "bem/solve_bem.hpp"
#include "damage/shakedown.hpp"
#include "fatigue/row_strength.hpp"
#include "model/model.hpp"
#include "result/band_stress.hpp"
#include "result/patch.hpp"
#include "result/summary.hpp"
#include "single_track/single_track.hpp"
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
  double x_middle = 0;             ///< m, of the cycle
};

/// Judged bodies whose strength or fatigue limits the case gives; of several patches the one that decides. Throws
/// CaseError where a table of strengths ends too early. planes: with the critical planes of fatigue.
std::vector<SectionShakedown> half_space_shakedown(const CaseSpec& spec, const BemResult& result, bool planes = true);
/// The same of a finite element body, from its contact band, below the surface and at it.
struct BandBody {
  const BandStress& below;
  BandSurface surface;
};
/// patch: of the field of both surfaces.
std::vector<SectionShakedown> fem_shakedown(const Model& model, const PatchMeasures& patch, const BandBody& rail,
                                            const BandBody& wheel);

/// Limit for wheels that all run in the same place (single_track/single_track.hpp) of a section that has its other
/// factors. Where `upper` exceeds `wandering` by at most 2 % the limit lies between the two and is taken to be
/// `wandering`, the safe one. Else `input` is asked for and solved, some seconds; what comes out lies between the two.
double one_track(const Shakedown& found, const std::function<SingleTrackInput()>& input);

/// The same of every section of `sections`, which half_space_shakedown has found; of a line contact it is `wandering`.
void add_single_track(const CaseSpec& spec, const BemResult& result, std::vector<SectionShakedown>& sections);

/// Summary of the sections that have a strength.
ShakedownSummary shakedown_summary(const CaseSpec& spec, const std::vector<SectionShakedown>& sections);

// ---- the shakedown map of a case: its patch, pressure and layers under full sliding in the rolling direction, q = mu
// p
struct SlidingLimit {
  double traction = 0;       ///< mu = q/p
  ShakedownFactors factors;  ///< on the case's own pressure; without single_track
};
struct SlidingMap {
  BodyId body = BodyId::rail;
  double p_max = 0;  ///< Pa, of the patch; times a factor it is the pressure at a limit
  std::vector<SlidingLimit> limits;
};

/// mu = 0, 0.05, … 0.6 for every section that has a strength, on its own patch. As long as two half_space_shakedown:
/// stresses are linear in the tractions, so the cycle for any mu is that of the pressure plus mu times that of q = p.
std::vector<SlidingMap> sliding_maps(const BemResult& result, const std::vector<SectionShakedown>& sections);

}  // namespace railstrata
