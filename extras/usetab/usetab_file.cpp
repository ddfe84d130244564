#include "usetab/usetab_file.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "app/control.hpp"
#include "io/output_folder.hpp"
#include "io/provenance.hpp"
#include "record/output_file.hpp"
#include "usetab/usetab.hpp"

namespace railstrata {

ExitCode write_usetab(int cells, const CommandOptions& options) {
  const std::filesystem::path out = options.out.empty() ? "results/usetab" : options.out;
  const FolderHold hold = prepare_output_folder(out, options.force);
  const UsetabAxes axes = usetab_axes();
  UsetabOptions how;
  how.cells = cells;
  how.control = &control_by_signals();
  std::string text = usetab_head(axes, how.cells, fmt::format("RailStrata {}", build_info().version));
  std::size_t done = 0;
  how.solved = [&](double fraction) {
    how.control->progress("usetab", (static_cast<double>(done) + fraction) / static_cast<double>(axes.aspect.size()));
  };
  for (const double aspect : axes.aspect) {
    const std::vector<UsetabForce> forces = usetab_forces(aspect, axes, how);
    if (how.control->stop) break;
    text += usetab_rows(aspect, axes, forces);
    ++done;
  }
  how.control->progress("");
  if (how.control->stop) {
    spdlog::warn("stopped: nothing was written");
    return ExitCode::interrupted;
  }
  write_whole_file(out / "tabcon", text + usetab_end());
  spdlog::info("the table is {}", (out / "tabcon").string());
  return ExitCode::ok;
}

}  // namespace railstrata
