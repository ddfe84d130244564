#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <CLI/CLI.hpp>

#include <ctime>
#include <memory>
#include <numbers>

#include <nlohmann/json.hpp>

#include "app/case_of.hpp"
#include "app/check_report.hpp"
#include "app/common_options.hpp"
#include "app/control.hpp"
#include "app/profile_report.hpp"
#include "app/progress.hpp"
#include "app/time_estimate.hpp"
#include "ask/cell_time.hpp"
#include "core/faults.hpp"
#include "core/printable.hpp"
#include "curving/curve_files.hpp"
#include "fem/memory_need.hpp"
#include "io/output_folder.hpp"
#include "rules/support.hpp"
#include "runs/device_at_hand.hpp"
#include "runs/receptance.hpp"

namespace railstrata {
namespace {

struct CheckOptions {
  bool mesh = false;                            ///< --mesh
  bool receptance = false;                      ///< --receptance
  double largest = 3000;                        ///< --largest frequency of a receptance, Hz
  std::string time = "0.1 s";                   ///< --time: how long a blow is followed
  bool beam = false;                            ///< --beam: without finite elements
  std::vector<std::filesystem::path> measured;  ///< --measured
  std::string as;                               ///< --as: what a profile file is of
  std::vector<std::string> vary;                ///< --vary: of a sweep whose time is asked
  bool stresses = false;                        ///< --stresses, of the sweep
  int passes = 0;                               ///< --passes whose time is asked
};

// Processor time of this process until it has read its case; the page of a command takes about as long again.
double start_seconds = 0;
constexpr double kStartAndPage = 2;

std::vector<TimeEstimate> times_of(const LoadedCase& loaded, const CheckOptions& own, const CommandOptions& options,
                                   double before = 0) {
  return time_estimates(loaded, {cell_size(options.cell), options.threads, own.vary, own.stresses, own.passes, before,
                                 kStartAndPage * start_seconds});
}

/// Every tenth row from the first: at rest, 100 Hz, 200 Hz, …
void print_table(const Receptance& r, const std::vector<CsvColumn>& table) {
  constexpr std::size_t kEach = 10;
  fmt::print("displacement over force at the place of the force; pinned-pinned mode of the beam: {:.0f} Hz\n\n",
             r.pinned_pinned);
  for (const CsvColumn& c : table) fmt::print("{:>{}}", c.name, c.name.size() + 2);
  fmt::print("\n");
  for (std::size_t i = 0; i < r.frequency.size(); i += kEach) {
    for (const CsvColumn& c : table) fmt::print("{:>{}.4g}", c.values[i], c.name.size() + 2);
    fmt::print("\n");
  }
}

double blow_time(const std::string& text) {
  const double time = wall_time("--time", text);
  if (time >= 1e-3 && time <= 10) return time;
  throw CaseError(fmt::format("--time {} is out of range", text), "write a time from 1 ms to 10 s, e.g. \"0.1 s\"");
}

/// Writes receptance.csv and the page.
ExitCode check_receptance(const CheckOptions& wanted, const CommandOptions& options) {
  const LoadedCase loaded = load_case_of(options, uses::kReceptance);
  const std::filesystem::path out = output_folder_of(options, loaded, "-receptance");
  answer_interrupt_with("\nstopped: nothing was written\n");
  const double time = blow_time(wanted.time);
  std::vector<BlowEnergy> blows;
  std::vector<MeasuredReceptance> measured;
  for (const std::filesystem::path& file : wanted.measured) measured.push_back(read_receptance(file));
  const Receptance receptance = with_places(loaded, [&] {
    const Model model = build_model(loaded.spec, loaded.folder());
    Receptance all = beam_receptances(model, receptance_frequencies(wanted.largest));
    all.measured = measured;
    if (wanted.beam) return all;
    const Waiting waiting("blows of a hammer");
    blows = add_hammer_receptances(model, time, {}, all);
    return all;
  });
  for (const BlowEnergy& e : blows)
    spdlog::info(
        "energy of a blow: {:.3g} J; pads took {:.1f} %, ballast {:.1f} %, the rail's ends {:.1f} %, {:.2g} % "
        "is left, closure {:.1e}",
        e.supplied, 100 * e.pads / e.supplied, 100 * e.ballast / e.supplied, 100 * e.ends / e.supplied,
        100 * e.kept / e.supplied, e.closure() / e.supplied);
  const std::vector<CsvColumn> table = receptance_table(receptance);
  const FolderHold hold = prepare_output_folder(out, options.force);
  write_origin(out, loaded, options.command_line, options.threads);
  write_csv(out / "receptance.csv", table_origin(loaded), table);
  if (options.page) write_receptance_page(out / "report.html", loaded.spec.title, receptance);
  if (options.json) {
    nlohmann::ordered_json json{{"title", loaded.spec.title}, {"pinned_pinned_Hz", receptance.pinned_pinned}};
    for (const CsvColumn& c : table) json[c.name] = c.values;
    fmt::print("{}\n", json.dump(2));
  } else {
    print_table(receptance, table);
    for (const std::string& words : differences_in_words(receptance)) fmt::print("measured: {}\n", words);
  }
  spdlog::info("results are in {}", out.string());
  return ExitCode::ok;
}

/// Why a run would be refused here, though the case is sound: the card that it asks for; empty: it would not.
std::string lacking_here(const LoadedCase& loaded) {
  try {
    require_device(loaded);
  } catch (const EnvironmentError& e) {
    return fmt::format("{}\n    remedy: {}", e.what(), e.remedy);
  }
  return {};
}

void tell_profiles(const Placement& placement) {
  for (const std::string& note : placement.notes) spdlog::info("{}", note);
  for (const std::string& doubt : placement.doubts) spdlog::warn("{}", doubt);
}

/// For a case of the half-space engine alone: reports where the bodies touch, and why `run` refuses it.
ExitCode check_without_mesh(const LoadedCase& loaded, const std::vector<Diagnostic>& refused, const CheckOptions& own,
                            const CommandOptions& options) {
  const Placement placement = place(loaded.spec, loaded.folder());
  tell_profiles(placement);
  const std::vector<TimeEstimate> times = times_of(loaded, own, options);
  if (options.json) {
    nlohmann::ordered_json out = placement_json(loaded.spec, placement);
    out["times"] = times_json(times);
    out["not_in_fem"] = nlohmann::ordered_json::array();
    for (const Diagnostic& d : refused) out["not_in_fem"].push_back(d.message);
    fmt::print("{}\n", out.dump(2));
    return ExitCode::ok;
  }
  print_case(loaded, placement);
  print_times(times);
  fmt::print("\nfor `railstrata bem` alone; `run` refuses it:\n");
  for (const Diagnostic& d : refused) fmt::print("{}\n", printable(fmt::format("{}: {}", d.where, d.message)));
  return ExitCode::ok;
}

/// For a curve: where its wheelsets stand. Throws CaseError as `collective` does.
ExitCode check_curve(const LoadedCase& loaded, const CheckOptions& own, const CommandOptions& options) {
  const Placement placement = place(loaded.spec, loaded.folder());
  tell_profiles(placement);
  std::vector<BogieInCurve> bogies;
  const double seconds = processor_seconds([&] { bogies = solve_curve(loaded, &control()); });
  if (options.json)
    fmt::print("{}\n", curving_json(bogies).dump(2));
  else {
    print_case(loaded, placement);
    fmt::print("\n");
    for (const std::string& line : curving_lines(bogies)) fmt::print("{}\n", printable(line));
  }
  require_equilibrium(bogies);
  if (options.json) return ExitCode::ok;
  const bool both = loaded.spec.collective.curve.rail == CurveRail::both;
  const LoadedCase one = both ? with_overrides(loaded, {"curve.rail=\"outer\""}) : loaded;
  fmt::print("\n");
  print_times(times_of(with_curve_loads(one, bogies), own, options, seconds));
  if (both) fmt::print("               of one of both rails\n");
  return ExitCode::ok;
}

/// Where the bodies touch but cannot be meshed there (a contact on the flange), `run` alone refuses the case.
Model model_for_run(const LoadedCase& loaded) {
  try {
    return build_model(loaded.spec, loaded.folder());
  } catch (const CaseError& e) {
    const RigidContact c = place(loaded.spec, loaded.folder()).contact;
    spdlog::info(
        "the bodies touch at y = {:.3f} mm, z = {:.3f} mm, at an angle of {:.1f} degrees; {}`railstrata run` "
        "refuses the case:",
        1e3 * c.point.y, 1e3 * c.point.z, c.angle * 180 / std::numbers::pi,
        refused_by(uses::kHalfSpaces, loaded.spec).empty() ? "`railstrata bem` makes no mesh and takes it, " : "");
    if (e.diagnostics.front().where.empty()) throw;
    throw in_case_file(loaded, e);
  }
}

/// --mesh: rail.vtu and wheel.vtu, in a folder with the case.
void write_meshes(const CommandOptions& options, const LoadedCase& loaded, const Model& model) {
  const std::filesystem::path out = output_folder_of(options, loaded, "-mesh");
  const FolderHold hold = prepare_output_folder(out, options.force);
  write_origin(out, loaded, options.command_line, options.threads);
  write_mesh(out / "rail.vtu", model.rail);
  write_mesh(out / "wheel.vtu", model.wheel);
  spdlog::info("rail.vtu and wheel.vtu are in {}", out.string());
}

void require_nothing_to_write(const CommandOptions& options) {
  if (!options.out.empty() || options.force)
    throw CaseError("--out and --force: check writes no files by itself",
                    "add --mesh or --receptance, or leave them out");
}

ExitCode command_check(const CheckOptions& own, const CommandOptions& options) {
  if (names_profile_file(options.case_file)) return check_profile(options, own.as);
  if (own.receptance) return check_receptance(own, options);
  if (!own.mesh) require_nothing_to_write(options);
  const LoadedCase loaded = load_case_of(options, uses::kAny);
  start_seconds = static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
  if (own.mesh) require_support(uses::kFiniteElements, loaded);
  if (!own.mesh && !loaded.spec.collective.curve.bogies.empty()) return check_curve(loaded, own, options);
  if (const std::vector<Diagnostic> refused = refused_by(uses::kFiniteElements, loaded); !refused.empty())
    return check_without_mesh(loaded, refused, own, options);
  const Model model = model_for_run(loaded);
  tell_profiles(model.placement);
  if (own.mesh) write_meshes(options, loaded, model);
  require_memory(model);
  const RunEstimate estimate = estimate_run(model);
  const std::vector<TimeEstimate> times = times_of(loaded, own, options);
  const std::string lacking = lacking_here(loaded);
  if (options.json) {
    nlohmann::ordered_json out = run_json(model, estimate);
    out["times"] = times_json(times);
    if (!lacking.empty()) out["not_here"] = lacking;
    fmt::print("{}\n", out.dump(2));
    return ExitCode::ok;
  }
  print_case(loaded, model.placement);
  print_estimate(model, estimate);
  print_times(times);
  if (!lacking.empty()) fmt::print("not here       {}\n", printable(lacking));
  for (const Warning& w : warnings_of(model, estimate)) fmt::print("warning        {}: {}\n", w.name, w.text);
  fmt::print("\n{}", mesh_table(model));
  return ExitCode::ok;
}

CommandWork declare_check(CLI::App& sub, CommandOptions& options) {
  const auto own = std::make_shared<CheckOptions>();
  add_case(sub, options);
  auto* mesh = sub.add_flag("--mesh", own->mesh, "Write the meshes as VTU into a folder");
  auto* receptance =
      sub.add_flag("--receptance", own->receptance,
                   "Compute the displacement over force of the rail on its track, at midspan and over a sleeper, "
                   "instead: table and page in a folder")
          ->excludes(mesh);
  add_output(sub, options, "results/<case name>-mesh or -receptance");
  sub.add_option("--largest", own->largest, "With --receptance: largest frequency in Hz (default: 3000)")
      ->check(CLI::Range(20.0, 20000.0))
      ->needs(receptance);
  sub.add_option("--time", own->time, "With --receptance: how long a blow is followed (default: \"0.1 s\")")
      ->needs(receptance);
  sub.add_option("--as", own->as, "With a profile file: rail or wheel (default: by its ending or shape)")
      ->check(CLI::IsMember({"rail", "wheel"}));
  sub.add_flag("--beam", own->beam, "With --receptance: the beam alone, at once, without finite elements")
      ->needs(receptance);
  sub.add_option("--measured", own->measured,
                 "With --receptance: tables of measurements to hold it against, with columns frequency [Hz], one of "
                 "receptance [nm/N], mobility [m/(s N)] and accelerance [m/(s^2 N)], and phase [deg] if known")
      ->needs(receptance);
  add_cell(sub, options);
  auto* vary = add_repeated(sub, "--vary", own->vary, "KEY=VALUES", "Estimate the time of such a sweep too");
  sub.add_flag("--stresses", own->stresses, "With --vary: of the sweep with --stresses")->needs(vary);
  sub.add_option("--passes", own->passes, "Estimate the time of so many passes by the stationary method too")
      ->check(CLI::Range(1, 1000000));
  add_no_report(sub, options);
  return [own, &options] { return command_check(*own, options); };
}

}  // namespace

extern const Command kCheckCommand{
    "check",
    "Read a case and report what a run would be: contact point, mesh, stable step, memory, time. Solves trials of a "
    "second or so for the times. Of a profile file: what was read",
    "Examples:\n  railstrata check cases/quick\n  railstrata check cases/paper/base.toml --set mesh.element_size=\"2 "
    "mm\"\n  railstrata check cases/paper/base.toml --json\n  railstrata check cases/quick --mesh --out "
    "/tmp/mesh\n  railstrata check cases/along/receptance.toml --receptance --beam --set track.preset=medium\n  "
    "railstrata check data/profiles/cn60_head.csv --out /tmp/profile\n",
    declare_check};

}  // namespace railstrata
