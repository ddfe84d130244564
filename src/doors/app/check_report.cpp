#include "app/check_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/axle_report.hpp"
#include "app/mesh_report.hpp"
#include "app/progress.hpp"
#include "core/printable.hpp"
#include "fem/memory_need.hpp"
#include "io/geometry_json.hpp"
#include "rules/track_facts.hpp"

namespace railstrata {
namespace {

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

}  // namespace

void print_case(const LoadedCase& loaded, const Placement& placement) {
  fmt::print("{}\n\n", printable(fmt::format("{}: {}", loaded.file.string(), loaded.spec.title)));
  print_geometry(loaded.spec, placement);
  print_layers(loaded.spec);
}

namespace {

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

}  // namespace

void print_estimate(const Model& m, const RunEstimate& e) {
  fmt::print("mesh           {} elements, {} nodes\n", m.rail.elements() + m.wheel.elements(),
             m.rail.nodes() + m.wheel.nodes());
  fmt::print("stable step    {:.2f} ns (single elements {:.2f} ns, limited by {}); steps of {:.2f} ns\n",
             1e9 * e.limits.lanczos, 1e9 * e.limits.element, e.limits.where, 1e9 * e.limits.chosen);
  if (e.limits.added_mass > 0) {
    std::vector<std::string> blocks;
    for (const ScaledBlock& b : e.limits.scaled_blocks) blocks.push_back(b.name);
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

std::vector<Warning> warnings_of(const Model& m, const RunEstimate& e) {
  const std::vector<double>& positions = m.spec.run.positions;
  std::vector<Warning> out =
      run_advice(m.spec, positions.empty() ? 0.0 : *std::max_element(positions.begin(), positions.end()), e.limits);
  if (auto memory = memory_advice(m.spec, m.hertz.p0, 2 * std::max(m.hertz.a, m.hertz.b)))
    out.push_back(std::move(*memory));
  return out;
}

namespace {

nlohmann::ordered_json as_json(const std::vector<Warning>& warnings) {
  nlohmann::ordered_json out = nlohmann::ordered_json::array();
  for (const Warning& w : warnings)
    out.push_back({{"name", w.name}, {"value", w.value}, {"limit", w.limit}, {"text", w.text}});
  return out;
}

}  // namespace

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

namespace {

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

}  // namespace railstrata
