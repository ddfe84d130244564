#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "ask/answer.hpp"
#include "ask/solve_settings.hpp"
#include "bem/one_patch.hpp"
#include "core/faults.hpp"
#include "jobs/state_table.hpp"
#include "judge/check_limits.hpp"
#include "passes/pass_plan.hpp"
#include "passes/pass_runner.hpp"
#include "passes/pass_way.hpp"
#include "result/result_table.hpp"
#include "rules/clashes.hpp"
#include "runs/pass_job.hpp"

namespace railstrata {
namespace {

class SteadyPasses : public PassJob {
 public:
  SteadyPasses(LoadedCase loaded, const PassOrder& order, Control& control)
      : PassJob("the case, the --set, the --cell, the grid and the version it began with", std::move(loaded), order,
                control),
        runner_(with_places(loaded_, [&] { return runner_of(); })) {
    series_.state = runner_.body().virgin();
    series_.cycle = passes_per_cycle(loaded_.spec.passes);
    if (loaded_.spec.passes.jump != PassJump::off) series_.jump.length = kShortestJump;
  }
  int passes() const { return series_.state.passes; }

 private:
  PassRunner runner_of() {
    AskOptions how;
    how.bem.cell = wanted_.cell;
    how.bem.apart = false;
    how.control = &control_;
    const std::vector<CaseSpec> specs = cases_of_tractions(loaded_.spec);
    std::vector<Placement> placements;
    std::vector<BemResult> solutions;
    // the verdict on the elastic stress stands beside the class of the rail
    Wanted wanted = kContactAlone;
    wanted.shakedown = wanted.single_track = true;
    for (CaseSpec spec : specs) {
      spec.run.judged = JudgedBodies::rail;
      placements.push_back(in_plane(spec, place(spec, loaded_.folder()), how.bem));
      Answer answer = ask(spec, placements.back(), wanted, how);
      wanted = kContactAlone;
      doubt(answer.summary);
      tractions_.push_back(answer.summary.contact.F_x / answer.summary.contact.F_z);
      if (solutions.empty()) answer_.elastic = std::move(answer.summary);
      solutions.push_back(std::move(answer.result));
    }
    placement_ = placements.front();
    if (loaded_.spec.passes.pressure == PassPressure::following) following_.emplace(specs, placements, how.bem);
    return {loaded_.spec, std::move(solutions), following_ ? &*following_ : nullptr, &control_};
  }

  /// Collects failed checks and warnings of the contact that all passes use, each once.
  void doubt(const Summary& contact) {
    for (const Check& c : contact.checks) {
      if (c.ok) continue;
      sound_ = false;
      const auto [name, unit] = check_words(c.name);
      add_doubt(fmt::format("a check of the contact fails: {} is {}, limit {}", name, with_unit(unit, c.value, 3),
                            limit_text(unit, c.limit)));
    }
    for (const Warning& w : contact.warnings) add_doubt(w.text);
  }
  void add_doubt(std::string text) {
    std::vector<std::string>& doubts = answer_.doubts;
    if (std::find(doubts.begin(), doubts.end(), text) == doubts.end()) doubts.push_back(std::move(text));
  }

  std::string identity() const override {
    return fmt::format("{} {} {} {}", PassJob::identity(), grid().nx, grid().ny, wanted_.cell);
  }

  void begin() override {
    PassJob::begin();
    report_contact();
  }

  void resume() override {
    report_contact();
    if (!std::filesystem::exists(folder() / kPassState)) return;
    const int stations = active_stations(folder() / kPassState);
    // where no window is long enough it is a state of another grid, which is refused below
    while (grid().active_stations() < stations && runner_.lengthen(1, series_.state)) {
    }
    series_ = read_pass_series(folder() / kPassState, folder() / kPassTable, grid(), series_.cycle);
    if (passes() > 0) runner_.stand(place_of(passes()), series_.state);
  }

  void report_contact() {
    for (const std::string& note : runner_.rail().notes) control_.info("{}", note);
    for (const std::string& doubt : answer_.doubts) control_.warn("{}", doubt);
  }

  const SteadyGrid& grid() const { return runner_.rail().grid; }
  PassRunner::Place place_of(int pass) const {
    const PassPlan plan = pass_plan(loaded_.spec.passes, pass);
    return {columns_to(grid(), plan.lateral), plan.traction};
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
    PassRunner::Place place;
    Field strain;
    bool sound;
  };
  Kept keep_all() const { return {series_, last_, last_row_, runner_.place(), runner_.strain(), sound_}; }
  void take_back(const Kept& kept) {
    series_ = kept.series;
    last_ = kept.last;
    last_row_ = kept.row;
    sound_ = kept.sound;
    runner_.take_back(kept.place, kept.strain);
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
        runner_.stand(place_of(before.passes + n), series_.state);
        runner_.roll(series_.state);
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
    double window = runner_.rail().window;
    try {
      FollowedPass rolled = runner_.next(place_of(pass), series_.state, [&] {
        control_.info("flow goes on behind the load: followed over {:.3g} half-lengths instead of {:.3g}",
                      runner_.rail().window, window);
        window = runner_.rail().window;
        kept = keep_all();
      });
      last_ = std::move(rolled.result);
      keep(pass_row(grid(), pass, *last_), rolled);
    } catch (const Interrupted&) {
      take_back(kept);
      return false;
    }
    return true;
  }

  void keep(PassRow row, const FollowedPass& pass) {
    row.contact = {tractions_[runner_.place().solution], pass.creepage, pass.largest_pressure,
                   runner_.place().column * grid().dy};
    row.rounds = pass.rounds;
    last_row_ = row;
    add_pass(row, *last_, series_);
    report(row, fmt::format("pressure up to {:.0f} MPa; {} iterations{}", 1e-6 * row.contact.p_max, row.iterations,
                            row.rounds > 0 ? fmt::format(", {} rounds of the contact", row.rounds) : ""));
    if (!pass.converged) {
      sound_ = false;
      control_.warn("pass {}: contact and yielding have not settled: pressure still changes by {:.2g} of its largest",
                    row.pass, pass.change);
    }
    if (row.late_flow > kLateFlow && !late_) {
      late_ = true;
      control_.warn(
          "pass {}: {:.2g} % of the largest flow comes in the last quarter of the window of {:.3g} half-lengths behind "
          "the load: give a longer passes.window",
          row.pass, 100 * row.late_flow, runner_.rail().window);
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
    write_pass_state(folder() / kPassState, origin(), grid(), series_);
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
    const RailPasses& rail = runner_.rail();
    const PassWay way = pass_way(rail, runner_.body(), runner_.strain(), *last_, series_.state);
    PassProgress progress = progress_of(verdict_of(series_), series_.strains, last_row_);
    progress.ductility = loaded_.spec.passes.ductility;
    progress.strain_life = strain_life_of(loaded_.spec.rail_material, "rail", "material.rail");
    answer_.verdict = verdict_ = describe(progress);
    answer_.law = describe_law(rail.rows[static_cast<std::size_t>(way.row)].law);
    answer_.ductility = loaded_.spec.passes.ductility;
    write_residual(folder(), origin(), rail, series_, *last_);
    // one elastic contact for all passes would sink the rail deeper than the wheel reaches
    if (rail.grid.ny > 1 && loaded_.spec.passes.pressure == PassPressure::following)
      write_profile_table(folder() / kPressedProfile, origin(), pressed_profile(*placement_, rail.grid, *last_));
    write_way(folder(), origin(), rail, way);
    write_section_vtk(folder() / "section.vtp", rail, series_, *last_);
    write_pass_summary(folder() / kPassSummary, loaded_.spec, rail, series_, *last_, way, answer_);
  }

  PassAnswer answer_;
  std::vector<double> tractions_;  ///< of each solution
  std::optional<FollowingContact> following_;
  std::optional<Placement> placement_;  ///< of the first solution
  PassRunner runner_;                   ///< fills those before
  PassSeries series_;
  std::optional<PassResult> last_;
  PassRow last_row_;
  bool late_ = false;  ///< flow goes on at the end of the window, and it has been said
};

}  // namespace

PassesEnd passes_in_folder(LoadedCase loaded, const PassOrder& order, Control& control) {
  require_support(uses::kPasses, loaded);
  require_cell(order.cell);
  loaded.spec.run.rolling = true;  // passes roll, as those by finite elements do
  SteadyPasses job(std::move(loaded), order, control);
  const JobEnd end = job.carry_out();
  return {job.passes(), end};
}

}  // namespace railstrata
