#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "app/commands.hpp"
#include "app/output_folder.hpp"
#include "app/progress.hpp"
#include "app/run_fem.hpp"
#include "app/stop_flag.hpp"
#include "io/provenance.hpp"
#include "io/summary_json.hpp"
#include "model/model.hpp"

namespace railstrata {
namespace {

std::vector<std::string> table_origin(const LoadedCase& loaded) {
  return {fmt::format("RailStrata {}", version_text()), fmt::format("case: {} ({})", loaded.file.filename().string(), loaded.spec.title),
          "x from the axle in the rolling direction, y towards the field side; tractions act on the rail"};
}

std::string in_mm(double metres) { return fmt::format("{:.2f} mm", 1e3 * metres); }

void print_summary(const Summary& s) {
  const ContactSummary& c = s.contact;
  fmt::print("\n{}, wheel at {}\n", s.title, in_mm(s.position));
  fmt::print("  p_max            {:8.1f} MPa\n", 1e-6 * c.p_max);
  fmt::print("  q_max            {:8.1f} MPa\n", 1e-6 * c.q_max);
  fmt::print("  patch            {} long, {} wide, {:.1f} mm²\n", in_mm(c.patch_length), in_mm(c.patch_width), 1e6 * c.patch_area);
  fmt::print("  slip area        {:8.1f} % of the patch\n", 100 * c.slip_area_fraction);
  fmt::print("  forces on wheel  F_x {:.2f}, F_y {:.2f}, F_z {:.2f} kN, F_x/F_z {:.4f}\n", 1e-3 * c.F_x, 1e-3 * c.F_y, 1e-3 * c.F_z, c.F_x / c.F_z);
  if (std::isfinite(c.creepage_x)) fmt::print("  creepage         {:8.3f} e-3 longitudinal (negative: driving)\n", 1e3 * c.creepage_x);
  fmt::print("  penetration      {:8.4f} um of {:.1f} um approach\n", 1e6 * c.penetration_max, 1e6 * c.approach);
  auto maximum = [](const char* what, const std::optional<StressPair>& pair) {
    if (!pair) return;
    fmt::print("  rail {:<11} von Mises {:7.1f} MPa at x {:+.2f}, y {:+.2f}, depth {:.2f} mm; sigma_1 {:7.1f} MPa at x {:+.2f}, y {:+.2f}, depth {:.2f} mm\n", what, 1e-6 * pair->von_mises.value,
               1e3 * pair->von_mises.x, 1e3 * pair->von_mises.y, 1e3 * pair->von_mises.depth, 1e-6 * pair->sigma1.value, 1e3 * pair->sigma1.x, 1e3 * pair->sigma1.y, 1e3 * pair->sigma1.depth);
  };
  maximum("surface", s.rail.surface);
  maximum("subsurface", s.rail.subsurface);
  maximum("layer", s.rail.layer);
  maximum("interface", s.rail.interface);
  maximum("matrix", s.rail.matrix);
  fmt::print("  checks\n");
  for (const Check& k : s.checks) fmt::print("    {:<6} {:<34} {:10.3g}  (limit {:.3g})\n", k.ok ? "ok" : "FAILED", k.name, k.value, k.limit);
}

// One bar or line of progress per phase.
class PhaseReport {
 public:
  explicit PhaseReport(bool shown) : shown_(shown) {}
  void operator()(const std::string& phase, double fraction, const std::string& detail) {
    if (phase != phase_) {
      phase_ = phase;
      bar_.reset();
      if (phase == "rolling") bar_.emplace("rolling", shown_);
      else if (phase != "results") spdlog::info("{}", phase == "mesh" ? "meshing wheel and rail" : "static preload");
    }
    if (bar_) bar_->update(fraction);
    if (!detail.empty()) spdlog::debug("{}: {}", phase, detail);
  }

 private:
  bool shown_;
  std::string phase_;
  std::optional<Progress> bar_;
};

}  // namespace

ExitCode command_run(const CommandOptions& options) {
  const LoadedCase loaded = load_case_of(options);
  const std::filesystem::path out = output_folder_of(options, loaded);
  place(loaded.spec, loaded.folder());  // faults of the input before a folder is made
  prepare_output_folder(out, options.force);
  write_origin(out, loaded, options.command_line, options.threads);
  spdlog::info("{}: results go to {}", loaded.spec.title, out.string());

  FemRequest request;
  request.spec = loaded.spec;
  request.case_folder = loaded.folder();
  request.out = out;
  request.provenance = table_origin(loaded);
  request.commit = build_info().commit + (build_info().dirty ? "+dirty" : "");
  request.threads = options.threads;
  PhaseReport report(spdlog::default_logger()->level() <= spdlog::level::info);
  request.report = std::ref(report);
  request.stop = &stop_flag();
  const FemOutcome outcome = run_fem(request);

  for (const Summary& s : outcome.summaries) {
    if (options.json) fmt::print("{}\n", summary_json(s).dump(2));
    else print_summary(s);
  }
  if (outcome.stopped) {
    spdlog::warn("stopped before the last wanted position; {} holds the history so far", out.string());
    return ExitCode::interrupted;
  }
  const bool all_ok = std::all_of(outcome.summaries.begin(), outcome.summaries.end(), [](const Summary& s) { return std::all_of(s.checks.begin(), s.checks.end(), [](const Check& k) { return k.ok; }); });
  if (!all_ok) spdlog::warn("a check failed: read the results with care");
  return all_ok ? ExitCode::ok : ExitCode::failed_checks;
}

}  // namespace railstrata
