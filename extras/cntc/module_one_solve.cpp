// Module 1: places, kinematics and the height under a load.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "cntc/curved_patch.hpp"
#include "cntc/drive.hpp"
#include "cntc/module_one.hpp"
#include "cntc/results.hpp"
#include "cntc/settings.hpp"
#include "cntc/wheel_balance.hpp"
#include "cntc/wheel_motion.hpp"
#include "cntc/within_search.hpp"

namespace railstrata::cntc {
namespace {

constexpr int kOnSurfaces = 3, kConformal = 4;

int method_of(const Problem& base) { return flag(base.settings, kDiscretisation) % 10; }

void require_method(const Problem& base) {
  const int method = method_of(base);
  if (method > 5)
    throw Refused(kOther, fmt::format("D = {}: oblique and other searches are not offered, 2 to 5 are", method));
  if (method == kConformal && on_roller(base)) throw Refused(kOther, "D = 4, conformal contact, is offered on a rail");
}

void require_settings(const ModuleOne& one, const Problem& base) {
  const auto missing = [](bool is_there, const char* what, const char* call) {
    if (!is_there) throw Refused(kOther, fmt::format("no {}: call {}", what, call));
  };
  if (!one.rail || !one.wheel) throw Refused(kProfile, "no rail or wheel profile: call cntc_setprofileinputfname");
  missing(one.has_track, "track", "cntc_settrackdimensions");
  missing(one.has_wheelset, "wheelset", "cntc_setwheelsetdimensions");
  missing(one.steps.dx > 0, "elements", "cntc_setpotcontact with icp = -1");
  missing(base.settings.has_materials, "materials", "cntc_setmaterialparameters");
  const int config = flag(base.settings, kConfiguration);
  if (config != 0 && config != 1 && config != 4 && config != 5)
    throw Refused(kOther, fmt::format("CONFIG = {}: 0 and 1 (rail), 4 and 5 (roller) are offered", config));
  if (on_roller(base) && !(one.track.roller_radius != 0))
    throw Refused(kOther, "a roller (CONFIG 4, 5) has a radius, NOMRAD of cntc_settrackdimensions");
  require_method(base);
  if (flag(base.settings, kNorm) == 1 && !(one.forces.load > 0))
    throw Refused(kOther, "no vertical force: call cntc_setverticalforce");
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
    const double more = 0.4 * steps.combine;
    for (int j = 0; j < plane.my; ++j) {
      const CurvedRow row =
          plane.rows.empty() ? CurvedRow{plane.across(j), 0, 0} : plane.rows[static_cast<std::size_t>(j)];
      const double slope = std::cos(plane.angle + row.turn), y = plane.reference.to_outer({0, row.s, row.n}).y;
      for (int i = 0; i < plane.mx; ++i) {
        const double x = plane.reference.at.x + plane.x + i * plane.dx;
        const auto holds = [&](const Box& b) {
          return x >= b.x[0] - more && x <= b.x[1] + more && y >= b.y[0] - more * slope && y <= b.y[1] + more * slope;
        };
        part_.push_back(static_cast<std::size_t>(std::find_if(boxes_.begin(), boxes_.end(), holds) - boxes_.begin()));
      }
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
    balance(one_, base_,
            {[this](double z) { return press(z); },
             [this] { return search_overlaps(place(one_, base_, 0), one_.steps).least_gap; }});
    std::vector<Overlap> found;
    for (const WheelRailPatch& patch : one_.found.patches) found.push_back(patch.overlap);
    if (!on_roller(base_)) require_found(place(one_, base_, one_.wheelset.at[2]), found);
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
  double press(double z) {
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
      if (method_of(base_) == kConformal) bend(patch.plane, overlap, pair);
      // As in CONTACT, which discards tractions outside of a patch under a given height.
      const bool keeps = lattice() && flag(base_.settings, kNorm) == 1;
      const More added = keeps ? more_to_cover(patch.plane, before(overlap.extent)) : More{};
      widen(patch.plane, added);
      Distance distance = rigid_distance(pair, patch.plane);
      take_apart(distance, patch.plane, added);
      patch.approach = distance.approach;
      patch.on_wheel = seen_from(pair.wheel_at, patch.plane.reference);
      patch.on_rail = seen_from(pair.rail_at, patch.plane.reference);
      patch.along = one_.wheelset.at[0] + patch.plane.reference.at.x;
      patch.across = one_.rail->arc(patch.on_rail.at.y) - one_.rail->zero_arc();
      one_.found.patches.push_back(std::move(patch));
      force += solve_patch(static_cast<int>(one_.found.patches.size()), distance, pair.wheel_at);
    }
    return force;
  }

  /// The elements that were in contact before are needed for what they do to those of now.
  static More more_to_cover(const PatchPlane& plane, const std::optional<Solved>& before) {
    if (!before) return {};
    const PatchGrid& g = before->on.grid;
    const Plane& pressure = before->rolling.normal.pressure;
    const long x0 = std::lround((g.x0 - plane.x - plane.origin_x) / plane.dx);
    const long s0 = std::lround((g.y0 - plane.s - plane.origin_s) / plane.ds);
    More by;
    for (int i = 0; i < g.nx; ++i)
      for (int j = 0; j < g.ny; ++j) {
        if (!(pressure[g.index(i, j)] > 0)) continue;
        const int x = static_cast<int>(x0) + i, s = static_cast<int>(s0) + j;
        by.before = std::max(by.before, -x);
        by.behind = std::max(by.behind, x - plane.mx + 1);
        by.below = std::max(by.below, -s);
        by.above = std::max(by.above, s - plane.my + 1);
      }
    return by;
  }

  /// Nothing touches in the elements that were added: there may be another patch.
  static void take_apart(Distance& distance, const PatchPlane& plane, const More& added) {
    constexpr double kApart = 0.05;  // m
    double least = kApart;
    for (int j = 0; j < plane.my; ++j)
      for (int i = 0; i < plane.mx; ++i) {
        double& gap = distance.gap[static_cast<std::size_t>(i + plane.mx * j)];
        const bool own_x = i >= added.before && i < plane.mx - added.behind;
        if (own_x && j >= added.below && j < plane.my - added.above)
          least = std::min(least, gap);
        else
          gap = kApart;
      }
    for (double& gap : distance.gap) gap -= least;
    distance.approach -= least;
  }

  double solve_patch(int number, const Distance& distance, const Marker& wheel) {
    WheelRailPatch& patch = one_.found.patches[static_cast<std::size_t>(number - 1)];
    Problem& problem = problems_.patch(number);
    const PatchPlane& plane = patch.plane;
    problem.units = base_.units;
    problem.side = side_of(base_);
    problem.settings = base_.settings;
    problem.rows = plane.rows;
    Settings& s = problem.settings;
    problem.origin_x = plane.origin_x;
    problem.origin_y = plane.origin_s;
    problem.broken = false;
    s.grid = {3, plane.mx, plane.my, {plane.x + plane.origin_x, plane.s + plane.origin_s, plane.dx, plane.ds}};
    s.gap = {9, 0, 0, distance.gap};
    s.flags[kNorm] = s.flags[kForce] = 0;
    s.flags[kTang] = flag(base_.settings, kTang);
    s.approach = patch.approach;
    set_motion(patch, distance, s);
    if (one_.varies > 0) set_slice(patch, problem);
    if (patch.overlap.parts.size() > 1) Parts(patch, one_.steps).settle(problem);
    problem.solved = before(patch.overlap.extent);
    s.flags[kTime] = problem.solved ? 0 : 2;
    solve(problem, remarks_);
    add_up(patch, problem, wheel);
    return patch.force.z;
  }

  void set_motion(const WheelRailPatch& patch, const Distance& distance, Settings& s) const {
    const PatchPlane& plane = patch.plane;
    const int method = method_of(base_);
    Rolling moving;
    if (method == kOnSurfaces || method == kConformal) {
      SurfaceSlip slip = surface_slip(one_, base_, plane, distance);
      moving = slip.rolling;
      s.flags[kExtraSlip] = 1;
      // As the interface has it: of a shift in mm.
      const double unit = flag(base_.settings, kTang) == 1 ? 1e3 : 1;
      for (std::vector<double>* part : {&slip.more_x, &slip.more_y})
        for (double& value : *part) value *= unit;
      s.extra_x = std::move(slip.more_x);
      s.extra_y = std::move(slip.more_y);
    } else {
      moving = rolling(one_, base_, patch);
    }
    s.creepages = moving.creepages;
    s.creepages.x += moving.creepages.spin * plane.origin_s;
    s.creepages.y -= moving.creepages.spin * plane.origin_x;
    s.chi = moving.chi;
    s.speed = std::max(moving.speed, 1e-12);
    s.step = one_.relative_step * plane.dx;
  }

  /// Friction by the inclination or the place; of a curved patch each row has its own.
  void set_slice(const WheelRailPatch& patch, Problem& problem) const {
    const bool by_angle = one_.varies == 1;
    const double at = by_angle ? patch.on_wheel.roll() : one_.wheelset.at[0];
    set_friction(problem, one_.friction_digit, numbers_at(one_.slices, at));
    if (!by_angle || patch.plane.rows.empty()) return;
    if (one_.friction_digit != 0)
      throw Refused(kFriction,
                    "friction by the inclination (V = 1) of a conformal contact (D = 4) is offered with L = 0");
    for (const CurvedRow& row : patch.plane.rows) {
      const std::vector<double> numbers = numbers_at(one_.slices, patch.plane.angle + row.turn);
      problem.settings.row_friction.push_back(std::max(1e-6, std::min(numbers[0], numbers[1])));
    }
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

  struct Before {
    Box extent;
    std::optional<Solved> solved;
  };

  ModuleOne& one_;
  Problem& base_;
  PatchProblems& problems_;
  std::vector<Before> before_;
  std::vector<std::string>& remarks_;
};

}  // namespace

void solve_wheel(ModuleOne& one, Problem& base, PatchProblems& problems, std::vector<std::string>& remarks) {
  Wheel(one, base, problems, remarks).run();
}

}  // namespace railstrata::cntc
