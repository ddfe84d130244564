#pragma once
// The half-space solution of a case as values: patch, forces, stresses and summary, of a transient its history too.
// Nothing is written or printed here.
#include <optional>
#include <vector>

#include "bem/solve_bem.hpp"
#include "bem/transient.hpp"
#include "fatigue/shakedown_summary.hpp"
#include "fatigue/sliding_map.hpp"
#include "fatigue/streamlines.hpp"
#include "result/summary.hpp"
#include "result/transient_row.hpp"

namespace railstrata {

struct HalfSpaceSolution {
  BemResult result;  ///< patch and forces; rail_interior() and wheel_interior() give the stresses at any point. Of a
                     ///< transient those of its last state
  Summary summary;   ///< with the largest stresses of both bodies
  std::vector<TransientRow> history = {};        ///< a row a step; empty in steady rolling
  std::optional<LoadedMoment> moment = {};       ///< of a transient: what holds in its last state
  double coarsest = 0;                           ///< cell_of_patch of a transient's worst state
  std::vector<StreamlineRow> streamlines = {};   ///< of all patches, of what rolls
  std::vector<SectionShakedown> shakedown = {};  ///< of the bodies whose strength the case gives
  std::vector<SlidingMap> sliding = {};          ///< complete_shakedown adds them if asked
  bool stopped = false;                          ///< the observer ended the transient before its end
};

/// The case as half-space theory can treat it. A static case (run.rolling = false) has frictionless contact, as the
/// finite elements' preload has.
CaseSpec half_space_case(CaseSpec spec);

/// Solves half_space_case(spec): steady rolling, or the case's transient, whose states the observer receives.
/// summary.run.threads is the number of threads of the calling thread (core/parallel.hpp), commit that of the program.
/// A transient that was stopped has no stresses. Several threads may solve at a time. Throws as solve_bem and
/// solve_transient.
HalfSpaceSolution solve_half_space(const CaseSpec& spec, const Placement& placement, const BemOptions& options = {},
                                   const TransientObserver& observer = {});

/// Adds to a solution, in some seconds, where the case gives strengths: the limit of shakedown for traffic on one line,
/// and if asked the maps of limits over traction.
void complete_shakedown(const CaseSpec& spec, HalfSpaceSolution& solution, bool with_maps = false);

/// The same without the stresses, which cost more than the contact of steady rolling.
HalfSpaceSolution solve_half_space_contact(const CaseSpec& spec, const Placement& placement,
                                           const BemOptions& options = {}, const TransientObserver& observer = {});

}  // namespace railstrata
