#include "io/summary_json.hpp"

#include <cmath>
#include <utility>

#include "io/damage_files.hpp"
#include "record/json.hpp"
#include "record/output_file.hpp"
#include "result/result_table.hpp"

namespace railstrata {
namespace {

using Json = nlohmann::ordered_json;

/// The numbers of one group, in the order of the table; a life that does not end as text.
void add_numbers(std::string_view group, const Summary& s, Json& out) {
  for (const ResultNumber& n : result_numbers())
    if (n.group == group) out[n.key()] = std::isinf(n.value(s)) ? Json(kEndlessLife) : json_number(n.unit, n.value(s));
}

Json patches(const Summary& s) {
  Json out = Json::array();
  for (const PatchSummary& p : s.patches) {
    Summary of_patch;
    of_patch.contact = p.contact;
    Json patch{{"y_m", json_number(p.y)}, {"rail_y_m", json_number(p.rail_y)}, {"wheel_y_m", json_number(p.wheel_y)}};
    add_numbers("contact", of_patch, patch);
    out.push_back(std::move(patch));
  }
  return out;
}

Json maximum(const StressMaximum& m) {
  if (!std::isfinite(m.value)) return nullptr;
  Json out;
  for (const StressNumber& n : stress_numbers())
    out[std::string(n.key) + std::string(n.unit.key_ending)] = json_number(m.*n.member);
  return out;
}

Json pair(const std::optional<StressPair>& p) {
  if (!p) return nullptr;
  Json out;
  for (const StressMeasure& m : stress_measures()) out[std::string(m.key)] = maximum((*p).*m.member);
  return out;
}

Json stress(const Summary& s) {
  Json out;
  for (const StressBody& body : stress_bodies())
    for (const StressZone& zone : stress_zones())
      out[std::string(body.key)][std::string(zone.key)] = pair((s.*body.member).*zone.member);
  return out;
}

Json plastic(const Summary& s) {
  Json out;
  add_numbers("plastic", s, out);
  out["body"] = s.plastic.body.empty() ? Json(nullptr) : Json(s.plastic.body);
  out["zone"] = s.plastic.zone.empty() ? Json(nullptr) : Json(s.plastic.zone);
  return out;
}

}  // namespace

Json steels_json(const DamageSummary& d) {
  Json out = Json::object();
  for (const auto& [body, steel] : {std::pair{"rail", &d.rail_steel}, std::pair{"wheel", &d.wheel_steel}})
    if (!steel->text.empty())
      out[body] = {
          {"factor", json_number(steel->factor)}, {"source", wear_source_text(steel->source)}, {"text", steel->text}};
  return out;
}

Json summary_json(const Summary& s) {
  Json out;
  out["title"] = s.title;
  if (!s.state.empty()) out["state"] = s.state;
  add_numbers("", s, out);
  add_numbers("contact", s, out["contact"]);
  if (!s.patches.empty()) out["patches"] = patches(s);
  out["stress"] = stress(s);
  add_numbers("damage", s, out["damage"]);
  if (!s.damage.rail_steel.text.empty()) out["damage"]["wear_of_steels"] = steels_json(s.damage);
  if (!s.shakedown.bodies.empty()) out["shakedown"] = shakedown_json(s);
  if (!s.fatigue.empty()) {
    out["fatigue"] = fatigue_json(s);
    add_numbers(kLayersGroup, s, out[kLayersGroup]);
  }
  if (!s.life.text.empty()) {
    add_numbers(kLifeGroup, s, out["life"]);
    out["life"]["text"] = s.life.text;
  }
  if (std::isfinite(s.crack.K_II_range)) add_numbers(kCrackGroup, s, out[std::string(kCrackGroup)]);
  if (std::isfinite(s.interface_slip.passages)) add_numbers(kInterfaceGroup, s, out[std::string(kInterfaceGroup)]);
  if (std::isfinite(s.passage.F_z_max)) add_numbers(kPassageGroup, s, out[std::string(kPassageGroup)]);
  if (std::isfinite(s.plastic.strain)) out["plastic"] = plastic(s);
  add_numbers("energy", s, out["energy"]);
  Json& run = out["run"];
  run["engine"] = s.run.engine;
  add_numbers("run", s, run);
  run["commit"] = s.run.commit;
  out["checks"] = Json::array();
  for (const Check& k : s.checks)
    out["checks"].push_back(
        {{"name", k.name}, {"ok", k.ok}, {"value", json_number(k.value)}, {"limit", json_number(k.limit)}});
  out["warnings"] = Json::array();
  for (const Warning& w : s.warnings)
    out["warnings"].push_back(
        {{"name", w.name}, {"value", json_number(w.value)}, {"limit", json_number(w.limit)}, {"text", w.text}});
  return out;
}

void write_summary(const std::filesystem::path& file, const Summary& summary) {
  write_whole_file(file, summary_json(summary).dump(2) + "\n");
}

}  // namespace railstrata
