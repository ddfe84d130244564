#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "app/case_of.hpp"
#include "app/commands.hpp"
#include "app/option_values.hpp"
#include "app/summary_text.hpp"
#include "app/waiting.hpp"
#include "app/write_page.hpp"
#include "io/output_folder.hpp"
#include "runs/half_space_need.hpp"
#include "runs/write_half_space_result.hpp"

namespace railstrata {

ExitCode command_bem(const CommandOptions& options) {
  const LoadedCase loaded = load_case_of(options);
  const std::filesystem::path out = output_folder_of(options, loaded, "-bem");
  BemOptions bem;
  bem.cell = cell_size(options.cell);
  const Placement placement = place(loaded.spec, loaded.folder());
  const HalfSpaceNeed need = half_space_need(loaded.spec, placement, bem.cell);
  require_memory(need, bem.cell);
  answer_interrupt_with("\nstopped: nothing was written\n");
  const HalfSpaceSolution solution = [&] {
    const Waiting waiting(fmt::format("half-spaces, {}", need_text(need)), spdlog::should_log(spdlog::level::info));
    return solve_half_space(loaded.spec, placement, bem);
  }();
  for (const std::string& note : solution.result.notes) spdlog::info("{}", note);

  require_apart(out, loaded);
  const FolderHold hold = prepare_output_folder(out, options.force);
  answer_interrupt_with("\nstopped while the results were written: they are not complete; start again with --force\n");
  try {
    clear_old_results(out);
    write_origin(out, loaded, options.command_line, options.threads);
    write_half_space_result(out, table_origin(loaded), loaded.spec, placement, solution);
  } catch (EnvironmentError& e) {
    if (!e.remedy.empty()) e.remedy += ", then start it again with --force";
    throw;
  }
  print_summary(solution.summary, options.json);
  spdlog::info("results are in {}", out.string());
  if (options.page) add_report(out);
  const bool ok = all_checks_hold(solution.summary);
  if (!ok) spdlog::warn("a check failed: read the results with care");
  return ok ? ExitCode::ok : ExitCode::failed_checks;
}

}  // namespace railstrata
