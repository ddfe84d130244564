#include "runs/run_job.hpp"

#include "model/rolling_start.hpp"

#include <fmt/format.h>

#include <utility>

#include "core/faults.hpp"
#include "io/folder_kind.hpp"
#include "io/output_folder.hpp"
#include "io/provenance.hpp"
#include "model/model.hpp"
#include "record/escaped_text.hpp"
#include "rules/clashes.hpp"
#include "runs/device_at_hand.hpp"
#include "runs/write_report.hpp"

namespace railstrata {

LoadedCase case_to_resume(const std::filesystem::path& folder) {
  if (!std::filesystem::is_directory(folder))
    throw CaseError(fmt::format("cannot go on with {}: there is no such folder", folder.string()),
                    "name the result folder of a run that was interrupted");
  if (std::filesystem::exists(folder / "summary.json") && !has_checkpoint(folder))
    throw CaseError(fmt::format("there is nothing to resume: {} holds a finished run", folder.string()),
                    "start another with `railstrata run CASE`");
  if (!std::filesystem::exists(folder / "case.toml"))
    throw CaseError(fmt::format("{} has no case.toml, which a run goes on with", folder.string()),
                    "name the result folder of a run that was interrupted, or put its case.toml back");
  return load_case(folder / "case.toml");
}

RunJob::RunJob(LoadedCase loaded, JobOrder order, const FemOptions& options, Control& control)
    : CaseJob({"run", nullptr, ""}, std::move(loaded), std::move(order), control), options_(options) {
  if (!order_.resume) require_support(uses::kFiniteElements, loaded_);
  require_device(loaded_, options.ranks);
  if (!order_.resume) place(loaded_.spec, loaded_.folder());  // faults of the input before a folder is made
  options_.control = &control;
  checkpoint_ = {{}, version_text(), origin()};
}

FolderHold RunJob::hold() { return order_.resume ? FolderHold(folder()) : CaseJob::hold(); }

void RunJob::mesh() {
  control_.info("meshing wheel and rail");
  control_.progress("meshing");
  try {
    system_ = std::unique_ptr<const RollingSystem>(new RollingSystem(fem_system(loaded_.spec, loaded_.folder())));
  } catch (const CaseError& e) {
    if (e.diagnostics.front().where.empty()) throw;
    throw in_case_file(loaded_, e);
  }
  for (const std::string& note : system_->model.placement.notes) control_.info("{}", note);
  for (const std::string& doubt : system_->model.placement.doubts) control_.warn("{}", doubt);
  const CaseSpec& spec = system_->model.spec;
  if (const std::string why = why_from_rest(spec); !why.empty() && spec.run.rolling && spec.run.start != RunStart::rest)
    control_.info("the rolling starts from rest: {}", why);
}

void RunJob::begin() {
  control_.info("{}: results go to {}", loaded_.spec.title, folder().string());
  checkpoint_.case_sha256 = identity();
  mesh();
  clear_old_results(folder());
  CaseJob::begin();
}

void RunJob::resume() {
  if (!has_checkpoint(folder()))
    throw CaseError(fmt::format("there is nothing to resume in {}: the run was stopped before its first checkpoint",
                                folder().string()),
                    fmt::format("start it again: {}", command_again(folder())));
  checkpoint_.case_sha256 = identity();
  FoundCheckpoint found = read_checkpoint(folder(), checkpoint_.case_sha256);
  for (const std::string& note : found.notes) control_.warn("{}; the checkpoint before it is taken", note);
  const CheckpointOrigin& earlier = found.checkpoint.origin;
  if (earlier.program != checkpoint_.program)
    control_.warn(
        "the run was begun by RailStrata {}, this is {}: it goes on, but not with the bits of a run in one go",
        earlier.program, checkpoint_.program);
  remove_parts(folder(), PartsOf::dead);
  checkpoint_.provenance = earlier.provenance;
  begun_ = std::move(found.checkpoint.run);
  const auto& state = begun_->stepper.state;
  control_.info("{}: goes on in {} at x = {:.2f} mm, t = {:.4g} ms", loaded_.spec.title, folder().string(),
                1e3 * begun_->position(), 1e3 * state.time);
  mesh();
}

bool RunJob::step() {
  FemWriter writer(*system_, folder(), checkpoint_, begun_ ? &*begun_ : nullptr);
  if (!begun_) {
    control_.info("static preload");
    control_.progress("preload");
  }
  RunObserver observer;
  writer.observe(observer, control_);
  try {
    FemSolution solution = solve_fem(*system_, observer, options_, std::exchange(begun_, {}));
    control_.progress("writing", 1);
    writer.write(solution);
    for (const FemPosition& position : solution.positions) summaries_.push_back(position.summary);
    for (const Summary& s : summaries_)
      for (const Check& check : s.checks) sound_ = sound_ && check.ok;
    residual_ = std::move(solution.residual);
    out_of_time_ = solution.limit_reached;
    finished_ = !solution.stopped;
  } catch (const NumericalError& e) {
    if (!std::filesystem::exists(checkpoint_file(folder()))) throw;
    throw NumericalError(
        fmt::format("{}\n    the last good state is in {}", e.what(), checkpoint_file(folder()).string()));
  }
  system_.reset();
  return finished_;
}

bool RunJob::write_page() { return add_report(folder(), control_); }

std::string RunJob::to_resume() const {
  return fmt::format("\n    railstrata run --resume {}", shell_word(folder().string()));
}

void follow_run(const LoadedCase& loaded, const std::filesystem::path& resumed, const FemOptions& options) {
  if (resumed.empty()) require_support(uses::kFiniteElements, loaded);
  require_device(loaded, options.ranks);
  std::optional<RunState> begun;
  if (!resumed.empty()) begun = read_checkpoint(resumed, case_identity(loaded)).checkpoint.run;
  const RollingSystem system = fem_system(loaded.spec, loaded.folder());
  RunObserver observer;  // what rank 0 asks for: all ranks take part in collecting the state
  const CaseSpec& spec = system.model.spec;
  if (spec.run.rolling && spec.run.output.patch_series) observer.frame = [](const RollingSample&) {};
  observer.save = [](const RunState&, bool) {};
  solve_fem(system, observer, options, std::move(begun));
}

}  // namespace railstrata
