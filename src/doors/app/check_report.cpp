#include "app/check_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "app/progress.hpp"
#include "core/faults.hpp"
#include "core/printable.hpp"
#include "fem/memory_need.hpp"
#include "geometry/wheelset.hpp"
#include "io/geometry_json.hpp"
#include "mesh/quality.hpp"
#include "mesh/unstructured.hpp"
#include "record/vtk.hpp"
#include "rules/track_facts.hpp"

namespace railstrata {
namespace {

struct MeshRow {
  std::string body;
  BlockQuality quality;
  double step = 0;  ///< s, smallest edge over the fastest wave speed of the body's materials: a bound that shows which
                    ///< block limits the step
};

double fastest_wave(const std::vector<Elastic>& materials) {
  double c = 0;
  for (const Elastic& m : materials) c = std::max(c, std::sqrt((m.lambda + 2 * m.mu) / m.density));
  return c;
}

void add_rows(std::vector<MeshRow>& rows, const SweptBody& body, const std::vector<Elastic>& materials) {
  const double fastest = fastest_wave(materials), matrix = fastest_wave({materials.front()});
  for (const BlockQuality& q : measure_quality(body)) {
    const bool layered = q.block == body.blocks[body.contact.block].name;
    rows.push_back({body.name, q, q.edge_min / (layered ? fastest : matrix)});
  }
}

/// One per block of both bodies.
std::vector<MeshRow> mesh_rows(const Model& model) {
  std::vector<MeshRow> rows;
  add_rows(rows, model.rail, model.rail_materials);
  add_rows(rows, model.wheel, model.wheel_materials);
  return rows;
}

nlohmann::ordered_json mesh_json(const std::vector<MeshRow>& rows) {
  auto out = nlohmann::ordered_json::array();
  for (const MeshRow& r : rows)
    out.push_back({{"body", r.body},
                   {"block", r.quality.block},
                   {"elements", r.quality.elements},
                   {"scaled_jacobian_min", r.quality.scaled_jacobian_min},
                   {"aspect_max", r.quality.aspect_max},
                   {"edge_min_m", r.quality.edge_min},
                   {"edge_over_wave_speed_s", r.step}});
  return out;
}

AxleWheel wheel_of(const RigidContact& contact, double mean_radius, double half_distance, double curvature) {
  return {contact, 1 - half_distance * curvature - contact.rolling_radius / mean_radius, yaw_creepage(contact),
          wheel_spin(contact) + std::cos(contact.angle) * curvature};
}

std::optional<AxleOnTrack> axle_if_any(const CaseSpec& spec, const Placement& placement) {
  if (placement.wheel.primitive() || placement.rail.primitive() || std::isfinite(placement.track.rail_radius))
    return std::nullopt;
  try {
    return axle_of(spec, placement);
  } catch (const CaseError&) {
    return std::nullopt;
  }
}

std::string line_of(const char* name, const char* wheel, const AxleWheel& w) {
  return fmt::format(
      "{:<14} {}: rolling radius {:.3f} mm, contact angle {:.2f} mrad, creepages {:.3e} and {:.3e}, spin {:.4f} 1/m\n",
      name, wheel, 1e3 * w.contact.rolling_radius, 1e3 * w.contact.angle, w.creepage_x, w.creepage_y, w.spin);
}

nlohmann::ordered_json json_of(const AxleWheel& w) {
  return {{"rolling_radius_m", w.contact.rolling_radius},
          {"angle_rad", w.contact.angle},
          {"creepage_x", w.creepage_x},
          {"creepage_y", w.creepage_y},
          {"spin_per_m", w.spin}};
}

/// Empty where the wheels stand on no track (an arc, a plane, a roller) or the other wheel misses its rail.
std::string axle_text(const CaseSpec& spec, const Placement& placement) {
  const std::optional<AxleOnTrack> axle = axle_if_any(spec, placement);
  if (!axle) return {};
  return line_of("axle", "this wheel", axle->here) + line_of("", "the other ", axle->other) +
         fmt::format("{:<14} rolling radius of the other less this one {:.3f} mm; the curve asks for {:.3f} mm\n", "",
                     1e3 * axle->radius_difference, 1e3 * axle->wanted_difference);
}

nlohmann::ordered_json axle_json(const CaseSpec& spec, const Placement& placement) {
  const std::optional<AxleOnTrack> axle = axle_if_any(spec, placement);
  if (!axle) return nullptr;
  return {{"this_wheel", json_of(axle->here)},
          {"other_wheel", json_of(axle->other)},
          {"radius_difference_m", axle->radius_difference},
          {"wanted_difference_m", axle->wanted_difference}};
}

/// y of the contact point on the wheel, m from the tape circle.
double wheel_y(const Placement& p) {
  return p.contact.roll == 0 ? p.contact.point.y - p.contact.wheel_offset_y : p.wheel.at(p.contact.wheel_s).position.y;
}

void print_layers(const CaseSpec& spec) {
  for (const LayerSpec& l : spec.layers) {
    const std::string young = l.graded() ? fmt::format("{:.4g} to {:.4g}", 1e-9 * l.young_table.front().young,
                                                       1e-9 * l.young_table.back().young)
                                         : fmt::format("{:.4g}", 1e-9 * l.material.young);
    const std::string along =
        fmt::format("{}{}{}", l.from ? fmt::format(", from {:g} mm", 1e3 * *l.from) : "",
                    l.to ? fmt::format(", to {:g} mm", 1e3 * *l.to) : "",
                    l.taper_length > 0 ? fmt::format(", tapered over {:g} mm", 1e3 * l.taper_length) : "");
    fmt::print("layer          {} on the {}: {:.3g} mm thick, {:.3g} mm wide, E = {} GPa{}\n", l.name, body_word(l.on),
               1e3 * l.thickness, 1e3 * l.width, young, along);
  }
}

void print_geometry(const CaseSpec& spec, const Placement& placement) {
  const RigidContact& c = placement.contact;
  const HertzContact hertz = hertz_estimate(spec, c);
  fmt::print("profiles       {} on {}\n", placement.wheel.name(), placement.rail.name());
  fmt::print("contact point  y = {:.3f} mm, z = {:.3f} mm; on the wheel at y = {:.3f} mm\n", 1e3 * c.point.y,
             1e3 * c.point.z, 1e3 * wheel_y(placement));
  fmt::print("contact angle  {:.2f} mrad; rolling radius {:.3f} mm\n", 1e3 * c.angle, 1e3 * c.rolling_radius);
  const char* name = "track";
  for (const TrackFact& f : track_facts(spec.geometry)) {
    fmt::print("{:<14} {}: {} ({})\n", name, f.label, f.value, f.from);
    name = "";
  }
  if (c.rail_turn != 0)
    fmt::print("rail           {} of {:.3f} mm along rolling at the contact\n", c.rail_turn > 0 ? "roller" : "hollow",
               1e3 / std::abs(c.rail_turn));
  if (c.yaw != 0)
    fmt::print("yaw            {:.3f} mrad; the contact lies {:.3f} mm before the axle\n", 1e3 * c.yaw, 1e3 * c.x);
  if (c.roll != 0) fmt::print("roll           {:.3f} mrad, field side up\n", 1e3 * c.roll);
  fmt::print("{}", axle_text(spec, placement));
  if (spec.vehicle.approach)
    fmt::print("approach       {:.4g} mm, given: the load is a result, {:.3f} kN by Hertz\n",
               1e3 * *spec.vehicle.approach, 1e-3 * hertz.load);
  else
    fmt::print("static load    {:.3f} kN\n", 1e-3 * spec.vehicle.load());
  if (spec.geometry.in_line())
    fmt::print("Hertz          a = {:.2f} mm, p0 = {:.0f} MPa on a line of {:.4g} mm\n", 1e3 * hertz.a, 1e-6 * hertz.p0,
               2e3 * hertz.b);
  else
    fmt::print("Hertz estimate a = {:.2f} mm, b = {:.2f} mm, p0 = {:.0f} MPa (local curvatures only)\n", 1e3 * hertz.a,
               1e3 * hertz.b, 1e-6 * hertz.p0);
}

void print_ranks(const RunEstimate& e) {
  for (const RunEstimate::OnRanks& r : e.ranks)
    fmt::print("on {} ranks     about {}; one has {:.0f} % of the work and gets {:.2f} MB a step; {:.0f} MB each\n",
               r.need.ranks, duration_text(r.seconds), 100 * r.need.largest_share, 1e-6 * r.need.bytes,
               1e-6 * r.memory_bytes);
  if (!e.ranks.empty())
    fmt::print("ranks          at most {}; times for machines like this one, {:.0f} us and {:.1f} GB/s apart\n",
               e.ranks.front().need.tiles, 1e6 * RankNetwork{}.latency, 1e-9 * RankNetwork{}.bandwidth);
}

void print_card(const RunEstimate& e) {
  if (!e.card.refused.empty()) return fmt::print("on a card      not: a device takes no {}\n", e.card.refused);
  if (e.card.cards.empty()) return;
  std::string times;
  for (const device::DeviceNeed::OnCard& c : e.card.cards)
    times += fmt::format("{}{} on {} ({:.2f} TB/s)", times.empty() ? "" : ", ",
                         duration_text(static_cast<double>(e.steps) * c.step), c.name, 1e-12 * c.bandwidth);
  fmt::print("on a card      about {}: counted from data sheets, not measured\n", times);
  fmt::print(
      "               {:.0f} MB there: fields {:.0f}, elements' forces {:.0f}, tables {:.0f}, contact {:.1f}; "
      "{:.0f} bytes a step to the host\n",
      1e-6 * e.card.memory(), 1e-6 * e.card.fields, 1e-6 * e.card.rows, 1e-6 * e.card.tables, 1e-6 * e.card.contact,
      e.card.copied);
}

nlohmann::ordered_json as_json(const std::vector<Warning>& warnings) {
  nlohmann::ordered_json out = nlohmann::ordered_json::array();
  for (const Warning& w : warnings)
    out.push_back({{"name", w.name}, {"value", w.value}, {"limit", w.limit}, {"text", w.text}});
  return out;
}

nlohmann::ordered_json as_json(const std::vector<RunEstimate::OnRanks>& all) {
  nlohmann::ordered_json out = nlohmann::ordered_json::array();
  for (const RunEstimate::OnRanks& r : all)
    out.push_back({{"ranks", r.need.ranks},
                   {"most_ranks", r.need.tiles},
                   {"largest_share", r.need.largest_share},
                   {"bytes_a_step", r.need.bytes},
                   {"memory_bytes_each", r.memory_bytes},
                   {"rolling_wall_s", r.seconds}});
  return out;
}

nlohmann::ordered_json as_json(const device::DeviceNeed& need, long steps) {
  if (!need.refused.empty()) return {{"refused", need.refused}};
  if (need.cards.empty()) return nullptr;
  nlohmann::ordered_json cards = nlohmann::ordered_json::array();
  for (const device::DeviceNeed::OnCard& c : need.cards)
    cards.push_back({{"name", c.name},
                     {"bytes_per_s", c.bandwidth},
                     {"step_s", c.step},
                     {"rolling_wall_s", static_cast<double>(steps) * c.step}});
  return {{"measured", false},           {"memory_bytes", need.memory()},
          {"of_fields", need.fields},    {"of_element_forces", need.rows},
          {"of_tables", need.tables},    {"of_contact", need.contact},
          {"bytes_a_step", need.copied}, {"cards", cards}};
}

}  // namespace

void print_case(const LoadedCase& loaded, const Placement& placement) {
  fmt::print("{}\n\n", printable(fmt::format("{}: {}", loaded.file.string(), loaded.spec.title)));
  print_geometry(loaded.spec, placement);
  print_layers(loaded.spec);
}

void print_estimate(const Model& m, const RunEstimate& e) {
  fmt::print("mesh           {} elements, {} nodes\n", m.rail.elements() + m.wheel.elements(),
             m.rail.nodes() + m.wheel.nodes());
  fmt::print("stable step    {:.2f} ns (single elements {:.2f} ns, limited by {}); steps of {:.2f} ns\n",
             1e9 * e.limits.lanczos, 1e9 * e.limits.element, e.limits.where, 1e9 * e.limits.chosen);
  if (e.limits.added_mass > 0) {
    std::vector<std::string> blocks;
    for (const ScaledBlock& block : e.limits.scaled_blocks) blocks.push_back(block.name);
    fmt::print(
        "mass scaling   {:.3f} kg against stretching across thin rows, on {:.3f} kg of {}; the step without it {:.2f} "
        "ns\n",
        e.limits.added_mass, e.limits.scaled_mass, fmt::join(blocks, ", "), 1e9 * e.limits.unscaled);
  }
  fmt::print("memory         {:.0f} MB\n", 1e-6 * e.memory_bytes);
  if (e.steps > 0) fmt::print("rolling        {} steps, about {} here\n", e.steps, duration_text(e.seconds));
  print_ranks(e);
  print_card(e);
}

std::string mesh_table(const Model& model) {
  const std::vector<MeshRow> rows = mesh_rows(model);
  std::string out = fmt::format("{:<6} {:<14} {:>10} {:>12} {:>10} {:>12} {:>12}\n", "body", "block", "elements",
                                "Jacobian", "aspect", "edge/mm", "edge/c/ns");
  const auto limiting =
      std::min_element(rows.begin(), rows.end(), [](const MeshRow& a, const MeshRow& b) { return a.step < b.step; });
  for (auto row = rows.begin(); row != rows.end(); ++row)
    out += fmt::format("{:<6} {:<14} {:>10} {:>12.3f} {:>10.1f} {:>12.4f} {:>12.2f}{}\n", row->body, row->quality.block,
                       row->quality.elements, row->quality.scaled_jacobian_min, row->quality.aspect_max,
                       1e3 * row->quality.edge_min, 1e9 * row->step, row == limiting ? "  limits the step" : "");
  return out;
}

void write_mesh(const std::filesystem::path& file, const SweptBody& body) {
  HexMesh mesh = unstructured(body);
  VtkHexahedra out;
  out.points = std::move(mesh.points);
  out.cells = std::move(mesh.cells);
  out.cell_fields = {{"material", 1, std::vector<std::int32_t>(mesh.material.begin(), mesh.material.end())},
                     {"block", 1, std::vector<std::int32_t>(mesh.block.begin(), mesh.block.end())},
                     {"scaled_jacobian", 1, std::move(mesh.scaled_jacobian)}};
  write_vtu(file, out);
}

std::vector<Warning> warnings_of(const Model& m, const RunEstimate& e) {
  const std::vector<double>& positions = m.spec.run.positions;
  std::vector<Warning> out =
      run_advice(m.spec, positions.empty() ? 0.0 : *std::max_element(positions.begin(), positions.end()), e.limits);
  if (auto memory = memory_advice(m.spec, m.hertz.p0, 2 * std::max(m.hertz.a, m.hertz.b)))
    out.push_back(std::move(*memory));
  return out;
}

nlohmann::ordered_json placement_json(const CaseSpec& spec, const Placement& placement) {
  const RigidContact& c = placement.contact;
  const HertzContact hertz = hertz_estimate(spec, c);
  return {{"title", spec.title},
          {"track", track_json(spec.geometry)},
          {"contact",
           {{"x_m", c.x},
            {"y_m", c.point.y},
            {"z_m", c.point.z},
            {"wheel_y_m", wheel_y(placement)},
            {"angle_rad", c.angle},
            {"yaw_rad", c.yaw},
            {"roll_rad", c.roll},
            {"rolling_radius_m", c.rolling_radius},
            {"rail_turn_per_m", c.rail_turn}}},
          {"axle", axle_json(spec, placement)},
          {"load_N", hertz.load},
          {"hertz", {{"a_m", hertz.a}, {"b_m", hertz.b}, {"p0_Pa", hertz.p0}}}};
}

nlohmann::ordered_json run_json(const Model& m, const RunEstimate& e, bool machines) {
  nlohmann::ordered_json out = placement_json(m.spec, m.placement);
  out.update({{"elements", m.rail.elements() + m.wheel.elements()},
              {"nodes", m.rail.nodes() + m.wheel.nodes()},
              {"stable_step_s", e.limits.lanczos},
              {"unscaled_step_s", e.limits.unscaled},
              {"added_mass_kg", e.limits.added_mass},
              {"element_step_bound_s", e.limits.element},
              {"limited_by", e.limits.where},
              {"step_s", e.limits.chosen},
              {"steps", e.steps},
              {"rolling_wall_s", e.seconds},
              {"memory_bytes", e.memory_bytes},
              {"blocks", mesh_json(mesh_rows(m))},
              {"warnings", as_json(warnings_of(m, e))}});
  if (machines) out.update({{"on_ranks", as_json(e.ranks)}, {"on_a_card", as_json(e.card, e.steps)}});
  return out;
}

AxleOnTrack axle_of(const CaseSpec& spec, const Placement& placement) {
  TrackGeometry beside = placement.track;
  for (double TrackGeometry::*odd : {&TrackGeometry::lateral_shift, &TrackGeometry::yaw, &TrackGeometry::roll})
    beside.*odd = -(beside.*odd);
  const RigidContact other = place_wheel(placement.wheel, placement.rail, beside);
  const double here = placement.contact.rolling_radius, mean = 0.5 * (here + other.rolling_radius),
               curvature = spec.geometry.curve_radius ? 1 / *spec.geometry.curve_radius : 0.0,
               half = tape_circle_distance(placement.track);
  return {wheel_of(placement.contact, mean, half, curvature), wheel_of(other, mean, half, -curvature),
          other.rolling_radius - here, 2 * half * mean * curvature};
}

}  // namespace railstrata
