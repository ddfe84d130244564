// Module 1: places, kinematics and the height under a load.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "cntc/drive.hpp"
#include "cntc/module_one.hpp"
#include "cntc/results.hpp"
#include "cntc/settings.hpp"

namespace railstrata::cntc {
namespace {

constexpr int kMostHeights = 60;

void require_settings(const ModuleOne& one, const Problem& base) {
  const auto missing = [](bool is_there, const char* what, const char* call) {
    if (!is_there) throw Refused(kOther, fmt::format("no {}: call {}", what, call));
  };
  if (!one.rail || !one.wheel) throw Refused(kProfile, "no rail or wheel profile: call cntc_setprofileinputfname");
  missing(one.has_track, "track", "cntc_settrackdimensions");
  missing(one.has_wheelset, "wheelset", "cntc_setwheelsetdimensions");
  missing(one.steps.dx > 0, "elements", "cntc_setpotcontact with icp = -1");
  missing(base.settings.has_materials, "materials", "cntc_setmaterialparameters");
  const auto refuse = [&](int code, int least, int most, const char* what) {
    const int value = flag(base.settings, code);
    if (value < least || value > most) throw Refused(kOther, fmt::format("{} = {}: {}", what, value, "is not offered"));
  };
  const int config = flag(base.settings, kConfiguration);
  if (config != 0 && config != 1 && config != 4 && config != 5)
    throw Refused(kOther, fmt::format("CONFIG = {}: 0 and 1 (rail), 4 and 5 (roller) are offered", config));
  if (on_roller(base) && !(one.track.roller_radius != 0))
    throw Refused(kOther, "a roller (CONFIG 4, 5) has a radius, NOMRAD of cntc_settrackdimensions");
  refuse(kForce, 0, 0, "total tangential forces, F");
  const int method = flag(base.settings, kDiscretisation) % 10;
  if (method > 2 && method != 5)
    throw Refused(
        kOther, fmt::format("D = {} (conformal, oblique or other contact search) is not offered: 2 and 5 are", method));
  if (flag(base.settings, kNorm) == 1 && !(one.load > 0))
    throw Refused(kOther, "no vertical force: call cntc_setverticalforce");
}

RigidPair place(ModuleOne& one, const Problem& base, double z) {
  const double side = side_of(base);
  const auto& shift = one.rail_shift;
  const TrackPlace& t = one.track;
  Vec3 at{0, side * t.y, t.z};
  if (t.gauge_depth > 0) {
    const GaugePoint gauge = gauge_point(*one.rail, t.cant, t.gauge_depth);
    at = {0, 0.5 * t.gauge - gauge.y, on_roller(base) ? 0 : -gauge.top};
  }
  one.found.rail_at = marker(at + Vec3{0, side * shift[0], shift[1]}, -t.cant + side * shift[2]);
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

Vec3 mirrored(Vec3 v, double side) { return {v.x, side * v.y, v.z}; }
Vec3 mirrored_turn(double roll, double pitch, double yaw, double side) { return {side * roll, pitch, side * yaw}; }

/// Velocity and rotation of the bodies at a point, in the axes of the patch.
struct Moving {
  Vec3 velocity, turn;
};

Moving of_rail(const ModuleOne& one, const Problem& base, const Marker& patch) {
  const double side = side_of(base), curvature = one.track.curvature;
  const auto& shift = one.rail_shift;
  const Vec3 arm = patch.at - one.found.rail_at.at;
  Moving out;
  if (!on_roller(base)) {
    const double turning = -side * one.wheelset.rate[0] * curvature;
    out.turn = {side * shift[5], 0, turning};
    out.velocity = Vec3{-turning * one.found.rail_at.at.y, side * shift[3], shift[4]} + cross(out.turn, arm);
    return out;
  }
  const Vec3 from_axle = patch.at - Vec3{0, 0, one.track.roller_radius};
  const Vec3 of_profile{side * shift[5], 0, 0};
  const double pitch = one.pitch_rate_of_roller;
  const Vec3 roller{0, pitch, -side * std::abs(from_axle.z) * pitch * curvature};
  out.turn = of_profile + roller;
  out.velocity = Vec3{0, side * shift[3], shift[4]} + cross(of_profile, arm) + cross(roller, from_axle);
  return out;
}

struct Rolling {
  double speed = 0, chi = 0;
  Creepages creepages;  ///< SI
};

/// (rail - wheel) over the mean of the wheel's way along the track and around its axle. [eve70a/CONTACT, user guide]
Rolling rolling(const ModuleOne& one, const Problem& base, const WheelRailPatch& patch) {
  const double side = side_of(base);
  const Marker& m = patch.plane.reference;
  const Vec3 point = m.at + patch.approach * m.axes[2];
  const Moving rail = of_rail(one, base, m);
  const auto &r = one.wheelset.rate, &f = one.flexibility.rate;
  const Vec3 in_wheelset = one.found.wheelset_at.to_inner(point);
  const Vec3 bending = mirrored_turn(f[3], f[5], f[4], side);
  const Vec3 own = mirrored({f[0], f[1], f[2]}, side) + cross(bending, in_wheelset - one.found.wheel_in_wheelset.at);
  const Vec3 turn = one.found.wheelset_at.turned(mirrored_turn(r[3], r[5], r[4], side));
  const Vec3 arm = one.found.wheelset_at.turned(in_wheelset);
  const Vec3 wheel = mirrored({r[0], r[1], r[2]}, side) + cross(turn, arm) + one.found.wheelset_at.turned(own);
  const double around = cross(one.found.wheelset_at.turned({0, r[5], 0}), arm).x;
  Rolling out;
  const Vec3 slip = m.turned_back(rail.velocity - wheel);
  const Vec3 spin = m.turned_back(rail.turn - turn - one.found.wheelset_at.turned(bending));
  const bool shift = flag(base.settings, kTang) == 1;
  if (shift) {
    out.speed = 1;
  } else if (!on_roller(base)) {
    const double along = wheel.x - rail.velocity.x - around;
    out.speed = 0.5 * (std::abs(along) + std::abs(around));
    const bool forward = std::abs(along) >= std::abs(around) ? along >= 0 : around <= 0;
    out.chi = forward ? 0 : std::numbers::pi;
  } else {
    const double roller = m.turned_back(rail.velocity).x;
    out.speed = 0.5 * std::abs(roller + m.turned_back(wheel).x);
    const bool forward = std::abs(roller) >= std::abs(wheel.x) ? roller <= 0 : wheel.x <= 0;
    out.chi = forward ? 0 : std::numbers::pi;
  }
  if (out.speed < 1e-9) return out;
  out.creepages = {slip.x / out.speed, slip.y / out.speed, spin.z / out.speed, 1};
  return out;
}

std::vector<double> numbers_at(const std::vector<FrictionSlice>& slices, double at) {
  std::size_t k = 0;
  while (k + 1 < slices.size() && slices[k + 1].at <= at) ++k;
  const FrictionSlice &a = slices[k], &b = slices[std::min(k + 1, slices.size() - 1)];
  const double share = b.at > a.at ? std::clamp((at - a.at) / (b.at - a.at), 0.0, 1.0) : 0;
  std::vector<double> out(a.numbers.size());
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = a.numbers[i] + share * (b.numbers[i] - a.numbers[i]);
  return out;
}

/// Parts of a patch, regions of overlap that lie between D_COMB and D_SEP apart: the pressure of one depresses another
/// by a share of what a half-space would, so that two patches grow into one without a jump. [eve70a/CONTACT, user
/// guide]
class Parts {
 public:
  Parts(const WheelRailPatch& patch, const SearchSteps& steps) : boxes_(patch.overlap.parts), steps_(steps) {
    const PatchPlane& plane = patch.plane;
    const double more = 0.4 * steps.combine, slope = std::cos(plane.angle);
    for (int j = 0; j < plane.my; ++j)
      for (int i = 0; i < plane.mx; ++i) {
        const double x = plane.reference.at.x + plane.x + i * plane.dx;
        const double y = plane.reference.at.y + (plane.s + j * plane.ds) * slope;
        const auto holds = [&](const Box& b) {
          return x >= b.x[0] - more && x <= b.x[1] + more && y >= b.y[0] - more * slope && y <= b.y[1] + more * slope;
        };
        part_.push_back(static_cast<std::size_t>(std::find_if(boxes_.begin(), boxes_.end(), holds) - boxes_.begin()));
      }
  }

  /// Solves without friction until the gap of each part, less what the others do not do to it, is settled.
  void settle(Problem& problem) const {
    constexpr double kSettled = 1e-7, kBeside = 0.05;  // of the approach; m
    constexpr int kMostTurns = 50;
    std::vector<double>& gap = problem.settings.gap.value;
    for (std::size_t k = 0; k < gap.size(); ++k)
      if (part_[k] == boxes_.size()) gap[k] = kBeside;
    const std::vector<double> rigid = gap;
    const int friction = std::exchange(problem.settings.flags[kTang], 0);
    for (int turn = 0; turn < kMostTurns; ++turn) {
      std::vector<std::string> remarks;
      solve(problem, remarks);
      const std::vector<double> missing = missing_depression(*problem.solved);
      double change = 0;
      for (std::size_t k = 0; k < gap.size(); ++k) {
        const double next = rigid[k] - missing[k];
        change = std::max(change, std::abs(next - gap[k]));
        gap[k] = next;
      }
      if (change <= kSettled * problem.settings.approach) break;
    }
    problem.settings.flags[kTang] = friction;
  }

 private:
  std::vector<double> missing_depression(const Solved& s) const {
    const PatchGrid& g = s.on.grid;
    std::vector<double> out(g.size(), 0.0);
    const auto element = [&](int i, int j) { return static_cast<std::size_t>(i + g.nx * j); };
    for (std::size_t b = 0; b < boxes_.size(); ++b) {
      Plane pressure(g.size(), 0.0), depression(g.size());
      for (int i = 0; i < g.nx; ++i)
        for (int j = 0; j < g.ny; ++j)
          if (part_[element(i, j)] == b) pressure[g.index(i, j)] = s.rolling.normal.pressure[g.index(i, j)];
      s.influence->normal(pressure.data(), depression.data());
      for (int i = 0; i < g.nx; ++i)
        for (int j = 0; j < g.ny; ++j) {
          const std::size_t a = part_[element(i, j)];
          if (a == b || a == boxes_.size()) continue;
          out[element(i, j)] += (1 - interaction(boxes_[a], boxes_[b], steps_)) * depression[g.index(i, j)];
        }
    }
    return out;
  }

  const std::vector<Box>& boxes_;
  const SearchSteps& steps_;
  std::vector<std::size_t> part_;  ///< of each element; the number of parts: of none
};

class Wheel {
 public:
  Wheel(ModuleOne& one, Problem& base, PatchProblems& problems, std::vector<std::string>& remarks)
      : one_(one), base_(base), problems_(problems), remarks_(remarks) {}

  void run() {
    require_settings(one_, base_);
    keep_before();
    one_.found.patches.clear();
    if (flag(base_.settings, kNorm) == 0)
      press(one_.wheelset.at[2], true);
    else
      sink();
  }

 private:
  /// The patches of the case before, which P = 0 goes on from, whatever heights are tried.
  void keep_before() {
    for (std::size_t k = 0; k < one_.found.patches.size(); ++k) {
      Problem& problem = problems_.patch(static_cast<int>(k) + 1);
      if (problem.solved && flag(base_.settings, kTime) == 0) {
        put_on_lattice(one_.found.patches[k], problem.solved->on.grid);
        before_.push_back({one_.found.patches[k].overlap.extent, std::move(problem.solved)});
      }
      problem.solved.reset();
    }
  }

  /// Elements of steady rolling, centred on their patch, get the nearest places of those that stay on the rail.
  void put_on_lattice(const WheelRailPatch& patch, PatchGrid& g) const {
    const PatchPlane& plane = patch.plane;
    if (!lattice() || plane.origin_x != 0 || plane.origin_s != 0) return;
    const double x = flag(base_.settings, kTang) == 1 ? patch.along : plane.reference.at.x;
    g.x0 += std::round(x / g.dx) * g.dx;
    g.y0 += std::round(patch.across / g.dy) * g.dy;
  }

  /// The state before of a patch: of those that its stretch of the rail meets.
  std::optional<Solved> before(const Box& extent) const {
    const auto meets = [&](const Before& b) { return b.extent.y[0] <= extent.y[1] && extent.y[0] <= b.extent.y[1]; };
    std::optional<Solved> out;
    for (const Before& b : before_)
      if (meets(b)) out = out ? joined(*out, *b.solved) : b.solved;
    return out;
  }

  /// Where elements keep their places: on the rail in a shift, over the track's origin in transient rolling.
  Lattice lattice() const {
    const int tang = flag(base_.settings, kTang);
    return tang == 1 ? Lattice(one_.wheelset.at[0]) : tang == 2 ? Lattice(0.0) : std::nullopt;
  }

  /// The patches of the wheel at the height z; the vertical force on the rail.
  double press(double z, bool with_friction) {
    one_.wheelset.at[2] = z;
    const RigidPair pair = place(one_, base_, z);
    const Search search = search_overlaps(pair, one_.steps);
    one_.found.patches.clear();
    if (search.overlaps.size() > kMostProblems)
      throw Refused(kSearch, fmt::format("{} patches are more than {}", search.overlaps.size(), kMostProblems));
    double force = 0;
    for (const Overlap& overlap : search.overlaps) {
      WheelRailPatch patch;
      patch.overlap = overlap;
      patch.plane = plane_of(overlap, pair, one_.steps, flag(base_.settings, kMostCells), lattice());
      Distance distance = rigid_distance(pair, patch.plane);
      patch.approach = distance.approach;
      patch.on_wheel = seen_from(pair.wheel_at, patch.plane.reference);
      patch.on_rail = seen_from(pair.rail_at, patch.plane.reference);
      patch.along = one_.wheelset.at[0] + patch.plane.reference.at.x;
      patch.across = one_.rail->arc(patch.on_rail.at.y) - one_.rail->zero_arc();
      one_.found.patches.push_back(std::move(patch));
      force += solve_patch(static_cast<int>(one_.found.patches.size()), std::move(distance.gap), with_friction,
                           pair.wheel_at);
    }
    return force;
  }

  double solve_patch(int number, std::vector<double> gap, bool with_friction, const Marker& wheel) {
    WheelRailPatch& patch = one_.found.patches[static_cast<std::size_t>(number - 1)];
    Problem& problem = problems_.patch(number);
    const PatchPlane& plane = patch.plane;
    problem.units = base_.units;
    problem.side = side_of(base_);
    problem.settings = base_.settings;
    Settings& s = problem.settings;
    problem.origin_x = plane.origin_x;
    problem.origin_y = plane.origin_s;
    problem.broken = false;
    s.grid = {3, plane.mx, plane.my, {plane.x + plane.origin_x, plane.s + plane.origin_s, plane.dx, plane.ds}};
    s.gap = {9, 0, 0, std::move(gap)};
    s.flags[kNorm] = 0;
    s.flags[kTang] = with_friction ? flag(base_.settings, kTang) : 0;
    s.approach = patch.approach;
    const Rolling moving = rolling(one_, base_, patch);
    s.creepages = moving.creepages;
    s.creepages.x += moving.creepages.spin * plane.origin_s;
    s.creepages.y -= moving.creepages.spin * plane.origin_x;
    s.chi = moving.chi;
    s.speed = std::max(moving.speed, 1e-12);
    s.step = one_.relative_step * plane.dx;
    if (one_.varies > 0)
      set_friction(problem, one_.friction_digit,
                   numbers_at(one_.slices, one_.varies == 1 ? patch.on_wheel.roll() : one_.wheelset.at[0]));
    if (patch.overlap.parts.size() > 1) Parts(patch, one_.steps).settle(problem);
    problem.solved = before(patch.overlap.extent);
    s.flags[kTime] = problem.solved ? 0 : 2;
    std::vector<std::string> remarks;
    solve(problem, remarks);
    if (with_friction) remarks_.insert(remarks_.end(), remarks.begin(), remarks.end());
    add_up(patch, problem, wheel);
    return patch.force.z;
  }

  void add_up(WheelRailPatch& patch, const Problem& problem, const Marker& wheel) const {
    const Resultant on_rail = resultant(problem);
    const Marker& m = patch.plane.reference;
    patch.force = m.turned(on_rail.force);
    const Vec3 moment = m.turned(on_rail.moment);
    patch.moment_on_rail = cross(m.at - one_.found.rail_at.at, patch.force) + moment;
    patch.force_of_wheelset = one_.found.wheelset_at.turned_back(patch.force);
    patch.moment_on_wheel = one_.found.wheelset_at.turned_back(cross(m.at - wheel.at, patch.force) + moment);
  }

  /// The height under the load: F = k (z - z_0)^(3/2) through the last heights, between heights that bracket it.
  void sink() {
    const double load = one_.load, touching = search_overlaps(place(one_, base_, 0), one_.steps).least_gap;
    constexpr double kFirst = 5e-5;  // m
    const bool near = flag(base_.settings, kTime) == 0 || flag(base_.settings, kEstimate) > 0;
    double low = touching, high = touching, z = touching + (near && one_.found.sunk > 0 ? one_.found.sunk : kFirst);
    double force = 0;
    bool bracketed = false;
    for (int k = 0; k < kMostHeights; ++k) {
      force = press(z, true);
      one_.found.sunk = z - touching;
      if (std::abs(force - load) <= base_.settings.tolerance * load) return;
      if (force < load)
        low = std::max(low, z);
      else {
        high = z;
        bracketed = true;
      }
      const double sunk = z - touching;
      double next = touching + (force > 0 ? sunk * std::pow(load / force, power(z - touching, force)) : 2 * sunk);
      next = std::min(next, touching + 4 * sunk);
      if (bracketed && !(next > low && next < high)) next = 0.5 * (low + high);
      if (!bracketed && next <= low) next = low + 0.5 * sunk;
      if (std::abs(next - z) < 1e-13) return;
      z = next;
    }
    throw Refused(kTotalForce, fmt::format("no height of the wheelset was found for the vertical force {:g}", load));
  }

  /// 1/n of F = k sunk^n through this height and the one before.
  double power(double sunk, double force) {
    double out = 2.0 / 3;
    if (last_force_ > 0 && force > 0 && force != last_force_ && sunk != last_sunk_)
      out = std::clamp(std::log(sunk / last_sunk_) / std::log(force / last_force_), 0.1, 1.5);
    last_sunk_ = sunk;
    last_force_ = force;
    return out;
  }

  struct Before {
    Box extent;
    std::optional<Solved> solved;
  };

  ModuleOne& one_;
  Problem& base_;
  PatchProblems& problems_;
  std::vector<Before> before_;
  std::vector<std::string>& remarks_;
  double last_sunk_ = 0, last_force_ = 0;
};

}  // namespace

void solve_wheel(ModuleOne& one, Problem& base, PatchProblems& problems, std::vector<std::string>& remarks) {
  Wheel(one, base, problems, remarks).run();
}

}  // namespace railstrata::cntc
