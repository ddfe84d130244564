#pragma once
// The undeformed gap of a wheel of revolution on a rail, extruded or of revolution too, measured along the normal of
// the contact plane.
//
// Contact frame: origin at the rigid contact point, x rolling direction, y along the common tangent (rising by the
// contact angle to the field side), n from the rail to the wheel. The wheel is its profile turned about the axle, the
// axle by the yaw, so the curvatures and the change of rolling radius across the patch are exact.
#include "bem/patch_grid.hpp"
#include "bem/plane_algebra.hpp"
#include "geometry/placement.hpp"
#include "geometry/profile.hpp"

namespace railstrata {

/// A row of cells on a turning surface.
struct RowPlane {
  Vec2 point;        ///< m, on the rail's section
  double angle = 0;  ///< rad, the middle between both surfaces'
};

struct ProfileGap {
  Plane gap;  ///< m, >= 0 up to round-off at small contact angles (the wheel is lowered along z); where a profile has
              ///< ended or turned away: kNoSurface
  Plane rail_height;  ///< m, the rail's surface above the contact plane
  Plane radius;       ///< m, distance from the axle of the middle between the two surfaces: what the deformed interface
                      ///< rolls on
  Plane rail_radius;  ///< m, the same from the rail's axle, < 0: hollow; empty: a straight rail
  std::vector<RowPlane> rows;  ///< of local_gap; empty: all cells in the contact plane
  static constexpr double kNoSurface = 0.05;
};

ProfileGap profile_gap(const Profile& wheel, const Profile& rail, const TrackGeometry& track,
                       const RigidContact& contact, const PatchGrid& grid);

/// The same on turning surfaces: rows of cells follow each other by arc length, and of each row gap and heights are
/// along its own normal.
ProfileGap local_gap(const Profile& wheel, const Profile& rail, const TrackGeometry& track, const RigidContact& contact,
                     const PatchGrid& grid);

}  // namespace railstrata
