#pragma once
// Numbers of a case that are not known exactly and decide how long a rail lasts: ductility, friction, strength, wear
// factor and the place of the wheels. Each has a coefficient of variation v (of the place a standard deviation) in
// [life]; its ends are two of them away: best (1 - 2 v) and best (1 + 2 v).
//
// One number holds for all metal or all wheels at once: what differs from wheel to wheel is part of the traffic
// (collective.lateral_deviation, the rows of the collective).
#include <array>
#include <string>
#include <vector>

#include "spec/case_spec.hpp"

namespace railstrata {

/// A case with one number at an end of its spread.
struct InputEnd {
  std::string value;  ///< as people read it: "0.245", "× 0.93", "-1 mm"
  CaseSpec spec;
};

struct UncertainInput {
  std::string name;              ///< "friction"
  std::string key;               ///< of its scatter: "life.friction_scatter"
  std::array<InputEnd, 2> ends;  ///< the lower and the higher value
};

/// Those of a case that has them: not a strength where nothing has one, nor what has a scatter of 0.
///
/// Strength: the laws of yielding of the rail and its layers grow as in material/plastic.hpp (σ_y0, Q, all C_i), their
/// fatigue limits with them; hardness, and with it wear, stays. Friction: all coefficients of the case and its loads,
/// along and across. Place: the lateral shift of all wheels, positive to the field side.
std::vector<UncertainInput> uncertain_inputs(const CaseSpec& spec);

/// The material with all strengths times a factor: its law of yielding as the keys hardening would give it.
MaterialSpec with_strength(const MaterialSpec& material, double factor);

}  // namespace railstrata
