// Module 1: results in the caller's units.
#include <algorithm>
#include <cmath>
#include <utility>

#include "cntc/calls.hpp"
#include "cntc/module_one.hpp"
#include "cntc/results.hpp"
#include "record/unit.hpp"

namespace railstrata::cntc {
namespace {

/// Numbers at the places of CONTACT's lists, which begin at 1; unset ones are 0 as there.
class List {
 public:
  explicit List(std::size_t size) : values_(size, 0.0) {}
  void put(std::size_t first, std::initializer_list<double> values) {
    for (const double v : values) values_[first++ - 1] = v;
  }
  std::vector<double> take() { return std::move(values_); }

 private:
  std::vector<double> values_;
};

const WheelRailPatch* patch_of(const ModuleOne& one, int number) {
  return number >= 1 && number <= static_cast<int>(one.found.patches.size())
             ? &one.found.patches[static_cast<std::size_t>(number - 1)]
             : nullptr;
}

/// The centre of pressure, in the track.
Vec3 centre_of_pressure(const WheelRailPatch& patch, const Problem& problem) {
  const Resultant r = resultant(problem);
  const double n = r.force.z;
  return n > 0 ? patch.plane.reference.to_outer({-r.moment.y / n, r.moment.x / n, 0}) : patch.plane.reference.at;
}

}  // namespace

std::vector<double> contact_location(const ModuleOne& one, const Problem& base, const Problem& problem, int number) {
  List out(38);
  const WheelRailPatch* patch = patch_of(one, number);
  if (!patch) return out.take();
  const double side = side_of(base), length = base.units.length;
  const auto put = [&](std::size_t first, const Marker& m) {
    out.put(first, {m.at.x / length, side * m.at.y / length, m.at.z / length});
  };
  const Marker& m = patch->plane.reference;
  const auto arc = [&](const Outline& o, const Marker& at) { return o.arc(o.at(at.at.y).y) / length; };
  put(1, m);
  out.put(4, {side * m.roll()});
  put(5, patch->on_rail);
  out.put(8, {arc(*one.rail, patch->on_rail), side * patch->on_rail.roll()});
  put(10, patch->on_wheel);
  out.put(13, {-arc(*one.wheel, patch->on_wheel), side * patch->on_wheel.roll()});
  const Vec3 pressed = centre_of_pressure(*patch, problem);
  out.put(15, {pressed.x / length, side * pressed.y / length});
  out.put(18, {one.forces.rail.way[0] / length, one.forces.rail.way[1] / length});
  const Marker wheel = placed(one.found.wheelset_at, one.found.wheel_in_wheelset);
  put(21, wheel);
  out.put(24, {side * wheel.roll(), side * wheel.yaw()});
  out.put(26,
          {side * one.found.rail_at.at.y / length, one.found.rail_at.at.z / length, side * one.found.rail_at.roll()});
  const Marker in_wheelset = seen_from(one.found.wheelset_at, m);
  put(30, in_wheelset);
  out.put(33, {side * in_wheelset.roll()});
  put(34, one.found.wheel_in_wheelset);
  out.put(37, {side * one.found.wheel_in_wheelset.roll(), side * one.found.wheel_in_wheelset.yaw()});
  return out.take();
}

std::vector<double> global_forces(const ModuleOne& one, const Problem& base, int number) {
  List out(24);
  Vec3 track, on_rail, wheelset, on_wheel;
  const auto add = [&](const WheelRailPatch& p) {
    track += p.force;
    on_rail += p.moment_on_rail;
    wheelset += p.force_of_wheelset;
    on_wheel += p.moment_on_wheel;
  };
  if (number == -1)
    for (const WheelRailPatch& p : one.found.patches) add(p);
  else if (const WheelRailPatch* p = patch_of(one, number))
    add(*p);
  const double side = side_of(base), body = base.units.body, length = base.units.length;
  const auto put = [&](std::size_t first, Vec3 force, Vec3 moment) {
    out.put(first, {body * force.x, side * body * force.y, body * force.z});
    out.put(first + 3, {side * body * moment.x / length, body * moment.y / length, side * body * moment.z / length});
  };
  put(1, track, on_rail);
  put(7, wheelset, on_wheel);
  put(13, one.found.rail_at.turned_back(track), one.found.rail_at.turned_back(on_rail));
  put(19, one.found.wheel_in_wheelset.turned_back(wheelset), one.found.wheel_in_wheelset.turned_back(on_wheel));
  return out.take();
}

namespace {

/// Arc lengths of the points asked for: at the profile's own (isampl 0 and -1), at equal steps (1) or so many in each
/// interval.
std::vector<double> places(const Profile& p, int sampling, double step) {
  const std::vector<double>& knots = p.knots();
  if (sampling <= 0) return knots;
  std::vector<double> out;
  if (sampling == 1) {
    const int count = static_cast<int>((p.s_max() - p.s_min()) / step) + 1;
    for (int k = 0; k < count; ++k) out.push_back(p.s_min() + k * step);
    return out;
  }
  for (std::size_t k = 0; k + 1 < knots.size(); ++k)
    for (int i = 0; i < sampling; ++i) out.push_back(knots[k] + (knots[k + 1] - knots[k]) * i / sampling);
  out.push_back(knots.back());
  return out;
}

std::vector<double> gauge_values(const ModuleOne& one, const Problem& base) {
  const GaugePoint g = gauge_point(*one.rail, one.track.cant, one.track.gauge_depth);
  const double side = side_of(base), length = base.units.length;
  return {g.y / length,
          g.z / length,
          (side * (0.5 * one.track.gauge - g.y) + one.rail_shift[0]) / length,
          (one.rail_shift[1] - g.top) / length,
          g.y / length,
          (one.track.gauge_depth + g.top) / length};
}

}  // namespace

std::vector<double> profile_values(const ModuleOne& one, const Problem& base, int task, std::span<const int> ints,
                                   Numbers reals) {
  const bool of_wheel = !ints.empty() && ints[0] >= 1;
  const std::optional<Outline>& outline = of_wheel ? one.wheel : one.rail;
  if (task == -1) return {outline ? 0.0 : double{kProfile}, outline ? 0.0 : 1.0};
  if (!outline) throw Refused(kProfile, "there is no such profile: cntc_setprofileinputfname comes first");
  if (task == 3) {
    if (of_wheel) throw Refused(kProfile, "a gauge point is of the rail");
    return gauge_values(one, base);
  }
  if (task < 0 || task > 5) throw Refused(kProfile, "tasks -1 to 5 are offered: profiles do not vary");
  const Profile& p = outline->profile();
  // As in CONTACT: profiles in mm, whatever the units are.
  const double step = reals.empty() || reals[0] < 1e-4 ? 1.0 : reals[0];
  const std::vector<double> at = places(p, ints.size() > 1 ? ints[1] : 0, kMilli * step);
  if (task == 0) return {static_cast<double>(at.size())};
  std::vector<double> first, second;
  const Marker place = of_wheel ? placed(one.found.wheelset_at, one.found.wheel_in_wheelset) : one.found.rail_at;
  for (const double s : at) {
    const double inside = std::clamp(s, p.s_min(), p.s_max());
    const Outline::Point q = outline->along(inside);
    const Vec2 tangent = p.at(inside).tangent;
    Vec3 v{0, q.y, q.z};
    if (task == 2) {
      v = place.to_outer(v);
      v.y *= side_of(base);
    }
    first.push_back(task == 4 ? kToMilli * s : task == 5 ? std::atan2(-tangent.z, tangent.y) : kToMilli * v.y);
    second.push_back(kToMilli * v.z);
  }
  if (task <= 2) first.insert(first.end(), second.begin(), second.end());
  return first;
}

std::vector<double> wheelset_motion(const Motion& motion, const Problem& base, bool rates) {
  const auto& v = rates ? motion.rate : motion.at;
  const double length = base.units.length;
  return {v[0] / length, v[1] / length, v[2] / length, v[3], v[4], v[5]};
}

}  // namespace railstrata::cntc
