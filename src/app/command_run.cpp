#include <spdlog/spdlog.h>

#include "app/commands.hpp"
#include "app/output_folder.hpp"
#include "app/progress.hpp"
#include "app/stop_flag.hpp"
#include "model/model.hpp"

namespace railstrata {

ExitCode command_run(const CommandOptions& options) {
  const LoadedCase loaded = load_case_of(options);
  const Model model = build_model(loaded.spec, loaded.folder());
  const std::filesystem::path out = output_folder_of(options, loaded);
  prepare_output_folder(out, options.force);
  write_origin(out, loaded, options.command_line, options.threads);
  spdlog::info("{}: {} elements, results go to {}", loaded.spec.title, model.rail.elements() + model.wheel.elements(), out.string());
  // The engine's call stands here: preload, rolling (Progress, stop_flag()), result files, summary.
  throw NumericalError("the finite element engine is not linked yet");
}

}  // namespace railstrata
