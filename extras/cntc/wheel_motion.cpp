#include "cntc/wheel_motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace railstrata::cntc {

RigidPair place(ModuleOne& one, const Problem& base, double z) {
  const double side = side_of(base);
  const auto& shift = one.rail_shift;
  const auto& gives = one.forces.rail.way;
  const TrackPlace& t = one.track;
  Vec3 at{0, side * t.y, t.z};
  if (t.gauge_depth > 0) {
    const GaugePoint gauge = gauge_point(*one.rail, t.cant, t.gauge_depth);
    at = {0, 0.5 * t.gauge - gauge.y, on_roller(base) ? 0 : -gauge.top};
  }
  one.found.rail_at =
      marker(at + Vec3{0, side * (shift[0] + gives[0]), shift[1] + gives[1]}, -t.cant + side * shift[2]);
  const auto& flexible = one.flexibility.at;
  const double tread = one.tape_y ? one.wheel->at(*one.tape_y).z : 0;
  one.found.wheel_in_wheelset = marker({flexible[0], 0.5 * one.flange_distance - one.flange_place + side * flexible[1],
                                        one.wheel_radius - tread + flexible[2]},
                                       side * flexible[3], side * flexible[4]);
  const auto& p = one.wheelset.at;
  one.found.wheelset_at = marker({0, side * p[1], z - one.wheel_radius}, side * p[3], side * p[4]);
  RigidPair out;
  out.rail = &*one.rail;
  out.wheel = &*one.wheel;
  out.rail_at = one.found.rail_at;
  out.wheel_at = placed(one.found.wheelset_at, one.found.wheel_in_wheelset);
  out.wheel_radius = one.wheel_radius;
  out.roller_radius = on_roller(base) ? t.roller_radius : 0;
  return out;
}

namespace {

Vec3 mirrored(Vec3 v, double side) { return {v.x, side * v.y, v.z}; }
Vec3 mirrored_turn(double roll, double pitch, double yaw, double side) { return {side * roll, pitch, side * yaw}; }

/// Of a rigid body: velocity at a point and rotation, in the track.
struct Moving {
  Vec3 velocity, turn;
};

Moving of_rail(const ModuleOne& one, const Problem& base, Vec3 point) {
  const double side = side_of(base), curvature = one.track.curvature;
  const auto& shift = one.rail_shift;
  const Vec3 arm = point - one.found.rail_at.at;
  Moving out;
  if (!on_roller(base)) {
    const double turning = -side * one.wheelset.rate[0] * curvature;
    out.turn = {side * shift[5], 0, turning};
    out.velocity = Vec3{-turning * one.found.rail_at.at.y, side * shift[3], shift[4]} + cross(out.turn, arm);
    return out;
  }
  const Vec3 from_axle = point - Vec3{0, 0, one.track.roller_radius};
  const Vec3 of_profile{side * shift[5], 0, 0};
  const double pitch = one.pitch_rate_of_roller;
  const Vec3 roller{0, pitch, -side * std::abs(from_axle.z) * pitch * curvature};
  out.turn = of_profile + roller;
  out.velocity = Vec3{0, side * shift[3], shift[4]} + cross(of_profile, arm) + cross(roller, from_axle);
  return out;
}

/// `aside`: how far the point lies along the track from where the wheelset's rotation moves it.
Moving of_wheel(const ModuleOne& one, const Problem& base, Vec3 point, double aside = 0) {
  const double side = side_of(base);
  const Marker& axle = one.found.wheelset_at;
  const auto &r = one.wheelset.rate, &f = one.flexibility.rate;
  const Vec3 in_wheelset = axle.to_inner(point);
  const Vec3 bending = mirrored_turn(f[3], f[5], f[4], side);
  const Vec3 own = mirrored({f[0], f[1], f[2]}, side) + cross(bending, in_wheelset - one.found.wheel_in_wheelset.at);
  const Vec3 turn = axle.turned(mirrored_turn(r[3], r[5], r[4], side));
  const Vec3 arm = axle.turned(in_wheelset - Vec3{aside, 0, 0});
  return {mirrored({r[0], r[1], r[2]}, side) + cross(turn, arm) + axle.turned(own), turn + axle.turned(bending)};
}

}  // namespace

Rolling rolling(const ModuleOne& one, const Problem& base, const WheelRailPatch& patch) {
  const Marker &m = patch.plane.reference, &axle = one.found.wheelset_at;
  const Vec3 point = m.at + patch.approach * m.axes[2];
  const Moving rail = of_rail(one, base, m.at), wheel = of_wheel(one, base, point);
  const double around = cross(axle.turned({0, one.wheelset.rate[5], 0}), axle.turned(axle.to_inner(point))).x;
  Rolling out;
  const Vec3 slip = m.turned_back(rail.velocity - wheel.velocity);
  const Vec3 spin = m.turned_back(rail.turn - wheel.turn);
  if (flag(base.settings, kTang) == 1) {
    out.speed = 1;
  } else if (!on_roller(base)) {
    const double along = wheel.velocity.x - rail.velocity.x - around;
    out.speed = 0.5 * (std::abs(along) + std::abs(around));
    const bool forward = std::abs(along) >= std::abs(around) ? along >= 0 : around <= 0;
    out.chi = forward ? 0 : std::numbers::pi;
  } else {
    const double roller = m.turned_back(rail.velocity).x, of_wheel = wheel.velocity.x;
    out.speed = 0.5 * std::abs(roller + m.turned_back(wheel.velocity).x);
    const bool forward = std::abs(roller) >= std::abs(of_wheel) ? roller <= 0 : of_wheel <= 0;
    out.chi = forward ? 0 : std::numbers::pi;
  }
  if (out.speed < 1e-9) return out;
  out.creepages = {slip.x / out.speed, slip.y / out.speed, spin.z / out.speed, 1};
  return out;
}

namespace {

/// Slip in the elements: the velocities of both surfaces along the line between their ways, in the rows' own systems.
class Surfaces {
 public:
  Surfaces(const ModuleOne& one, const Problem& base, const PatchPlane& plane, const Distance& distance)
      : one_(one), base_(base), plane_(plane), distance_(distance), shift_(flag(base.settings, kTang) == 1) {
    const auto& body = base.settings.materials.body;
    const double wheel = (1 - body[0].poisson) / body[0].shear(), rail = (1 - body[1].poisson) / body[1].shear();
    share_of_rail_ = rail / (rail + wheel);
  }

  SurfaceSlip slip() const {
    SurfaceSlip out;
    // A shift goes over 1 mm in CONTACT, whatever the units are: only the direction of the ways depends on it.
    double along = shift_ ? 1e-3 : one_.wheelset.rate[0];
    if (!shift_ && on_roller(base_)) {
      const Vec3 at = plane_.reference.at;
      along =
          -0.5 * plane_.reference.turned_back(of_rail(one_, base_, at).velocity + of_wheel(one_, base_, at).velocity).x;
    }
    out.rolling.chi = along < 0 ? std::numbers::pi : 0;
    out.rolling.speed = shift_ ? 1 : std::abs(along);
    out.rolling.creepages.length = 1;
    const std::size_t n = distance_.gap.size();
    out.more_x.assign(n, 0.0);
    out.more_y.assign(n, 0.0);
    if (out.rolling.speed < 1e-9) return out;
    for (std::size_t k = 0; k < n; ++k) {
      const Vec2 way = at(k, along);
      out.more_x[k] = way.y / out.rolling.speed;
      out.more_y[k] = way.z / out.rolling.speed;
    }
    take_creepages(out);
    return out;
  }

 private:
  double x(std::size_t k) const {
    return plane_.x + static_cast<double>(k % static_cast<std::size_t>(plane_.mx)) * plane_.dx;
  }
  std::size_t row(std::size_t k) const { return k / static_cast<std::size_t>(plane_.mx); }
  bool is_there(std::size_t k) const { return distance_.has_both[k] != 0; }

  /// In the row's system, less the motion of the system along the rail.
  Vec3 own(const Vec3& velocity, std::size_t k, double along) const {
    Vec3 v = plane_.reference.turned_back(velocity);
    if (!plane_.rows.empty()) v = marker({}, plane_.rows[row(k)].turn).turned_back(v);
    if (!on_roller(base_)) v.x -= along;
    return v;
  }

  /// x and y of rail - wheel.
  Vec2 at(std::size_t k, double along) const {
    if (!is_there(k)) return {0, 0};
    const double s = plane_.across(static_cast<int>(row(k)));
    const auto point = [&](double n) { return plane_.reference.to_outer({x(k), s, n}); };
    const Vec3 rail = own(of_rail(one_, base_, point(distance_.rail[k])).velocity, k, along);
    const Vec3 wheel = own(of_wheel(one_, base_, point(distance_.wheel[k]), one_.flexibility.at[0]).velocity, k, along);
    const Vec3 middle = share_of_rail_ * rail + (1 - share_of_rail_) * wheel, apart = rail - wheel;
    const double size = std::hypot(middle.x, middle.z), forward = along < 0 ? -1 : 1;
    if (size < 1e-12) return {apart.x, apart.y};
    return {-forward * (apart.x * middle.x + apart.z * middle.z) / size, apart.y};
  }

  /// The creepages nearest to the slip where the bodies overlap, and what is left of it. The solution takes the spin a
  /// sixth of a step ahead, as CONTACT does.
  void take_creepages(SurfaceSlip& out) const {
    const double ahead = shift_ ? 0 : std::cos(out.rolling.chi) * one_.relative_step * plane_.dx / 6;
    const auto y = [&](std::size_t k) { return plane_.along_row(static_cast<int>(row(k))); };
    double count = 0, mean_x = 0, mean_y = 0, far = 0;
    double slip_x = 0, slip_y = 0, turning = 0;
    for (std::size_t k = 0; k < out.more_x.size(); ++k) {
      if (!is_there(k) || !(distance_.gap[k] < distance_.approach)) continue;
      const double a = x(k) + ahead, b = y(k);
      count += 1;
      mean_x += a;
      mean_y += b;
      far += a * a + b * b;
      slip_x += out.more_x[k];
      slip_y += out.more_y[k];
      turning += a * out.more_y[k] - b * out.more_x[k];
    }
    if (count == 0) return;
    for (double* sum : {&mean_x, &mean_y, &far, &slip_x, &slip_y, &turning}) *sum /= count;
    const double spread = far - mean_x * mean_x - mean_y * mean_y;
    Creepages& c = out.rolling.creepages;
    c.spin = spread > 1e-18 ? (turning + mean_y * slip_x - mean_x * slip_y) / spread : 0;
    c.x = slip_x + mean_y * c.spin;
    c.y = slip_y - mean_x * c.spin;
    for (std::size_t k = 0; k < out.more_x.size(); ++k) {
      out.more_x[k] -= is_there(k) ? c.x - y(k) * c.spin : 0;
      out.more_y[k] -= is_there(k) ? c.y + (x(k) + ahead) * c.spin : 0;
    }
  }

  const ModuleOne& one_;
  const Problem& base_;
  const PatchPlane& plane_;
  const Distance& distance_;
  bool shift_ = false;
  double share_of_rail_ = 0.5;
};

}  // namespace

SurfaceSlip surface_slip(const ModuleOne& one, const Problem& base, const PatchPlane& plane, const Distance& distance) {
  return Surfaces(one, base, plane, distance).slip();
}

}  // namespace railstrata::cntc
