#include "runs/ranked_run.hpp"

#include <utility>

#include "io/checkpoint_file.hpp"
#include "io/output_folder.hpp"
#include "runs/device_at_hand.hpp"

namespace railstrata {

RankedRun join_run(LoadedCase loaded, const Ranks& ranks) {
  require_support(uses::kFiniteElements, loaded);
  require_device(loaded, ranks);
  return {std::move(loaded)};
}

RankedRun join_resumed_run(const std::filesystem::path& folder, const Ranks& ranks) {
  LoadedCase loaded = load_case(folder / "case.toml");
  require_device(loaded, ranks);
  FoundCheckpoint found = read_checkpoint(folder, identity_in_folder(folder, loaded));
  return {std::move(loaded), std::move(found.checkpoint.run)};
}

// The same outputs are requested as on rank 0: all ranks take part in collecting the state.
void follow_run(RankedRun& run, const FemOptions& options) {
  const RollingSystem system = fem_system(run.loaded.spec, run.loaded.folder());
  RunObserver observer;
  const CaseSpec& spec = system.model.spec;
  if (spec.run.rolling && spec.run.output.patch_series) observer.frame = [](const RollingSample&) {};
  observer.save = [](const RunState&, bool) {};
  solve_fem(system, observer, options, std::exchange(run.begun, {}));
}

}  // namespace railstrata
