#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <optional>

#include "app/case_of.hpp"
#include "app/commands.hpp"
#include "app/option_values.hpp"
#include "app/progress.hpp"
#include "app/signals.hpp"
#include "app/write_page.hpp"
#include "core/faults.hpp"
#include "runs/pass_folder.hpp"

namespace railstrata {
namespace {

/// m; 0: chosen.
double roll_length(const PassesOptions& options) {
  if (options.wheels != "new")
    throw CaseError("--wheels same: on a short roll a wheel touches the rail at another place of its rim in every pass",
                    "--wheels new");
  return options.roll_length.empty() ? 0 : length_of("--roll-length", options.roll_length);
}

/// Options of the finite elements alone, which the stationary method would pass over in silence.
void require_stationary(const PassesOptions& options) {
  if (!options.roll_length.empty())
    throw CaseError("--roll-length: the stationary method rolls no length", "take it out, or add --engine fem");
  if (options.wheels != "new")
    throw CaseError("--wheels: the wheel of the stationary method is elastic, and the same for ever",
                    "take it out, or add --engine fem");
}

PassOrder order_of(const CommandOptions& options, const LoadedCase& loaded) {
  PassOrder order;
  order.folder = output_folder_of(options, loaded, "-passes");
  order.passes = options.passes.passes;
  order.resume = options.passes.resume;
  order.force = options.force;
  order.page = options.page;
  order.command = {options.command_line, options.threads};
  return order;
}

/// What both methods say on the screen.
PassFolderObserver teller() {
  PassFolderObserver out;
  out.wishes = [] { return RunWishes{&stop_flag(), &save_flag()}; };
  out.info = [](const std::string& text) { spdlog::info("{}", text); };
  out.warn = [](const std::string& text) { spdlog::warn("{}", text); };
  out.page = [](const std::filesystem::path& page, const std::function<WrittenPage()>& write) {
    write_page_or_warn(page, write);
  };
  return out;
}

ExitCode code_of(const PassesEnd& end) { return end.converged ? ExitCode::ok : ExitCode::failed_checks; }

}  // namespace

ExitCode command_passes(const CommandOptions& options) {
  if (options.passes.engine == engine_word(Engine::fem)) return command_rolled_passes(options);
  require_stationary(options.passes);
  LoadedCase loaded = load_half_space_case_of(options, CaseUse::yielding);
  PassOrder order = order_of(options, loaded);
  order.cell = cell_size(options.cell);
  const PassesEnd end = passes_in_folder(std::move(loaded), order, teller());
  if (!end.stopped) return code_of(end);
  spdlog::warn("stopped after pass {}; go on with --resume", end.passes);
  return ExitCode::interrupted;
}

ExitCode command_rolled_passes(const CommandOptions& options) {
  if (!options.cell.empty())
    throw CaseError("--cell: finite elements have no cells",
                    "take it out, and give mesh.element_size, or --engine bem");
  CommandOptions own = options;  // with run.plasticity, so that what it asks of others is checked
  own.overrides.emplace_back("run.plasticity=true");
  own.overrides.emplace_back("run.rolling=true");
  LoadedCase loaded = load_case_of(own, CaseUse::yielding);
  require_finite_elements(loaded);
  PassOrder order = order_of(options, loaded);
  order.roll_length = roll_length(options.passes);
  order.checkpoint_every = wall_time("--checkpoint-every", options.passes.checkpoint_every);
  std::optional<Progress> bar;
  PassFolderObserver observer = teller();
  observer.preload = [](double residual, double wanted, int iterations) {
    spdlog::debug("preload: residual {:.1e} (wanted {:.0e}), {} iterations", residual, wanted, iterations);
  };
  observer.going = [&](int pass, double fraction) {
    if (!bar) bar.emplace(fmt::format("pass {}", pass), spdlog::default_logger()->level() <= spdlog::level::info);
    bar->update(fraction);
  };
  observer.passed = [&] { bar.reset(); };
  const PassesEnd end = rolled_passes_in_folder(std::move(loaded), order, observer);
  if (!end.stopped) return code_of(end);
  spdlog::warn("stopped in pass {}; go on with --resume", end.passes + 1);
  return ExitCode::interrupted;
}

}  // namespace railstrata
