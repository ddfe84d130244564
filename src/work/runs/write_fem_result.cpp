#include "runs/write_fem_result.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "core/faults.hpp"
#include "io/damage_files.hpp"
#include "io/geometry_json.hpp"
#include "io/output_folder.hpp"
#include "io/result_files.hpp"
#include "io/summary_json.hpp"
#include "passage/passage.hpp"
#include "passes/rolled_pass_files.hpp"
#include "record/csv.hpp"
#include "record/output_file.hpp"
#include "record/unit.hpp"
#include "report/assets.hpp"
#include "result/stress_sections.hpp"

namespace railstrata {
namespace {

namespace fs = std::filesystem;

void write_position(const Model& model, const FemPosition& position, const fs::path& folder,
                    const std::vector<std::string>& provenance) {
  const auto& [contact, rail, wheel, streamlines, shakedown, summary] = position;
  write_patch_tables(folder, provenance, {&contact.field});
  const StressMaximum& deepest = summary.rail.subsurface->von_mises;
  write_depth_line(folder / "depth_line.csv", provenance, depth_line(rail, deepest.x, deepest.y));
  const double centre_y = centre_line(contact.field).y;
  write_sections(folder, "rail", provenance, band_sections(rail, deepest.x, centre_y));
  write_sections(folder, "wheel", provenance, band_sections(wheel, summary.wheel.subsurface->von_mises.x, centre_y));
  write_geometry(folder / "geometry.json", model.spec, model.placement);
  write_placed_surfaces(folder, model.placement, contact.position);
  write_view_script(folder);
  write_vtp(folder / "patch.vtp", patch_mesh({&contact.field}, contact.position));
  if (model.spec.run.output.volume) {
    write_vtu(folder / "rail.vtu", band_mesh(rail, contact.position));
    write_vtu(folder / "wheel.vtu", band_mesh(wheel, contact.position));
  }
  write_streamlines(folder / "streamlines.csv", provenance, streamlines);
  write_shakedown(folder, provenance, summary, shakedown);
  write_summary(folder / "summary.json", summary);
}

}  // namespace

bool has_checkpoint(const fs::path& folder) {
  std::error_code error;
  return fs::exists(checkpoint_file(folder), error) || fs::exists(previous_checkpoint_file(folder), error);
}

void save_checkpoint(const fs::path& folder, const CheckpointOrigin& origin, const RunState& state, bool stopping,
                     const Control& control) {
  try {
    write_checkpoint(folder, origin, state);
    control.info("checkpoint at x = {:.2f} mm", 1e3 * state.position());
  } catch (const EnvironmentError& e) {
    if (stopping) throw;
    control.warn("no checkpoint: {}; the run goes on", e.what());
  }
}

void FemWriter::begin_history() {
  if (!history_)
    history_.emplace(
        folder_ / "history.csv", origin_.provenance,
        history_columns(!system_.pads.none(), system_.varies_along(), !system_.rail().mesh.interfaces.empty()));
}

void FemWriter::add(const HistoryRow& row) {
  begin_history();
  history_->add(row);
  if (row.points.empty()) return;
  if (!points_)
    points_.emplace(folder_ / "points_history.csv", origin_.provenance,
                    point_columns(system_.model.spec.run.plasticity));
  for (std::size_t k = 0; k < row.points.size(); ++k) {
    const WatchedPoint& at = system_.watched_points[k];
    points_->add({row.time, row.position, static_cast<int>(k) + 1, at.x, at.depth, at.layer, row.points[k]});
  }
}

bool FemWriter::has_series() const {
  const CaseSpec& spec = system_.model.spec;
  return spec.run.rolling && spec.run.output.patch_series;
}

PatchSeries& FemWriter::series(const std::vector<double>& times) {
  if (!series_) series_.emplace(folder_, origin_.provenance, times);
  return *series_;
}

FemWriter::FemWriter(const RollingSystem& system, fs::path folder, CheckpointOrigin origin, const RunState* begun)
    : system_(system), folder_(std::move(folder)), origin_(std::move(origin)) {
  if (!begun) return;
  begin_history();
  for (const HistoryRow& row : begun->result.history) add(row);
  if (has_series()) series(begun->frame_times);
}

void FemWriter::observe(RunObserver& observer, const Control& control) {
  observer.history = [this](const HistoryRow& row) { add(row); };
  if (has_series())
    observer.frame = [this](const RollingSample& sample) {
      series().add(sample.time, series().frames(), sample.position, contact_field(system_, sample));
    };
  observer.save = [this, &control](const RunState& state, bool stopping) {
    save_checkpoint(folder_, origin_, state, stopping, control);
  };
}

void FemWriter::write(const FemSolution& solution) {
  begin_history();
  for (const FemPosition& position : solution.positions) {
    const bool last = !solution.stopped && &position == &solution.positions.back();
    const fs::path folder =
        last ? folder_ : folder_ / fmt::format("{}{:.10g}mm", kPositionFolder, 1e3 * position.contact.position);
    if (!last) make_folder(folder, Above::there);
    write_position(system_.model, position, folder, origin_.provenance);
  }
  if (const std::vector<ForceLine> lines = force_spectrum(system_.model.spec, solution.history); !lines.empty())
    write_csv(folder_ / "force_spectrum.csv", origin_.provenance, lines,
              Columns<ForceLine>{{"frequency", unit::kHertz, &ForceLine::frequency},
                                 {"wavelength", unit::kMillimetres, &ForceLine::wavelength},
                                 {"F_z_amplitude", unit::kKilonewtons, &ForceLine::amplitude}});
  if (solution.residual) write_run_residual(folder_, origin_.provenance, *solution.residual);
  if (!solution.stopped) remove_checkpoints(folder_);
}

}  // namespace railstrata
