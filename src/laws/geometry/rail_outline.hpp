#pragma once
// A rail's section below its head: underside, web and foot.
#include <vector>

#include "geometry/profile.hpp"
#include "geometry/track_presets.hpp"

namespace railstrata {

/// What stands below a head. UIC60 is 60E1, UIC54 is 54E1 [EN13674].
enum class RailSection { CN60, UIC60, UIC54 };
/// Of a head of that name; of any other that of its track: UIC60 of EN, else CN60.
RailSection rail_section(std::string_view profile, TrackKind track);

/// Lower part of a rail section for a head profile, in the rail's profile frame: underside, web and foot at the
/// section's height, the underside widened towards the end of the head's flank (docs/conventions.md). A flank that ends
/// higher than the section's is continued straight. Throws CaseError for a head without flanks (a plane, an arc, a list
/// that ends on the running surface).
///
/// Every list includes both its ends and begins where the one before ends; arcs are drawn with a sagitta of 2
/// micrometres. Neighbouring parts meet at the 45-degree points of the two web fillets, so that each can be mapped by a
/// mesh.
struct RailOutline {
  // Right half (y >= 0); the left half is its mirror image (for measured profiles the head is taken as it is and only
  // the lower part mirrored).
  double flank_y = 0, flank_z = 0;  ///< where the head's flank ends and the underside begins
  std::vector<Vec2> underside;      ///< from the flank's end to the web, z decreasing
  std::vector<Vec2> web;            ///< from the underside's end down to the foot's top
  std::vector<Vec2> foot_top;       ///< from the web's end out to the toe (largest y)
  std::vector<Vec2> toe;            ///< from there down to the base
  double base_z = 0;                ///< bottom of the foot
};
RailOutline rail_outline(const Profile& head, RailSection section = RailSection::CN60);

}  // namespace railstrata
