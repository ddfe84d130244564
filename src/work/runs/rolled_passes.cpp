#include "runs/rolled_passes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/faults.hpp"
#include "fem/lateral_start.hpp"
#include "fem/memory_need.hpp"
#include "fem/plastic_zone.hpp"
#include "fem/rail_at_rest.hpp"
#include "model/model.hpp"
#include "model/rolling_start.hpp"
#include "passes/pass_plan.hpp"

namespace railstrata {
namespace {

constexpr double kLength = 12, kLeast = 8;                // half-lengths
constexpr double kFrom = 6 / kLength, kTo = 8 / kLength;  // of the length rolled

constexpr double kBehind = 6, kAhead = 4;  // half-lengths, of the loops

constexpr double kCorrection = 0.5;  // of the creepage: half of what the traction lacks, whose last samples vibrate

PassRoll roll_of(const CaseSpec& spec, const std::filesystem::path& folder, double length) {
  const double a = hertz_estimate(spec, place(spec, folder).contact).a;
  if (length == 0) length = kLength * a;
  if (length < kLeast * a)
    throw CaseError(fmt::format("a pass of {:.3g} mm leaves no steady stations: the patch's half-length is {:.3g} mm",
                                1e3 * length, 1e3 * a),
                    fmt::format("roll {:.3g} mm or more", 1e3 * kLeast * a));
  return {a, length, kFrom * length, kTo * length};
}

/// m, along the rail's profile: how far the contact point moves from that of the case's own place.
double contact_range(CaseSpec spec, const std::filesystem::path& folder) {
  const double farthest = farthest_pass(spec.passes), shift = spec.geometry.lateral_shift;
  if (farthest == 0) return 0;
  constexpr int kPlaces = 10;  // to either side
  const double own = place(spec, folder).contact.rail_s;
  double most = 0;
  for (int k = -kPlaces; k <= kPlaces; ++k) {
    spec.geometry.lateral_shift = shift + farthest * k / kPlaces;
    most = std::max(most, std::abs(place(spec, folder).contact.rail_s - own));
  }
  return most;
}

/// A run of one pass.
CaseSpec case_of_rolls(CaseSpec spec, const std::filesystem::path& folder, const PassRoll& roll) {
  spec.run.positions = {roll.length};
  spec.run.window = 2 * spec.mesh.element_size;
  spec.run.start = RunStart::rest;
  spec.run.run_up = std::min(run_up_of(spec, 0), roll.from);
  spec.run.output.patch_series = false;
  const double range = contact_range(spec, folder);
  if (range == 0) return spec;
  spec.mesh.fine_width = spec.mesh.fine_width.value_or(kFineWidth) + 2 * range;
  return spec;
}

/// The rail after the passes so far: for the next wheel a piece with free ends, for the results endless.
RailBefore rail_with(const RollingSystem& system, const PlasticSection& section, bool endless) {
  RailBefore out;
  out.history = history_of_section(system.rail(), section);
  out.u = rail_at_rest(system, out.history, endless);
  return out;
}

/// F_x over F_z where the wheel runs over the stations of the result, mean, as single rows vibrate. Before them the
/// traction of a constant creepage still grows.
double mean_traction(const std::vector<HistoryRow>& history, const PassRoll& roll) {
  double along = 0, down = 0;
  for (const HistoryRow& row : history) {
    if (row.position < roll.from || row.position > roll.to) continue;
    along += row.forces.x;
    down += row.forces.z;
  }
  return along / down;
}

/// Correction of the creepage for the wanted traction, from an elastic wheel that rolls over the stations of the
/// result. None if stopped.
std::optional<double> measured_shift(Model model, double traction, const PassRoll& roll, const FemOptions& options) {
  model.spec.run.plasticity = false;
  model.spec.run.positions = {roll.to};
  const RollingSystem system(model);
  const FemSolution solution = solve_fem(system, {}, options);
  if (solution.stopped) return std::nullopt;
  return estimated_creepage(model, traction) - estimated_creepage(model, mean_traction(solution.history, roll));
}

}  // namespace

RolledPasses::RolledPasses(const CaseSpec& spec, std::filesystem::path folder, double length)
    : folder_(std::move(folder)),
      roll_(roll_of(spec, folder_, length)),
      spec_(case_of_rolls(spec, folder_, roll_)),
      base_(build_model(spec_, folder_)) {}

CaseSpec RolledPasses::case_of(int pass) const {
  const PassPlan plan = pass_plan(spec_.passes, pass);
  CaseSpec out = spec_;
  out.geometry.lateral_shift += plan.lateral;
  if (spec_.passes.traction_coefficients.empty()) return out;
  out.drive.traction_coefficient = spec_.passes.traction_coefficients[plan.traction];
  out.drive.creepage.reset();
  return out;
}

Model RolledPasses::model_of(int pass, double creepage_shift) const {
  Model model = build_model(case_of(pass), folder_, &base_.rail);
  if (const std::optional<double> traction = model.spec.drive.traction())
    model.spec.drive.creepage = estimated_creepage(model, *traction) + creepage_shift;
  return model;
}

std::optional<RolledPasses::Pass> RolledPasses::next(RolledSeries& series, const RunObserver& follow,
                                                     const FemOptions& options, std::optional<RunState> begun) const {
  const int pass = series.passes + 1;
  const std::optional<double> traction = case_of(pass).drive.traction();
  FemOptions own = options;
  own.before = nullptr;
  own.residual = false;  // that of the series is computed here
  if (pass == 1 && traction) {
    const std::optional<double> shift = measured_shift(model_of(pass, 0), *traction, roll_, own);
    if (!shift) return std::nullopt;
    series.creepage_shift = *shift;
  }
  const Model model = model_of(pass, series.creepage_shift);
  require_memory(model);
  const RollingSystem system(model);
  RailBefore before;
  if (!begun && !series.section.quads.empty()) {
    before = rail_with(system, series.section, false);
    own.before = &before;
  }
  PlasticSection after, first, second;
  RolledRail rolled;
  RunObserver observer = follow;
  observer.finished = [&](const RollingState& state) {
    const PlasticHistory& history = state.bodies[kRail].history;
    rolled = {state.bodies[kRail].u, history, state.axle.pose().x, kBehind * roll_.half_length,
              kAhead * roll_.half_length};
    const double middle = 0.5 * (roll_.from + roll_.to);
    after = plastic_section(system.rail(), history, roll_.from, roll_.to);
    first = plastic_section(system.rail(), history, roll_.from, middle);
    second = plastic_section(system.rail(), history, middle, roll_.to);
  };
  const FemSolution solution = solve_fem(system, observer, own, std::move(begun));
  if (solution.stopped) return std::nullopt;

  const PlasticSection was = on_quads(series.section, after);
  Pass out{rolled_pass(system, base_, was, after, rail_with(system, after, true), 0.5 * (roll_.from + roll_.to)), {}};
  out.loops = rolled_loops(system, base_, after, out, rolled);
  const Summary& summary = solution.positions.back().summary;
  out.uneven = unevenness(was, first, second);
  out.row.error = out.uneven;
  out.row.iterations = static_cast<int>(summary.run.steps);
  out.row.contact = {mean_traction(solution.history, roll_), summary.contact.creepage_x, summary.contact.patch.p_max,
                     system.model.spec.geometry.lateral_shift - base_.spec.geometry.lateral_shift};
  add_rolled_pass(after, out, series);
  if (traction)
    series.creepage_shift += kCorrection * (estimated_creepage(system.model, *traction) -
                                            estimated_creepage(system.model, out.row.contact.traction));
  return out;
}

}  // namespace railstrata
