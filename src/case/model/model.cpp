#include "model/model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/faults.hpp"
#include "geometry/height_field.hpp"
#include "geometry/profile_names.hpp"
#include "geometry/read_profile.hpp"
#include "halfspace/line_contact.hpp"
#include "mesh/quality.hpp"
#include "model/drive_at_contact.hpp"
#include "model/profile_doubts.hpp"
#include "model/rolling_start.hpp"
#include "model/stretches.hpp"

namespace railstrata {
namespace {

Profile find_profile(ProfileKind kind, const std::string& name, const std::filesystem::path& folder,
                     const ProfileFrame& frame, std::vector<std::string>& notes) {
  std::filesystem::path file = name;
  if (file.is_relative()) file = folder / file;
  if (file.has_extension() && (file.extension() == ".csv" || file.extension() == ".txt" || file.extension() == ".dat" ||
                               std::filesystem::exists(file)))
    return read_profile(kind, file, &notes, frame);
  return builtin_profile(kind, name);
}

Elastic to_elastic(const MaterialSpec& m) { return elastic(m.young, m.poisson, m.density); }

/// A layer without a given width covers a block that is narrower.
double width_of(const CaseSpec& spec, const LayerSpec& l) {
  const bool on_block = l.on == BodyId::rail && spec.geometry.rail_shape == RailShape::block;
  return on_block && l.width == LayerSpec{}.width ? std::min(l.width, spec.geometry.block_width) : l.width;
}

LayerMesh mesh_of(const CaseSpec& spec, const LayerSpec& l) {
  LayerMesh out{l.name, l.varies_across() ? largest_value(l.thickness_table) : l.thickness, width_of(spec, l),
                l.elements};
  out.from = l.begin();
  out.to = l.end();
  for (const UnbondedStretch& s : l.unbonded) out.unbonded.push_back({s.from, s.to});
  out.unbonded_friction = l.unbonded_friction;
  out.across = l.thickness_table;
  return out;
}

/// Mean modulus of a table between two depths.
double mean_young(const std::vector<ModulusPoint>& table, double top, double bottom) {
  double area = 0;
  for (std::size_t i = 1; i < table.size(); ++i) {
    const ModulusPoint &a = table[i - 1], &b = table[i];
    const double from = std::max(top, a.depth), to = std::min(bottom, b.depth);
    if (from < to)
      area += (to - from) * (a.young + (b.young - a.young) * (0.5 * (from + to) - a.depth) / (b.depth - a.depth));
  }
  return area / (bottom - top);
}

/// How far within the layer's ends a row of elements ends: where the taper reaches the row's middle, in whole elements.
double taper_at(const CaseSpec& spec, const LayerSpec& l, double middle) {
  const double h = spec.mesh.element_size;
  return h * std::round(l.taper_length * middle / l.thickness / h);
}

/// A layer as the mesh has it: of one that is graded or tapers each row of elements is one; of a graded one with the
/// mean modulus over its height.
struct Row {
  LayerMesh mesh;
  MaterialSpec material;
};
std::vector<Row> rows_on(const CaseSpec& spec, BodyId body) {
  std::vector<Row> out;
  for (const LayerSpec& l : spec.layers) {
    if (l.on != body) continue;
    const LayerMesh whole = mesh_of(spec, l);
    if (!l.graded() && !(l.taper_length > 0)) {
      out.push_back({whole, l.material});
      continue;
    }
    const int rows = layer_rows(whole, spec.mesh.element_size);
    for (int k = 0; k < rows; ++k) {
      MaterialSpec material = l.material;
      if (l.graded()) material.young = mean_young(l.young_table, l.thickness * k / rows, l.thickness * (k + 1) / rows);
      LayerMesh row = whole;
      row.name = fmt::format("{} {}", l.name, k + 1);
      row.thickness = l.thickness / rows;
      row.elements = 1;
      row.continues = k + 1 < rows;
      if (row.continues) row.unbonded.clear();
      const double in = taper_at(spec, l, l.thickness * (k + 0.5) / rows);
      row.from += in;
      row.to -= in;
      out.push_back({row, material});
    }
  }
  return out;
}

std::vector<LayerMesh> layer_meshes(const CaseSpec& spec, BodyId body) {
  std::vector<LayerMesh> out;
  for (const Row& row : rows_on(spec, body)) out.push_back(row.mesh);
  return out;
}

/// Where layers begin, end and come off, and where stretches jump, in increasing order, m.
std::vector<double> planes_of(const CaseSpec& spec, BodyId body, const std::vector<LayerMesh>& layers) {
  std::vector<double> out;
  for (const LayerMesh& l : layers) {
    for (const double x : {l.from, l.to})
      if (std::isfinite(x)) out.push_back(x);
    for (const SweepRange& stretch : l.unbonded) out.insert(out.end(), {stretch.from, stretch.to});
  }
  for (const StretchSpec& stretch : spec.stretches)
    for (std::size_t i = 1; stretch.on == body && i < stretch.along.size(); ++i)
      if (const double a = stretch.along[i - 1].x, b = stretch.along[i].x; b - a < 0.5 * spec.mesh.element_size)
        out.push_back(0.5 * (a + b));
  std::sort(out.begin(), out.end());
  return out;
}

std::vector<Elastic> materials_of(const CaseSpec& spec, BodyId body, const MaterialSpec& matrix) {
  std::vector<Elastic> out{to_elastic(matrix)};
  for (const Row& row : rows_on(spec, body)) out.push_back(to_elastic(row.material));
  return out;
}

std::vector<Elastic> materials_at_surface(const CaseSpec& spec, BodyId body, std::vector<Elastic> materials) {
  const auto top =
      std::find_if(spec.layers.begin(), spec.layers.end(), [&](const LayerSpec& l) { return l.on == body; });
  if (top != spec.layers.end() && top->graded()) {
    MaterialSpec material = top->material;
    material.young = top->young_table.front().young;
    materials[1] = to_elastic(material);
  }
  return materials;
}

// Middle of the lateral strip in which the undeformed profiles are closer than `closeness`: the patch may lie to one
// side of the first point of contact.
struct StripMiddle {
  double rail_s, wheel_s;
  double width;  ///< m, along the rail
};
StripMiddle strip_middle(const Placement& p, double closeness) {
  const RigidContact& c = p.contact;
  constexpr double step = 0.1e-3, reach = 30e-3;
  auto gap = [&](double s) {
    const Vec2 rail = rail_to_model(p.track, p.rail.at(s).position);
    const double y = rail.y - c.wheel_offset_y;
    if (y <= p.wheel.y_min() || y >= p.wheel.y_max()) return closeness + 1;
    return c.wheel_offset_z + p.wheel.height(y) - rail.z;
  };
  double low = c.rail_s, high = c.rail_s;
  while (low - step > p.rail.s_min() && c.rail_s - low < reach && gap(low - step) < closeness) low -= step;
  while (high + step < p.rail.s_max() && high - c.rail_s < reach && gap(high + step) < closeness) high += step;
  const double middle = 0.5 * (low + high);
  return {middle, p.wheel.s_at_y(rail_to_model(p.track, p.rail.at(middle).position).y - c.wheel_offset_y), high - low};
}

}  // namespace

RailSection section_below_head(const GeometrySpec& g, const Profile& rail) {
  return rail_section(rail.name(), track_preset_of(g.track, g.wheel_profile, g.rail_profile).kind);
}

Placement place(const CaseSpec& spec, const std::filesystem::path& folder, const Profile* worn) {
  const GeometrySpec& g = spec.geometry;
  std::vector<std::string> notes;
  Profile wheel = find_profile(ProfileKind::wheel, g.wheel_profile, folder, {g.wheel_mirror, g.wheel_offset}, notes);
  Profile rail =
      worn ? *worn : find_profile(ProfileKind::rail, g.rail_profile, folder, {g.rail_mirror, g.rail_offset}, notes);
  TrackGeometry track{g.gauge,        g.gauge_depth,
                      g.back_to_back, g.flange_back_to_tape,
                      g.cant,         g.lateral_shift,
                      g.wheel_radius, g.yaw,
                      g.roll,         g.rail_radius.value_or(TrackGeometry::kStraight)};
  const RigidContact contact = place_wheel(wheel, rail, track);
  std::vector<std::string> doubts = profile_doubts(g, wheel, rail);
  return {std::move(wheel), std::move(rail), track, contact, std::move(notes), std::move(doubts)};
}

FallingFriction falling_friction(const CaseSpec& spec) {
  const FrictionSpec& f = spec.friction;
  const double at_rest = spec.drive.friction_coefficient;
  if (f.law == FrictionForm::coulomb || !(at_rest > 0)) return {};
  return {f.law, f.kinetic_coefficient.value() / at_rest, f.half_velocity.value(), f.memory_distance,
          f.memory_velocity};
}

ThirdBody third_body(const CaseSpec& spec) {
  const ThirdBodySpec& t = spec.third_body;
  if (!t.thickness) return {};
  return {*t.thickness,         t.shear_modulus.value(),      t.yield_shear.value_or(0),
          t.hardening,          t.residual_shear.value_or(0), t.yield_by_pressure,
          t.modulus_by_pressure};
}

double lateral_friction_share(const CaseSpec& spec) {
  const double along = spec.drive.friction_coefficient;
  return along > 0 ? spec.friction.lateral_coefficient.value_or(along) / along : 1;
}

namespace {

/// A line contact as an ellipse whose semi-axis across is half the line. Without an approach.
HertzContact line_estimate(const CaseSpec& spec, const RigidContact& c, double modulus) {
  const double load = spec.vehicle.load(), length = *spec.geometry.line_length;
  const LineHertz line = hertz_line(0.5 * c.curvature_rolling, modulus, load / length);
  return {line.a, 0.5 * length, line.p0, std::numeric_limits<double>::quiet_NaN(), load};
}

}  // namespace

double modulus_of(const CaseSpec& spec) {
  return contact_modulus({spec.wheel_material.young, spec.wheel_material.poisson},
                         {spec.rail_material.young, spec.rail_material.poisson});
}

HertzContact hertz_estimate(const CaseSpec& spec, const RigidContact& c) {
  const double lateral = c.curvature_wheel_lateral + c.curvature_rail_lateral;
  const double modulus = modulus_of(spec);
  if (spec.geometry.in_line()) return line_estimate(spec, c, modulus);
  const auto under = [&](double load) {
    return hertz_contact(0.5 * c.curvature_rolling, 0.5 * std::max(lateral, 0.02), modulus, load);
  };
  if (!spec.vehicle.approach) return under(spec.vehicle.load());
  constexpr double kAnyLoad = 1e5;
  return under(kAnyLoad * std::pow(*spec.vehicle.approach / under(kAnyLoad).approach, 1.5));
}

namespace {

// An element that is turned inside out or flat would be computed without a warning.
void require_sound_mesh(const SweptBody& body, BodyId id, const CaseSpec& spec) {
  for (const BlockQuality& q : measure_quality(body)) {
    if (q.scaled_jacobian_min > 0) continue;
    const GeometrySpec& g = spec.geometry;
    const MeshSpec& m = spec.mesh;
    const std::string shape =
        id == BodyId::wheel
            ? fmt::format("geometry.rim_thickness (now {:g} mm), geometry.flange_back_to_tape (now {:g} mm)",
                          1e3 * g.wheel_section.rim_thickness, 1e3 * g.flange_back_to_tape)
            : fmt::format("geometry.block_width and block_height (now {:g} and {:g} mm)", 1e3 * g.block_width,
                          1e3 * g.block_height);
    throw CaseError(
        fmt::format("the {} cannot be meshed: in its part \"{}\" an element near x = {:.1f} mm, y = {:.1f} mm, "
                    "z = {:.1f} mm is turned inside out (scaled Jacobian {:.3f})",
                    body_word(id), q.block, 1e3 * q.worst_at.x, 1e3 * q.worst_at.y, 1e3 * q.worst_at.z,
                    q.scaled_jacobian_min),
        fmt::format("there is too little room for the fine zone: look at {}, the profile, mesh.fine_depth (now "
                    "{:g} mm) and mesh.fine_width (now {:g} mm)",
                    shape, 1e3 * m.fine_depth, 1e3 * m.fine_width.value_or(kFineWidth)));
  }
}

/// Of the rail beyond the fine range; on a track as long as its bays ask for.
double end_length(const CaseSpec& spec, double begin, double end) {
  if (spec.track.held()) return spec.mesh.end_length;
  const double out = 0.5 * (spec.track.support.length() - (end - begin));
  if (out < spec.mesh.end_length)
    throw CaseError(fmt::format("the rail of {} bays would end {:.0f} mm beyond the wheel's path, less than "
                                "mesh.end_length",
                                spec.track.support.bays, 1e3 * out),
                    "give more track.bays, or a shorter path (run.positions)", "track.bays");
  return out;
}

/// At rest layers are bonded everywhere: a stretch that has come off lies where the wheel at its start is not felt.
void refuse_unbonded_at_start(const CaseSpec& spec, double semi_axis, double rail_end) {
  constexpr double kFelt = 6;  // semi-axes of the patch
  for (std::size_t i = 0; i < spec.layers.size(); ++i)
    for (const UnbondedStretch& stretch : spec.layers[i].unbonded) {
      const std::string key = fmt::format("layer.{}.unbonded", i);
      if (stretch.from < kFelt * semi_axis)
        throw CaseError(
            fmt::format("a stretch begins at {:.1f} mm: the wheel starts on a bonded layer, and is felt as far as six "
                        "times its patch's half length, {:.1f} mm",
                        1e3 * stretch.from, 1e3 * kFelt * semi_axis),
            "put the stretch farther on", key);
      if (stretch.to >= rail_end)
        throw CaseError(fmt::format("a stretch ends at {:.1f} mm, where the rail has ended: {:.1f} mm",
                                    1e3 * stretch.to, 1e3 * rail_end),
                        "let it end before, or give more run.positions or mesh.end_length", key);
    }
}

/// A layer that ends has something of itself on the rail, m from the start of the wheel.
void refuse_layers_off_rail(const CaseSpec& spec, double rail_begin, double rail_end) {
  for (std::size_t i = 0; i < spec.layers.size(); ++i) {
    const LayerSpec& layer = spec.layers[i];
    if (layer.on != BodyId::rail || (layer.begin() < rail_end && layer.end() > rail_begin)) continue;
    throw CaseError(fmt::format("layer.{} lies off the rail, which reaches from {:.1f} mm to {:.1f} mm", i,
                                1e3 * rail_begin, 1e3 * rail_end),
                    "put it on the rail, or give more run.positions or mesh.end_length",
                    fmt::format("layer.{}.{}", i, layer.begin() < rail_end ? "to" : "from"));
  }
}

/// Frees the foot of a rail that has a track.
void set_on_track(const TrackSpec& track, SweptBody& rail) {
  if (!track.held() && rail.on_pads.empty()) rail.on_pads = std::exchange(rail.prescribed, {});
}

/// run.run_up, run.positions and where the run ends.
void plan_path(Model& m) {
  constexpr double kFromRest = 0.3;  // m
  constexpr int kMostWindows = 5;    // of rolling until results repeat
  const double patch_length = 2 * m.hertz.a;
  const bool steady = why_from_rest(m.spec).empty();
  RunSpec& run = m.spec.run;
  if (!run.rolling) return;
  const bool given = run.run_up.has_value();
  run.run_up = run_up_of(m.spec, patch_length);
  m.until_repeated = steady && run.positions.empty();
  if (m.until_repeated)
    for (int k = 0; k < kMostWindows; ++k) run.positions.push_back(*run.run_up + (k + 0.5) * run.window);
  else if (run.positions.empty())
    run.positions = {kFromRest};
  const auto [first, last] = std::minmax_element(run.positions.begin(), run.positions.end());
  if (steady && !given) run.run_up = std::clamp(*first - 0.5 * run.window, 0.0, *run.run_up);
  m.x_end = *last + 0.5 * run.window;
}

}  // namespace

double Model::likely_end(double position) const {
  if (!until_repeated) return x_end;
  for (std::size_t k = 1; k < spec.run.positions.size(); ++k)
    if (const double end = spec.run.positions[k] + 0.5 * spec.run.window; end > position) return end;
  return x_end;
}

std::vector<LayerSpec> layers_at_contact(const CaseSpec& spec, const Placement& placement) {
  const auto y_of = [&](const Profile& profile, double s) {
    if (spec.bem.bodies == ContactBodies::sections) s = kSectionPlace * std::round(s / kSectionPlace);
    return profile.at(std::clamp(s, profile.s_min(), profile.s_max())).position.y;
  };
  const RigidContact& contact = placement.contact;
  return layers_across(spec.layers, y_of(placement.rail, contact.rail_s), y_of(placement.wheel, contact.wheel_s));
}

CaseSpec case_at_contact(CaseSpec spec, const Placement& placement) {
  spec.layers = layers_at_contact(spec, placement);
  std::erase_if(spec.layers, [](const LayerSpec& layer) { return !(layer.thickness > 0); });
  return spec;
}

MeshedSection meshed_section(const CaseSpec& spec, const Placement& placement, BodyId body, double contact_s,
                             const MeshSizes& sizes) {
  CaseSpec own = spec;
  own.mesh.element_size = sizes.element;
  for (LayerSpec& layer : own.layers) layer.elements = 0;
  const auto layers = [&] {
    std::vector<LayerMesh> meshes = layer_meshes(own, body);
    for (LayerMesh& layer : meshes) layer.rows_follow = true;
    return meshes;
  };
  const GeometrySpec& g = spec.geometry;
  MeshedSection out;
  if (body == BodyId::rail) {
    RailMeshSpec rail;
    rail.shape = g.rail_shape;
    rail.section = section_below_head(g, placement.rail);
    rail.contact_s = contact_s;
    rail.x_end = sizes.element;
    rail.block_width = g.block_width;
    rail.block_height = g.block_height;
    rail.layers = layers();
    out = {mesh_rail(placement.rail, placement.track, rail, sizes), materials_of(own, body, spec.rail_material)};
    set_on_track(spec.track, out.body);
  } else {
    WheelMeshSpec wheel;
    wheel.shape = g.wheel_shape;
    wheel.contact_s = contact_s;
    wheel.theta_end = sizes.element / g.wheel_radius;
    wheel.section = g.wheel_section;
    wheel.layers = layers();
    out = {mesh_wheel(placement.wheel, g.wheel_radius, {}, wheel, sizes), materials_of(own, body, spec.wheel_material)};
  }
  require_sound_mesh(out.body, body, spec);
  return out;
}

Model build_model(const CaseSpec& spec, const std::filesystem::path& folder, const SweptBody* meshed_rail) {
  Model m{.spec = spec,
          .placement = place(spec, folder),
          .rail_materials = materials_of(spec, BodyId::rail, spec.rail_material),
          .wheel_materials = materials_of(spec, BodyId::wheel, spec.wheel_material),
          .load = spec.vehicle.load()};
  m.rail_at_surface = materials_at_surface(spec, BodyId::rail, m.rail_materials);
  m.wheel_at_surface = materials_at_surface(spec, BodyId::wheel, m.wheel_materials);
  const RigidContact& contact = m.placement.contact;
  m.hertz = hertz_estimate(spec, contact);
  m.reference = overlap_place(m.placement.wheel, m.placement.rail, m.placement.track, contact, {},
                              contact.wheel_offset_z - m.hertz.approach / std::cos(contact.angle));
  m.spec.drive = drive_at_contact(m.spec, m.reference);
  plan_path(m);
  // The fine range holds the patch and room for its search at both ends of the path.
  m.reach = contact_reach(spec.irregularities, spec.geometry.wheel_radius);
  const double margin = 1.5 * m.hertz.a + 4 * spec.mesh.element_size + std::abs(contact.x) + m.reach;
  // A steady start has no time to settle where the fine range ends close behind the wheel.
  const double behind = margin + (why_from_rest(spec).empty() ? 4 * m.hertz.a : 0.0);
  const StripMiddle strip = strip_middle(m.placement, m.hertz.approach);
  if (!spec.mesh.fine_width) m.spec.mesh.fine_width = std::max(kFineWidth, strip.width + 2 * spec.mesh.element_size);
  const MeshSizes sizes{spec.mesh.element_size, *m.spec.mesh.fine_width, spec.mesh.fine_depth, spec.mesh.coarse_ratio,
                        spec.mesh.largest};

  const GeometrySpec& g = spec.geometry;
  RailMeshSpec rail;
  rail.shape = g.rail_shape;
  rail.section = section_below_head(g, m.placement.rail);
  rail.contact_s = strip.rail_s;
  rail.x_begin = -behind;
  rail.x_end = m.x_end + margin;
  rail.end_length = end_length(spec, rail.x_begin, rail.x_end);
  refuse_unbonded_at_start(spec, m.hertz.a, rail.x_end + rail.end_length);
  refuse_layers_off_rail(spec, rail.x_begin - rail.end_length, rail.x_end + rail.end_length);
  rail.block_width = g.block_width;
  rail.block_height = g.block_height;
  rail.layers = layer_meshes(spec, BodyId::rail);
  rail.planes = planes_of(spec, BodyId::rail, rail.layers);
  m.rail = meshed_rail     ? *meshed_rail
           : g.rail_radius ? mesh_ring_rail(m.placement.rail, *g.rail_radius, rail, sizes)
                           : mesh_rail(m.placement.rail, m.placement.track, rail, sizes);
  set_on_track(spec.track, m.rail);

  WheelMeshSpec wheel;
  wheel.shape = g.wheel_shape;
  wheel.contact_s = strip.wheel_s;
  wheel.theta_begin = -behind / contact.rolling_radius;
  wheel.theta_end = (m.x_end + margin) / contact.rolling_radius;
  wheel.section = g.wheel_section;
  wheel.layers = layer_meshes(spec, BodyId::wheel);
  for (const double x : planes_of(spec, BodyId::wheel, wheel.layers))
    wheel.planes.push_back(x / contact.rolling_radius);
  m.wheel =
      mesh_wheel(m.placement.wheel, g.wheel_radius, {0, contact.wheel_offset_y, contact.axle_height}, wheel, sizes);
  add_stretches(m);
  m.spec.layers = layers_at_contact(spec, m.placement);
  for (const BodyId id : kBodies) require_sound_mesh(id == BodyId::rail ? m.rail : m.wheel, id, spec);
  return m;
}

}  // namespace railstrata
