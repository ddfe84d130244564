#include "app/run_fem.hpp"

#include <fmt/format.h>

#include "app/peak_memory.hpp"
#include "fem/rolling_run.hpp"
#include "io/geometry_json.hpp"
#include "io/placed_surfaces.hpp"
#include "io/result_files.hpp"
#include "io/summary_json.hpp"
#include "post/fem_summary.hpp"
#include "report/view.hpp"

namespace railstrata {
namespace {

namespace fs = std::filesystem;

// patch.pvd and its frames.
class PatchSeries {
 public:
  PatchSeries(const RollingSystem& system, const fs::path& out) : system_(system), folder_(out / "patch_series"), series_(out / "patch.pvd") { fs::create_directories(folder_); }
  void add(const RollingSample& sample) {
    const fs::path file = folder_ / fmt::format("patch_{:04d}.vtp", frames_++);
    write_vtp(file, patch_mesh(contact_field(system_, sample), sample.position));
    series_.add(sample.time, file);
  }

 private:
  const RollingSystem& system_;
  fs::path folder_;
  PvdSeries series_;
  int frames_ = 0;
};

void write_position(const RollingSystem& sys, const MeanContact& mean, const Summary& summary, const fs::path& folder, const std::vector<std::string>& provenance) {
  fs::create_directories(folder);
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
  report("mesh", -1, "");
  const RollingSystem system(build_model(request.spec, request.case_folder));
  HistoryLog history(request.out / "history.csv", request.provenance);
  std::optional<PatchSeries> series;
  if (request.spec.run.rolling && request.spec.output.patch_series) series.emplace(system, request.out);

  RunObserver observer;
  observer.stop = request.stop;
  observer.preload = [&](double residual, double wanted, int iterations) { report("preload", -1, fmt::format("residual {:.1e} (wanted {:.0e}), {} iterations", residual, wanted, iterations)); };
  observer.history = [&](const HistoryRow& row) { history.add(row); };
  observer.progress = [&](double fraction, const HistoryRow& row) {
    report("rolling", fraction, fmt::format("x {:.1f} mm, F_z {:.2f} kN, F_x/F_z {:.3f}, p_max {:.0f} MPa", 1e3 * row.position, 1e-3 * row.forces.z, row.forces.x / row.forces.z, 1e-6 * row.p_max));
  };
  if (series) observer.frame = [&](const RollingSample& sample) { series->add(sample); };
  const RunResult run = run_rolling(system, observer);

  report("results", -1, "");
  FemOutcome outcome;
  outcome.stopped = run.stopped;
  for (std::size_t k = 0; k < run.positions.size(); ++k) {
    if (run.positions[k].samples.empty()) break;
    const MeanContact mean = mean_contact(system, run.positions[k]);
    Summary summary = fem_summary(system, run, mean);
    summary.run.commit = request.commit;
    summary.run.threads = request.threads;
    summary.run.peak_memory_bytes = peak_memory();
    const bool last = k + 1 == run.positions.size();
    write_position(system, mean, summary, last ? request.out : request.out / fmt::format("position_{:.0f}mm", 1e3 * mean.position), request.provenance);
    outcome.summaries.push_back(std::move(summary));
  }
  return outcome;
}

}  // namespace railstrata
