#include "app/collective_wear.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/case_of.hpp"
#include "app/control.hpp"
#include "app/option_values.hpp"
#include "core/faults.hpp"
#include "fatigue/rail_damage.hpp"
#include "record/csv.hpp"
#include "record/json.hpp"
#include "record/output_file.hpp"
#include "text/units.hpp"
#include "wear/wear_loop_job.hpp"

namespace railstrata {
namespace {

double depth_option(const std::string& text) {
  const double depth = length_of("--max-wear", text);
  if (depth > 0 && depth <= kMostWearOfOneProfile) return depth;
  throw CaseError(fmt::format("--max-wear {}: must be above 0 and at most 1 mm", text), "take e.g. \"0.05 mm\"");
}

}  // namespace

ExitCode collective_wear(const WearOptions& wanted, const CommandOptions& options) {
  LoadedCase loaded = load_case_of(options, uses::kWearLoop);
  const WearLoopOrder order{job_order_of(options, loaded, "-wear-loop", wanted.resume), wanted.steps, wanted.passages,
                            depth_option(wanted.max_wear), cell_size(options.cell)};
  return code_of(carry_out_wear_loop(std::move(loaded), order, control_by_signals(), [&](const WornRail& rail) {
    if (!options.json) return;
    const nlohmann::ordered_json end{{"steps", rail.step},
                                     {"passages", rail.passages},
                                     {"worn_area_m2", rail.area},
                                     {"rail_profile", rail.file.string()}};
    fmt::print("{}\n", json_text(end, 2));
  }));
}

}  // namespace railstrata
