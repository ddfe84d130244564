#include "passes/pass_json.hpp"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "model/zone.hpp"
#include "record/json.hpp"

namespace railstrata {

using Json = nlohmann::ordered_json;

Json last_pass_json(const CsvTable& table) {
  Json out;
  for (std::size_t c = 1; c < table.columns.size(); ++c)
    out[table.columns[c].name] = json_number(table.columns[c].values.back());
  return out;
}

Json points_json(const std::vector<std::vector<PassStrain>>& points, PassClass whole) {
  Json out;
  for (const PassClass kind :
       {PassClass::elastic_shakedown, PassClass::plastic_shakedown, PassClass::ratchetting, PassClass::transient})
    out[class_text(kind)] =
        std::count_if(points.begin(), points.end(), [&](const auto& p) { return class_of_point(p, whole) == kind; });
  return out;
}

Json ductility_json(double ductility, double reached, const std::vector<PassStrain>& cycles, int cycle) {
  const DuctilityReach reach = passes_to_ductility(ductility, reached, cycles);
  const auto passes = [&](double count) { return json_number(cycle * count); };
  return {{"strain", ductility},
          {"reached", reached},
          {"passes", passes(reach.passes)},
          {"earliest", passes(reach.earliest)},
          {"latest", passes(reach.latest)}};
}

Json zones_json(const CaseSpec& spec, const std::vector<ZoneTop>& zones) {
  Json out = Json::array();
  for (const ZoneTop& z : zones)
    out.push_back({{"name", zone_name(spec, BodyId::rail, z.zone)}, {"zone", z.zone}, {"top_m", z.top}});
  return out;
}

Json loops_json(const std::vector<PassLoop>& loops) {
  Json out = Json::array();
  for (const PassLoop& l : loops) out.push_back({{"name", l.name}, {"y_m", l.y}, {"depth_m", l.depth}});
  return out;
}

}  // namespace railstrata
