#pragma once
// Conditions of wheel and rail by name, as numbers of the laws of this room, each with how sure it is and where it
// comes from. None of them replaces a measurement: friction of one rail changes within hours by as much as from one
// condition to the next.
#include <string_view>
#include <vector>

#include "core/certainty.hpp"
#include "friction/falling_friction.hpp"
#include "friction/third_body.hpp"

namespace railstrata {

struct FrictionCondition {
  std::string_view name;
  Certainty certainty = Certainty::absent;
  std::string_view source;
  double coefficient = 0;    ///< at rest
  double low = 0, high = 0;  ///< its range, from the source or the field
  FallingFriction law{};     ///< kinetic_share, half_velocity, memory
  ThirdBody film{};          ///< none without a thickness
};

/// dry, wet, locomotive, friction_modifier, greased, sand, clay, magnetite, molybdenum_disulphide.
const std::vector<FrictionCondition>& friction_conditions();

/// Throws CaseError with the nearest name and the list.
const FrictionCondition& friction_condition(std::string_view name);

}  // namespace railstrata
