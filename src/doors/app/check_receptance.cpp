#include "app/check_receptance.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <nlohmann/json.hpp>

#include "app/case_of.hpp"
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

}  // namespace

ExitCode check_receptance(const ReceptanceOptions& wanted, const CommandOptions& options) {
  const LoadedCase loaded = load_case_of(options, uses::kReceptance);
  const std::filesystem::path out = output_folder_of(options, loaded, "-receptance");
  answer_interrupt_with("\nstopped: nothing was written\n");
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

}  // namespace railstrata
