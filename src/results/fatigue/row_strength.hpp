#pragma once
// Strength and stiffness of the rows of a section, from the case, and the fatigue of its points.
#include <functional>
#include <string>
#include <vector>

#include "core/body_id.hpp"
#include "damage/dang_van.hpp"
#include "damage/stress_history.hpp"
#include "result/summary.hpp"
#include "spec/case_fwd.hpp"

namespace railstrata {

struct StrengthSpec;  // spec/strength_spec.hpp

/// Per row of a stress history. A zone without a strength has NaN: it is taken to stay elastic.
struct RowStrength {
  std::vector<double> shear;                   ///< Pa, k = yield strength / sqrt(3)
  std::vector<double> young;                   ///< Pa
  std::vector<DangVanLimit> endurance;         ///< infinite where it is not known
  std::vector<double> residual_x, residual_y;  ///< Pa, of the process
  std::vector<std::string> notes;              ///< which strengths are estimates, and how, or not known
  std::vector<std::string> endurance_notes;    ///< likewise
  bool any() const;                            ///< of a strength
};

/// Whether `says` is true of the body, or of a layer on it.
bool any_zone(const CaseSpec& spec, BodyId body, const std::function<bool(const StrengthSpec&)>& says);
/// Whether a case gives a strength of a body, or of a layer on it.
bool strength_given(const CaseSpec& spec, BodyId body);
/// Whether a body is one of those that the case asks about (run.judged).
bool judged(const CaseSpec& spec, BodyId body);
/// Whether there is anything to judge: a strength of a body that the case asks about.
bool strength_to_judge(const CaseSpec& spec);

/// Per zone: the yield strength, a table of it, a grade, else an estimate from hardness, in this order. Depths of rail
/// and wheel count from the running surface. Throws CaseError where a table ends above the deepest row of its zone.
RowStrength row_strength(const CaseSpec& spec, BodyId body, const StressHistory& rows);

/// Von Mises stress of the process over the yield strength where it is largest, and the zone; 0 where neither is given.
struct ProcessStress {
  double share = 0;
  std::string zone;
};
ProcessStress largest_process_stress(const CaseSpec& spec, BodyId body);

/// Pa, in shear, at a depth, of an interface above or below it; below the end of a table its last value.
std::function<double(double depth, bool below_interface)> shear_strength_by_depth(const CaseSpec& spec, BodyId body);

// ---- fatigue below the surface, brittle layers and interfaces of a section, as far as the case gives constants
/// Whether a case gives anything that a body's fatigue is computed from: limits, toughness, bonds.
bool fatigue_given(const CaseSpec& spec, BodyId body);

/// `strength`: row_strength of the same rows. Parameters without constants are left out; without `planes` those of
/// critical planes too, which take most of its time.
BodyFatigue section_fatigue(const CaseSpec& spec, BodyId body, const StressHistory& history,
                            const RowStrength& strength, bool planes = true);

}  // namespace railstrata
