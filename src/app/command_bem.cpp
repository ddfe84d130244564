#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "app/commands.hpp"
#include "app/summary_text.hpp"
#include "app/waiting.hpp"
#include "post/bem_summary.hpp"
#include "runs/half_space_need.hpp"
#include "runs/output_folder.hpp"
#include "runs/peak_memory.hpp"
#include "runs/run_bem.hpp"
#include "runs/write_report.hpp"

namespace railstrata {

ExitCode command_bem(const CommandOptions& options) {
  const LoadedCase loaded = load_case_of(options);
  const std::filesystem::path out = output_folder_of(options, loaded, "-bem");
  const CaseSpec spec = half_space_case(loaded.spec);
  BemOptions bem;
  bem.cell = cell_size(options.cell);
  const Placement placement = place(spec, loaded.folder());
  const HalfSpaceNeed need = half_space_need(spec, placement, bem.cell);
  require_memory(need, bem.cell);
  answer_interrupt_with("\nstopped: nothing was written\n");
  const BemResult result = [&] {
    const Waiting waiting(fmt::format("half-spaces, {}", need_text(need)), spdlog::should_log(spdlog::level::info));
    return solve_bem(spec, placement, bem);
  }();
  for (const std::string& note : result.notes) spdlog::info("{}", note);
  Summary summary = bem_summary(spec, result);
  summary.run.commit = commit_text();
  summary.run.threads = options.threads;
  summary.run.peak_memory_bytes = peak_memory();

  require_apart(out, loaded);
  const FolderHold hold = prepare_output_folder(out, options.force);
  answer_interrupt_with("\nstopped while the results were written: they are not complete; start again with --force\n");
  clear_old_results(out);
  write_origin(out, loaded, options.command_line, options.threads);
  write_bem_geometry(out, spec, placement, summary.position);
  write_bem_result(out, table_origin(loaded), result, summary);
  print_summary(summary, options.json);
  spdlog::info("results are in {}", out.string());
  if (options.report) add_report(out, options.threads);
  const bool ok = all_checks_hold(summary);
  if (!ok) spdlog::warn("a check failed: read the results with care");
  return ok ? ExitCode::ok : ExitCode::failed_checks;
}

}  // namespace railstrata
