#include "cntc/drive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "cntc/discretise.hpp"
#include "cntc/moved_state.hpp"
#include "cntc/simplified.hpp"
#include "cntc/viscoelastic.hpp"
#include "core/faults.hpp"
#include "friction/falling_friction.hpp"

namespace railstrata::cntc {
namespace {

constexpr int kFrictionless = 0, kShift = 1, kTransient = 2;

/// Keys of a case as the numbers that a caller has set.
std::string in_words_of_contact(std::string text) {
  constexpr std::pair<std::string_view, std::string_view> kWords[] = {
      {"friction.memory_distance", "MEMDST"},   {"friction.half_velocity", "SABSH1"},
      {"friction.kinetic_coefficient", "FKIN"}, {"friction.law", "the L-digit"},
      {"friction.temperature_table", "DFHEAT"}, {"third_body.hardening", "K_TAU"},
      {"third_body.yield_shear", "TAU_C0"},     {"drive.friction_coefficient", "FSTAT"},
      {"drive.creepage", "a creepage (F = 0)"}, {"drive.speed", "VELOC"}};
  for (const auto& [key, word] : kWords)
    for (std::size_t at = text.find(key); at != std::string::npos; at = text.find(key, at + word.size()))
      text.replace(at, key.size(), word);
  return text;
}

PlanePair extra_slip(const Settings& s, const PatchGrid& g, double unit) {
  if (flag(s, kExtraSlip) == 0) return {};
  for (const auto* part : {&s.extra_x, &s.extra_y})
    if (part->size() != g.size())
      throw Refused(kGrid,
                    fmt::format("E = 1 has {} values of extra rigid slip, the potential contact area {} elements",
                                part->size(), g.size()));
  PlanePair out{Plane(g.size()), Plane(g.size())};
  for (int i = 0; i < g.nx; ++i)
    for (int j = 0; j < g.ny; ++j) {
      const auto at = static_cast<std::size_t>(i + g.nx * j);
      out.x[g.index(i, j)] = unit * s.extra_x[at];
      out.y[g.index(i, j)] = unit * s.extra_y[at];
    }
  return out;
}

class Drive {
 public:
  Drive(Problem& problem, std::vector<std::string>& remarks)
      : problem_(problem), settings_(problem.settings), remarks_(remarks), tang_(flag(settings_, kTang)) {}

  void run() {
    std::optional<Solved> last = std::move(problem_.solved);
    problem_.solved.reset();
    const bool was_broken = std::exchange(problem_.broken, true);
    Solved next = prepared();
    const bool turn_it = tang_ >= kTransient && settings_.chi != 0;
    if (turn_it && last) turn(last->rolling);
    solve_turned(next, last, was_broken, turn_it);
    if (turn_it) {
      turn(next.rolling);
      reverse(next.temperature);
      for (Plane& late : next.late) reverse(late);
      for (Plane* part : {&next.late[1], &next.late[2]})
        for (double& value : *part) value = -value;
    }
    next.border_cells = border_cells(next);
    problem_.solved = std::move(next);
    problem_.broken = false;
  }

 private:
  Solved prepared() {
    Solved out;
    out.on = discretise(settings_);
    const Materials& m = settings_.materials;
    out.upper = {m.layers[0], m.body[0]};
    out.lower = {m.layers[1], m.body[1]};
    if (m.viscosity)
      for (LayeredHalfSpace* body : {&out.upper, &out.lower}) body->substrate = soft(body->substrate, *m.viscosity);
    out.influence = problem_.cache.get(out.upper, out.lower, out.on.grid, m.film.flexibility());
    out.shift = tang_ == kShift;
    const Creepages& c = settings_.creepages;
    out.spin = out.shift ? c.spin : c.spin / c.length;
    out.speed = settings_.speed;
    if (flag(settings_, kNorm) == 1 && !(settings_.load > 0))
      throw Refused(kOther, "no normal force: call cntc_setnormalforce");
    if (tang_ != kFrictionless && !settings_.friction)
      throw Refused(kFriction, "no friction: call cntc_setfrictionmethod");
    if (settings_.friction) out.friction = *settings_.friction;
    for (int i = 0; i < (settings_.row_friction.empty() ? 0 : out.on.grid.nx); ++i)
      out.local_friction.insert(out.local_friction.end(), settings_.row_friction.begin(), settings_.row_friction.end());
    out.film = m.film;
    if (out.friction.falling.falls() && tang_ == kShift)
      throw Refused(kFriction, "friction that falls with slip is offered in rolling, T = 2 and 3");
    if (!out.friction.by_temperature.empty() && (!settings_.heat || tang_ < kTransient))
      throw Refused(kFriction, "L = 6 needs temperatures, cntc_settemperaturedata with H = 3, and T = 2 or 3");
    if (out.film.thickness > 0 && out.friction.falling.falls() && !out.friction.falling.remembers())
      throw Refused(kFriction,
                    "a film (M = 4) under friction that falls with slip (L = 3 to 5) needs a memory, MEMDST");
    check_step(out.on.grid);
    check_simplified(out);
    if (m.viscosity &&
        (tang_ <= kTransient || out.influence->couples() || !m.layers[0].empty() || !m.layers[1].empty()))
      throw Refused(kOther, "M = 1 is offered in steady rolling (T = 3) of bodies of one elasticity without layers");
    return out;
  }

  void check_simplified(const Solved& next) const {
    const Materials& m = settings_.materials;
    const int bound = flag(settings_, kBound);
    if (!m.simplified) {
      if (bound != 0) throw Refused(kOther, "B = 2 and 3 are offered with M = 3 and 5; set B = 0");
      return;
    }
    if (tang_ <= kTransient || flag(settings_, kForce) != 0)
      throw Refused(kOther, "M = 3 and 5 are offered in steady rolling with given creepages, T = 3 and F = 0");
    if (!m.layers[0].empty() || !m.layers[1].empty())
      throw Refused(kOther, "M = 3 and 5 are of homogeneous bodies: take the layers off");
    if (!next.friction.by_temperature.empty())
      throw Refused(kFriction, "M = 3 and 5 are offered with L = 0 and 3 to 5");
    if (bound != 0 && settings_.grid.number >= 0)
      throw Refused(kOther, "B = 2 and 3 are of a Hertzian contact, IPOTCN < 0");
  }

  void check_step(const PatchGrid& g) {
    if (!settings_.step || tang_ < kTransient) return;
    const double off = std::abs(*settings_.step - g.dx) / g.dx;
    if (tang_ == kTransient && off > 1e-4)
      throw Refused(kGrid, fmt::format("in transient rolling the step DQ has to be DX = {:g}, not {:g}",
                                       g.dx / problem_.units.length, *settings_.step / problem_.units.length));
    if (off > 0.01)
      remarks_.push_back(fmt::format("the rolling step DQ = DX = {:g} is taken", g.dx / problem_.units.length));
  }

  RollingContact contact(const Solved& next, bool turn_it) const {
    RollingContact c;
    c.gap = next.on.gap;
    if (flag(settings_, kNorm) == 1)
      c.target.load = settings_.load;
    else
      c.target.approach = settings_.approach;
    c.friction = next.friction.at_rest;
    c.falling = next.friction.falling;
    c.speed = next.speed;
    c.third_body = settings_.materials.film;
    if (!next.friction.by_temperature.empty()) {
      c.heat = settings_.heat;
      c.heat->friction = next.friction.by_temperature;
    }
    c.leading_edge = LeadingEdge::whole_cell;
    const Creepages& given = settings_.creepages;
    const double unit = next.shift ? given.length : 1, sign = turn_it ? -1 : 1;
    c.x.creepage = sign * unit * given.x;
    c.y.creepage = sign * unit * given.y;
    c.spin = next.spin;
    // CONTACT takes it as it is: of a shift in mm, whatever the units are.
    c.extra_slip = extra_slip(settings_, next.on.grid, next.shift ? 1e-3 : 1);
    c.local_friction = next.local_friction;
    if (turn_it) {
      reverse(c.gap);
      reverse(c.local_friction);
      turn_vectors(c.extra_slip);
    }
    return c;
  }

  /// Forces on body 2 over a normal force.
  void set_forces(RollingContact& c, double load, bool turn_it) const {
    const int forces = flag(settings_, kForce);
    const double bound = (turn_it ? 1 : -1) * c.friction * load;
    if (forces >= 1) c.x.force = bound * settings_.relative_x;
    if (forces == 2) c.y.force = bound * settings_.relative_y;
  }

  /// The state before, P = 0, on the elements of now; there is none in the first case, and P = 2 always starts anew.
  const RollingSolution* before(const PatchGrid& g, std::optional<Solved>& last, bool was_broken) {
    if (flag(settings_, kTime) != 0 || tang_ == kFrictionless || tang_ > kTransient) return nullptr;
    if (was_broken) throw Refused(kOther, "the case before failed: there is no state to go on from, start with P = 2");
    if (!last) {
      remarks_.emplace_back("there is no case before: P = 2 is taken");
      return nullptr;
    }
    if (last->flexibility[0] > 0 || !last->late[0].empty())
      throw Refused(kOther, "the case before was one of M = 1, 3 or 5, of steady rolling: start with P = 2");
    const std::optional<Offset> by = offset_of(g, last->on.grid);
    if (!by)
      throw Refused(kGrid,
                    "a case that goes on from the one before (P = 0) has to have elements of its size, at its places");
    const bool moves = by->x != 0 || by->y != 0 || g.nx != last->on.grid.nx || g.ny != last->on.grid.ny;
    if (moves) last->rolling = Moved(g, last->on.grid, *by).of(last->rolling);
    last->on.grid = g;
    return &last->rolling;
  }

  void set_history(RollingContact& c, const Solved& next, const PatchGrid& g, const RollingSolution* from) const {
    if (tang_ == kShift || tang_ == kTransient) {
      c.kind = tang_ == kShift ? RollingKind::shift : RollingKind::transient;
      c.step = g.dx;
      if (!from) {
        c.before = {Plane(g.size()), Plane(g.size())};
      } else if (tang_ == kShift) {
        shift_on(*next.influence, g, *from, c);
      } else {
        roll_on_one_cell(*next.influence, g, *from, c);
      }
    }
  }

  void solve_turned(Solved& next, std::optional<Solved>& last, bool was_broken, bool turn_it) {
    const PatchGrid g = turn_it ? turned(next.on.grid) : next.on.grid;
    RollingContact c = contact(next, turn_it);
    if (!c.target.load && *c.target.approach <= *std::min_element(c.gap.begin(), c.gap.end())) {
      apart(next, c);
      return;
    }
    const RollingSolution* from = before(next.on.grid, last, was_broken);
    set_history(c, next, g, from);
    const bool warm = flag(settings_, kEstimate) != 0 && last && last->on.grid.nx == g.nx && last->on.grid.ny == g.ny;
    const RollingSolution* start = warm || from ? &last->rolling : nullptr;
    try {
      if (tang_ == kFrictionless)
        without_friction(next, g, c, start);
      else if (settings_.materials.simplified)
        simplified(next, g, c, start);
      else
        with_friction(next, g, c, start, turn_it);
      if (settings_.heat && tang_ >= kTransient) next.temperature = temperature(next, g, c);
    } catch (const CaseError& e) {
      const std::string& key = e.diagnostics.front().where;
      const bool of_law = key.starts_with("friction.") || key.starts_with("third_body.");
      throw Refused(flag(settings_, kForce) > 0 ? kTotalForce
                    : of_law                    ? kFriction
                                                : kTangential,
                    in_words_of_contact(e.what()));
    } catch (const NumericalError& e) {
      throw Refused(normal_fails(next, g, c) ? kNormal : kTangential, e.what());
    }
  }

  /// Of friction that does not depend on it: of the rows as they stand.
  Plane temperature(const Solved& next, const PatchGrid& g, const RollingContact& c) const {
    if (!next.rolling.temperature.empty()) return next.rolling.temperature;
    const Plane flux = friction_flux(next.rolling.tangential, c.speed), cold(g.size(), 0.0);
    return contact_temperature(*settings_.heat, g, flux, cold, {}, true, g.dx, c.speed);
  }

  RollingOptions options() const {
    RollingOptions out;
    out.tangential.tolerance = settings_.tolerance;
    out.coupling_tolerance = settings_.tolerance;
    return out;
  }

  static void blank(TangentialSolution& t, std::size_t cells, const Plane& pressure) {
    for (Plane* plane : {&t.q_x, &t.q_y, &t.slip.x, &t.slip.y, &t.cell_slip.x, &t.cell_slip.y})
      plane->assign(cells, 0.0);
    t.state.assign(cells, ContactState::separated);
    for (std::size_t k = 0; k < cells; ++k)
      if (pressure[k] > 0) t.state[k] = ContactState::stick;
  }

  static void apart(Solved& next, const RollingContact& c) {
    NormalSolution& n = next.rolling.normal;
    n.pressure.assign(c.gap.size(), 0.0);
    n.gap = c.gap;
    for (double& value : n.gap) value -= *c.target.approach;
    n.approach = *c.target.approach;
    blank(next.rolling.tangential, c.gap.size(), n.pressure);
    next.rolling.tangential.creepage_x = c.x.creepage;
    next.rolling.tangential.creepage_y = c.y.creepage;
  }

  void without_friction(Solved& next, const PatchGrid& g, const RollingContact& c, const RollingSolution* start) const {
    next.rolling.normal =
        solve_normal(*next.influence, g, c.gap, c.target, options().normal, start ? start->normal.pressure : Plane{});
    TangentialSolution& t = next.rolling.tangential;
    blank(t, g.size(), next.rolling.normal.pressure);
    t.creepage_x = c.x.creepage;
    t.creepage_y = c.y.creepage;
  }

  void simplified(Solved& next, const PatchGrid& g, const RollingContact& c, const RollingSolution* start) const {
    const int bound = flag(settings_, kBound);
    next.rolling.normal = bound != 0 ? assumed_pressure(next.on, g, bound == 3)
                                     : solve_normal(*next.influence, g, c.gap, c.target, options().normal,
                                                    start ? start->normal.pressure : Plane{});
    SimplifiedSolution found = solve_simplified(settings_.materials, next.on.hertz, g, next.rolling.normal, c);
    next.rolling.tangential = std::move(found.tangential);
    next.flexibility = found.flexibility;
    next.reduction = found.reduction;
    next.friction.at_rest = found.friction;
    next.friction.falling = {};
  }

  bool delayed() const {
    const std::optional<Viscosity>& v = settings_.materials.viscosity;
    return v && v->share > 0 && v->time > 0;
  }

  /// A step of rolling under friction so steep that it has several answers is solved in turn with its slip.
  RollingSolution rolled(const InfluenceOperator& influence, const PatchGrid& g, const RollingContact& c,
                         const RollingSolution* start) const {
    try {
      return solve_rolling(influence, g, c, options(), start);
    } catch (const CaseError& e) {
      if (tang_ != kTransient || e.diagnostics.front().where != "friction.half_velocity") throw;
    }
    return by_turns(influence, g, c, start);
  }

  /// Slip gives friction, friction gives slip: from no slip upwards to the least slip that repeats, from a slip of V
  /// downwards to the largest one, or from the slip of the step before (INISLP > 0, < 0, = 0).
  RollingSolution by_turns(const InfluenceOperator& influence, const PatchGrid& g, RollingContact c,
                           const RollingSolution* start) const {
    constexpr int kMostTurns = 2000;
    const FallingFriction law = std::exchange(c.falling, {});
    const auto speed = [&](const RollingSolution& s) {
      Plane out(g.size());
      for (std::size_t k = 0; k < out.size(); ++k)
        out[k] = c.speed * std::hypot(s.tangential.slip.x[k], s.tangential.slip.y[k]);
      return out;
    };
    Plane slip(g.size(), settings_.first_slip < 0 ? c.speed : 0.0);
    if (settings_.first_slip == 0 && start) slip = speed(*start);
    c.local_friction.resize(g.size());
    RollingSolution s;
    for (int turn = 0; turn < kMostTurns; ++turn) {
      for (std::size_t k = 0; k < slip.size(); ++k)
        c.local_friction[k] = c.friction * friction_share(law, slip[k]).value;
      s = solve_rolling(influence, g, c, options(), turn == 0 ? start : &s);
      const Plane next = speed(s);
      double change = 0, size = 0;
      for (std::size_t k = 0; k < slip.size(); ++k) {
        change += (next[k] - slip[k]) * (next[k] - slip[k]);
        size += next[k] * next[k];
      }
      slip = next;
      if (change <= settings_.tolerance * settings_.tolerance * size) return s;
    }
    throw NumericalError("slip and friction do not settle against each other");
  }

  /// Where the approach is given, forces over the load that comes out are found in turn.
  void with_friction(Solved& next, const PatchGrid& g, RollingContact& c, const RollingSolution* start,
                     bool turn_it) const {
    constexpr double kSettled = 1e-7;
    constexpr int kMostTurns = 40;
    const bool load_given = c.target.load.has_value(), driven = flag(settings_, kForce) > 0;
    double load = load_given ? *c.target.load : 0;
    if (!load_given && driven)
      load =
          solve_normal(*next.influence, g, c.gap, c.target, options().normal, start ? start->normal.pressure : Plane{})
              .load;
    for (int k = 0; k < kMostTurns; ++k) {
      set_forces(c, load, turn_it);
      const RollingSolution* from = k == 0 ? start : &next.rolling;
      next.rolling = delayed() ? solve_delayed(*next.influence, settings_.materials, g, c, options(), from, next.late)
                               : rolled(*next.influence, g, c, from);
      const double before = std::exchange(load, next.rolling.normal.load);
      if (load_given || !driven || std::abs(load - before) <= kSettled * load) return;
    }
    throw Refused(kTotalForce, "forces over the load that comes out do not settle under this approach");
  }

  bool normal_fails(const Solved& next, const PatchGrid& g, const RollingContact& c) const {
    try {
      solve_normal(*next.influence, g, c.gap, c.target, options().normal);
    } catch (const std::exception&) {
      return true;
    }
    return false;
  }

  static int border_cells(const Solved& s) {
    const PatchGrid& g = s.on.grid;
    int count = 0;
    for (int i = 0; i < g.nx; ++i)
      for (int j = 0; j < g.ny; ++j) {
        const bool ends = (g.nx >= 3 && (i == 0 || i == g.nx - 1)) || (g.ny >= 3 && (j == 0 || j == g.ny - 1));
        count += ends && s.rolling.normal.pressure[g.index(i, j)] > 0;
      }
    return count;
  }

  Problem& problem_;
  const Settings& settings_;
  std::vector<std::string>& remarks_;
  int tang_;
};

}  // namespace

Solved joined(const Solved& one, const Solved& other) {
  const PatchGrid &a = one.on.grid, &b = other.on.grid;
  const std::optional<Offset> apart = offset_of(b, a);
  if (!apart) throw Refused(kGrid, "patches that join (P = 0) have to have elements of one size, on one lattice");
  Solved out = one;
  PatchGrid& g = out.on.grid;
  const int x = std::min(0, apart->x), y = std::min(0, apart->y);
  g.x0 += x * g.dx;
  g.y0 += y * g.dy;
  g.nx = std::max(a.nx, apart->x + b.nx) - x;
  g.ny = std::max(a.ny, apart->y + b.ny) - y;
  out.rolling = Moved(g, a, {x, y}).of(one.rolling);
  const RollingSolution more = Moved(g, b, {x - apart->x, y - apart->y}).of(other.rolling);
  TangentialSolution& t = out.rolling.tangential;
  const TangentialSolution& u = more.tangential;
  const auto add = [](Plane& to, const Plane& from) {
    if (to.size() == from.size()) add_scaled(to, 1, from);
  };
  add(out.rolling.normal.pressure, more.normal.pressure);
  add(t.q_x, u.q_x);
  add(t.q_y, u.q_y);
  for (std::size_t k = 0; k < t.state.size(); ++k)
    if (t.state[k] == ContactState::separated) t.state[k] = u.state[k];
  return out;
}

void solve(Problem& problem, std::vector<std::string>& remarks) { Drive(problem, remarks).run(); }

}  // namespace railstrata::cntc
