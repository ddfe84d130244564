#include "runs/write_fem_result.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "core/faults.hpp"
#include "io/damage_files.hpp"
#include "io/geometry_json.hpp"
#include "io/output_folder.hpp"
#include "io/placed_surfaces.hpp"
#include "io/result_files.hpp"
#include "io/summary_json.hpp"
#include "io/transient_files.hpp"
#include "passage/force_spectrum.hpp"
#include "passes/rolled_pass_files.hpp"
#include "record/csv.hpp"
#include "record/output_file.hpp"
#include "record/unit.hpp"
#include "report/view.hpp"
#include "result/stress_sections.hpp"

namespace railstrata {
namespace {

namespace fs = std::filesystem;

/// The film of an interrupted run; none where it left none, or one that was cut.
std::optional<CsvTable> film_left_in(const fs::path& file) {
  if (!fs::exists(file)) return std::nullopt;
  try {
    return read_csv(file);
  } catch (const CaseError&) {
    return std::nullopt;
  }
}

// patch.pvd with its frames, and the same as patch_film.csv.
class PatchSeries {
 public:
  /// times: of the frames that an interrupted run has left.
  PatchSeries(const RollingSystem& system, const fs::path& out, const std::vector<std::string>& provenance,
              const std::vector<double>& times)
      : system_(system),
        folder_(out / kSeriesFolder),
        series_(out / "patch.pvd"),
        left_(times.empty() ? std::nullopt : film_left_in(out / "patch_film.csv")),
        film_(out / (left_ ? "patch_film.csv" + part_ending() : "patch_film.csv"), provenance) {
    make_folder(folder_, Above::there);
    for (double time : times) series_.add(time, next_file());
    if (left_) keep_film(out);
  }
  void add(const RollingSample& sample) {
    const int frame = frames_;
    const fs::path file = next_file();
    const ContactField field = contact_field(system_, sample);
    film_.add(frame, sample.position, field);
    write_vtp(file, patch_mesh({&field}, sample.position));
    series_.add(sample.time, file);
  }

 private:
  // The film replaces the earlier one when its frames are there: a kill loses none.
  void keep_film(const fs::path& out) {
    film_.keep(*left_, frames_);
    left_.reset();
    fs::rename(out / ("patch_film.csv" + part_ending()), out / "patch_film.csv");
  }
  fs::path next_file() { return folder_ / fmt::format("patch_{:04d}.vtp", frames_++); }
  const RollingSystem& system_;
  fs::path folder_;
  PvdSeries series_;
  std::optional<CsvTable> left_;
  PatchFilm film_;
  int frames_ = 0;
};

Columns<ForceLine> spectrum_columns() {
  return {{"frequency", unit::kHertz, &ForceLine::frequency},
          {"wavelength", unit::kMillimetres, &ForceLine::wavelength},
          {"F_z_amplitude", unit::kKilonewtons, &ForceLine::amplitude}};
}

/// Folder of a position before the last.
fs::path position_folder(double position) { return fmt::format("{}{:.10g}mm", kPositionFolder, 1e3 * position); }

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

// Made when there is something to put in: a run stopped before the rolling leaves none.
struct FemWriter::GrowingFiles {
  std::optional<RecordLog<HistoryRow>> history;
  std::optional<RecordLog<PointRow>> points;
  std::optional<PatchSeries> series;

  RecordLog<HistoryRow>& history_in(const fs::path& folder, const RollingSystem& system,
                                    const std::vector<std::string>& provenance) {
    if (!history)
      history.emplace(
          folder / "history.csv", provenance,
          history_columns(!system.pads.none(), system.varies_along(), !system.rail().mesh.interfaces.empty()));
    return *history;
  }
  void add(const HistoryRow& row, const fs::path& folder, const RollingSystem& system,
           const std::vector<std::string>& provenance) {
    history_in(folder, system, provenance).add(row);
    if (row.points.empty()) return;
    if (!points)
      points.emplace(folder / "points_history.csv", provenance, point_columns(system.model.spec.run.plasticity));
    for (std::size_t k = 0; k < row.points.size(); ++k) {
      const WatchedPoint& at = system.watched_points[k];
      points->add({row.time, row.position, static_cast<int>(k) + 1, at.x, at.depth, at.layer, row.points[k]});
    }
  }
  PatchSeries& series_in(const fs::path& folder, const RollingSystem& system,
                         const std::vector<std::string>& provenance, const std::vector<double>& times = {}) {
    if (!series) series.emplace(system, folder, provenance, times);
    return *series;
  }
};

FemWriter::FemWriter(const RollingSystem& system, fs::path folder, CheckpointOrigin origin, const RunState* begun)
    : system_(system),
      folder_(std::move(folder)),
      origin_(std::move(origin)),
      growing_(std::make_unique<GrowingFiles>()) {
  if (!begun) return;
  growing_->history_in(folder_, system_, origin_.provenance);
  for (const HistoryRow& row : begun->result.history) growing_->add(row, folder_, system_, origin_.provenance);
  const CaseSpec& spec = system_.model.spec;
  if (spec.run.rolling && spec.run.output.patch_series)
    growing_->series_in(folder_, system_, origin_.provenance, begun->frame_times);
}

FemWriter::~FemWriter() = default;

void FemWriter::observe(RunObserver& observer, const Control& control) {
  observer.history = [this](const HistoryRow& row) { growing_->add(row, folder_, system_, origin_.provenance); };
  const CaseSpec& spec = system_.model.spec;
  if (spec.run.rolling && spec.run.output.patch_series)
    observer.frame = [this](const RollingSample& sample) {
      growing_->series_in(folder_, system_, origin_.provenance).add(sample);
    };
  observer.save = [this, &control](const RunState& state, bool stopping) {
    save_checkpoint(folder_, origin_, state, stopping, control);
  };
}

void FemWriter::write(const FemSolution& solution) {
  growing_->history_in(folder_, system_, origin_.provenance);
  for (const FemPosition& position : solution.positions) {
    const bool last = !solution.stopped && &position == &solution.positions.back();
    const fs::path folder = last ? folder_ : folder_ / position_folder(position.contact.position);
    if (!last) make_folder(folder, Above::there);
    write_position(system_.model, position, folder, origin_.provenance);
  }
  if (const std::vector<ForceLine> lines = force_spectrum(system_.model.spec, solution.history); !lines.empty())
    write_csv(folder_ / "force_spectrum.csv", origin_.provenance, lines, spectrum_columns());
  if (solution.residual) write_run_residual(folder_, origin_.provenance, *solution.residual);
  if (!solution.stopped) remove_checkpoints(folder_);
}

}  // namespace railstrata
