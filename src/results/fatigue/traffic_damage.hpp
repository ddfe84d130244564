#pragma once
// Damage of rail and wheel by many kinds of wheels, each so often: their sums, times collective.wear_factor, spread by
// collective.lateral_deviation.
#include <span>

#include "fatigue/wheel_damage.hpp"
#include "model/model.hpp"
#include "spec/case_fwd.hpp"

namespace railstrata {

/// The patches of a kind of wheels.
struct WheelKind {
  double passages = 1;
  std::span<const PatchDamage> patches;
};

/// placement: of the case (profile, track); `cell` [m]: length of the cells.
RailDamage rail_damage(const CaseSpec& spec, std::span<const WheelKind> kinds, const Placement& placement, double cell);

/// Damage of one wheel that runs the kinds in proportion to their passages.
WheelDamage wheel_damage(const CaseSpec& spec, std::span<const WheelKind> kinds, const Placement& placement,
                         double cell);

}  // namespace railstrata
