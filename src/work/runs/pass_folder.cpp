#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <exception>
#include <memory>
#include <optional>
#include <utility>

#include "ask/answer.hpp"
#include "ask/solve_settings.hpp"
#include "bem/one_patch.hpp"
#include "core/faults.hpp"
#include "jobs/state_table.hpp"
#include "judge/check_limits.hpp"
#include "passes/pass_errors.hpp"
#include "passes/pass_plan.hpp"
#include "passes/pass_way.hpp"
#include "passes/steady_series.hpp"
#include "record/unit.hpp"
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
        series_(with_places(loaded_, [&] { return first_series(); })) {}
  int passes() const { return series_->passes(); }

 private:
  std::unique_ptr<SteadySeries> first_series() {
    SteadySeries::Listener listener{[this](int pass) { report(pass, 0); },
                                    [this](const PassRow& row, const FollowedPass& pass) { pass_ended(row, pass); },
                                    [this](const std::string& text) { control_.info("{}", text); }};
    return std::make_unique<SteadySeries>(loaded_.spec, contacts_of(loaded_.spec, wanted_.cell, true),
                                          std::move(listener), &control_);
  }

  /// judged: the answer of the rail that does not yield is kept, too.
  SeriesContacts contacts_of(const CaseSpec& of, double cell, bool judged) {
    AskOptions how;
    how.bem.cell = cell;
    how.bem.apart = false;
    how.control = &control_;
    const std::vector<CaseSpec> specs = cases_of_tractions(of);
    std::vector<Placement> placements;
    SeriesContacts out;
    // the verdict on the elastic stress stands beside the class of the rail
    Wanted wanted = kContactAlone;
    wanted.shakedown = wanted.single_track = judged;
    for (CaseSpec spec : specs) {
      spec.run.judged = JudgedBodies::rail;
      placements.push_back(in_plane(spec, place(spec, loaded_.folder()), how.bem));
      Answer answer = ask(spec, placements.back(), wanted, how);
      wanted = kContactAlone;
      if (judged) doubt(answer.summary);
      out.tractions.push_back(answer.summary.contact.F_x / answer.summary.contact.F_z);
      if (judged && out.solutions.empty()) answer_.elastic = std::move(answer.summary);
      out.solutions.push_back(std::move(answer.result));
    }
    if (judged) placement_ = placements.front();
    if (of.passes.pressure == PassPressure::following)
      out.following = std::make_unique<FollowingContact>(specs, placements, how.bem);
    return out;
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
    return fmt::format("{} {} {} {}", PassJob::identity(), series_->grid().nx, series_->grid().ny, wanted_.cell);
  }

  void begin() override {
    PassJob::begin();
    report_contact();
  }

  void resume() override {
    report_contact();
    if (std::filesystem::exists(folder() / kPassState)) series_->resume(folder() / kPassState, folder() / kPassTable);
  }

  void report_contact() {
    for (const std::string& note : series_->rail().notes) control_.info("{}", note);
    for (const std::string& doubt : answer_.doubts) control_.warn("{}", doubt);
  }

  bool finished() const override { return passes() >= wanted_.passes; }

  /// Coarser grids go before the last step: only that has the results, and a job that is stopped before takes it again.
  bool step() override {
    if (series_->nearly(wanted_.passes) && !compare()) return false;
    return series_->step(wanted_.passes);
  }

  /// All passes on the coarser grids. False: given up.
  bool compare() {
    if (compared_) return true;
    const std::vector<double> grids = coarser_grids(loaded_.spec.passes);
    if (grids.empty()) answer_.no_error = "passes.patch_cells = 2 is the coarsest grid: no other one to compare with";
    for (const double r : grids) {
      control_.info("error of the grid: the same passes on one {:.3g} times as coarse", r);
      CaseSpec spec = loaded_.spec;
      spec.passes = on_coarser_grid(spec.passes, r);
      try {
        SteadySeries other(spec, contacts_of(spec, r * wanted_.cell, false), {}, &control_);
        while (other.passes() < wanted_.passes) {
          if (!other.step(wanted_.passes)) return false;
          save_when_due();
        }
        coarser_.push_back({r, other.series().table, other.last_row().strain, verdict_of(other.series()).kind});
      } catch (const Interrupted&) {
        return false;
      } catch (const std::exception& e) {
        coarser_.clear();
        answer_.no_error = fmt::format("no passes on a grid {:.3g} times as coarse: {}", r, e.what());
        break;
      }
    }
    compared_ = true;
    return true;
  }

  void pass_ended(const PassRow& row, const FollowedPass& pass) {
    report(row, fmt::format("pressure up to {:.0f} MPa; {} iterations{}", 1e-6 * row.contact.p_max, row.iterations,
                            row.rounds > 0 ? fmt::format(", {} rounds of the contact", row.rounds) : ""));
    if (!pass.converged)
      control_.warn("pass {}: contact and yielding have not settled: pressure still changes by {:.2g} of its largest",
                    row.pass, pass.change);
    if (row.late_flow > kLateFlow && !late_) {
      late_ = true;
      control_.warn(
          "pass {}: {:.2g} % of the largest flow comes in the last quarter of the window of {:.3g} half-lengths behind "
          "the load: give a longer passes.window",
          row.pass, 100 * row.late_flow, series_->rail().window);
    }
    if (!row.converged)
      control_.warn("pass {} has not settled: stresses still change by {:.2g} of the shear strength", row.pass,
                    row.error);
  }

  /// Table before state: a table that has gone on is cut when the state is read.
  void save() override {
    write_csv(folder() / kPassTable, origin(), series_->series().table.columns);
    write_pass_state(folder() / kPassState, origin(), series_->grid(), series_->series());
  }

  void finish() override {
    if (!series_->last()) {
      control_.info("{}: there already: {}", folder().string(), passes_text(passes()));
      return;
    }
    sound_ = sound_ && series_->settled();
    save();
    write_results();
    warn_of_large_strain(series_->last_row().strain);
    control_.info("after {}: {} Results are in {}", passes_text(passes()), verdict_, folder().string());
    report_errors();
  }

  void report_errors() const {
    const PassErrors& error = answer_.error;
    if (!error.known()) {
      control_.info("no error of the grid: {}", answer_.no_error);
      return;
    }
    const PassRow& row = series_->last_row();
    control_.info(
        "pass {}: accumulated {}, net {}; residual stress {:.0f} ± {:.2g} MPa along, {:.0f} ± {:.2g} MPa across",
        row.pass, strain_text(row.largest.accumulated, error.of("accumulated_strain")),
        strain_text(row.largest.net, error.of("net_strain")), kToMega * row.stress[0], error.of("sigma_x_min_MPa"),
        kToMega * row.stress[1], error.of("sigma_y_min_MPa"));
    const PassClass own = verdict_of(series_->series()).kind;
    for (const PassClass kind : error.classes)
      if (kind != own) {
        control_.warn("the class depends on the grid: {} on a coarser one", class_text(kind));
        break;
      }
    if (const std::vector<std::string> open = not_converged(error, series_->series().table); !open.empty())
      control_.warn("{} not converged with the grid: give finer passes.patch_cells, passes.patch_rows and --cell",
                    fmt::format("{} {}", fmt::join(open, ", "), open.size() == 1 ? "has" : "have"));
  }

  /// The results are those of the last pass.
  void stop() override {
    if (!series_->last()) return;
    if (!compared_) answer_.no_error = "stopped before the passes on coarser grids had ended";
    finish();
    if (order_.page) write_page();
  }
  bool write_page() override { return !series_->last() || PassJob::write_page(); }
  std::string how_far() const override { return fmt::format("after pass {}", passes()); }

  void write_results() {
    const RailPasses& rail = series_->rail();
    const PassSeries& series = series_->series();
    const PassResult& last = *series_->last();
    const PassWay way = pass_way(rail, series_->body(), series_->strain(), last, series.state);
    if (compared_ && finished())
      answer_.error = pass_errors({1, series.table, series_->last_row().strain, verdict_of(series).kind}, coarser_,
                                  rail.grid.thickness);
    PassProgress progress = progress_of(verdict_of(series), series.strains, series_->last_row());
    progress.ductility = loaded_.spec.passes.ductility;
    progress.strain_life = strain_life_of(loaded_.spec.rail_material, "rail", "material.rail");
    progress.error = answer_.error;
    progress.cycle = series.cycle;
    answer_.verdict = verdict_ = describe(progress);
    answer_.law = describe_law(rail.rows[static_cast<std::size_t>(way.row)].law);
    answer_.ductility = loaded_.spec.passes.ductility;
    write_residual(folder(), origin(), rail, series, last);
    // one elastic contact for all passes would sink the rail deeper than the wheel reaches
    if (rail.grid.ny > 1 && loaded_.spec.passes.pressure == PassPressure::following)
      write_profile_table(folder() / kPressedProfile, origin(), pressed_profile(*placement_, rail.grid, last));
    write_way(folder(), origin(), rail, way);
    write_section_vtk(folder() / "section.vtp", rail, series, last);
    write_pass_summary(folder() / kPassSummary, loaded_.spec, rail, series, last, way, answer_);
  }

  PassAnswer answer_;
  std::optional<Placement> placement_;    ///< of the first traction
  std::unique_ptr<SteadySeries> series_;  ///< fills those before
  std::vector<ComparedPasses> coarser_;
  bool compared_ = false;
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
