#include "runs/run_fem.hpp"

#include <fmt/format.h>

#include "core/faults.hpp"
#include "fem/rolling_run.hpp"
#include "io/geometry_json.hpp"
#include "io/output_file.hpp"
#include "io/placed_surfaces.hpp"
#include "io/result_files.hpp"
#include "io/summary_json.hpp"
#include "post/fem_summary.hpp"
#include "report/view.hpp"
#include "runs/memory_need.hpp"
#include "runs/output_folder.hpp"
#include "runs/peak_memory.hpp"
#include "runs/stop_flag.hpp"

namespace railstrata {
namespace {

namespace fs = std::filesystem;

// patch.pvd and its frames.
class PatchSeries {
 public:
  /// times: of the frames that an interrupted run has left.
  PatchSeries(const RollingSystem& system, const fs::path& out, const std::vector<double>& times)
      : system_(system), folder_(out / kSeriesFolder), series_(out / "patch.pvd") {
    make_folder(folder_, Above::there);
    for (double time : times) series_.add(time, next_file());
  }
  void add(const RollingSample& sample) {
    const fs::path file = next_file();
    write_vtp(file, patch_mesh(contact_field(system_, sample), sample.position));
    series_.add(sample.time, file);
  }

 private:
  fs::path next_file() { return folder_ / fmt::format("patch_{:04d}.vtp", frames_++); }
  const RollingSystem& system_;
  fs::path folder_;
  PvdSeries series_;
  int frames_ = 0;
};

// history.csv and the series, made when there is something to put in: a run stopped before the rolling leaves none.
class RunningFiles {
 public:
  RunningFiles(const RollingSystem& system, const FemRequest& request) : system_(system), request_(request) {
    if (!request.resume) return;
    open_history();
    for (const HistoryRow& row : request.resume->result.history) history_->add(row);
    if (wants_series()) series_.emplace(system_, request_.out, request.resume->frame_times);
  }
  bool wants_series() const { return request_.spec.run.rolling && request_.spec.output.patch_series; }
  void open_history() {
    if (!history_) history_.emplace(request_.out / "history.csv", request_.provenance);
  }
  void add(const HistoryRow& row) {
    open_history();
    history_->add(row);
  }
  void add(const RollingSample& sample) {
    if (!series_) series_.emplace(system_, request_.out, std::vector<double>{});
    series_->add(sample);
  }

 private:
  const RollingSystem& system_;
  const FemRequest& request_;
  std::optional<HistoryLog> history_;
  std::optional<PatchSeries> series_;
};

/// Of a position before the last.
fs::path position_folder(double position) { return fmt::format("{}{:.10g}mm", kPositionFolder, 1e3 * position); }

void write_position(const RollingSystem& sys, const MeanContact& mean, const Summary& summary, const fs::path& folder,
                    const std::vector<std::string>& provenance) {
  write_patch_tables(folder, provenance, mean.field);
  const double contact_y = sys.model.placement.contact.point.y;
  const BandStress rail = band_stress(sys.model.rail, mean.rail, contact_y - sys.model.rail.origin.y);
  const BandStress wheel = band_stress(sys.model.wheel, mean.wheel, contact_y - sys.model.wheel.origin.y);
  const StressMaximum& deepest = summary.rail.subsurface->von_mises;
  write_depth_line(folder / "depth_line.csv", provenance, depth_line(rail, deepest.x, deepest.y));
  const double centre_y = centre_line(mean.field).y;
  write_sections(folder, "rail", provenance, band_sections(rail, deepest.x, centre_y));
  write_sections(folder, "wheel", provenance, band_sections(wheel, summary.wheel.subsurface->von_mises.x, centre_y));
  write_geometry(folder / "geometry.json", sys.model.spec, sys.model.placement);
  write_placed_surfaces(folder, sys.model.placement, mean.position);
  write_view_script(folder);
  write_vtp(folder / "patch.vtp", patch_mesh(mean.field, mean.position));
  if (sys.model.spec.output.volume) {
    write_vtu(folder / "rail.vtu", band_mesh(rail, mean.position));
    write_vtu(folder / "wheel.vtu", band_mesh(wheel, mean.position));
  }
  write_summary(folder / "summary.json", summary);
}

}  // namespace

FemOutcome run_fem(const FemRequest& request) {
  auto report = [&](const std::string& phase, double fraction, const std::string& detail) {
    if (request.report) request.report(phase, fraction, detail);
  };
  RunControl control(request.times);
  report("mesh", -1, "");
  const Model model = build_model(request.spec, request.case_folder);
  require_memory(model);
  const RollingSystem system(model);
  if (request.begin) request.begin();
  RunningFiles files(system, request);
  if (!request.resume) report("preload", -1, "");

  RunObserver observer;
  observer.stop = &stop_flag();
  observer.preload = [&](double residual, double wanted, int iterations) {
    control.watch_limit();
    report("preload", -1, fmt::format("residual {:.1e} (wanted {:.0e}), {} iterations", residual, wanted, iterations));
  };
  observer.history = [&](const HistoryRow& row) { files.add(row); };
  observer.progress = [&](double fraction, const HistoryRow& row) {
    report("rolling", fraction,
           fmt::format("x {:.1f} mm, F_z {:.2f} kN, F_x/F_z {:.3f}, p_max {:.0f} MPa", 1e3 * row.position,
                       1e-3 * row.forces.z, row.forces.x / row.forces.z, 1e-6 * row.p_max));
  };
  if (files.wants_series()) observer.frame = [&](const RollingSample& sample) { files.add(sample); };
  Demand demand = Demand::go_on;
  observer.demand = [&] { return demand = control.demand(); };
  observer.save = [&](const RunState& state) {
    const auto start = std::chrono::steady_clock::now();
    try {
      write_checkpoint(request.out, {request.case_sha256, request.program, request.provenance}, state);
      report("checkpoint", -1, fmt::format("x = {:.2f} mm", 1e3 * state.stepper.state.axle.x));
    } catch (const EnvironmentError& e) {
      if (demand == Demand::save_and_stop) throw;
      report("warning", -1, fmt::format("no checkpoint: {}; the run goes on", e.what()));
    }
    control.saved(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  };
  const RunResult run = [&] {
    try {
      return request.resume ? resume_rolling(system, observer, *request.resume) : run_rolling(system, observer);
    } catch (const NumericalError& e) {
      if (!std::filesystem::exists(checkpoint_file(request.out))) throw;
      throw NumericalError(
          fmt::format("{}\n    the last good state is in {}", e.what(), checkpoint_file(request.out).string()));
    } catch (const Interrupted&) {
      if (!control.limit_reached()) throw;
      throw EnvironmentError(
          "the static preload alone takes longer than --max-time allows: there is nothing to resume yet; give the run "
          "more time");
    }
  }();

  report("results", -1, "");
  files.open_history();
  FemOutcome outcome;
  outcome.stopped = run.stopped;
  outcome.limit_reached = control.limit_reached();
  for (std::size_t k = 0; k < run.positions.size(); ++k) {
    if (run.positions[k].samples.empty()) break;
    const MeanContact mean = mean_contact(system, run.positions[k]);
    Summary summary = fem_summary(system, run, mean);
    summary.run.commit = request.commit;
    summary.run.threads = request.threads;
    summary.run.peak_memory_bytes = peak_memory();
    const bool last = !run.stopped && k + 1 == run.positions.size();
    const fs::path folder = last ? request.out : request.out / position_folder(run.positions[k].position);
    if (!last) make_folder(folder, Above::there);
    write_position(system, mean, summary, folder, request.provenance);
    outcome.summaries.push_back(std::move(summary));
  }
  if (!run.stopped) remove_checkpoints(request.out);
  return outcome;
}

}  // namespace railstrata
