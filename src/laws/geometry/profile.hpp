#pragma once
// Wheel and rail profiles: plane curves in the section plane.
//
// Frame of a profile (docs/conventions.md): y lateral, positive to the FIELD side (flange / gauge side negative); z UP;
// metres.
//   rail : origin at the crown on the rail's axis, not canted; the material lies below the curve.
//   wheel: origin on the tread at the tape circle; z points to the axle; the material lies above the curve; the flange
//   has z < 0.
// A curve is walked with y increasing over the running surface; s is the arc length, s = 0 at y = 0.
#include <memory>
#include <string>
#include <vector>

#include "core/vec.hpp"
#include "geometry/point_scatter.hpp"

namespace railstrata {

enum class ProfileKind { rail, wheel };

/// A line or circular arc, walked from p0 to p1. radius = 0 means a line.
struct ProfileSegment {
  Vec2 p0, p1, centre;
  double radius = 0;
};

/// The points of a curve and what they are worth.
struct ListedPoints {
  std::vector<Vec2> points;  ///< m, in the frame above
  PointScatter scatter;
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
  /// Exact curve of lines and arcs (each less than half a turn), in metres. Throws std::invalid_argument if they do not
  /// join.
  static Profile from_segments(ProfileKind kind, std::string name, std::vector<ProfileSegment> segments);
  /// Curve through measured or listed points (metres, in the frame above), made C2 in arc length.
  /// The scatter of the points is estimated, at least that of `rounding` (m, the last digit of the heights; 0: none),
  /// and smoothed away: knots stand as far apart as its curvature needs, half a millimetre to 4 mm, and down to the
  /// points' own spacing where the curve bends sharply. Points that are farther apart than that are interpolated. The
  /// curve leaves the points by no more than four times the scatter or 1 nanometre. Throws CaseError: fewer than 5
  /// points, total chord length outside 5–500 mm (metre/millimetre mix-up), loops, y = 0 not covered, a curve that
  /// between its points swings out to more than 1.25 times the length of their chords, or that misses neighbours by
  /// more than they lie apart.
  /// knots_moved: by which part of their distance the knots stand nearer to the first point, 0 to 1.
  static Profile from_points(ProfileKind kind, std::string name, const std::vector<Vec2>& points, double rounding = 0,
                             double knots_moved = 0);

  /// The same curve upside down, z reversed: a rail's as that of a wheel, with the material above it, and back.
  Profile upturned() const;

  ProfileKind kind() const { return kind_; }
  const std::string& name() const { return name_; }
  double s_min() const;
  double s_max() const;
  /// Throws std::out_of_range outside [s_min, s_max]. At a kink the piece towards larger s counts.
  ProfilePoint at(double s) const;
  /// Arc length of the point of the running surface with the lateral coordinate y. Throws std::out_of_range outside.
  double s_at_y(double y) const;
  /// Height of the running surface, z(y).
  double height(double y) const { return at(s_at_y(y)).position.z; }
  double y_min() const {
    return graph_y_begin_;
  }  ///< of the running surface (the part around s = 0 where the curve is a graph over y)
  double y_max() const { return graph_y_end_; }
  /// Arc lengths where pieces join: ends of the segments, or the spline's knots. Increasing; first s_min, last s_max.
  const std::vector<double>& knots() const { return s_; }
  /// Index of the knot that the piece with the arc length s begins at.
  std::size_t piece_of(double s) const;
  /// What the curve was fitted to; null for an exact curve.
  const ListedPoints* listed() const { return listed_.get(); }
  /// The exact curve; empty for a point profile.
  const std::vector<ProfileSegment>& segments() const { return segments_; }
  /// True for a plane or a single arc (circular_profile): it has no flange or gauge face, and place_wheel centres the
  /// pair.
  bool primitive() const { return primitive_; }

 private:
  friend Profile circular_profile(ProfileKind, double, double);
  struct Local {
    Vec2 position, d1, d2;  // derivatives with respect to s; |d1| = 1 for segments, within 1e-6 for splines
  };
  Local local(std::size_t piece, double s) const;
  double s_at_y_within(std::size_t piece, double y, double lo, double hi) const;
  double graph_end(bool towards_field) const;
  /// Where within a spline's piece, from near to far, dy/ds turns: the curve may fold back there between two knots that
  /// both run outwards. `far` if nowhere.
  double turning_of_slope(std::size_t piece, double near, double far) const;
  void set_origin();  // shifts s_ to s(y = 0) = 0 and finds the running surface

  ProfileKind kind_ = ProfileKind::rail;
  std::string name_;
  bool primitive_ = false;
  std::vector<ProfileSegment> segments_;
  std::shared_ptr<const ListedPoints> listed_;
  std::vector<double> s_;                   // knots (segment ends, or spline knots)
  std::vector<Vec2> p_, d2_;                // point profiles: positions and second derivatives of the cubic spline in s
  std::vector<double> knot_y_;              // lateral coordinates of the knots
  double graph_begin_ = 0, graph_end_ = 0;  // arc lengths of y_min and y_max
  double graph_y_begin_ = 0, graph_y_end_ = 0;
};

}  // namespace railstrata
