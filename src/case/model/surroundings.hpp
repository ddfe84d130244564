#pragma once
// The surroundings of a solved patch: how far the profiles turn over it, the nearest edges of bodies and layers, the
// wheel's flange, and places outside of it where the bodies would touch as well. Warnings are made of it in judge.
#include <optional>
#include <string>

#include "model/model.hpp"

namespace railstrata {

/// The region that an engine has solved, in the contact plane: t along the common tangent from the rigid contact point,
/// m.
struct SolvedPatch {
  double low = 0, high = 0;                  ///< edges of the patch
  double covered_low = 0, covered_high = 0;  ///< where the engine looks for contact
  double normal_force = 0;                   ///< N
  double approach = 0;                       ///< m, along the contact normal
};

struct PatchEdges {
  double angle_spanned = 0;  ///< rad, the more that either profile's tangent turns over the patch
  /// half the change of the angle between the two profiles over the patch: of circular profiles the half-width over
  /// their relative radius, b (1/R_wheel + 1/R_rail)
  double half_width_over_radius = 0;
  double edge_share = 0;  ///< half-width, of the distance from the patch's middle to the nearest edge of a body or
                          ///< layer; 1: the patch reaches it, or beyond
  std::string edge;       ///< what edge that is and at which y of its body
};

/// The flange of a wheel that stands on a rail with a gauge face.
struct FlangePlace {
  double height = 0;         ///< m, of its crest below the tape circle
  double contact_depth = 0;  ///< m, of the wheel's contact point below the tape circle
  double beyond_gauge = 0;   ///< m, of its crest beyond the rail's gauge face, towards the field side
};

/// A place of the transverse profile where the bodies would overlap. y in each profile's own frame.
struct SecondContact {
  double overlap = 0;  ///< m, along the normal there
  double rail_y = 0, wheel_y = 0;
  double angle = 0;  ///< rad, of the rail's tangent in the track
};

struct PatchSurroundings {
  PatchEdges edges;
  double curvature_rolling = 0;  ///< 1/m, across the profiles, of the body that turns more
  std::optional<FlangePlace> flange;
  std::optional<SecondContact> second;  ///< that the engine leaves out
  bool cut_off = false;                 ///< pressure reaches where a profile or the block ends
  double bent_by_others = 0;       ///< curvature that the wheel's other patches give the surfaces, of the contact's
  double rail_y = 0, wheel_y = 0;  ///< m, the rigid contact point in each profile's own frame
  double rail_reach = 0, wheel_reach = 0;  ///< m, largest |y| of the patch in each profile's own frame
  double layer_change = 0;  ///< largest difference of a layer's thickness below the patch, of its largest thickness
};

/// A body ends where its profile ends or has turned away from the contact plane by 45 degrees, a block also at its
/// sides. Without `second`, `cut_off` and `bent_by_others`, which are the engines' to add.
PatchSurroundings patch_surroundings(const CaseSpec& spec, const Placement& placement, const SolvedPatch& patch);

/// Second contact: an axle that is guided sideways descends by d = approach / cos(angle). At a place with the vertical
/// gap g, the tangent's angle alpha and the distance r from the patch the bodies overlap by
///   (d - g) cos(alpha) - N/(pi E* r),
/// the last term being the depression of both surfaces by the force N of the patch. [Johnson1985 eq. 3.22a] The largest
/// overlap > 0 is reported, at places that neither are connected to the patch nor lie in the solved region.
std::optional<SecondContact> second_contact(const CaseSpec& spec, const Placement& placement, const SolvedPatch& patch);

}  // namespace railstrata
