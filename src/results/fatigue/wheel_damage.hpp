#pragma once
// Damage of a wheel by the same passages, by position across its tread; and that of rail and wheel by many kinds of
// wheels, each so often.
//
// Rolling is steady: a point of the tread passes the patch as a point of the rail does, once a turn, and so wears by
// the same integral of the patch along x with the constants of its own material (StreamlineRow::wheel_depth). A turn is
// 2 pi R long, R the distance of the streamline from the axle. So
//     depth of the wheel per distance rolled = depth of one turn / (2 pi R),
// and the volume that a wheel loses over a distance is that which the rail loses below it, where the materials are the
// same: 2 pi R times the wheel's area per distance is the rail's area per passage.
//
// A position is the arc length s along the wheel's own profile. A streamline's strip lies as far from the contact point
// as on the tangent; its worn area, depth times width, is spread over the cells there and kept.
#include <span>
#include <vector>

#include "fatigue/rail_damage.hpp"
#include "model/model.hpp"
#include "spec/case_fwd.hpp"

namespace railstrata {

struct WheelDamage : ProfileWear {
  std::vector<double> share;  ///< of the distance during which the cell is in a patch of some load
};

/// No damage yet. The profile is cut into cells of at most `cell` [m].
WheelDamage unworn_wheel(const Profile& wheel, double cell);

/// Adds a patch of a wheel that runs so for this share of its distance.
void add_distance(WheelDamage& damage, const PatchDamage& patch, double share);

/// As spread_aside of a rail (fatigue/rail_damage.hpp).
void spread_aside(WheelDamage& damage, double deviation);

/// The patches of a kind of wheels.
struct WheelKind {
  double passages = 1;
  std::span<const PatchDamage> patches;
};

/// Their sums, times collective.wear_factor, spread by collective.lateral_deviation. placement: of the case (profile,
/// track); `cell` [m]: length of the cells.
RailDamage rail_damage(const CaseSpec& spec, std::span<const WheelKind> kinds, const Placement& placement, double cell);

/// Damage of one wheel that runs the kinds in proportion to their passages.
WheelDamage wheel_damage(const CaseSpec& spec, std::span<const WheelKind> kinds, const Placement& placement,
                         double cell);

}  // namespace railstrata
