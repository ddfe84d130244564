#include "judge/run_advice.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "model/sliding_waves.hpp"

namespace railstrata {
namespace {

constexpr const char* kWithinRamp = "measured_within_torque_ramp";

void warn_within_ramp(const CaseSpec& spec, double position, std::vector<Warning>& out) {
  const DriveSpec& drive = spec.drive;
  if (!spec.run.rolling || drive.traction().value_or(0) == 0) return;
  const double ramp = drive.torque_ramp * drive.speed, begin = position - 0.5 * spec.run.window;
  constexpr double kRounding = 1e-9;  // of the ramp: 105 mm less 5 mm is a little less than 100 mm in binary
  if (ramp <= begin + kRounding * ramp) return;
  out.push_back(
      {kWithinRamp, ramp, begin,
       fmt::format("the torque rises over {:.4g} ms, {:.4g} mm at this speed, and the measuring window begins "
                   "at {:.4g} mm: later run.positions, or a shorter drive.torque_ramp",
                   1e3 * drive.torque_ramp, 1e3 * ramp, 1e3 * begin)});
}

void warn_of_added_mass(const StepLimits& limits, std::vector<Warning>& out) {
  double most = 0;
  std::string blocks;
  for (const ScaledBlock& b : limits.scaled_blocks) {
    if (b.added <= kMuchAddedMass * b.mass) continue;
    most = std::max(most, b.added / b.mass);
    blocks +=
        fmt::format("{}{:.3g} kg to the {:.3g} kg of the {}", blocks.empty() ? "" : ", ", b.added, b.mass, b.name);
  }
  if (blocks.empty()) return;
  out.push_back(
      {"mass_scaling_adds_much", most, kMuchAddedMass,
       fmt::format("mass scaling adds {} against stretching across thin rows: rigid motion keeps the real masses, "
                   "vibrations across the layers are slowed; run.mass_scaling_step = 0 adds none",
                   blocks)});
}

}  // namespace

std::vector<Warning> run_advice(const CaseSpec& spec, double position, const StepLimits& limits) {
  std::vector<Warning> out;
  warn_within_ramp(spec, position, out);
  warn_of_added_mass(limits, out);
  return out;
}

std::optional<Warning> memory_advice(const CaseSpec& spec, double p_max, double longer_axis) {
  if (!spec.run.rolling || !falling_friction(spec).remembers()) return {};
  const double given = spec.friction.memory_distance, needed = stable_memory_distance(spec, p_max, longer_axis);
  if (needed <= kShortFrictionMemory * given) return {};
  return Warning{
      "short_friction_memory", needed / given, kShortFrictionMemory,
      fmt::format("under {:.0f} MPa steady sliding is stable from a friction.memory_distance of {:.3g} um on; "
                  "it is {:.3g} um, and vibration may grow",
                  1e-6 * p_max, 1e6 * needed, 1e6 * given)};
}

void add_run_advice(Summary& summary, const CaseSpec& spec, const StepLimits& limits) {
  const bool traction_missed = std::any_of(summary.checks.begin(), summary.checks.end(), [](const Check& c) {
    return c.name == "traction_coefficient_reached" && !c.ok;
  });
  for (Warning& w : run_advice(spec, summary.position, limits)) {
    if (w.name == kWithinRamp && traction_missed) w.text += "; traction_coefficient_reached fails for this reason";
    summary.warnings.push_back(std::move(w));
  }
  const PatchMeasures& patch = summary.contact.patch;
  if (auto w = memory_advice(spec, patch.p_max, std::max(patch.length, patch.width)))
    summary.warnings.push_back(std::move(*w));
}

}  // namespace railstrata
