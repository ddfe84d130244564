#include "runs/folder_run.hpp"

#include <fmt/format.h>

#include <utility>

#include "core/faults.hpp"
#include "core/shell_word.hpp"
#include "io/folder_kind.hpp"
#include "io/provenance.hpp"
#include "model/model.hpp"
#include "runs/device_at_hand.hpp"

namespace railstrata {
namespace {

bool has_checkpoint(const std::filesystem::path& folder) {
  return std::filesystem::exists(checkpoint_file(folder)) || std::filesystem::exists(previous_checkpoint_file(folder));
}

// The case of the folder, as it was run.
LoadedCase case_of_folder(const std::filesystem::path& folder) {
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

CheckpointOrigin origin_of(const LoadedCase& loaded, std::string identity) {
  return {std::move(identity), version_text(), table_origin(loaded)};
}

// What can be done once the machine lets us write again.
std::string how_to_go_on(const std::filesystem::path& folder) {
  return has_checkpoint(folder) ? fmt::format(", then go on with\n    {}", resume_command(folder))
                                : std::string(", then start the run again with --force");
}

FemSolution solve_with_files(FolderRun& run, const RollingSystem& system, const FemOptions& options) {
  const Control& control = control_or_none(options.control);
  FemWriter writer(system, run.folder, run.origin, run.begun ? &*run.begun : nullptr);
  if (!run.begun) {
    control.info("static preload");
    control.progress("preload");
  }
  RunObserver observer;
  writer.observe(observer, control);
  try {
    FemSolution solution = solve_fem(system, observer, options, std::exchange(run.begun, {}));
    control.progress("writing", 1);
    writer.write(solution);
    return solution;
  } catch (const NumericalError& e) {
    if (!std::filesystem::exists(checkpoint_file(run.folder))) throw;
    throw NumericalError(
        fmt::format("{}\n    the last good state is in {}", e.what(), checkpoint_file(run.folder).string()));
  }
}

}  // namespace

std::string resume_command(const std::filesystem::path& folder) {
  return fmt::format("railstrata run --resume {}", shell_word(folder.string()));
}

FolderRun begin_run(LoadedCase loaded, const std::filesystem::path& folder, bool force, const Ranks& ranks) {
  if (!loaded.not_in_fem.empty()) throw CaseError(loaded.not_in_fem);
  require_device(loaded, ranks);
  place(loaded.spec, loaded.folder());  // faults of the input before a folder is made
  require_apart(folder, loaded);
  FolderHold hold = prepare_output_folder(folder, force);
  CheckpointOrigin origin = origin_of(loaded, case_identity(loaded));
  return {std::move(loaded), folder, std::move(origin), std::move(hold)};
}

FolderRun resume_run(const std::filesystem::path& folder, const Ranks& ranks) {
  LoadedCase loaded = case_of_folder(folder);
  require_device(loaded, ranks);
  CheckpointOrigin origin = origin_of(loaded, identity_in_folder(folder, loaded));
  FolderHold hold(folder);
  if (!has_checkpoint(folder))
    throw CaseError(fmt::format("there is nothing to resume in {}: the run was stopped before its first checkpoint",
                                folder.string()),
                    fmt::format("start it again: {}", command_again(folder)));
  FoundCheckpoint found = read_checkpoint(folder, origin.case_sha256);
  std::vector<std::string> notes;
  for (const std::string& note : found.notes) notes.push_back(note + "; the checkpoint before it is taken");
  if (found.checkpoint.origin.program != origin.program)
    notes.push_back(fmt::format(
        "the run was begun by RailStrata {}, this is {}: it goes on, but not with the bits of a run in one go",
        found.checkpoint.origin.program, origin.program));
  remove_parts(folder, PartsOf::dead);
  origin.provenance = found.checkpoint.origin.provenance;
  return {std::move(loaded), folder, std::move(origin), std::move(hold), std::move(found.checkpoint.run),
          std::move(notes)};
}

FemSolution solve_in_folder(FolderRun& run, const RunCommand& command, const FemOptions& options) {
  try {
    control_or_none(options.control).info("meshing wheel and rail");
    control_or_none(options.control).progress("meshing");
    const RollingSystem system = fem_system(run.loaded.spec, run.loaded.folder());
    if (!run.begun) {
      clear_old_results(run.folder);
      write_origin(run.folder, run.loaded, command.command_line, command.threads);
    }
    return solve_with_files(run, system, options);
  } catch (EnvironmentError& e) {
    if (!e.remedy.empty()) e.remedy += how_to_go_on(run.folder);
    throw;
  } catch (const Interrupted& e) {  // before there was anything to keep
    throw Interrupted(fmt::format("{}\n    remedy: start it again: {}", e.what(), command_again(run.folder)));
  }
}

}  // namespace railstrata
