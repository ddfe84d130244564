#pragma once
// Plane sections of the rail below the contact band, in the rail's profile frame.
#include "geometry/rail_outline.hpp"
#include "mesh/section_grid.hpp"

namespace railstrata {

/// The outline's right half below the head's flank, cut where mapped patches meet: at the 45° points of the fillets.
struct LowerOutline {
  std::vector<Vec2> underside;  ///< from the head's lower corner to the 45° point of the fillet to the web
  std::vector<Vec2> web;        ///< on to the 45° point of the fillet to the foot
  std::vector<Vec2> foot_top;   ///< on to the toe's upper corner
  std::vector<Vec2> toe;        ///< on to the toe's lower corner, on the base
};
LowerOutline lower_outline(const RailOutline& outline);

/// Head below the band, down to the line across the web's top.
struct HeadSection {
  Section section;
  NodeLine under_band;             ///< left to right along the band's bottom
  NodeLine left_face, right_face;  ///< under the band's two ends, from the flank inward
  NodeLine web_line;               ///< left to right between the 45° points
};
/// Boundary of the head's core: points along the band's bottom from one end face to the other, the two at which its
/// corners stand, and the band's end points on the flanks.
struct HeadBoundary {
  std::vector<Vec2> under_band;
  std::size_t left_corner = 0,
              right_corner = 0;  ///< left_corner intervals on the left side, as many right of right_corner
  Vec2 left_flank, right_flank;
};
HeadSection head_section(const HeadBoundary& boundary, const LowerOutline& lower, double element);

/// Web and foot, conforming.
struct FootSection {
  Section section;
  NodeLine web_line;  ///< as in HeadSection
  NodeLine base;      ///< bottom of the foot, left to right
};
FootSection foot_section(const LowerOutline& lower, double largest);

}  // namespace railstrata
