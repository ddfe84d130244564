#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <fstream>
#include <iterator>
#include <optional>

#include "app/case_of.hpp"
#include "app/commands.hpp"
#include "app/option_values.hpp"
#include "app/signals.hpp"
#include "core/faults.hpp"
#include "io/output_file.hpp"
#include "io/output_folder.hpp"
#include "io/pass_files.hpp"
#include "runs/solve_half_space.hpp"

namespace railstrata {
namespace {

namespace fs = std::filesystem;
constexpr const char *kTable = "passes.csv", *kState = "state.csv", *kIdentity = "passes.id", *kSummary = "passes.json";
constexpr double kLargeStrain = 0.05;  // small strains err by some percent from here on

/// Steady rolling over one rail is what the stationary method knows.
void require_steady(const LoadedCase& loaded) {
  if (loaded.spec.transient.kind != TransientKind::none)
    throw CaseError("passes are of steady rolling, the case is a transient", "take out [transient]",
                    loaded.file.string());
}

/// The passes of one folder.
class Passes {
 public:
  Passes(const CommandOptions& options, LoadedCase loaded)
      : options_(options),
        loaded_(std::move(loaded)),
        out_(output_folder_of(options, loaded_, "-passes")),
        rail_(with_places(loaded_, [&] { return rail_of(); })),
        body_(body_of(rail_)),
        strain_(contact_strain(rail_, body_)) {
    series_.state = body_.virgin();
    require_apart(out_, loaded_);
  }

  ExitCode run() {
    const FolderHold hold = prepare_output_folder(out_, options_.force || options_.passes.resume);
    options_.passes.resume ? resume() : begin();
    for (const std::string& note : rail_.notes) spdlog::info("{}", note);
    const std::atomic<bool>& stop = stop_flag();
    while (series_.state.passes < options_.passes.passes && !stop) take_pass();
    if (last_)
      finish();
    else
      spdlog::info("{}: {} passes are there already", out_.string(), series_.state.passes);
    if (series_.state.passes < options_.passes.passes) {
      spdlog::warn("stopped after pass {}; go on with --resume", series_.state.passes);
      return ExitCode::interrupted;
    }
    return converged_ ? ExitCode::ok : ExitCode::failed_checks;
  }

 private:
  RailPasses rail_of() const {
    BemOptions bem;
    bem.cell = cell_size(options_.cell);
    const HalfSpaceSolution solution =
        solve_half_space_contact(loaded_.spec, place(loaded_.spec, loaded_.folder()), bem);
    return rail_passes(loaded_.spec, solution.result);
  }

  std::string identity() const {
    return fmt::format("{} {} {} {}\n", case_identity(loaded_), rail_.grid.nx, rail_.grid.ny, options_.cell);
  }

  void begin() {
    clear_old_results(out_);
    for (const char* name : {kTable, kState, kSummary, "residual.csv", "profile.csv"}) fs::remove(out_ / name);
    write_origin(out_, loaded_, options_.command_line, options_.threads);
    write_whole_file(out_ / kIdentity, identity());
  }

  void resume() {
    std::ifstream in(out_ / kIdentity, std::ios::binary);
    if (std::string(std::istreambuf_iterator<char>(in), {}) != identity())
      throw CaseError(fmt::format("{}: no passes of this very case", out_.string()),
                      "give the case, the --set and the --cell of its beginning, or another --out without --resume");
    if (fs::exists(out_ / kState)) series_ = read_pass_series(out_ / kState, out_ / kTable, rail_.grid);
  }

  void take_pass() {
    last_ = body_.run_pass(strain_, series_.state);
    add_pass(rail_.grid, *last_, series_);
    const PassRow row = pass_row(rail_.grid, series_.state.passes, *last_);
    spdlog::info(
        "pass {}: accumulated {:.3g}, net {:.3g} at {:.2f} mm; residual stress {:.0f} MPa along, {:.0f} MPa "
        "across; {} iterations",
        row.pass, row.largest.accumulated, row.largest.net, 1e3 * row.net_depth, 1e-6 * row.stress[0],
        1e-6 * row.stress[1], row.iterations);
    if (!row.converged) {
      converged_ = false;
      spdlog::warn("pass {} has not settled: stresses still change by {:.2g} of the shear strength", row.pass,
                   row.error);
    }
    constexpr auto kOften = std::chrono::seconds(20);
    if (Clock::now() - saved_ > kOften) save();
  }

  /// Table before state: a table that has gone on is cut when the state is read.
  void save() {
    write_pass_table(out_ / kTable, table_origin(loaded_), series_);
    write_pass_state(out_ / kState, table_origin(loaded_), rail_.grid, series_);
    saved_ = Clock::now();
  }

  void finish() {
    save();
    write_residual(out_, table_origin(loaded_), rail_, series_, *last_);
    write_pass_summary(out_ / kSummary, loaded_.spec, rail_, series_);
    double largest = 0;
    for (std::size_t n = 0; n < rail_.grid.points(); ++n)
      largest = std::max(
          largest, std::sqrt(double_contraction(last_->plastic_strain[n].data(), last_->plastic_strain[n].data())));
    if (largest > kLargeStrain)
      spdlog::warn(
          "plastic strain has reached {:.3g}: beyond 0.05 small strains err by some percent, beyond 0.1 the "
          "numbers are no claim",
          largest);
    const PassVerdict verdict = verdict_of(series_);
    spdlog::info("after {} passes: {}; net strain {:.3g} per pass; results are in {}", series_.state.passes,
                 words(verdict.kind), verdict.rate, out_.string());
  }

  using Clock = std::chrono::steady_clock;
  const CommandOptions& options_;
  LoadedCase loaded_;
  fs::path out_;
  RailPasses rail_;
  SteadyBody body_;
  Field strain_;
  PassSeries series_;
  std::optional<PassResult> last_;
  bool converged_ = true;
  Clock::time_point saved_ = Clock::now();
};

}  // namespace

ExitCode command_passes(const CommandOptions& options) {
  LoadedCase loaded = load_case_of(options);
  require_steady(loaded);
  return Passes(options, std::move(loaded)).run();
}

}  // namespace railstrata
