#include "collective/worn_points.hpp"

namespace railstrata {

bool has_gauge(const Placement& p) { return !p.wheel.primitive() && !p.rail.primitive(); }

double crown_height(const std::vector<Vec2>& points) { return worn_profile(points).height(0); }

std::vector<Vec2> in_own_frame(std::vector<Vec2> points) {
  const double crown = crown_height(points);
  for (Vec2& p : points) p.z -= crown;
  return points;
}

Profile worn_profile(const std::vector<Vec2>& points) {
  return Profile::from_points(ProfileKind::rail, "worn", points);
}

double gauge_widening(const Profile& worn, const Placement& unworn) {
  return 2 * (gauge_face_y(worn, unworn.track) - gauge_face_y(unworn.rail, unworn.track));
}

}  // namespace railstrata
