#include "judge/plausibility.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "fatigue/row_strength.hpp"
#include "judge/check_limits.hpp"
#include "model/model.hpp"
#include "model/rolling_start.hpp"
#include "model/sliding_waves.hpp"
#include "result/result_table.hpp"

namespace railstrata {
namespace {

double largest_von_mises(const StressSummary& s) {
  double most = 0;
  for (const auto& pair : {s.surface, s.subsurface, s.layer, s.interface, s.matrix})
    if (pair && pair->von_mises.value > most) most = pair->von_mises.value;
  return most;
}

class Warnings {
 public:
  explicit Warnings(Engine engine) : fem_(engine == Engine::fem) {}

  /// With the table's words, followed by `more`.
  void above(std::string_view name, double value, double limit, const std::string& more = "") {
    const CheckRow& row = check_row(name);
    if (!(value > limit)) return;
    out_.push_back({.name = std::string(name),
                    .value = value,
                    .limit = limit,
                    .text = fmt::format("{}{} ({}, limit {}): {}", row.what, more, with_unit(row.unit, value, 3),
                                        limit_text(row.unit, limit), row.advice)});
  }
  /// Against the table's limit for this engine, if it has one.
  void above(std::string_view name, double value, const std::string& more = "") {
    const double limit = fem_ ? check_row(name).fem_limit : check_row(name).bem_limit;
    if (!std::isnan(limit)) above(name, value, limit, more);
  }
  std::vector<Warning> take() { return std::move(out_); }

 private:
  bool fem_;
  std::vector<Warning> out_;
};

void warn_of_layers(const CaseSpec& spec, const PatchSurroundings& around, Warnings& out) {
  double beyond = 0, reach = 0, width = 0;
  for (const LayerSpec& layer : spec.layers) {
    if (layer.varies_across()) continue;
    const double twice = 2 * (layer.on == BodyId::rail ? around.rail_reach : around.wheel_reach);
    if (twice - layer.width <= beyond) continue;
    beyond = twice - layer.width;
    reach = twice;
    width = layer.width;
  }
  out.above("patch_wider_than_layer", reach, width);
  out.above("layer_varies_below_patch", around.layer_change);
}

std::string place(double rail_y, double wheel_y, double angle) {
  return fmt::format("y = {:.1f} mm of the rail, {:.1f} mm of the wheel, at {:.1f}°", 1e3 * rail_y, 1e3 * wheel_y,
                     unit::kDegrees.factor * angle);
}

void warn_of_second_contact(const PatchSurroundings& around, double angle, Warnings& out) {
  if (!around.second) return;
  const SecondContact& second = *around.second;
  out.above("second_contact", second.overlap,
            fmt::format("; first place: {}; second place: {}", place(around.rail_y, around.wheel_y, angle),
                        place(second.rail_y, second.wheel_y, second.angle)));
}

void warn_of_flange(const PatchSurroundings& around, Warnings& out) {
  if (!around.flange) return;
  out.above("contact_on_flange_crest", around.flange->contact_depth, around.flange->height - kFlangeTip);
  out.above("flange_outside_gauge", around.flange->beyond_gauge);
}

/// The zone whose process stress is the largest share of its strength.
void warn_of_process_stress(const CaseSpec& spec, Warnings& out) {
  ProcessStress worst;
  for (const BodyId body : {BodyId::rail, BodyId::wheel})
    if (ProcessStress found = largest_process_stress(spec, body); found.share > worst.share) worst = std::move(found);
  out.above("process_stress_beyond_yield", worst.share, fmt::format(", in {}", worst.zone));
}

/// Where the case gives the rail's strength, its load factors replace the common strength.
void warn_of_stress(const Summary& s, const CaseSpec& spec, Warnings& out) {
  if (!strength_given(spec, BodyId::rail)) out.above("von_mises_above_common_rail_yield", largest_von_mises(s.rail));
  double rising = 0;
  for (const StressSummary* body : {&s.rail, &s.wheel})
    for (const auto& pair : {body->surface, body->subsurface, body->layer, body->interface, body->matrix})
      for (const StressMaximum& m : pair ? std::array{pair->von_mises, pair->sigma1} : std::array<StressMaximum, 2>{})
        if (m.at_rim) rising = std::max(rising, m.value);
  out.above("stress_maximum_at_rim", rising / s.contact.patch.p_max);
}

void warn_of_wear_map(const DamageSummary& damage, Warnings& out) {
  if (!(damage.kth_of_map.worn > 0)) return;
  out.above("kth_outside_map", damage.kth_of_map.outside(), fmt::format("; {}", outside_words(damage.kth_of_map)));
}

constexpr const char* kWithinRamp = "measured_within_torque_ramp";
constexpr double kMuchAddedMass = check_row("mass_scaling_adds_much").fem_limit,
                 kShortFrictionMemory = check_row("short_friction_memory").fem_limit;

void warn_within_ramp(const CaseSpec& spec, double position, std::vector<Warning>& out) {
  const DriveSpec& drive = spec.drive;
  if (!spec.run.rolling || drive.traction().value_or(0) == 0 || why_from_rest(spec).empty()) return;
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

std::string outside_words(const MapShares& kth) {
  return fmt::format("{:.0f} % of it where the surfaces seize (p > 0.8 H), {:.0f} % where they slip faster than 1 m/s",
                     100 * kth.seized / kth.worn, 100 * kth.fast / kth.worn);
}

double film_shear(const CaseSpec& spec, const PatchMeasures& patch) {
  return patch.q_max_point * third_body(spec).flexibility() / (0.5 * shorter_axis(patch));
}

std::vector<Warning> flange_warnings(const PatchSurroundings& around) {
  Warnings out(Engine::bem);
  warn_of_flange(around, out);
  return out.take();
}

std::vector<Warning> implausible(const Summary& s, const CaseSpec& spec, const PatchSurroundings& around,
                                 double element) {
  Warnings out(s.run.engine);
  const PatchMeasures& patch = s.contact.patch;
  out.above("few_cells_over_patch", element / shorter_axis(patch));
  if (spec.bem.normals == ContactNormals::plane) out.above("patch_spans_angle", around.edges.angle_spanned);
  out.above("patch_large_against_radius",
            std::max(around.edges.half_width_over_radius, 0.5 * patch.length * around.curvature_rolling));
  if (spec.bem.bodies == ContactBodies::half_spaces)  // sections have the edge
    out.above("patch_near_edge", around.edges.edge_share, fmt::format(", here {}", around.edges.edge));
  warn_of_layers(spec, around, out);
  if (s.run.engine == Engine::fem)
    out.above("patch_near_border_of_fine_zone", patch.width,
              spec.mesh.fine_width.value_or(kFineWidth) - 2 * spec.mesh.element_size);
  out.above("patches_near_each_other", around.bent_by_others);
  if (spec.third_body.thickness) out.above("soft_film", film_shear(spec, patch));
  out.above("plastic_strain_large", s.plastic.strain);
  warn_of_second_contact(around, s.contact.contact_angle, out);
  warn_of_flange(around, out);
  warn_of_process_stress(spec, out);
  warn_of_stress(s, spec, out);
  warn_of_wear_map(s.damage, out);
  out.above("wheels_in_one_track", s.life.groove);
  return out.take();
}

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
