#pragma once
// A patch of several contacts that were solved in one plane, taken apart where it is not connected.
#include <vector>

#include "bem/several_patches.hpp"

namespace railstrata {

/// One connected part of a patch, or several around one place.
struct PatchPiece {
  RigidContact place;  ///< of the profiles, with the contact angle there
  PatchOnWheel patch;  ///< on the grid and in the plane of the whole, nothing outside of the part
};

/// The cells with pressure that hang together, by sides or corners, belong to the contact that their centre of pressure
/// is nearest to. The dissipation of the whole is shared by q·slip of the cells. Of one part: the whole, at the plane's
/// own place where it holds several contacts, else at that contact.
std::vector<PatchPiece> pieces_of(const PatchOnWheel& whole);

}  // namespace railstrata
