// The columns of tables: numbers of the result table and the stresses that tables hold; the worst of all layers.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "result/result_table.hpp"

namespace railstrata {
namespace {

using namespace unit;

/// The stresses that tables hold, in their order.
struct StressColumn {
  std::string_view body, zone, measure, number;
};
constexpr StressColumn kStressColumns[] = {
    {"rail", "surface", "von_mises_max", "value"},    {"rail", "surface", "sigma1_max", "value"},
    {"rail", "subsurface", "von_mises_max", "value"}, {"rail", "subsurface", "von_mises_max", "depth"},
    {"rail", "layer", "von_mises_max", "value"},      {"rail", "layer", "sigma1_max", "value"},
    {"rail", "interface", "von_mises_max", "value"},  {"rail", "matrix", "von_mises_max", "value"},
    {"rail", "subsurface", "von_mises_max", "error"}, {"rail", "layer", "von_mises_max", "error"},
    {"rail", "interface", "von_mises_max", "error"},  {"rail", "matrix", "von_mises_max", "error"}};

template <class Row>
const Row& row_of(const std::vector<Row>& rows, std::string_view key) {
  return *std::find_if(rows.begin(), rows.end(), [&](const Row& r) { return r.key == key; });
}

bool of_strength(const ResultNumber& n) {
  return n.group == kShakedownGroup || n.group == kLayersGroup || n.group == kLifeGroup || n.group == kCrackGroup;
}

ResultColumn column_of(const ResultNumber& n) {
  const bool same = n.unit.factor == n.unit.column_factor;
  return {.name = n.column_name(),
          .path = n.path(),
          .factor = n.unit.column_factor,
          .title = std::string(n.label),
          .unit = same ? n.unit.shown : "",
          .shown_unit = n.unit,
          .doc = n.name,
          .of_stress = of_strength(n) || n.group == kInterfaceGroup,
          .of_strength = of_strength(n),
          .of_all_patches = n.of_all_patches,
          .of_passage = n.group == kPassageGroup,
          .comparable = n.comparable,
          .digits = n.digits};
}

ResultColumn column_of(const StressColumn& c) {
  const StressZone& zone = row_of(stress_zones(), c.zone);
  const StressMeasure& measure = row_of(stress_measures(), c.measure);
  const StressNumber& number = row_of(stress_numbers(), c.number);
  const bool value = c.number == "value";
  return {
      .name = fmt::format("{}_{}_{}{}{}", c.body, c.zone, measure.symbol, value ? "" : fmt::format("_{}", c.number),
                          number.unit.column_ending),
      .path = fmt::format("/stress/{}/{}/{}/{}{}", c.body, c.zone, c.measure, c.number, number.unit.key_ending),
      .factor = number.unit.column_factor,
      .title = fmt::format("{} {} {}{}", c.body, measure.name, zone.name, value ? "" : ", " + std::string(c.number)),
      .unit = number.unit.shown,
      .shown_unit = number.unit,
      .doc = number.doc,
      .of_stress = true};
}

void take_larger(double value, double& out) {
  if (std::isfinite(value) && !(value <= out)) out = value;
}
void take_smaller(double value, double& out) {
  if (std::isfinite(value) && !(value >= out)) out = value;
}

}  // namespace

std::string ResultColumn::symbol() const { return name.substr(0, name.size() - shown_unit.column_ending.size()); }
std::string ResultColumn::key() const { return symbol() + std::string(shown_unit.key_ending); }

const std::vector<StressBody>& stress_bodies() {
  static const std::vector<StressBody> bodies{{"rail", &Summary::rail}, {"wheel", &Summary::wheel}};
  return bodies;
}

const std::vector<StressZone>& stress_zones() {
  using S = StressSummary;
  static const std::vector<StressZone> zones{
      {"surface", &S::surface, "at the surface",
       "At the running surface; finite elements: recovered from its tractions and strains, with the peaks between "
       "nodes at "
       "the front of slip and at the edges of the patch"},
      {"subsurface", &S::subsurface, "below the surface",
       "Deeper than a tenth of the patch's shorter semi-axis or half a thinner surface layer; in finite elements also "
       "deeper than one element edge"},
      {"layer", &S::layer, "in the layers", "In the layers, with their borders"},
      {"interface", &S::interface, "at the interfaces",
       "On both sides of every border between materials; finite elements: recovered from the element centres of the "
       "side"},
      {"matrix", &S::matrix, "in the matrix", "Below all layers, with their lower border"}};
  return zones;
}

const std::vector<StressMeasure>& stress_measures() {
  static const std::vector<StressMeasure> measures{{"von_mises_max", "von_mises", &StressPair::von_mises, "von Mises"},
                                                   {"sigma1_max", "sigma_1", &StressPair::sigma1, "σ₁"}};
  return measures;
}

const std::vector<StressNumber>& stress_numbers() {
  static const std::vector<StressNumber> numbers{
      {"value", kMPa, &StressMaximum::value, "Largest value"},
      {"x", kMillimetres, &StressMaximum::x, "Distance from the axle in the rolling direction"},
      {"y", kMillimetres, &StressMaximum::y, "Distance from the rigid contact point towards the field side"},
      {"depth", kMillimetres, &StressMaximum::depth, "Depth below the surface along the normal"},
      {"error", kMPa, &StressMaximum::error,
       "Error bar, defined as for `p_max`; half-spaces, von Mises stresses below the surface"}};
  return numbers;
}

std::vector<ResultColumn> table_columns() {
  std::vector<ResultColumn> contact_columns, strength_columns, run_columns;
  for (const ResultNumber& n : result_numbers())
    if (n.column)
      (n.group == "run" ? run_columns : of_strength(n) ? strength_columns : contact_columns).push_back(column_of(n));
  std::vector<ResultColumn> out = std::move(contact_columns);
  for (const StressColumn& c : kStressColumns) out.push_back(column_of(c));
  out.insert(out.end(), strength_columns.begin(), strength_columns.end());
  out.insert(out.end(), run_columns.begin(), run_columns.end());
  return out;
}

LayerWorst layer_worst(const Summary& summary) {
  LayerWorst out;
  for (const BodyFatigue& body : summary.fatigue) {
    for (const BrittleSummary& z : body.brittle) {
      if (z.zone == body.body) continue;  // rail and wheel themselves are no layers
      take_larger(z.sigma1, out.sigma_1);
      take_larger(z.share_of_tensile, out.share_of_tensile);
      take_smaller(z.critical_flaw, out.critical_flaw);
    }
    for (const InterfaceSummary& i : body.interfaces) {
      take_larger(i.tension, out.interface_tension);
      take_larger(i.shear, out.interface_shear);
      take_larger(i.shear_range, out.shear_range);
      take_larger(i.delamination, out.delamination);
    }
  }
  return out;
}

}  // namespace railstrata
