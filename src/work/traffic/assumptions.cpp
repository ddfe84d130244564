#include "traffic/assumptions.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "collective/wear_words.hpp"
#include "model/material_strength.hpp"
#include "model/zone.hpp"
#include "record/number_text.hpp"
#include "record/unit.hpp"

namespace railstrata {
namespace {

struct Assumption {
  std::string what, value, range, key;
};

/// "0.245 to 0.455", of an input of the design; empty without one.
std::string range_of_input(const TrafficRange& range, const std::string& input) {
  for (const InputEffect& e : range.effects)
    if (e.input == input) return fmt::format("{} to {} ({})", e.value[0], e.value[1], e.key);
  return {};
}

std::string friction_text(const CaseSpec& spec) {
  double low = spec.drive.friction_coefficient, high = low;
  for (const LoadSpec& load : spec.loads) {
    low = std::min(low, load.friction_coefficient.value_or(low));
    high = std::max(high, load.friction_coefficient.value_or(high));
  }
  return low < high ? fmt::format("{:.3g} to {:.3g} by load", low, high) : fmt::format("{:.3g}", low);
}

std::string traction_text(const std::vector<CollectiveRow>& rows) {
  const std::string free = free_words(rows);
  return free.empty() ? "as the loads or [drive] give it" : free;
}

/// How a zone of the rail yields and tires.
void add_zone(const CaseSpec& spec, int zone, const std::string& strengths, std::vector<Assumption>& out) {
  const MaterialSpec& material = zone_material(spec, BodyId::rail, zone);
  const std::string name = zone_name(spec, BodyId::rail, zone), key = zone_key(spec, BodyId::rail, zone);
  const std::optional<PlasticLaw> law = plastic_law(material, name, key);
  out.push_back({fmt::format("yielding of {}", name),
                 !law ? "stays elastic"
                 : law->notes.empty()
                     ? fmt::format("as given, from {} on", with_unit(unit::kMPa, law->at(0).plastic.yield, 3))
                     : fmt::format("{}", fmt::join(law->notes, "; ")),
                 law ? strengths : "", fmt::format("{0}.hardening, {0}.yield_strength", key)});
  const FatigueSpec& f = material.strength.fatigue;
  out.push_back({fmt::format("fatigue of {}", name),
                 f.limit && f.exponent ? fmt::format("limit {} at {:.3g} cycles, exponent {:.3g}",
                                                     with_unit(unit::kMPa, *f.limit, 3), f.cycles, *f.exponent)
                                       : "not given, so this life is not known",
                 "", fmt::format("{0}.fatigue_limit, {0}.fatigue_exponent, {0}.dang_van_coefficient", key)});
}

std::string grinding_text(const GrindingSpec& grinding) {
  if (!grinding.every) return "none";
  return fmt::format("{} every {:.3g} MGT", limit_text(unit::kMillimetres, grinding.depth),
                     unit::kMGT.factor * *grinding.every);
}

std::string wear_text(const FollowedTraffic& t) {
  const WearLaw law = t.spec.collective.wear_law;
  for (const KnownWear& wear : known_wear(t.unworn))
    if (wear.law == law) {
      const std::string steel = steel_words(t.rows, law);
      return wear.words + (steel.empty() ? "" : "; " + steel);
    }
  return "no data of its law: nothing wears";
}

std::vector<Assumption> assumptions(const FollowedTraffic& t) {
  const CaseSpec& spec = t.spec;
  const ClockResult& best = t.best();
  const auto input = [&](const char* name) { return range_of_input(t.range, name); };
  std::vector<Assumption> out{
      {"traffic",
       fmt::format("{} load{}, {:.4g} wheels and {:.3g} MGT a collective, thoroughly mixed", t.rows.size(),
                   t.rows.size() == 1 ? "" : "s", best.wheels, 1e-6 * best.tonnes),
       "", "[[load]], collective.file"},
      {"followed",
       fmt::format("{:.3g} MGT{}", unit::kMGT.factor * best.reached,
                   best.ended.empty() ? "" : fmt::format(" of {:.3g}: {}", unit::kMGT.factor * t.horizon, best.ended)),
       "", "life.until"},
      {"traction", traction_text(t.rows), "", "drive.traction_coefficient"},
      {"friction coefficient", friction_text(spec), input("friction"), "drive.friction_coefficient"},
      {"place of the wheels",
       spec.collective.lateral_deviation > 0
           ? fmt::format("standard deviation {}", limit_text(unit::kMillimetres, spec.collective.lateral_deviation))
           : "all wheels of a load on one line",
       input("place"), "collective.lateral_deviation"},
      {"ductility",
       spec.passes.ductility ? fmt::format("{:.3g}", *spec.passes.ductility) : "not given, so this life is not known",
       input("ductility"), "passes.ductility"}};
  const auto layers = static_cast<int>(layers_on(spec, BodyId::rail).size());
  for (int zone = layers > 0 ? 1 : 0; zone <= layers; ++zone) add_zone(spec, zone, input("strength"), out);
  if (layers > 0) add_zone(spec, 0, input("strength"), out);
  out.insert(out.end(), {{"wear law", wear_text(t), "", "collective.wear_law"},
                         {"wear factor", fmt::format("{:.3g}", spec.collective.wear_factor), input("wear factor"),
                          "collective.wear_factor"},
                         {"grinding", grinding_text(spec.life.grinding), "", "grinding.every, grinding.depth"},
                         {"cells of the contact", limit_text(unit::kMillimetres, t.cell), "", "--cell"},
                         {"pressure", "of elastic bodies, on the profile of the day", "", ""}});
  return out;
}

}  // namespace

ReportTable assumptions_table(const FollowedTraffic& traffic) {
  ReportTable out{.id = "assumptions",
                  .title = "What this rests on",
                  .note = "Key: what to change in the case, or on the command line, for another assumption.",
                  .columns = {},
                  .rows = {}};
  using A = Assumption;
  std::vector<TextColumn<A>> columns{{"what", [](const A& a) { return a.what; }},
                                     {"value", [](const A& a) { return a.value; }}};
  if (traffic.has_range()) columns.push_back({"range", [](const A& a) { return a.range; }});
  columns.push_back({"key", [](const A& a) { return a.key; }});
  add_rows(out, assumptions(traffic), columns);
  return out;
}

}  // namespace railstrata
