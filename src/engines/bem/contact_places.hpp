#pragma once
// The places where a wheel touches its rail when it is lowered, and which of them are one patch.
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "bem/case_patch.hpp"
#include "model/model.hpp"

namespace railstrata {

/// Neighbouring contacts nearer to each other in angle than this are solved in one plane with all their interaction
/// where the wheel overlaps the rail all the way between them: half of the angle that one patch may span without a
/// warning.
inline constexpr double kAngleOfOnePlane = 10 * std::numbers::pi / 180;
/// Between planes of their own and one plane the answer fades: over this much of the angle above it, and over so much
/// of the gap that is left between them [m] before the wheel overlaps the rail all the way.
inline constexpr double kFadingAngle = 0.02 * std::numbers::pi / 180, kFadingGap = 1e-6;

/// From 0 to 1 over x from 0 to 1, with the slope 0 at both ends.
double fade(double x);

/// A lowest place of the gap and the patch that it belongs to: by its number in order of descent.
struct ContactPlace {
  RigidContact contact;
  std::size_t patch = 0;
};

/// The first contact and those beside it that the wheel overlaps after a descent [m]. Neighbours nearly in one plane
/// are one patch where it overlaps the rail all the way between them. A contact in a line is one
/// place, and so is one that is settled.
std::vector<ContactPlace> places_of(const CaseSpec& spec, const Placement& placement, double descent);

/// One way to group the places, and its share in the answer.
struct Grouping {
  double share = 1;
  std::vector<ContactPlace> places;
};

/// All ways to group the places that count under a descent [m]. Two neighbours have a link of 1 where places_of makes
/// them one patch; it fades to 0 over kFadingAngle and kFadingGap. For each threshold between 0 and 1 links that reach
/// it hold, and the answer is the mean over the thresholds: continuous in all that links follow. The first one is that
/// of places_of, alone where no link fades.
std::vector<Grouping> groupings_of(const CaseSpec& spec, const Placement& placement, double descent);

/// Whether both groupings make the same patches of the places of the second one, which the first one has all.
bool agrees(const std::vector<ContactPlace>& first, const std::vector<ContactPlace>& second);

/// The patches' numbers without gaps, and the places in order along the rail.
void put_in_order(std::vector<ContactPlace>& places);

/// What one patch has: its contacts, and the stretch of the rail between the ridges to its neighbours.
struct PatchPlace {
  std::vector<RigidContact> contacts;
  RailStretch stretch;
  std::optional<std::size_t> beside_low, beside_high;  ///< the patches beyond its ends
  double touched_low = kNever, touched_high = kNever;  ///< m, descents from which the wheel overlaps the rail there
  static constexpr double kNever = std::numeric_limits<double>::infinity();
  /// The contact that touches first.
  const RigidContact& first() const;
  bool same_as(const PatchPlace& other) const;
};
/// In the order of their numbers, of places that are in order.
std::vector<PatchPlace> patch_places(const Placement& placement, const std::vector<ContactPlace>& places);

/// The patch of the contact that touches first, under a wheel that is lowered by `descent` [m].
PatchPlace first_place(const CaseSpec& spec, const Placement& placement, double descent);
/// All contacts there as one patch.
PatchPlace whole_place(const CaseSpec& spec, const Placement& placement, double descent);

/// The place and plane of a patch under a wheel that is lowered by `descent` [m] from the placement's contact
/// (overlap_place).
RigidContact plane_of(const Placement& placement, const PatchPlace& place, double descent);

/// What the grid in a plane has to hold under a descent [m], and where it ends: as far as where the wheel overlaps the
/// rail at the ridge to a neighbour.
PatchRoom room_of(const Placement& placement, const PatchPlace& place, const RigidContact& plane, double descent);

/// The place that a wheel's creepages and its approach are of, where it is lowered by `descent` [m]: that of the whole
/// overlap. It is the plane's of a wheel that touches at one place.
RigidContact reference_of(const Placement& placement, double descent);

/// The descent [m] of a wheel with this approach along the normal of its reference.
double descent_of(const Placement& placement, double approach);

/// Whether the places of two contacts of one wheel are the same.
bool same_place(const RigidContact& a, const RigidContact& b);

/// t of a point of the section in a contact's plane, m.
double along_plane(const RigidContact& contact, Vec2 point);

/// Throws CaseError with both places, the case's key and the remedy where a wheel that comes down by `approach` [m]
/// touches in a further plane: for what follows one patch alone.
void require_one_plane(const Placement& placement, double approach, const std::string& key, const std::string& remedy);

}  // namespace railstrata
