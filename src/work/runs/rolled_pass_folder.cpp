#include <fmt/format.h>

#include <chrono>
#include <optional>
#include <utility>

#include "core/faults.hpp"
#include "io/checkpoint_file.hpp"
#include "io/provenance.hpp"
#include "rules/clashes.hpp"
#include "runs/pass_job.hpp"
#include "runs/rolled_passes.hpp"
#include "runs/write_fem_result.hpp"

namespace railstrata {
namespace {

RolledPasses passes_of(const LoadedCase& loaded, double roll_length) {
  require_support(uses::kRolledPasses, loaded);
  return with_places(loaded, [&] { return RolledPasses(loaded.spec, loaded.folder(), roll_length); });
}

class RolledPassJob : public PassJob {
 public:
  RolledPassJob(LoadedCase loaded, const PassOrder& order, Control& control)
      : PassJob("the case, the --set, the --roll-length and the version it began with, with --engine fem",
                std::move(loaded), order, control),
        passes_(passes_of(loaded_, order.roll_length)) {
    fem_.control = &control_;
    fem_.times.checkpoint_every = order.checkpoint_every;
  }
  int passes() const { return series_.passes; }

 private:
  std::string identity() const override { return fmt::format("{} fem {}", PassJob::identity(), wanted_.roll_length); }
  CheckpointOrigin pass_origin() const {
    return {fmt::format("{} pass {}", CaseJob::identity(), series_.passes + 1), version_text(), origin()};
  }

  void begin() override {
    PassJob::begin();
    report_roll();
  }

  void resume() override {
    if (std::filesystem::exists(folder() / kPassState))
      series_ = read_rolled_series(folder() / kPassState, folder() / kPassTable);
    begun_ = checkpoint_of_pass();
    report_roll();
  }

  void report_roll() const {
    const PassRoll& roll = passes_.roll();
    control_.info("{}: a pass rolls {:.1f} mm, steady from {:.1f} to {:.1f} mm (half-length of the patch {:.2f} mm)",
                  loaded_.spec.title, 1e3 * roll.length, 1e3 * roll.from, 1e3 * roll.to, 1e3 * roll.half_length);
  }

  /// That of the pass under way; one of the pass before is what a kill has left.
  std::optional<RunState> checkpoint_of_pass() const {
    if (!has_checkpoint(folder())) return {};
    try {
      FoundCheckpoint found = read_checkpoint(folder(), pass_origin().case_sha256);
      for (const std::string& note : found.notes) control_.warn("{}; the checkpoint before it is taken", note);
      return std::move(found.checkpoint.run);
    } catch (const CaseError&) {
      control_.info("pass {} begins anew", series_.passes + 1);
      return {};
    }
  }

  RunObserver observer() {
    RunObserver out;
    out.progress = [this](double fraction, const HistoryRow&) { report(series_.passes + 1, fraction); };
    out.save = [this](const RunState& state, bool stopping) {
      save_checkpoint(folder(), pass_origin(), state, stopping, control_);
    };
    return out;
  }

  bool finished() const override { return series_.passes >= wanted_.passes; }

  bool step() override {
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
    report(row, fmt::format("uneven by {:.2g}", pass.uneven));
    if (const std::string doubt = unevenness_text(pass.uneven); !doubt.empty())
      control_.warn("pass {}: {}", row.pass, doubt);
    write_csv(folder() / kPassTable, origin(), series_.table.columns);  // before the state, which cuts it
    write_rolled_result(folder(), origin(), loaded_.spec, passes_.roll(), series_, pass, pass.loops);
    write_rolled_state(folder() / kPassState, origin(), series_);
    remove_checkpoints(folder());
    warn_of_large_strain(row.strain);
  }

  void finish() override {
    const PassVerdict verdict = classify(series_.strains);
    verdict_ = class_text(verdict.kind);
    control_.info("after {}: {}; net strain {:.3g} per pass; results are in {}", passes_text(passes()), verdict_,
                  verdict.rate, folder().string());
  }
  std::string how_far() const override { return fmt::format("in pass {}", passes() + 1); }

  RolledPasses passes_;
  FemOptions fem_;
  RolledSeries series_;
  std::optional<RunState> begun_;
};

}  // namespace

PassesEnd rolled_passes_in_folder(LoadedCase loaded, const PassOrder& order, Control& control) {
  RolledPassJob job(std::move(loaded), order, control);
  const JobEnd end = job.carry_out();
  return {job.passes(), end};
}

}  // namespace railstrata
