#include "geometry/turned_wheel.hpp"

#include <algorithm>
#include <cmath>

namespace railstrata {

TurnedWheel::TurnedWheel(const Profile& wheel, const TrackGeometry& track)
    : wheel_(wheel),
      radius_(track.wheel_radius),
      roll_(rotation_of_tangent(track.roll)),
      yaw_(rotation_of_tangent(track.yaw)),
      slope_(track.yaw),
      lean_(rotation_of_tangent(slope_ * roll_.s)),
      begin_(wheel.s_at_y(wheel.y_min())),
      end_(wheel.s_at_y(wheel.y_max())) {}

Vec3 TurnedWheel::turned(Vec3 p) const {
  const Vec2 rolled = section({p.y, p.z});
  return yaw(yaw_, {p.x, rolled.y, rolled.z});
}

// The normal (t_y sin theta, t_z, -t_y cos theta) of the unturned surface has no part along the rail, which in the
// wheel's own axes is (cos psi, -sin psi cos phi, sin psi sin phi):
//   sin theta - tan psi sin phi cos theta = tan psi cos phi t_z/t_y
TurnedPoint TurnedWheel::outline(double s) const {
  const ProfilePoint p = wheel_.at(s);
  // a flank too steep for its circle to have such a place lies above the outline
  const double steep = std::clamp(slope_ * roll_.c * lean_.c * p.tangent.z / std::max(p.tangent.y, 1e-6), -1.0, 1.0),
               level = std::sqrt((1 - steep) * (1 + steep)), sine = steep * lean_.c + level * lean_.s,
               cosine = level * lean_.c - steep * lean_.s, r = radius_ - p.position.z;
  TurnedPoint out;
  out.position = turned({r * sine, p.position.y, radius_ - r * cosine});
  const Vec3 normal = turned({p.tangent.y * sine, p.tangent.z, -p.tangent.y * cosine});
  out.along = {-normal.z, normal.y};
  out.depth = r * cosine;
  return out;
}

double TurnedWheel::s_at_y(double y) const {
  constexpr double kClose = 1e-14;
  constexpr int kMostSteps = 60;
  double low = begin_, high = end_,
         s = std::clamp(wheel_.s_at_y(std::clamp(y, wheel_.y_min(), wheel_.y_max())), low, high);
  for (int i = 0; i < kMostSteps; ++i) {
    const TurnedPoint p = outline(s);
    const double error = p.position.y - y;
    (error > 0 ? high : low) = s;
    double next = s - error / std::max(p.along.y, 0.01);
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::abs(next - s) < kClose) break;
    s = next;
  }
  return s;
}

double OutlineWalk::height(double y) {
  constexpr double kNear = 1e-7;  // m, from where the tangent leads on
  constexpr int kMostSteps = 4;
  for (int i = 0; s_ && i < kMostSteps; ++i) {
    *s_ += (y - last_.position.y) / std::max(last_.along.y, 0.01);
    if (!wheel_.has(*s_)) break;
    last_ = wheel_.outline(*s_);
    if (std::abs(y - last_.position.y) < kNear)
      return last_.position.z + (y - last_.position.y) * last_.along.z / last_.along.y;
  }
  s_ = wheel_.s_at_y(y);
  last_ = wheel_.outline(*s_);
  return last_.position.z;
}

TurnedPoint TurnedWheel::cut(double s, double x) const {
  constexpr int kTurns = 6;  // each leaves the share tan(psi) tan(phi) x/r of the error
  const ProfilePoint p = wheel_.at(s);
  const double r = radius_ - p.position.z;
  double along = 0, below = r;
  for (int i = 0; i < kTurns; ++i) {
    const double across = roll_.c * p.position.y - roll_.s * (radius_ - below);
    along = (x + yaw_.s * across) / yaw_.c;
    below = std::sqrt(std::max(0.0, (r - along) * (r + along)));
  }
  const double sine = along / r, cosine = below / r;
  const Vec3 by_s = turned({-p.tangent.z * sine, p.tangent.y, p.tangent.z * cosine}),
             by_theta = turned({below, 0, along});
  const double theta_by_s = -by_s.x / by_theta.x;
  TurnedPoint out;
  out.position = turned({along, p.position.y, radius_ - below});
  out.along = {by_s.y + theta_by_s * by_theta.y, by_s.z + theta_by_s * by_theta.z};
  out.depth = below;
  return out;
}

// The circle's tangent (cos theta, 0, sin theta), turned, is (X, Y, Z) with Y sin(delta) = Z cos(delta), which gives
// theta; its part in the plane is Y cos(delta) + Z sin(delta) = Y/cos(delta).
double lateral_motion(const RigidContact& c) {
  const double sine = std::sin(c.angle) * std::sin(c.yaw),
               cosine = std::cos(c.angle) * std::cos(c.roll) + std::sin(c.angle) * std::sin(c.roll) * std::cos(c.yaw),
               along = cosine * std::cos(c.yaw) + sine * std::sin(c.roll) * std::sin(c.yaw),
               across = cosine * std::sin(c.yaw) - sine * std::sin(c.roll) * std::cos(c.yaw);
  return across / (along * std::cos(c.angle));
}

}  // namespace railstrata
