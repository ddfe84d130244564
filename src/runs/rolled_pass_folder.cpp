#include <fmt/format.h>

#include <chrono>
#include <optional>
#include <utility>

#include "core/faults.hpp"
#include "io/checkpoint_file.hpp"
#include "io/provenance.hpp"
#include "runs/pass_folder_parts.hpp"
#include "runs/rolled_passes.hpp"
#include "runs/write_fem_result.hpp"

namespace railstrata {
namespace {

RolledPasses passes_of(const LoadedCase& loaded, double roll_length) {
  if (!loaded.not_in_fem.empty()) throw CaseError(loaded.not_in_fem);
  try {
    return {loaded.spec, loaded.folder(), roll_length};
  } catch (const CaseError& e) {
    throw in_case_file(loaded, e);
  }
}

/// The passes of one folder.
class RolledFolder {
 public:
  RolledFolder(const PassOrder& order, LoadedCase loaded, Control& control)
      : order_(order), loaded_(std::move(loaded)), control_(control), passes_(passes_of(loaded_, order.roll_length)) {
    require_apart(order_.folder, loaded_);
    fem_.control = &control_;
    fem_.times.checkpoint_every = order_.checkpoint_every;
  }

  PassesEnd run() {
    const FolderHold hold = prepare_output_folder(order_.folder, order_.force || order_.resume);
    order_.resume ? resume() : begin_pass_folder(loaded_, order_, identity());
    const PassRoll& roll = passes_.roll();
    control_.info("{}: a pass rolls {:.1f} mm, steady from {:.1f} to {:.1f} mm (half-length of the patch {:.2f} mm)",
                  loaded_.spec.title, 1e3 * roll.length, 1e3 * roll.from, 1e3 * roll.to, 1e3 * roll.half_length);
    while (series_.passes < order_.passes && take_pass()) {
    }
    const bool complete = series_.passes >= order_.passes;
    if (complete) conclude();
    return {series_.passes, !complete, true};
  }

 private:
  std::string identity() const { return fmt::format("{} fem {}\n", case_identity(loaded_), order_.roll_length); }
  CheckpointOrigin origin() const {
    return {fmt::format("{} pass {}", case_identity(loaded_), series_.passes + 1), version_text(),
            table_origin(loaded_)};
  }

  void resume() {
    require_same_passes(order_, identity(), " by finite elements", "the --set and the --roll-length");
    if (std::filesystem::exists(order_.folder / kPassState))
      series_ = read_rolled_series(order_.folder / kPassState, order_.folder / kPassTable);
    begun_ = checkpoint_of_pass();
  }

  /// That of the pass under way; one of the pass before is what a kill has left.
  std::optional<RunState> checkpoint_of_pass() const {
    const std::filesystem::path& folder = order_.folder;
    if (!std::filesystem::exists(checkpoint_file(folder)) && !std::filesystem::exists(previous_checkpoint_file(folder)))
      return {};
    try {
      FoundCheckpoint found = read_checkpoint(folder, origin().case_sha256);
      for (const std::string& note : found.notes)
        control_.warn("{}; the checkpoint before it is taken", note);
      return std::move(found.checkpoint.run);
    } catch (const CaseError&) {
      control_.info("pass {} begins anew", series_.passes + 1);
      return {};
    }
  }

  RunObserver observer() {
    RunObserver out;
    out.progress = [this](double fraction, const HistoryRow&) {
      report_passes(order_, series_.passes + 1, fraction, control_);
    };
    out.save = [this](const RunState& state, bool stopping) {
      save_checkpoint(order_.folder, origin(), state, stopping, control_);
    };
    return out;
  }

  /// False when it was stopped on the way.
  bool take_pass() {
    std::optional<RolledPasses::Pass> pass;
    fem_.times.begun = std::chrono::steady_clock::now();
    try {
      pass = passes_.next(series_, observer(), fem_, std::exchange(begun_, {}));
    } catch (const Interrupted&) {
    }
    if (pass) keep(*pass);
    return pass.has_value();
  }

  void keep(const RolledPasses::Pass& pass) {
    const PassRow& row = pass.row;
    control_.info(
        "pass {}: accumulated {:.3g}, net {:.3g} at {:.2f} mm; residual stress {:.0f} MPa along, {:.0f} MPa across; "
        "uneven by {:.2g}",
        row.pass, row.largest.accumulated, row.largest.net, 1e3 * row.net_depth, 1e-6 * row.stress[0],
        1e-6 * row.stress[1], pass.uneven);
    if (pass.uneven > kLargestUnevenness)
      control_.warn("pass {}: plastic strain differs by {:.2g} of itself along the steady stations", row.pass,
                    pass.uneven);
    const std::filesystem::path& folder = order_.folder;
    write_rolled_table(folder / kPassTable, table_origin(loaded_), series_);  // before the state, which cuts it
    write_rolled_result(folder, table_origin(loaded_), loaded_.spec, passes_.roll(), series_, pass, pass.loops);
    write_rolled_state(folder / kPassState, table_origin(loaded_), series_);
    remove_checkpoints(folder);
    warn_of_large_strain(row.strain, control_);
  }

  void conclude() {
    const PassVerdict verdict = verdict_of(series_.table);
    control_.info("after {}: {}; net strain {:.3g} per pass; results are in {}", passes_text(series_.passes),
                  words(verdict.kind), verdict.rate, order_.folder.string());
    write_pass_page(order_, words(verdict.kind), control_);
  }

  const PassOrder& order_;
  LoadedCase loaded_;
  Control& control_;
  RolledPasses passes_;
  FemOptions fem_;
  RolledSeries series_;
  std::optional<RunState> begun_;
};

}  // namespace

PassesEnd rolled_passes_in_folder(LoadedCase loaded, const PassOrder& order, Control& control) {
  return RolledFolder(order, std::move(loaded), control).run();
}

}  // namespace railstrata
