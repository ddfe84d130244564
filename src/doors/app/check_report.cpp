#include "app/check_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "app/progress.hpp"
#include "core/faults.hpp"
#include "core/printable.hpp"
#include "fem/memory_need.hpp"
#include "geometry/profile_signs.hpp"
#include "io/geometry_json.hpp"
#include "mesh/quality.hpp"
#include "mesh/unstructured.hpp"
#include "model/profile_doubts.hpp"
#include "model/rolling_start.hpp"
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
    const std::string across = l.varies_across()
                                   ? fmt::format("up to {:.3g} mm thick from y = {:.3g} to {:.3g} mm",
                                                 1e3 * largest_value(l.thickness_table), 1e3 * l.low(), 1e3 * l.high())
                                   : fmt::format("{:.3g} mm thick, {:.3g} mm wide", 1e3 * l.thickness, 1e3 * l.width);
    fmt::print("layer          {} on the {}: {}, E = {} GPa{}\n", l.name, body_word(l.on), across, young, along);
  }
}

void print_geometry(const CaseSpec& spec, const Placement& placement) {
  const RigidContact& c = placement.contact;
  const HertzContact hertz = hertz_estimate(spec, c);
  fmt::print("profiles       {} on {}\n", placement.wheel.name(), placement.rail.name());
  fmt::print("contact point  y = {:.3f} mm, z = {:.3f} mm; on the wheel at y = {:.3f} mm\n", 1e3 * c.point.y,
             1e3 * c.point.z, 1e3 * wheel_y(placement));
  fmt::print("contact angle  {:.2f} mrad; rolling radius {:.3f} mm\n", 1e3 * c.angle, 1e3 * c.rolling_radius);
  if (const auto slope = head_inclination(placement.rail))
    fmt::print("rail's profile {} at the head's middle, before cant\n", inclination_text(*slope));
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

nlohmann::ordered_json as_json(const std::vector<Warning>& warnings) {
  nlohmann::ordered_json out = nlohmann::ordered_json::array();
  for (const Warning& w : warnings)
    out.push_back({{"name", w.name}, {"value", w.value}, {"limit", w.limit}, {"text", w.text}});
  return out;
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
  if (e.steps == 0) return;
  const std::string why = why_from_rest(m.spec);
  fmt::print("run            {} steps, with the preload about {} here{}; {}\n", e.steps, duration_text(e.seconds),
             m.until_repeated ? ", more where windows do not repeat" : "",
             why.empty() ? "from a steady start" : "from rest: " + why);
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
          {"load_N", hertz.load},
          {"hertz", {{"a_m", hertz.a}, {"b_m", hertz.b}, {"p0_Pa", hertz.p0}}}};
}

nlohmann::ordered_json run_json(const Model& m, const RunEstimate& e) {
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
              {"wall_s", e.seconds},
              {"memory_bytes", e.memory_bytes},
              {"blocks", mesh_json(mesh_rows(m))},
              {"warnings", as_json(warnings_of(m, e))}});
  return out;
}

}  // namespace railstrata
