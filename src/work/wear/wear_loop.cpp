#include "wear/wear_loop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "collective/collective_files.hpp"
#include "collective/worn_points.hpp"
#include "core/faults.hpp"
#include "lives/zone_life.hpp"
#include "model/zone.hpp"
#include "rules/support.hpp"

namespace railstrata {
namespace {

/// Between two curves with the same ends, positive where the second lies to the right of the first.
double area_between(const std::vector<Vec2>& first, const std::vector<Vec2>& second) {
  double twice = 0;
  const auto walk = [&](const std::vector<Vec2>& points, double sign) {
    for (std::size_t i = 1; i < points.size(); ++i) twice += sign * cross(points[i - 1], points[i]);
  };
  walk(first, -1);
  walk(second, 1);
  return 0.5 * twice;
}

/// The height that the reader of profiles takes off so that z = 0 at y = 0.
double origin_height(const WornRail& rail) { return rail.file.empty() ? 0.0 : crown_height(rail.points); }

void require_solved(const WearStep& step, const WornRail& before) {
  for (const CollectiveRow& row : step.rows)
    if (!row.sound())
      throw CaseError(fmt::format("step {}: {} cannot be solved on the rail after {} passages: {}", before.step + 1,
                                  row.name, before.passages, row.fault),
                      "remove the load, or change it; the earlier steps are kept");
}

/// m, of one collective.
std::vector<double> wear_of(const WearStep& step, const CaseSpec& spec) {
  const WearLaw law = spec.collective.wear_law;
  const std::vector<KnownWear> known = known_wear(step.damage);
  if (std::none_of(known.begin(), known.end(), [&](const KnownWear& w) { return w.law == law; }))
    throw CaseError("collective.wear_law: the case has no data for this law",
                    "give [material.rail] a hardness, or a grade, and for \"archard\" a wear_coefficient");
  std::vector<double> out = smoothed_wear(step.damage, law);
  if (!(*std::max_element(out.begin(), out.end()) > 0))
    throw CaseError("there is no wear: no load of the collective slips", "give loads with traction, yaw or spin");
  return out;
}

double all_passages(const std::vector<CollectiveRow>& rows) {
  double out = 0;
  for (const CollectiveRow& row : rows) out += row.passages;
  return out;
}

/// Cells' middles, and the ends, which stay.
struct Section {
  std::vector<double> s, depth;
};
Section section_of(const Profile& rail, const RailDamage& damage, const std::vector<double>& depth) {
  Section out{{rail.s_min()}, {0}};
  out.s.insert(out.s.end(), damage.s.begin(), damage.s.end());
  out.depth.insert(out.depth.end(), depth.begin(), depth.end());
  out.s.push_back(rail.s_max());
  out.depth.push_back(0);
  return out;
}

/// Takes `depth` times `share` off the profile.
void wear_off(const Profile& profile, const std::vector<double>& depth, double share, double height, WearStep& step,
              const WornRail& before) {
  const Section section = section_of(profile, step.damage, depth);
  std::vector<Vec2> old;
  step.rail.points.clear();
  for (std::size_t i = 0; i < section.s.size(); ++i) {
    const ProfilePoint p = profile.at(section.s[i]);
    old.push_back({p.position.y, p.position.z + height});
    step.rail.points.push_back(old.back() - share * section.depth[i] * p.outward);
  }
  step.rail.area = before.area + area_between(old, step.rail.points);
}

/// Place of the rail's uppermost layer among the layers; none without one.
std::optional<std::size_t> top_layer(const CaseSpec& spec) {
  const std::vector<std::size_t> layers = layers_on(spec, BodyId::rail);
  if (layers.empty()) return {};
  return layers.front();
}

/// On the worn rail at y, between its points.
Vec2 worn_point(const std::vector<Vec2>& points, double y) {
  std::size_t i = 1;
  while (i + 1 < points.size() && (points[i].y - y) * (points[i - 1].y - y) > 0) ++i;
  const double share = std::clamp((y - points[i - 1].y) / (points[i].y - points[i - 1].y), 0.0, 1.0);
  return points[i - 1] + share * (points[i] - points[i - 1]);
}

/// Every load meets the layer as thick as it is where it touches.
void thin_layers(std::vector<CollectiveRow>& rows, const std::filesystem::path& folder, const std::vector<Vec2>& unworn,
                 const std::vector<Vec2>& worn) {
  for (CollectiveRow& row : rows) {
    const Placement placement = place(row.spec, folder);
    const double y = model_to_rail(placement.track, placement.contact.point).y;
    row.spec.layers[*top_layer(row.spec)].thickness -= depth_below(unworn, worn_point(worn, y));
  }
}

/// What is left of the layer in the cells that wear, m; where the passages of one collective first wear it through.
struct LayerLeft {
  std::vector<double> left;
  double collectives = HUGE_VAL;
  std::size_t first = 0;
};
LayerLeft layer_left(double thickness, const std::vector<Vec2>& unworn, const std::vector<Vec2>& worn,
                     const RailDamage& damage, const std::vector<double>& depth) {
  LayerLeft out;
  for (std::size_t i = 0; i < depth.size(); ++i) {
    const double worn_by = depth[i] > 0 ? depth_below(unworn, worn_point(worn, damage.y[i])) : 0;
    out.left.push_back(std::max(thickness - worn_by, 0.0));
    if (!(depth[i] > 0) || out.left[i] / depth[i] >= out.collectives) continue;
    out.collectives = out.left[i] / depth[i];
    out.first = i;
  }
  return out;
}

/// After a share of a collective.
void note_layer(const LayerLeft& layer, const std::vector<double>& depth, double share, WearStep& step) {
  for (std::size_t i = 0; i < depth.size(); ++i) {
    const double left = layer.left[i] - share * depth[i];
    if (step.layer_left <= left) continue;
    step.layer_left = left;
    step.layer_y = step.damage.y[i];
  }
  if (share >= layer.collectives * (1 - 1e-12)) {
    step.layer_left = 0;
    step.layer_y = step.damage.y[layer.first];
  }
}

double tonnes_of(const std::vector<CollectiveRow>& rows) {
  double out = 0;
  for (const CollectiveRow& row : rows) out += row.tonnes();
  return out;
}

}  // namespace

double depth_below(const std::vector<Vec2>& unworn, Vec2 point, std::size_t from, std::size_t to) {
  double least = HUGE_VAL;
  for (std::size_t i = from; i < std::min(to, unworn.size()); ++i) {
    const Vec2 along = unworn[i] - unworn[i - 1], across = point - unworn[i - 1];
    const double share = std::clamp(dot(across, along) / dot(along, along), 0.0, 1.0);
    const Vec2 away = across - share * along;
    least = std::min(least, dot(away, away));
  }
  return std::sqrt(least);
}

WornRail unworn(const Placement& placement, double cell) {
  WornRail out;
  const RailDamage cells = undamaged(placement.rail, cell);
  for (const double s : section_of(placement.rail, cells, cells.usfd).s)
    out.points.push_back(placement.rail.at(s).position);
  return out;
}

CaseSpec on_worn_rail(const CaseSpec& spec, const Placement& original, const WornRail& rail) {
  CaseSpec out = spec;
  if (rail.file.empty()) return out;
  out.geometry.rail_mirror = false;  // of the file before
  out.geometry.rail_offset = 0;
  out.geometry.rail_profile = std::filesystem::absolute(rail.file).string();
  if (has_gauge(original)) out.geometry.gauge += gauge_widening(worn_profile(in_own_frame(rail.points)), original);
  return out;
}

WearStep wear_step(const CaseSpec& spec, const std::filesystem::path& folder, const Placement& original,
                   const WornRail& rail, const WearStepOptions& options) {
  require_support(uses::kWearLoop, spec);
  WearStep step;
  const CaseSpec worn = on_worn_rail(spec, original, rail);
  step.gauge = worn.geometry.gauge;
  step.rows = plan_collective(worn);
  const std::optional<std::size_t> top = top_layer(spec);
  const std::vector<Vec2> first = unworn(original, options.collective.bem.cell).points;
  if (top && !rail.file.empty()) thin_layers(step.rows, folder, first, rail.points);
  solve_collective(step.rows, folder, options.collective);
  step.stopped = std::any_of(step.rows.begin(), step.rows.end(), [](const CollectiveRow& r) { return !r.done; });
  if (step.stopped) return step;
  require_solved(step, rail);
  const Placement placement = place(worn, folder);
  step.damage = rail_damage(step.rows, placement, options.collective.bem.cell);
  const std::vector<double> depth = wear_of(step, spec);
  const double deepest = *std::max_element(depth.begin(), depth.end()), collective = all_passages(step.rows);
  step.passages = collective * options.max_wear / deepest;
  if (options.passages_left > 0) step.passages = std::min(step.passages, options.passages_left);
  LayerLeft layer;
  if (top) layer = layer_left(spec.layers[*top].thickness, first, rail.points, step.damage, depth);
  step.passages = std::min(step.passages, collective * layer.collectives);
  const double share = step.passages / collective;
  if (top) note_layer(layer, depth, share, step);
  step.tonnes = share * tonnes_of(step.rows);
  step.deepest = share * deepest;
  step.wanted_area = share * streamline_area(step.rows, spec.collective.wear_law);
  step.rail.step = rail.step + 1;
  step.rail.passages = rail.passages + step.passages;
  wear_off(placement.rail, depth, share, origin_height(rail), step, rail);
  return step;
}

}  // namespace railstrata
