#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "ask/solve_half_space.hpp"
#include "ask/solve_settings.hpp"
#include "core/faults.hpp"
#include "core/stop_request.hpp"
#include "jobs/profile_table.hpp"
#include "judge/check_limits.hpp"
#include "passes/following_contact.hpp"
#include "passes/pass_plan.hpp"
#include "passes/pass_text.hpp"
#include "passes/pass_way.hpp"
#include "passes/pass_way_files.hpp"
#include "passes/pressed_profile.hpp"
#include "result/result_table.hpp"
#include "rules/irregularity_rules.hpp"
#include "runs/pass_job.hpp"

namespace railstrata {
namespace {

/// Steady rolling over one rail is what the stationary method knows.
void require_steady(const LoadedCase& loaded) {
  if (loaded.spec.transient.kind != TransientKind::none)
    throw CaseError("passes are of steady rolling, the case is a transient", "take out [transient]",
                    loaded.file.string());
}

/// The work's result; CaseErrors of it get their places in the case.
template <class Work>
auto with_places(const LoadedCase& loaded, Work&& work) {
  try {
    return work();
  } catch (const CaseError& e) {
    throw in_case_file(loaded, e);
  }
}

class SteadyPasses : public PassJob {
 public:
  SteadyPasses(LoadedCase loaded, const PassOrder& order, Control& control)
      : PassJob("the case, the --set, the --cell, the grid and the version it began with", std::move(loaded), order,
                control),
        rail_(with_places(loaded_, [&] { return rail_of(); })) {
    renew_body();
    series_.cycle = passes_per_cycle(loaded_.spec.passes);
    if (loaded_.spec.passes.jump != PassJump::off) series_.jump.length = kShortestJump;
    limits_.control = &control_;
  }
  int passes() const { return series_.state.passes; }

 private:
  RailPasses rail_of() {
    require_same_along(loaded_.spec, "a series of passes");
    BemOptions bem;
    bem.cell = wanted_.cell;
    bem.apart = false;
    const StopRequest wish(&control_.stop);
    const std::vector<CaseSpec> specs = cases_of_tractions(loaded_.spec);
    std::vector<Placement> placements;
    for (const CaseSpec& spec : specs) {
      placements.push_back(place(spec, loaded_.folder()));
      HalfSpaceSolution solution = solve_half_space_contact(spec, placements.back(), bem);
      doubt(solution.summary);
      if (solutions_.empty()) judge_elastic(solution);
      const ContactSummary& c = solution.summary.contact;
      contacts_.push_back({c.F_x / c.F_z, solution.result.patch.largest_pressure, solution.result.rigid_slip.x});
      solutions_.push_back(std::move(solution.result));
    }
    placement_ = placements.front();
    if (loaded_.spec.passes.pressure == PassPressure::following) following_.emplace(specs, placements, bem);
    return rail_passes(loaded_.spec, solutions_);
  }

  /// Begins anew with a longer window behind the load.
  void lengthen(double window) {
    CaseSpec spec = loaded_.spec;
    spec.passes.window = window;
    std::vector<std::string> notes = std::move(rail_.notes);
    rail_ = rail_passes(spec, solutions_);
    rail_.notes = std::move(notes);
    renew_body();
    strain_.clear();
  }

  void renew_body() {
    body_.emplace(rail_.grid, rail_.rows, rail_.below, rail_.initial_stress);
    series_.state = body_->virgin();
  }

  /// Collects failed checks and warnings of the contact that all passes use, each once.
  void doubt(const Summary& contact) {
    const auto add = [&](std::string text) {
      if (std::find(doubts_.begin(), doubts_.end(), text) == doubts_.end()) doubts_.push_back(std::move(text));
    };
    for (const Check& c : contact.checks) {
      if (c.ok) continue;
      sound_ = false;
      const CheckRow* row = find_check(c.name);
      const Unit unit = row ? row->unit : unit::kNone;
      add(fmt::format("a check of the contact fails: {} is {}, limit {}", c.name, with_unit(unit, c.value, 3),
                      limit_text(unit, c.limit)));
    }
    for (const Warning& w : contact.warnings) add(w.text);
  }

  /// Shakedown factors of the elastic stress, to stand beside the class; where no strength is given there are none.
  void judge_elastic(HalfSpaceSolution& solution) {
    if (!strength_given(loaded_.spec, BodyId::rail)) return;
    CaseSpec of_rail = loaded_.spec;
    of_rail.run.judged = JudgedBodies::rail;
    solution.shakedown = half_space_shakedown(of_rail, solution.result);
    complete_shakedown(loaded_.spec, solution);
    answer_.shakedown = solution.summary.shakedown;
  }

  std::string identity() const override {
    return fmt::format("{} {} {} {}", PassJob::identity(), rail_.grid.nx, rail_.grid.ny, wanted_.cell);
  }

  void begin() override {
    PassJob::begin();
    report_contact();
  }

  void resume() override {
    report_contact();
    if (!std::filesystem::exists(folder() / kPassState)) return;
    const int stations = active_stations(folder() / kPassState);
    while (rail_.grid.active_stations() < stations) {
      const std::optional<double> window = longer_window(loaded_.spec.passes, rail_, 1);
      if (!window) break;  // a state of another grid, which is refused below
      lengthen(*window);
    }
    series_ = read_pass_series(folder() / kPassState, folder() / kPassTable, rail_.grid, series_.cycle);
    if (series_.state.passes > 0) stand(place_of(series_.state.passes));
  }

  void report_contact() {
    for (const std::string& note : rail_.notes) control_.info("{}", note);
    for (const std::string& doubt : doubts_) control_.warn("{}", doubt);
    rail_.notes.insert(rail_.notes.end(), doubts_.begin(), doubts_.end());
  }

  /// Where a wheel runs, and with which of the tractions.
  struct Place {
    int column = 0;
    std::size_t solution = 0;
    bool operator==(const Place&) const = default;
  };
  Place place_of(int pass) const {
    const PassPlan plan = pass_plan(loaded_.spec.passes, pass);
    return {columns_to(rail_.grid, plan.lateral), plan.traction};
  }
  void stand(Place place) {
    strain_ = contact_strain(rail_, *body_, rail_.contact_stress.at(place.solution), place.column);
    place_ = place;
  }

  /// The contact of the next pass in its place; computed anew only where it is another one.
  void drive(int pass) {
    const Place next = place_of(pass);
    if (!strain_.empty() && next == place_) return;
    if (!strain_.empty()) move_guess(rail_.grid, next.column - place_.column, series_.state);
    stand(next);
  }

  /// The next pass, where drive() has put it.
  FollowedPass roll() {
    if (following_) {
      FollowedPass pass = following_->run_pass(rail_, *body_, place_.solution, place_.column, series_.state, limits_);
      strain_ = std::move(pass.contact_strain);
      return pass;
    }
    const Contact& contact = contacts_[place_.solution];
    FollowedPass pass;
    pass.result = body_->run_pass(strain_, series_.state, limits_);
    pass.largest_pressure = contact.largest_pressure;
    pass.creepage = contact.creepage;
    return pass;
  }

  bool finished() const override { return series_.state.passes >= wanted_.passes; }

  /// A pass, or where passes are jumped over a round, or a jump and the rounds behind it: what is given up or taken
  /// back as a whole.
  bool step() override {
    const int done = passes() / series_.cycle, left = wanted_.passes / series_.cycle - done;
    if (series_.jump.length == 0 || passes() % series_.cycle != 0 || left < 1) return one_pass();
    const int length = std::min(series_.jump.length, left - kRoundsAfterJumps - 1);
    const Kept kept = keep_all();
    const bool ready = done >= kRoundsBeforeJumps && length >= kShortestJump;
    if (ready ? jump(length) : round().has_value()) {
      if (!ready && series_.jump.length < kShortestJump) ++series_.jump.length;
      return true;
    }
    take_back(kept);
    return false;
  }

  /// What a jump may have to be taken back to.
  struct Kept {
    PassSeries series;
    std::optional<PassResult> last;
    PassRow row;
    Place place;
    Field strain;
    bool sound;
  };
  Kept keep_all() const { return {series_, last_, last_row_, place_, strain_, sound_}; }
  void take_back(const Kept& kept) {
    series_ = kept.series;
    last_ = kept.last;
    last_row_ = kept.row;
    sound_ = kept.sound;
    place_ = kept.place;
    strain_ = kept.strain;
  }

  /// All passes of a round and their effect on the state; empty: given up.
  std::optional<std::vector<double>> round() {
    std::vector<double> rate = series_.state.history;
    for (int n = 0; n < series_.cycle; ++n)
      if (!one_pass()) return {};
    for (std::size_t n = 0; n < rate.size(); ++n) rate[n] = series_.state.history[n] - rate[n];
    return rate;
  }
  /// The same from another state on, which leaves nothing but a first guess.
  std::optional<std::vector<double>> change_in_round(const std::vector<double>& history) {
    const PassState before = series_.state;
    std::vector<double> rate = history;
    series_.state.history = history;
    try {
      for (int n = 1; n <= series_.cycle; ++n) {
        drive(before.passes + n);
        roll();
      }
    } catch (const Interrupted&) {
      return {};
    }
    for (std::size_t n = 0; n < rate.size(); ++n) rate[n] = series_.state.history[n] - rate[n];
    series_.state.history = before.history;
    series_.state.passes = before.passes;
    return rate;
  }

  /// A round, and a jump behind it of as many rounds as wanted or fewer by the tolerance, with the round that shows its
  /// error.
  bool jump(int rounds) {
    const double tolerance = loaded_.spec.passes.jump_tolerance;
    const std::optional<std::vector<double>> first = round();
    if (!first) return false;
    const Kept kept = keep_all();
    std::vector<double> start = series_.state.history;
    for (std::size_t n = 0; n < start.size(); ++n) start[n] -= (*first)[n];
    while (rounds >= kShortestJump) {
      std::optional<std::vector<double>> end =
          state_after(start, *first, rounds, [&](const std::vector<double>& state) { return change_in_round(state); });
      if (!end) return false;
      jump_over(rounds - 1, *end, series_);  // the first of them has been computed
      const std::optional<std::vector<double>> last = round();
      if (!last) return false;
      const double error = jump_error(start, *end, *first, *last, rounds);
      const int next = next_jump(rounds, error, tolerance);
      const std::string what = passes_text((rounds - 1) * series_.cycle);
      if (error <= tolerance) {
        control_.info("jumped over {}; error of the rate {:.2g}", what, error);
        series_.jump = {std::max(next, 1), std::max(series_.jump.error, error)};
        return true;
      }
      control_.info("a jump over {} is taken back: error of the rate {:.2g}", what, error);
      take_back(kept);
      rounds = next;
    }
    series_.jump.length = std::max(rounds, 1);
    return true;
  }

  bool one_pass() {
    const int pass = series_.state.passes + 1;
    Kept kept = keep_all();
    report(pass, 0);
    drive(pass);
    try {
      FollowedPass rolled = roll();
      while (pass == 1) {
        const std::optional<double> window = longer_window(loaded_.spec.passes, rail_, rolled.result.late_flow);
        if (!window) break;
        control_.info("flow goes on behind the load: followed over {:.3g} half-lengths instead of {:.3g}", *window,
                      rail_.window);
        lengthen(*window);
        kept = keep_all();
        drive(pass);
        rolled = roll();
      }
      last_ = std::move(rolled.result);
      keep(pass_row(rail_.grid, pass, *last_), rolled);
    } catch (const Interrupted&) {
      take_back(kept);
      return false;
    }
    return true;
  }

  void keep(PassRow row, const FollowedPass& pass) {
    row.place = place_.column * rail_.grid.dy;
    row.traction = contacts_[place_.solution].traction;
    row.largest_pressure = pass.largest_pressure;
    row.creepage = pass.creepage;
    row.rounds = pass.rounds;
    last_row_ = row;
    add_pass(row, *last_, series_);
    report(row, fmt::format("pressure up to {:.0f} MPa; {} iterations{}", 1e-6 * row.largest_pressure, row.iterations,
                            row.rounds > 0 ? fmt::format(", {} rounds of the contact", row.rounds) : ""));
    if (!pass.converged) {
      sound_ = false;
      control_.warn("pass {}: contact and yielding have not settled: pressure still changes by {:.2g} of its largest",
                    row.pass, pass.change);
    }
    if (row.late_flow > loaded_.spec.passes.window_tolerance && !late_) {
      late_ = true;
      control_.warn(
          "pass {}: {:.2g} % of the largest flow comes in the last quarter of the window of {:.3g} half-lengths behind "
          "the load: give a longer passes.window",
          row.pass, 100 * row.late_flow, rail_.window);
    }
    if (!row.converged) {
      sound_ = false;
      control_.warn("pass {} has not settled: stresses still change by {:.2g} of the shear strength", row.pass,
                    row.error);
    }
  }

  /// Table before state: a table that has gone on is cut when the state is read.
  void save() override {
    write_csv(folder() / kPassTable, origin(), series_.table.columns);
    write_pass_state(folder() / kPassState, origin(), rail_.grid, series_);
  }

  void finish() override {
    if (!last_) {
      control_.info("{}: there already: {}", folder().string(), passes_text(passes()));
      return;
    }
    save();
    write_results();
    warn_of_large_strain(last_row_.strain);
    control_.info("after {}: {} Results are in {}", passes_text(passes()), verdict_, folder().string());
  }

  /// The results are those of the last pass.
  void stop() override {
    if (!last_) return;
    finish();
    if (order_.page) write_page();
  }
  bool write_page() override { return !last_ || PassJob::write_page(); }
  std::string how_far() const override { return fmt::format("after pass {}", passes()); }

  void write_results() {
    const PassWay way = pass_way(rail_, *body_, strain_, *last_, series_.state);
    const std::size_t governing = way.points.front().point / static_cast<std::size_t>(rail_.grid.ny);
    PassProgress progress = progress_of(verdict_of(series_), series_.strains, last_row_);
    progress.ductility = loaded_.spec.passes.ductility;
    progress.strain_life = strain_life_of(loaded_.spec.rail_material, "rail", "material.rail");
    answer_.verdict = verdict_ = describe(progress);
    answer_.law = describe_law(rail_.rows[governing].law);
    answer_.ductility = loaded_.spec.passes.ductility;
    write_residual(folder(), origin(), rail_, series_, *last_);
    // one elastic contact for all passes would sink the rail deeper than the wheel reaches
    if (rail_.grid.ny > 1 && loaded_.spec.passes.pressure == PassPressure::following)
      write_profile_table(folder() / kPressedProfile, origin(), pressed_profile(*placement_, rail_.grid, *last_));
    write_way(folder(), origin(), rail_, way);
    write_section_vtk(folder() / "section.vtp", rail_, series_, *last_);
    write_pass_summary(folder() / kPassSummary, loaded_.spec, rail_, series_, *last_, way, answer_);
  }

  PassAnswer answer_;
  struct Contact {
    double traction = 0, largest_pressure = 0, creepage = 0;
  };
  std::vector<Contact> contacts_;    ///< of each solution, elastic
  std::vector<std::string> doubts_;  ///< of the contact
  std::optional<FollowingContact> following_;
  std::vector<BemResult> solutions_;
  std::optional<Placement> placement_;  ///< of the first solution
  RailPasses rail_;                     ///< fills those before
  std::optional<SteadyBody> body_;      ///< of rail_
  Field strain_;                        ///< of the contact at place_
  Place place_;
  PassSeries series_;
  PassLimits limits_;
  std::optional<PassResult> last_;
  PassRow last_row_;
  bool late_ = false;  ///< flow goes on at the end of the window, and it has been said
};

}  // namespace

PassesEnd passes_in_folder(LoadedCase loaded, const PassOrder& order, Control& control) {
  require_steady(loaded);
  require_cell(order.cell);
  loaded.spec.run.rolling = true;  // passes roll, as those by finite elements do
  SteadyPasses job(std::move(loaded), order, control);
  const JobEnd end = job.carry_out();
  return {job.passes(), end};
}

}  // namespace railstrata
