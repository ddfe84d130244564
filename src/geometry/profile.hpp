#pragma once
// Wheel and rail profiles: plane curves in the section plane.
//
// Frame of a profile (docs/conventions.md): y lateral, positive to the FIELD side (flange / gauge side negative); z UP; metres.
//   rail : origin at the crown on the rail's axis, not canted; the material lies below the curve.
//   wheel: origin on the tread at the tape circle; z points to the axle; the material lies above the curve; the flange has z < 0.
// A curve is walked with y increasing over the running surface; s is the arc length, s = 0 at y = 0.
#include <filesystem>
#include <string>
#include <vector>

#include "core/vec.hpp"

namespace railstrata {

enum class ProfileKind { rail, wheel };

/// A line or circular arc, walked from p0 to p1. radius = 0 means a line.
struct ProfileSegment {
  Vec2 p0, p1, centre;
  double radius = 0;
};

/// Data at one point of the curve.
struct ProfilePoint {
  Vec2 position;
  Vec2 tangent;      ///< unit, along increasing s
  Vec2 outward;      ///< unit normal pointing out of the material
  double curvature;  ///< 1/m, positive for a convex body (rail crown +1/0.3; LMA's R450 hollow -1/0.45)
};

class Profile {
 public:
  /// Exact curve of tangent lines and arcs, in metres.
  static Profile from_segments(ProfileKind kind, std::string name, std::vector<ProfileSegment> segments);
  /// Curve through measured or listed points (metres, in the frame above), made C2 in arc length.
  /// Throws CaseError: fewer than 5 points, total chord length outside 5–500 mm (metre/millimetre mix-up), loops.
  static Profile from_points(ProfileKind kind, std::string name, std::vector<Vec2> points);

  ProfileKind kind() const { return kind_; }
  const std::string& name() const { return name_; }
  double s_min() const;
  double s_max() const;
  ProfilePoint at(double s) const;
  /// Arc length of the point of the running surface with the lateral coordinate y. Throws std::out_of_range outside.
  double s_at_y(double y) const;
  /// Height of the running surface, z(y).
  double height(double y) const { return at(s_at_y(y)).position.z; }
  double y_min() const;  ///< of the running surface (the part where the curve is a graph over y)
  double y_max() const;

 private:
  ProfileKind kind_ = ProfileKind::rail;
  std::string name_;
  std::vector<ProfileSegment> segments_;  // exact curve; empty for point profiles
  std::vector<double> s_;                 // knots (segment ends or points)
  std::vector<Vec2> p_, d2_;              // point profiles: positions and second derivatives of the cubic spline in s
};

/// Names accepted by builtin_profile: LMA, S1002, CN60, UIC60, UIC54.
std::vector<std::string> builtin_profile_names(ProfileKind kind);
/// A profile shipped inside the program. Throws CaseError with the nearest name.
Profile builtin_profile(ProfileKind kind, const std::string& name);

/// Reads a two-column file (y z; blanks, tabs, commas or semicolons; # % ! " comments; a header row; decimal commas; mm or metres; z up or down; either side's
/// orientation). What was detected and flipped is appended to `notes`, one sentence each. Throws CaseError naming the file and line.
Profile read_profile(ProfileKind kind, const std::filesystem::path& file, std::vector<std::string>* notes = nullptr);

/// Outline of a whole rail section, a closed polygon in the rail's profile frame walked anticlockwise seen from +x (y to the right, z up), for a head profile:
/// CN60 has its own lower part; other heads are given CN60's underside, web and foot, faded into the end of the head's flanks (docs/conventions.md).
struct RailOutline {
  // Right half (y >= 0); the left half is its mirror image (for measured profiles the head is taken as it is and only the lower part mirrored).
  double flank_y = 0, flank_z = 0;                  ///< where the head's flank ends and the underside begins
  std::vector<Vec2> underside;                      ///< from the flank's end to the web, z decreasing
  std::vector<Vec2> web;                            ///< from the underside's end down to the foot's top
  std::vector<Vec2> foot_top;                       ///< from the web's end out to the toe
  double base_z = 0;                                ///< bottom of the foot
};
RailOutline rail_outline(const Profile& head);

/// Area [m²], centroid height above the base [m], second moments about the horizontal and vertical axes through the centroid [m⁴] of a closed polygon.
struct SectionProperties {
  double area, centroid_height, i_horizontal, i_vertical;
};
SectionProperties section_properties(const std::vector<Vec2>& polygon);

}  // namespace railstrata
