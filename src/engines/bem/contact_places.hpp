#pragma once
// The places where a wheel touches its rail when it is lowered, and which of them are one patch.
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

#include "model/model.hpp"

namespace railstrata {

/// Neighbouring contacts nearer to each other in angle than this are solved in one plane with all their interaction
/// where the wheel overlaps the rail all the way between them: half of the angle that one patch may span without a
/// warning.
inline constexpr double kAngleOfOnePlane = 10 * std::numbers::pi / 180;

/// A lowest place of the gap and the patch that it belongs to: by its number in order of descent.
struct ContactPlace {
  RigidContact contact;
  std::size_t patch = 0;
};

/// The first contact and those beside it that the wheel overlaps after a descent [m]. Neighbours nearly in one plane
/// are one patch where it overlaps the rail all the way between them.
std::vector<ContactPlace> places_of(const Placement& placement, double descent);

/// The patches' numbers without gaps, and the places in order along the rail.
void put_in_order(std::vector<ContactPlace>& places);

/// The contacts of one patch.
std::vector<RigidContact> contacts_of(const std::vector<ContactPlace>& places, std::size_t patch);

/// Where a patch of these contacts is solved under a wheel that is lowered by `descent` [m] from the placement's
/// contact: in the contact's own plane, or in one for all of them (common_contact).
RigidContact plane_of(const Placement& placement, const std::vector<RigidContact>& contacts, double descent);

/// t of a point of the section in a contact's plane, m.
double along_plane(const RigidContact& contact, Vec2 point);

/// Throws CaseError with both places, the case's key and the remedy where a wheel that comes down by `approach` [m]
/// touches in a further plane: for what follows one patch alone.
void require_one_plane(const Placement& placement, double approach, const std::string& key, const std::string& remedy);

}  // namespace railstrata
