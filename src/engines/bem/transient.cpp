#include "bem/transient.hpp"

#include "bem/one_patch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <utility>

#include "bem/several_patches.hpp"
#include "core/faults.hpp"
#include "rules/irregularity_rules.hpp"
#include "rules/support.hpp"

namespace railstrata {
namespace {

int step_count(const LoadHistory& history, const CaseSpec& spec, double cell) {
  if (!history.rolls()) return spec.transient.increments * static_cast<int>(std::lround(history.end()));
  return std::max(1, static_cast<int>(std::lround(history.end() / cell)));
}

/// Upper bound of the normal load: lateral friction on an inclined plane adds to it. Wedging is detected when it
/// occurs.
double largest_normal_load(const LoadHistory& history, double friction, const RigidContact& contact) {
  constexpr double kMostOfNormal = 2;
  const double alone = normal_load(history.largest_load(), 0, contact), c = std::cos(contact.angle),
               share = friction * std::abs(std::sin(contact.angle));
  return share < c ? std::min(alone * c / (c - share), kMostOfNormal * alone) : kMostOfNormal * alone;
}

class Course {
 public:
  Course(const CaseSpec& spec, const Placement& placement, const BemOptions& options)
      : spec_(spec),
        placement_(in_plane(spec, placement, options)),
        options_(options.rolling),
        history_(spec, placement_.contact),
        patch_(make_case_patch(
            spec, placement_, options,
            {.load = largest_normal_load(history_,
                                         spec.friction.lateral_coefficient.value_or(spec.drive.friction_coefficient),
                                         placement_.contact)})),
        rolling_(patch_.contact) {
    // the next step corrects the force error of this one within one cell, so the first creepage from rest would err by
    // twenty times the force's tolerance over friction
    options_.tangential.tolerance *= 0.1;
    if (!patch_.grid.line)
      require_one_plane(placement, patch_.frictionless.approach, "transient.kind",
                        "a transient is solved in one contact plane only: remove transient.kind");
    state_.steps = step_count(history_, spec, options.cell);
    require_a_cell();
    if (!rough()) return;
    require_fine_enough(spec, options.cell, "cells", "--cell");
    require_flat_start();
    while (!holds_way()) grow(options);
    rolling_ = patch_.contact;
  }

  TransientState run(const TransientObserver& observer) {
    const auto begin = std::chrono::steady_clock::now();
    start();
    while (report(observer) && state_.step < state_.steps) advance();
    state_.result = result();
    state_.result.effort.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return std::move(state_);
  }

 private:
  /// Rolling steps are whole cells; the history ends within half a cell of the last step.
  double place_at_end(int step) const {
    return history_.rolls() ? step * patch_.grid.dx : history_.end() * step / state_.steps;
  }

  void require_a_cell() const {
    const double cell = patch_.grid.dx;
    if (!history_.rolls() || history_.end() >= 0.5 * cell) return;
    throw CaseError(fmt::format("{:.3g} mm of rolling are less than half a cell of {:.3g} mm; steps are whole cells",
                                1e3 * history_.end(), 1e3 * cell),
                    "give a longer transient.distance, or smaller cells with --cell");
  }

  bool rough() const { return !(patch_.rail_heights.none() && patch_.wheel_heights.none()); }

  /// What rolls steadily from the start on finds no height there.
  void require_flat_start() const {
    if (spec_.transient.start != TransientStart::steady) return;
    if (gap_after(patch_, 0) != patch_.profile.gap)
      throw CaseError("start = \"steady\" on an [[irregularity]]: nothing rolls steadily there",
                      "start before it, or give start = \"rest\"", "transient.start");
  }

  /// Whether the frictionless patch stays inside the grid all along the way.
  bool holds_way() const {
    NormalSolution last;
    for (int step = 0; step <= state_.steps; ++step) {
      const double at = place_at_end(step);
      last = solve_normal(*patch_.influence, patch_.grid, gap_after(patch_, at),
                          {.load = normal_load(history_.at(at).load, 0, placement_.contact)}, options_.normal,
                          last.pressure);
      if (reaches_edge(patch_.grid, last.pressure)) return false;
    }
    return true;
  }

  void grow(const BemOptions& options) {
    const PatchGrid& g = patch_.grid;
    constexpr double kGrowth = 1.4;
    const auto more = [&](int cells) { return static_cast<int>(kGrowth * (cells / 2)) + 1; };
    const int half_x = more(g.nx), half_y = more(g.ny);
    if (2 * half_x * g.dx > options.largest_patch || (!g.line && 2 * half_y * g.dy > options.largest_patch))
      throw CaseError(
          fmt::format(
              "while rolling over the [[irregularity]] the load flattens the whole potential contact area of {:.0f} mm",
              1e3 * options.largest_patch),
          "check the load and the heights; half-space theory no longer applies", "irregularity");
    patch_ = case_patch_on(g.line ? line_grid(half_x, g.dx, g.dy) : centred_grid(half_x, half_y, g.dx, g.dy), spec_,
                           placement_, options, patch_.contact.target);
  }

  bool report(const TransientObserver& observer) {
    const double at = place_at_end(state_.step);
    state_.time = history_.time(at);
    state_.distance = history_.rolls() ? at : 0.0;
    if (!observer) return true;
    state_.result = result();
    return observer(state_);
  }

  /// The increment of a shift is no slip over V.
  BemResult result() const {
    BemResult out = bem_result(spec_, placement_, {placement_.contact, patch_, solution_});
    if (patch_.contact.kind == RollingKind::shift) out.rigid_slip = {};
    if (patch_.grid.line && state_.moment.x.force != force_before_) out.rigid_slip.x = kUnknown;
    return out;
  }

  /// Without rolling there is no rigid slip but the shift.
  RollingContact without_rolling() const {
    RollingContact out = rolling_;
    out.kind = RollingKind::shift;
    out.spin = 0;
    out.local_spin = {};
    out.extra_slip = {};
    return out;
  }

  void start() {
    state_.moment = history_.at(0);
    force_before_ = state_.moment.x.force;
    const LoadedMoment& m = state_.moment;
    const bool steady = history_.rolls() && spec_.transient.start == TransientStart::steady;
    patch_.contact = steady ? rolling_ : without_rolling();
    RollingContact& c = patch_.contact;
    c.x = m.x;
    c.y = m.y;
    if (steady) {
      c.spin = m.spin;
    } else {
      c.x.creepage = c.y.creepage = 0;
      if (history_.rolls()) c.falling = {};  // the shift before it rolls is made at rest
    }
    solve(nullptr);
    if (!steady) add_shift();
  }

  void advance() {
    force_before_ = state_.moment.x.force;
    const double from = place_at_end(state_.step), to = place_at_end(++state_.step);
    const LoadedMoment before = state_.moment, there = history_.at(to);
    const RollingSolution last = solution_;
    if (history_.rolls())
      roll(last, from, to, there);
    else
      shift(last, before, there);
    state_.moment = there;
    if (history_.rolls()) {
      state_.moment.x.creepage = patch_.contact.x.creepage;
      state_.moment.y.creepage = patch_.contact.y.creepage;
      state_.moment.spin = patch_.contact.spin;
    }
    solve(&last);
    if (history_.rolls())
      state_.friction_work += solution_.tangential.dissipation * patch_.grid.dx;
    else
      add_shift();
  }

  void roll(const RollingSolution& last, double from, double to, const LoadedMoment& there) {
    const LoadedMoment middle = history_.at(0.5 * (from + to));
    patch_.contact = rolling_;
    RollingContact& c = patch_.contact;
    c.x = {middle.x.creepage, there.x.force};
    c.y = {middle.y.creepage, there.y.force};
    c.spin = middle.spin;
    c.target.load = there.load;
    if (rough()) c.gap = gap_after(patch_, to);
    roll_on_one_cell(*patch_.influence, patch_.grid, last, c);
  }

  void shift(const RollingSolution& last, const LoadedMoment& before, const LoadedMoment& there) {
    patch_.contact = without_rolling();
    RollingContact& c = patch_.contact;
    c.x = {there.x.creepage - before.x.creepage, there.x.force};
    c.y = {there.y.creepage - before.y.creepage, there.y.force};
    shift_on(*patch_.influence, patch_.grid, last, c);
  }

  void add_shift() {
    state_.displacement_x += patch_.grid.line ? kUnknown : solution_.tangential.creepage_x;
    state_.displacement_y += solution_.tangential.creepage_y;
    state_.friction_work += solution_.tangential.dissipation;
  }

  /// N cos(delta) - T_y sin(delta) = G in turn: the lateral friction T_y follows the normal force N by at most f, so
  /// that each turn leaves f tan(delta) of the error.
  void solve(const RollingSolution* last) {
    constexpr double kTolerance = 1e-5;
    constexpr int kMostIterations = 60;
    const RigidContact& rigid = placement_.contact;
    const double load = state_.moment.load;
    RollingContact& c = patch_.contact;
    double lateral = c.y.force ? *c.y.force : last ? last->tangential.force_y : 0.0;
    for (int i = 0; i < kMostIterations; ++i) {
      c.target.load = normal_load(load, lateral, rigid);
      solution_ = solve_rolling(*patch_.influence, patch_.grid, c, options_, last);
      if (solution_.normal.touches_edge)
        throw NumericalError("the patch has grown beyond its grid: friction changes it more than expected");
      lateral = solution_.tangential.force_y;
      if (std::abs(normal_load(load, lateral, rigid) - *c.target.load) * std::cos(rigid.angle) <= kTolerance * load)
        return;
    }
    refuse_wedged("load", rigid);
  }

  /// Line contact: the displacement of distant points under a changing force, and the creepage of such a step, are not
  /// known.
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

  const CaseSpec& spec_;
  const Placement placement_;
  RollingOptions options_;
  LoadHistory history_;
  CasePatch patch_;
  RollingContact rolling_;  // of steady rolling: the geometry's slip
  RollingSolution solution_;
  TransientState state_;
  std::optional<double> force_before_;  // along the rail
};

/// N, at most, of friction and film in series.
double capacity(const CasePatch& patch, const NormalOptions& options, double normal) {
  const Plane pressure =
      solve_normal(*patch.influence, patch.grid, patch.contact.gap, {.load = normal}, options).pressure;
  double sum = 0;
  for (const double p : pressure)
    sum += std::min(patch.contact.friction * p, patch.contact.third_body.under(p, 1).yield_shear);
  return sum * patch.grid.cell_area();
}

/// A row's place; of two rows at one place, a jump, just behind it.
double place_of(const std::vector<double>& places, std::size_t row) {
  return row > 0 && places[row] == places[row - 1] ? std::nextafter(places[row], HUGE_VAL) : places[row];
}

}  // namespace

int transient_steps(const CaseSpec& spec, const Placement& placement, double cell) {
  return step_count(LoadHistory(spec, placement.contact), spec, cell);
}

TransientState solve_transient(const CaseSpec& spec, const Placement& placement, const BemOptions& options,
                               const TransientObserver& observer) {
  require_support(uses::kHalfSpaces, spec);
  return Course(spec, placement, options).run(observer);
}

void require_film_carries(const CaseSpec& spec, const Placement& placement, const BemOptions& options) {
  const ThirdBody film = third_body(spec);
  if (spec.transient.kind == TransientKind::none || !film.yields() || film.hardening > 0) return;
  const LoadHistory history(spec, placement.contact);
  const double largest = normal_load(history.largest_load(), 0, placement.contact);
  std::vector<double> places = history.places();
  if (places.empty()) places.push_back(0);
  const CasePatch patch = make_case_patch(spec, placement, options, {.load = largest});
  for (std::size_t row = 0; row < places.size(); ++row) {
    const LoadedMoment m = history.at(place_of(places, row));
    const double wanted = std::hypot(m.x.force.value_or(0), m.y.force.value_or(0));
    if (wanted == 0) continue;
    const double normal = normal_load(m.load, m.y.force.value_or(0), placement.contact),
                 available = capacity(patch, options.rolling.normal, normal);
    if (wanted < available) continue;
    throw CaseError(fmt::format("row {} of the transient wants {:.4g} kN of friction; a film that yields at {:.4g} MPa "
                                "carries at most {:.4g} kN under its load",
                                row + 1, 1e-3 * wanted, 1e-6 * film.yield_shear, 1e-3 * available),
                    "lower the force, raise third_body.yield_shear, or give creepages or displacements, which also "
                    "allow full sliding",
                    "third_body.yield_shear");
  }
}

}  // namespace railstrata
