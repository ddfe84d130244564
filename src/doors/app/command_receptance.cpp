#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <CLI/CLI.hpp>

#include <nlohmann/json.hpp>

#include "app/case_of.hpp"
#include "app/commands.hpp"
#include "app/common_options.hpp"
#include "app/option_values.hpp"
#include "app/waiting.hpp"
#include "core/faults.hpp"
#include "io/output_folder.hpp"
#include "runs/receptance.hpp"

namespace railstrata {
namespace {

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

ExitCode command_receptance(const CommandOptions& options) {
  const LoadedCase loaded = load_case_of(options);
  const std::filesystem::path out = output_folder_of(options, loaded, "-receptance");
  answer_interrupt_with("\nstopped: nothing was written\n");
  const ReceptanceOptions& wanted = options.receptance;
  const double time = blow_time(wanted.time);
  std::vector<BlowEnergy> blows;
  const Receptance receptance = with_places(loaded, [&] {
    const Model model = build_model(loaded.spec, loaded.folder());
    Receptance all = beam_receptances(model, receptance_frequencies(wanted.largest));
    if (wanted.beam) return all;
    const Waiting waiting("blows of a hammer", spdlog::should_log(spdlog::level::info));
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
  }
  spdlog::info("results are in {}", out.string());
  return ExitCode::ok;
}

void declare_receptance(CLI::App& sub, CommandOptions& options) {
  add_case(sub, options);
  add_output(sub, options, "results/<case name>-receptance");
  sub.add_option("--largest", options.receptance.largest, "Largest frequency in Hz (default: 3000)")
      ->check(CLI::Range(20.0, 20000.0));
  sub.add_option("--time", options.receptance.time, "How long a blow is followed (default: \"0.1 s\")");
  sub.add_flag("--beam", options.receptance.beam, "The beam alone, at once, without finite elements");
  add_no_report(sub, options);
}

}  // namespace

const Command kReceptanceCommand{
    "receptance", "Displacement over force of the rail on its track, at midspan and over a sleeper",
    "Examples:\n  railstrata receptance cases/along/receptance.toml\n  railstrata receptance "
    "cases/along/receptance.toml --beam --set track.preset=medium --largest 2000\n",
    declare_receptance, command_receptance};

}  // namespace railstrata
