#pragma once
// Profiles of wheel-rail contact as CONTACT takes them: y to the field side, z down, nothing shifted.
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cntc/profile_smoothing.hpp"
#include "geometry/profile.hpp"

namespace railstrata::cntc {

struct OutlineOptions {
  bool mirror_y = false;
  int mirror_z = 0;    ///< 0: z is turned down where it points up, -1: as it is, 1: turned
  double scale = 1e3;  ///< mm in the unit of the points
  Smoothing smoothing;
};

/// A profile with points of its running surface for searches.
class Outline {
 public:
  /// `aside`: y of the profile's origin; a Profile has to cover its own. `zero`: y where CONTACT's arc length begins.
  Outline(Profile profile, double aside, double zero);
  struct Point {
    double y = 0, z = 0, slope = 0;  ///< m, m, dz/dy
  };
  /// Of the running surface; the end where y lies beyond.
  Point at(double y) const;
  bool covers(double y) const { return y >= aside_ + profile_.y_min() && y <= aside_ + profile_.y_max(); }
  /// Arc length of the running surface at y, m.
  double arc(double y) const { return profile_.s_at_y(y - aside_); }
  double zero_arc() const { return zero_arc_; }
  /// At any arc length, also beyond the running surface.
  Point along(double s) const;
  const Profile& profile() const { return profile_; }
  /// By rising y, about 0.05 mm apart.
  const std::vector<Point>& points() const { return points_; }

 private:
  Profile profile_;
  double aside_ = 0, zero_arc_ = 0;
  std::vector<Point> points_;
};

/// The kind that the ending of a file's name says: .prr and .ban rails, .prw and .whl wheels. Throws Refused.
ProfileKind kind_of_file(std::string_view name);
/// Throws Refused with CONTACT's code for profiles.
Outline read_outline(ProfileKind kind, const std::string& file, const OutlineOptions& options);
/// y and z in turn.
Outline outline_of(ProfileKind kind, std::span<const double> values, const OutlineOptions& options);

/// y and z of the place where a canted rail [rad] is nearest to the track's middle within the depth below its highest
/// point, and z of that point, in axes of the track at the profile's origin.
struct GaugePoint {
  double y = 0, z = 0, top = 0;
};
GaugePoint gauge_point(const Outline& rail, double cant, double depth);

}  // namespace railstrata::cntc
