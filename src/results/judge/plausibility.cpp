#include "judge/plausibility.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "fatigue/row_strength.hpp"
#include "judge/check_limits.hpp"
#include "model/model.hpp"
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
    const double twice = 2 * (layer.on == BodyId::rail ? around.rail_reach : around.wheel_reach);
    if (twice - layer.width <= beyond) continue;
    beyond = twice - layer.width;
    reach = twice;
    width = layer.width;
  }
  out.above("patch_wider_than_layer", reach, width);
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

}  // namespace

double film_shear(const CaseSpec& spec, const PatchMeasures& patch) {
  return patch.q_max_point * third_body(spec).flexibility() / (0.5 * shorter_axis(patch));
}

std::vector<Warning> implausible(const Summary& s, const CaseSpec& spec, const PatchSurroundings& around,
                                 double element) {
  Warnings out(s.run.engine);
  const PatchMeasures& patch = s.contact.patch;
  out.above("few_cells_over_patch", element / shorter_axis(patch));
  out.above("patch_spans_angle", around.edges.angle_spanned);
  out.above("patch_large_against_radius",
            std::max(around.edges.half_width_over_radius, 0.5 * patch.length * around.curvature_rolling));
  out.above("patch_near_edge", around.edges.edge_share, fmt::format(", here {}", around.edges.edge));
  warn_of_layers(spec, around, out);
  if (s.run.engine == Engine::fem)
    out.above("patch_near_border_of_fine_zone", patch.width, spec.mesh.fine_width - 2 * spec.mesh.element_size);
  out.above("patches_near_each_other", around.bent_by_others);
  if (spec.third_body.thickness) out.above("soft_film", film_shear(spec, patch));
  out.above("plastic_strain_large", s.plastic.strain);
  warn_of_second_contact(around, s.contact.contact_angle, out);
  warn_of_flange(around, out);
  warn_of_process_stress(spec, out);
  warn_of_stress(s, spec, out);
  return out.take();
}

}  // namespace railstrata
