#include "bem/loaded_wheel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "bem/one_patch.hpp"
#include "core/faults.hpp"
#include "core/root.hpp"

namespace railstrata {

namespace {

void check_friction(const CaseSpec& spec, double load, double normal) {
  const double along = spec.drive.traction().value_or(0), across = spec.drive.lateral_traction_coefficient.value_or(0),
               wanted = std::hypot(along, across / lateral_friction_share(spec)) * load,
               available = spec.drive.friction_coefficient * normal;
  if (wanted == 0 || wanted < available) return;
  const std::string sideways = across == 0 ? "" : fmt::format(" along and {:g} across the rail", across);
  throw CaseError(fmt::format("a traction coefficient of {:g}{} needs {:.0f} N of friction; a friction coefficient of "
                              "{:g} provides at most {:.0f} N",
                              along, sideways, wanted, spec.drive.friction_coefficient, available),
                  "lower drive.traction_coefficient or raise drive.friction_coefficient",
                  across == 0 ? "drive.traction_coefficient" : "drive.lateral_traction_coefficient");
}

/// Whether the drive has forces, which count over the load.
bool forces_wanted(const CaseSpec& spec) {
  return spec.drive.friction_coefficient > 0 &&
         (spec.drive.traction().value_or(0) != 0 || spec.drive.lateral_traction_coefficient.value_or(0) != 0);
}

constexpr double kWedged = 0.02;  // of the slope without friction
constexpr int kMostIterations = 20;

struct LoadedPatch : PatchOnWheel {
  int load_iterations = 1;
  double power = kPowerOfHertz;  ///< of the descent in the vertical force
  bool wedged = false;           ///< the solution is that of the last normal load tried
};

/// Solves under a normal load or approach from the solution before, else from a neighbour, else on a new grid; and on a
/// new one where the patch reaches the edge of the other.
void solve_under(const NormalTarget& target, double weight, const OnePatch& one, const BemOptions& options,
                 LoadedPatch& out) {
  const auto solve = [&](const RollingSolution* start) {
    one.drive(weight, out.patch.contact);
    out.patch.contact.target = target;
    out.solution = solve_rolling(*out.patch.influence, out.patch.grid, out.patch.contact, options.rolling, start);
  };
  const bool laid = out.patch.influence && out.solution.normal.pressure.empty();
  if (!out.solution.normal.pressure.empty()) {
    solve(&out.solution);
    if (!out.solution.normal.touches_edge) return;
  } else if (!laid && one.starts_from_neighbour(options)) {
    out.patch = one.lay_on(options.neighbour->alone()->grid, target, options);
    solve(&options.neighbour->alone()->solution);
    if (!reaches_edge(out.patch.grid, out.solution.normal.pressure)) return;
  }
  if (!laid) out.patch = one.lay(target, options);
  solve(nullptr);
}

/// The patch on its grid in the plane as it stands now, with what was noted when the grid was laid.
CasePatch laid_again(const OnePatch& one, const NormalTarget& target, const BemOptions& options,
                     const CasePatch& before) {
  CasePatch out = one.lay_on(before.grid, target, options);
  out.notes = before.notes;
  return out;
}

/// The normal force to begin with [N]: with the lateral friction of a neighbour where that is the start.
double first_normal_load(const OnePatch& one, const CasePatch& laid, const BemOptions& options, double weight) {
  const bool near = !laid.influence && one.starts_from_neighbour(options);
  return normal_load(weight, near ? options.neighbour->alone()->solution.tangential.force_y : 0.0, one.plane());
}

/// Finds the normal force N with N cos(delta) - T_y(N) sin(delta) = G by secants (case_patch.hpp), in a plane that
/// stays: lateral friction T_y carries a share of the weight that grows with the contact angle, and itself depends on
/// N. Where that share grows as fast as N does, the slope of the left side is zero and no N is large enough: the wheel
/// is wedged. Where it carries so much that a secant would take away half of N or more, the next N is on the chord from
/// N = 0, which keeps it positive.
LoadedPatch balance_in_plane(const OnePatch& one, CasePatch laid, const BemOptions& options, double weight) {
  const double cosine = std::cos(one.plane().angle), sine = std::sin(one.plane().angle);
  double normal = first_normal_load(one, laid, options, weight), slope = cosine, previous_normal = 0,
         previous_excess = 0;
  LoadedPatch out;
  out.contact = one.plane();
  out.patch = std::move(laid);
  for (;; ++out.load_iterations) {
    solve_under({.load = normal}, weight, one, options, out);
    const double excess = normal * cosine - out.solution.tangential.force_y * sine - weight;
    if (std::abs(excess) <= options.balance * weight) return out;
    if (out.load_iterations > 1) slope = (excess - previous_excess) / (normal - previous_normal);
    out.wedged = !(slope > kWedged * cosine) || out.load_iterations == kMostIterations;
    if (out.wedged) return out;
    previous_normal = normal;
    previous_excess = excess;
    normal = excess > 0.5 * slope * normal ? normal * weight / (weight + excess) : normal - excess / slope;
  }
}

double vertical_force(const PatchOnWheel& p) {
  return p.solution.normal.load * std::cos(p.contact.angle) - p.solution.tangential.force_y * std::sin(p.contact.angle);
}

/// The same where the plane turns with the descent d of the wheel: by secants of V(d) = N cos(delta) - T_y sin(delta),
/// the plane and the approach those of d. It begins under the normal force that a plane nearby asks for, with Hertz's
/// slope, 1.5 V/d. Several contacts in one plane, which turns much with d, begin at a neighbour's descent with its
/// slope, but for forces of the drive, which may be more than friction bears at another d.
LoadedPatch balance_by_descent(OnePatch& one, CasePatch laid, const BemOptions& options, double weight, bool driven) {
  constexpr double kShareOfBalance = 0.1, kFinest = 1e-11;  // rad, of a plane that is kept
  const bool near = one.place().contacts.size() > 1 && !driven && !laid.influence && one.starts_from_neighbour(options);
  const double normal = first_normal_load(one, laid, options, weight);
  LoadedPatch out;
  out.patch = std::move(laid);
  out.contact = one.plane();
  if (near) out.power = options.neighbour->power;
  solve_under(near ? NormalTarget{{}, one.own_approach()} : NormalTarget{.load = normal}, weight, one, options, out);
  double excess = vertical_force(out) - weight,
         descent = near ? one.descent() : one.descent_at(out.solution.normal.approach),
         slope = out.power * (near ? weight + excess : weight) / descent;
  const double settled = std::max(kShareOfBalance * options.balance, kFinest);
  if (std::abs(excess) <= options.balance * weight) {
    one.lower(descent);
    if (std::abs(one.plane().angle - out.contact.angle) <= settled) return out;
  }
  for (;;) {
    const double previous_descent = descent, previous_excess = excess;
    descent -= std::clamp(excess / slope, -descent, 0.5 * descent);
    one.lower(descent);
    out.patch = laid_again(one, {{}, one.own_approach()}, options, out.patch);
    out.contact = one.plane();
    solve_under({{}, one.own_approach()}, weight, one, options, out);
    excess = vertical_force(out) - weight;
    if (++out.load_iterations > 2) slope = (excess - previous_excess) / (descent - previous_descent);
    if (std::abs(excess) <= options.balance * weight) {
      out.power = std::clamp(slope * descent / weight, 1.0, 3.0);
      return out;
    }
    const double usual = kPowerOfHertz * out.solution.normal.load * std::cos(out.contact.angle) / descent;
    out.wedged = !(slope > kWedged * usual) || out.load_iterations == kMostIterations;
    if (out.wedged) return out;
  }
}

std::size_t count_patches(const std::vector<ContactPlace>& places) {
  std::set<std::size_t> out;
  for (const ContactPlace& p : places) out.insert(p.patch);
  return out.size();
}

/// Of a neighbour with several solutions the last one of as many patches, else the first one, is where to start.
BemOptions starting_from(const BemOptions& options, const std::vector<ContactPlace>& places) {
  if (!options.neighbour || options.neighbour->others.empty()) return options;
  std::vector<BemNeighbour>& others = options.neighbour->others;
  const std::size_t patches = count_patches(places);
  const auto other =
      std::find_if(others.rbegin(), others.rend(), [&](const BemNeighbour& n) { return n.patches.size() == patches; });
  BemOptions out = options;
  if (other != others.rend()) out.neighbour = &*other;
  return out;
}

struct BorneLoad {
  SharedLoad load;
  std::vector<ContactPlace> places;  ///< that were looked at
  bool near_merging = false;         ///< as of share_load
};

/// Bears the load on patches of the places that count under a first descent.
BorneLoad bear_on_places(const CaseSpec& spec, const Placement& placement, const BemOptions& all_options,
                         std::optional<FirstPatch> first, double descent) {
  constexpr int kMostRounds = 5;
  const double load = spec.vehicle.load();
  for (int round = 1;; ++round) {
    BorneLoad out;
    out.places = places_of(spec, placement, descent);
    const BemOptions options = starting_from(all_options, out.places);
    SharedLoad& shared = out.load;
    shared = share_load(spec, placement, out.places, descent, options,
                        forces_wanted(spec) ? Merging::at_once : Merging::by_reach, out.near_merging);
    if (!shared.patches.empty()) return out;
    const bool as_laid = first && first->one.place().same_as(shared.alone);
    OnePatch one = as_laid ? first->one : OnePatch(spec, placement, shared.alone);
    if (!as_laid) one.lower(descent);
    CasePatch laid = as_laid ? std::move(first->laid) : CasePatch{};
    LoadedPatch alone = one.level() ? balance_in_plane(one, std::move(laid), options, load)
                                    : balance_by_descent(one, std::move(laid), options, load, forces_wanted(spec));
    if (alone.wedged) refuse_wedged("weight", alone.contact);
    first.reset();
    descent = one.level() ? one.descent_at(alone.solution.normal.approach) : one.descent();
    if (round < kMostRounds && places_of(spec, placement, descent).size() != shared.places) continue;
    shared.load_iterations = alone.load_iterations;
    shared.descent = descent;
    shared.power = alone.power;
    alone.contacts = std::move(shared.alone.contacts);
    alone.stretch = shared.alone.stretch;
    shared.patches.push_back(std::move(alone));
    return out;
  }
}

/// Fills `out` with its one patch. Under a given approach the vertical force F_z is a result. Forces of the drive count
/// over it: F_z and they are found in turn, from the frictionless contact on.
void press_alone(const CaseSpec& spec, const Placement& placement, double descent, const BemOptions& options,
                 SharedLoad& out) {
  constexpr int kMostRounds = 40;
  OnePatch one(spec, placement, out.alone);
  one.lower(descent);
  out.descent = descent;
  out.load_iterations = 1;
  out.patches.push_back({one.plane(), {}, {}, std::move(out.alone.contacts), out.alone.stretch});
  const NormalTarget target{{}, one.approach()};
  CasePatch& patch = out.patches.front().patch;
  RollingSolution& solution = out.patches.front().solution;
  if (!forces_wanted(spec) && one.starts_from_neighbour(options)) {
    patch = one.lay_on(options.neighbour->alone()->grid, target, options);
    one.drive(0, patch.contact);
    solution = solve_rolling(*patch.influence, patch.grid, patch.contact, options.rolling,
                             &options.neighbour->alone()->solution);
    if (!reaches_edge(patch.grid, solution.normal.pressure)) return;
  }
  patch = one.lay(target, options);
  const double cosine = std::cos(one.plane().angle), sine = std::sin(one.plane().angle);
  double vertical = cosine * patch.frictionless.load;
  for (;; ++out.load_iterations) {
    one.drive(vertical, patch.contact);
    solution = solve_rolling(*patch.influence, patch.grid, patch.contact, options.rolling,
                             out.load_iterations > 1 ? &solution : nullptr);
    const double before = vertical;
    vertical = cosine * solution.normal.load - sine * solution.tangential.force_y;
    const bool driven = patch.contact.x.force.value_or(0) != 0 || patch.contact.y.force.value_or(0) != 0;
    if (!driven || std::abs(vertical - before) <= options.balance * std::abs(vertical)) return;
    if (out.load_iterations == kMostRounds)
      throw CaseError("the ratio of forces to the resulting load does not converge with a given approach",
                      "lower the traction coefficients, or give a load instead of vehicle.approach",
                      "vehicle.approach");
  }
}

/// A way to group the places that is still to be solved, of the patches that it came from by merging.
struct Pending {
  Grouping grouping;
  std::vector<std::vector<BemStart>> smooth{};
};

/// In order of the number of patches, the most first; the shares of equal ones are added.
void add(Pending one, std::vector<Pending>& all) {
  const std::size_t patches = count_patches(one.grouping.places);
  for (auto it = all.begin(); it != all.end(); ++it) {
    if (agrees(it->grouping.places, one.grouping.places)) {
      it->grouping.share += one.grouping.share;
      if (it->smooth.empty()) it->smooth = std::move(one.smooth);
      return;
    }
    if (count_patches(it->grouping.places) < patches) {
      all.insert(it, std::move(one));
      return;
    }
  }
  all.push_back(std::move(one));
}

/// Solves every way to group the places under a descent, and what of their patches is merged.
std::vector<SharedLoad> press_together(const CaseSpec& spec, const Placement& placement, double descent,
                                       const BemOptions& options) {
  std::vector<Pending> pending;
  for (Grouping& grouping : groupings_of(spec, placement, descent)) {
    put_in_order(grouping.places);
    add({std::move(grouping)}, pending);
  }
  std::vector<SharedLoad> out;
  while (!pending.empty()) {
    const Pending now = std::move(pending.front());
    pending.erase(pending.begin());
    const std::vector<ContactPlace>& places = now.grouping.places;
    const BemOptions how = starting_from(options, places);
    SharedLoad one = share_between(spec, placement, places, descent, how, Merging::by_reach, now.smooth);
    const double share = one.meet ? share_merged(*one.meet) : 0;
    if (share > 0) add({{share * now.grouping.share, merged(places, *one.meet)}, one.smooth}, pending);
    if (share == 1 && one.meet->reach > kSurelyOne) continue;
    one.share = (1 - share) * now.grouping.share;
    if (one.patches.empty()) press_alone(spec, placement, descent, how, one);
    out.push_back(std::move(one));
  }
  return out;
}

std::vector<SharedLoad> press_to_approach(const CaseSpec& spec, const Placement& placement, const BemOptions& options) {
  const double descent = options.descent > 0 ? options.descent : descent_of(placement, *spec.vehicle.approach);
  if (!forces_wanted(spec)) return press_together(spec, placement, descent, options);
  require_one_plane(
      placement, *spec.vehicle.approach, "vehicle.approach",
      "give creepages instead of forces, or a load instead of vehicle.approach: the contacts share the force");
  std::vector<SharedLoad> out(1);
  out[0].alone = first_place(spec, placement, descent);
  press_alone(spec, placement, descent, options, out[0]);
  return out;
}

/// The descent at which the mean of all groupings bears the load, near one: a root of a continuous force. Nothing where
/// none is found.
std::vector<SharedLoad> sink_under_load(const CaseSpec& spec, const Placement& placement, const BemOptions& options,
                                        double near) {
  constexpr int kMostSteps = 30;
  constexpr double kSharper = 0.1, kFirstStep = 1e-3, kSame = 1e-14;  // of the tolerance; of the descent; m
  const double load = spec.vehicle.load(), close = options.balance * load;
  CaseSpec pressed = spec;
  BemNeighbour last = options.neighbour ? *options.neighbour : BemNeighbour{};
  BemOptions how = options;
  how.balance *= kSharper;
  how.neighbour = &last;
  std::vector<SharedLoad> out;
  double missed = 0;
  const auto excess = [&](double descent) {
    pressed.vehicle.approach = descent * std::cos(reference_of(placement, descent).angle);
    how.descent = descent;
    out = press_to_approach(pressed, placement, how);
    last = neighbour_of(out);
    how.keep_cells = true;
    missed = -load;
    for (const SharedLoad& one : out)
      for (const PatchOnWheel& p : one.patches) missed += one.share * vertical_force(p);
    return missed;
  };
  double a = near, at_a = excess(a), step = (at_a < 0 ? kFirstStep : -kFirstStep) * near;
  if (std::abs(at_a) <= close) return out;
  for (int i = 0; i < kMostSteps; ++i, step *= 2) {
    const double b = a + step, at_b = b > 0 ? excess(b) : -load;
    if (std::abs(at_b) <= close) return out;
    if (at_a * at_b < 0) {
      narrow_root(a, at_a, b, at_b, close, kSame, kMostSteps, excess);
      return std::abs(missed) <= close ? std::move(out) : std::vector<SharedLoad>{};
    }
    if (!(b > 0)) break;
    a = b;
    at_a = at_b;
  }
  return {};
}

/// The groupings of the places are those under the descent that is found; where this one is on the way between two, the
/// mean bears the load. Forces of the drive, which may be more than friction bears at another descent, keep those under
/// the first descent.
std::vector<SharedLoad> bear_weight(const CaseSpec& spec, const Placement& placement, const BemOptions& options) {
  constexpr int kMostRounds = 3;
  const double load = spec.vehicle.load();
  check_friction(spec, load, normal_load(load, 0, placement.contact));
  std::optional<FirstPatch> first;
  if (!options.neighbour || options.neighbour->empty()) first.emplace(press_first(spec, placement, options));
  double descent = first ? first->one.descent_at(first->laid.frictionless.approach) : options.neighbour->descent;
  BorneLoad borne;
  for (int round = 1;; ++round) {
    borne = bear_on_places(spec, placement, options, std::exchange(first, std::nullopt), descent);
    descent = borne.load.descent;
    const std::vector<Grouping> there = forces_wanted(spec) || borne.places.size() == 1
                                            ? std::vector<Grouping>{}
                                            : groupings_of(spec, placement, descent);
    const bool agreed = there.empty() || (there.size() == 1 && agrees(borne.places, there.front().places));
    if (agreed && !borne.near_merging) break;
    if (!agreed && there.size() == 1 && round < kMostRounds) continue;
    std::vector<SharedLoad> sunk = sink_under_load(spec, placement, options, descent);
    if (sunk.empty()) break;
    return sunk;
  }
  std::vector<SharedLoad> out;
  out.push_back(std::move(borne.load));
  return out;
}

}  // namespace

std::vector<SharedLoad> loaded_wheel(const CaseSpec& spec, const Placement& placement, const BemOptions& options) {
  return spec.vehicle.approach ? press_to_approach(spec, placement, options) : bear_weight(spec, placement, options);
}

BemNeighbour neighbour_of(std::vector<SharedLoad> solved) {
  BemNeighbour out;
  for (SharedLoad& one : solved) {
    const RailStretch all, &stretch = one.patches.front().stretch;
    const bool whole = one.patches.size() == 1 && stretch.low == all.low && stretch.high == all.high;
    BemNeighbour n{{}, one.descent, one.power, one.along, one.across, whole, std::move(one.smooth), {}};
    for (PatchOnWheel& p : one.patches) n.patches.push_back({p.patch.grid, std::move(p.solution), p.contact.rail_s});
    if (&one == &solved.front())
      out = std::move(n);
    else
      out.others.push_back(std::move(n));
  }
  return out;
}

}  // namespace railstrata
