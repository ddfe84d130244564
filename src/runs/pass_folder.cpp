#include "runs/pass_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>

#include "core/faults.hpp"
#include "core/stop_wish.hpp"
#include "judge/check_limits.hpp"
#include "passes/pass_files.hpp"
#include "passes/pass_plan.hpp"
#include "passes/pass_way.hpp"
#include "passes/pass_way_files.hpp"
#include "passes/pass_words.hpp"
#include "result/result_table.hpp"
#include "runs/pass_folder_parts.hpp"
#include "runs/solve_half_space.hpp"
#include "runs/solve_settings.hpp"

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

/// The passes of one folder.
class SteadyFolder {
 public:
  SteadyFolder(const PassOrder& order, LoadedCase loaded, Control& control)
      : order_(order),
        loaded_(std::move(loaded)),
        control_(control),
        rail_(with_places(loaded_, [&] { return rail_of(); })),
        body_(body_of(rail_)) {
    series_.state = body_.virgin();
    series_.cycle = passes_per_cycle(loaded_.spec.passes);
    require_apart(order_.folder, loaded_);
  }

  PassesEnd run() {
    const FolderHold hold = prepare_output_folder(order_.folder, order_.force || order_.resume);
    order_.resume ? resume() : begin_pass_folder(loaded_, order_, identity());
    for (const std::string& note : rail_.notes) control_.info("{}", note);
    for (const std::string& doubt : doubts_) control_.warn("{}", doubt);
    rail_.notes.insert(rail_.notes.end(), doubts_.begin(), doubts_.end());
    limits_.control = &control_;
    while (series_.state.passes < order_.passes && !control_.stop && take_pass()) {
    }
    if (last_)
      finish();
    else if (!control_.stop)
      control_.info("{}: there already: {}", order_.folder.string(), passes_text(series_.state.passes));
    return {series_.state.passes, series_.state.passes < order_.passes, converged_ && sound_};
  }

 private:
  RailPasses rail_of() {
    BemOptions bem;
    bem.cell = order_.cell;
    const StopWish wish(&control_.stop);
    std::vector<BemResult> solutions;
    for (const CaseSpec& spec : cases_of_tractions(loaded_.spec)) {
      HalfSpaceSolution solution = solve_half_space_contact(spec, place(spec, loaded_.folder()), bem);
      doubt(solution.summary);
      if (solutions.empty()) judge_elastic(solution);
      const ContactSummary& c = solution.summary.contact;
      traction_.push_back(c.F_x / c.F_z);
      solutions.push_back(std::move(solution.result));
    }
    return rail_passes(loaded_.spec, solutions);
  }

  /// What the contact that all passes take over makes of itself, each once: checks that fail, warnings.
  void doubt(const Summary& contact) {
    const auto add = [&](std::string text) {
      if (std::find(doubts_.begin(), doubts_.end(), text) == doubts_.end()) doubts_.push_back(std::move(text));
    };
    for (const Check& c : contact.checks) {
      if (c.ok) continue;
      sound_ = false;
      const CheckRow* row = find_check(c.name);
      const ResultUnit unit = row ? row->unit : result_unit::kNone;
      add(fmt::format("a check of the contact fails: {} is {}, limit {}", c.name, with_unit(unit, c.value, 3),
                      limit_text(unit, c.limit)));
    }
    for (const Warning& w : contact.warnings) add(w.text);
  }

  /// Shakedown factors of the elastic stress, to stand beside the class; where no strength is given there are none.
  void judge_elastic(HalfSpaceSolution& solution) {
    if (!strength_given(loaded_.spec, BodyId::rail)) return;
    solution.shakedown = half_space_shakedown(loaded_.spec, solution.result);
    std::erase_if(solution.shakedown, [](const SectionShakedown& s) { return s.body != BodyId::rail; });
    complete_shakedown(loaded_.spec, solution);
    answer_.shakedown = solution.summary.shakedown;
  }

  std::string identity() const {
    return fmt::format("{} {} {} {}\n", case_identity(loaded_), rail_.grid.nx, rail_.grid.ny, order_.cell);
  }

  void resume() {
    require_same_passes(order_, identity(), "", "the --set and the --cell");
    if (!std::filesystem::exists(order_.folder / kPassState)) return;
    series_ = read_pass_series(order_.folder / kPassState, order_.folder / kPassTable, rail_.grid);
    series_.cycle = passes_per_cycle(loaded_.spec.passes);
    if (series_.state.passes > 0) stand(place_of(series_.state.passes));
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
    strain_ = contact_strain(rail_, body_, place.solution, place.column);
    place_ = place;
  }

  /// The contact of the next pass in its place; computed anew only where it is another one.
  void drive(int pass) {
    const Place next = place_of(pass);
    if (!strain_.empty() && next == place_) return;
    if (!strain_.empty()) move_guess(rail_.grid, next.column - place_.column, series_.state);
    stand(next);
  }

  /// False: it was stopped, and then it has not been.
  bool take_pass() {
    const int pass = series_.state.passes + 1;
    const Place before = place_;
    Field guess = series_.state.residual_strain;
    report_passes(order_, pass, 0, control_);
    drive(pass);
    try {
      last_ = body_.run_pass(strain_, series_.state, limits_);
    } catch (const Interrupted&) {
      series_.state.residual_strain = std::move(guess);
      if (last_ && before != place_) stand(before);
      return false;
    }
    keep(pass_row(rail_.grid, pass, *last_));
    return true;
  }

  void keep(PassRow row) {
    row.place = place_.column * rail_.grid.dy;
    row.traction = traction_[place_.solution];
    last_row_ = row;
    add_pass(row, *last_, series_);
    control_.info(
        "pass {}: accumulated {:.3g}, net {:.3g} at {:.2f} mm; residual stress {:.0f} MPa along, {:.0f} MPa across; "
        "{} iterations",
        row.pass, row.largest.accumulated, row.largest.net, 1e3 * row.net_depth, 1e-6 * row.stress[0],
        1e-6 * row.stress[1], row.iterations);
    if (!row.converged) {
      converged_ = false;
      control_.warn("pass {} has not settled: stresses still change by {:.2g} of the shear strength", row.pass,
                    row.error);
    }
    constexpr auto kOften = std::chrono::seconds(20);
    if (Clock::now() - saved_ > kOften) save();
  }

  /// Table before state: a table that has gone on is cut when the state is read.
  void save() {
    write_pass_table(order_.folder / kPassTable, table_origin(loaded_), series_);
    write_pass_state(order_.folder / kPassState, table_origin(loaded_), rail_.grid, series_);
    saved_ = Clock::now();
  }

  void finish() {
    save();
    write_results();
    warn_of_large_strain(last_row_.strain, control_);
    control_.info("after {}: {} Results are in {}", passes_text(series_.state.passes), answer_.verdict,
                  order_.folder.string());
    write_pass_page(order_, answer_.verdict, control_);
  }

  void write_results() {
    const PassWay way = pass_way(rail_, body_, strain_, *last_, series_.state);
    const std::size_t governing = way.points.front().point / static_cast<std::size_t>(rail_.grid.ny);
    answer_.verdict = pass_words(standing_of(series_, last_row_));
    answer_.law = law_words(rail_.rows[governing].law);
    answer_.ductility = loaded_.spec.passes.ductility;
    write_residual(order_.folder, table_origin(loaded_), rail_, series_, *last_);
    write_way(order_.folder, table_origin(loaded_), rail_, way);
    write_section_vtk(order_.folder / "section.vtp", rail_, series_, *last_);
    write_pass_summary(order_.folder / kPassSummary, loaded_.spec, rail_, series_, *last_, way, answer_);
  }

  using Clock = std::chrono::steady_clock;
  const PassOrder& order_;
  LoadedCase loaded_;
  Control& control_;
  PassAnswer answer_;
  std::vector<double> traction_;     ///< of each solution
  std::vector<std::string> doubts_;  ///< of the contact
  bool sound_ = true;                ///< its checks hold
  RailPasses rail_;                  ///< fills the four before
  SteadyBody body_;
  Field strain_;  ///< of the contact at place_
  Place place_;
  PassSeries series_;
  PassLimits limits_;
  std::optional<PassResult> last_;
  PassRow last_row_;
  bool converged_ = true;
  Clock::time_point saved_ = Clock::now();
};

}  // namespace

PassesEnd passes_in_folder(LoadedCase loaded, const PassOrder& order, Control& control) {
  require_steady(loaded);
  require_cell(order.cell);
  loaded.spec.run.rolling = true;  // passes roll, as those by finite elements do
  return SteadyFolder(order, std::move(loaded), control).run();
}

}  // namespace railstrata
