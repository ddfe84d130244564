#include "fatigue/steel_wear.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "damage/hardness.hpp"
#include "damage/pearlite_wear.hpp"
#include "material/steels.hpp"
#include "model/zone.hpp"
#include "spec/case_spec.hpp"

namespace railstrata {
namespace {

/// HV of a body's steel that the law's tests had: what an estimate is taken over.
double reference_hardness(BodyId body) {
  const SteelNumber& brinell = grade(body == BodyId::rail ? "R260" : "ER8").hardness;
  return vickers_from_brinell(0.5 * (brinell.low + brinell.high));
}
std::string_view reference_name(BodyId body) { return body == BodyId::rail ? "R260" : "ER8"; }

/// HV at the surface, of the case or its grade; NaN where neither gives it.
double surface_hardness(const StrengthSpec& s, const Steel* steel) {
  if (s.hardness) return *s.hardness;
  if (!s.hardness_table.empty()) return s.hardness_table.front().value;
  if (!steel || !steel->hardness.known()) return kNotApplicable;
  return vickers_from_brinell(0.5 * (steel->hardness.low + steel->hardness.high));
}

/// "0.33 times that of R260", "as that of R260".
std::string over_reference(double factor, BodyId body) {
  return factor == 1 ? fmt::format("as that of {}", reference_name(body))
                     : fmt::format("{:.3g} times that of {}", factor, reference_name(body));
}

SteelWear estimated_wear(BodyId body, double vickers, const std::string& of) {
  const WearHardness range = pearlite_wear_range();
  const double factor = pearlite_wear(vickers) / pearlite_wear(reference_hardness(body));
  std::string text = fmt::format("{}, {}: estimated from {:.0f} HV between R200, R260 and R350HT",
                                 over_reference(factor, body), of, vickers);
  if (vickers > range.hardest)
    text += fmt::format("; harder than {:.0f} HV nothing is known, the value there is held", range.hardest);
  if (vickers < range.softest)
    text += fmt::format("; softer than {:.0f} HV nothing is known, the value there is held", range.softest);
  return {factor, WearSource::estimated, text};
}

SteelWear unknown_wear(BodyId body, const std::string& why, const std::string& key) {
  return {1, WearSource::unknown, fmt::format("taken as that of {}: {}; give {}", reference_name(body), why, key)};
}

}  // namespace

SteelWear steel_wear(const CaseSpec& spec, BodyId body) {
  const int zone = layers_on(spec, body).empty() ? 0 : 1;
  const StrengthSpec& s = zone_material(spec, body, zone).strength;
  const std::string key = zone_key(spec, body, zone), name = zone_name(spec, body, zone);
  if (s.wear_factor)
    return {*s.wear_factor, WearSource::given,
            fmt::format("{}, {}: given", over_reference(*s.wear_factor, body), name)};
  const Steel* steel = find_grade(s.grade);
  if (steel && steel->wear.known())
    return {steel->wear.low, WearSource::grade,
            fmt::format("{}, grade {}: {} ({})", over_reference(steel->wear.low, body), steel->name,
                        certainty_text(steel->wear.certainty), steel->wear.source)};
  if (steel && !steel->pearlite)
    return unknown_wear(body, fmt::format("grade {} is no pearlite, its hardness says nothing", steel->name),
                        key + ".wear_factor");
  const double vickers = surface_hardness(s, steel);
  if (std::isnan(vickers))
    return unknown_wear(body, fmt::format("{} has no grade and no hardness", name),
                        key + ".grade, hardness or wear_factor");
  return estimated_wear(body, vickers, steel ? fmt::format("grade {}", steel->name) : name);
}

}  // namespace railstrata
