#include "case/strength_options.hpp"

#include <numbers>

#include "case/option_slots.hpp"
#include "core/si_prefix.hpp"

namespace railstrata {
namespace {

using namespace dimension;
using namespace option_slot;
using M = MaterialSpec;
using S = StrengthSpec;

constexpr double kDeepest = 0.2;
const Range kStrength = {10 * kMega, 2e4 * kMega}, kHardnessRange = {50, 2000}, kResidual = {-5e3 * kMega, 5e3 * kMega};
constexpr std::string_view kBeyondStrength = "rail steel yields at 400 to 1000 MPa: look at the unit";
constexpr std::string_view kBeyondHardness = "rail steel has 220 to 450 HV, martensite up to 1000 HV";

double of_pure_shear(const CaseSpec&, std::size_t, double shear) { return std::numbers::sqrt3 * shear; }

/// Depths as each place counts them.
struct Depths {
  std::string_view top;
  double deepest;
};

struct OfRail {
  static const S& strength(const CaseSpec& spec, std::size_t) { return spec.rail_material.strength; }
  template <auto... Path>
  static Slot slot(CaseSpec& spec, std::size_t index) {
    return at<&CaseSpec::rail_material, &M::strength, Path...>(spec, index);
  }
};
struct OfWheel {
  static const S& strength(const CaseSpec& spec, std::size_t) { return spec.wheel_material.strength; }
  template <auto... Path>
  static Slot slot(CaseSpec& spec, std::size_t index) {
    return at<&CaseSpec::wheel_material, &M::strength, Path...>(spec, index);
  }
};
struct OfLayer {
  static const S& strength(const CaseSpec& spec, std::size_t index) { return spec.layers.at(index).material.strength; }
  template <auto... Path>
  static Slot slot(CaseSpec& spec, std::size_t index) {
    return layer<&LayerSpec::material, &M::strength, Path...>(spec, index);
  }
};

/// A table of one value by depth.
Option table_of(std::string_view key, Slot (*slot)(CaseSpec&, std::size_t), std::string_view doc, const Depths& depths,
                const Option& value, std::string_view example) {
  Option out{key, slot, doc};
  out.columns = {depth_column(depths.top, depths.deepest), value};
  out.example = example;
  return out;
}

Option grade_option(Slot (*slot)(CaseSpec&, std::size_t)) {
  return {
      "grade", slot,
      "A steel grade (R260, R350HT, ER8, …; `railstrata info` lists them), for the strength that no other key gives"};
}

template <class Place>
std::vector<Option> yield_options(const Depths& depths) {
  const Option strength{"strength", nullptr, "", kPressure, kStrength, {}, {}, nullptr, kBeyondStrength},
      hardness{"hardness", nullptr, "", kHardness, kHardnessRange, {}, {}, nullptr, kBeyondHardness};
  return {
      grade_option(Place::template slot<&S::grade>),
      {"yield_strength",
       Place::template slot<&S::yield_strength>,
       "Uniaxial yield strength (0.2 % proof stress); shakedown and fatigue are computed where it is known",
       kPressure,
       kStrength,
       {},
       {},
       nullptr,
       kBeyondStrength},
      {"shear_yield_strength",
       Place::template slot<&S::yield_strength>,
       "The same in pure shear, k: yield_strength is √3 k",
       kPressure,
       kStrength,
       {},
       {of_pure_shear},
       nullptr,
       kBeyondStrength},
      table_of("strength_table", Place::template slot<&S::strength_table>,
               "yield_strength that varies with depth: rows of depth and strength, linear between", depths, strength,
               R"([["0 mm", "750 MPa"], ["10 mm", "500 MPa"]])"),
      {"hardness",
       Place::template slot<&S::hardness>,
       "Vickers hardness, or Brinell's as \"300 HBW\"; a strength that is not given is estimated from it",
       kHardness,
       kHardnessRange,
       {},
       {},
       nullptr,
       kBeyondHardness},
      table_of("hardness_table", Place::template slot<&S::hardness_table>,
               "hardness that varies with depth: rows of depth and hardness, linear between", depths, hardness,
               R"([["0 mm", "380 HV"], ["10 mm", "300 HV"]])"),
      {"yield_to_tensile",
       Place::template slot<&S::yield_to_tensile>,
       "Yield over tensile strength where a yield strength is estimated from hardness, as yield_to_tensile times 3.2 "
       "MPa times HV: 0.53 to 0.57 is usual for R260, 0.65 to 0.70 for R350HT",
       kNumber,
       {0.2, 1.0}}};
}

template <class Place>
bool elastic_on_purpose(const CaseSpec& spec, std::size_t index) {
  return Place::strength(spec, index).elastic;
}

template <class Place>
bool set_named(const CaseSpec& spec, std::size_t index) {
  return !Place::strength(spec, index).hardening.empty();
}

/// What follows the yield strength: the law of docs/material.md.
template <class Place>
std::vector<Option> hardening_options() {
  Option isotropic{"isotropic_hardening", Place::template slot<&S::isotropic_hardening>,
                   "The yield stress grows by saturation (1 - exp(-rate p)) with the accumulated plastic strain p; a "
                   "negative saturation softens"},
      kinematic{"kinematic_hardening", Place::template slot<&S::kinematic_hardening>,
                "Up to four backstresses of Armstrong and Frederick, each with modulus C and recall gamma; recall = 0 "
                "is linear"},
      elastic{"elastic", Place::template slot<&S::elastic>, "Never yields, whatever its strength: for brittle layers"};
  isotropic.form = RowForm::one_named;
  isotropic.columns = {{"saturation", nullptr, "", kPressure, kResidual, {}, {}, nullptr, kBeyondStrength},
                       {"rate", nullptr, "", kNumber, {0, 1e5}}};
  isotropic.example = R"({ saturation = "80 MPa", rate = 12 })";
  kinematic.form = RowForm::named;
  kinematic.columns = {{"modulus", nullptr, "", kPressure, {0, 1e13}}, {"recall", nullptr, "", kNumber, {0, 1e6}}};
  kinematic.example = R"([{ modulus = "60 GPa", recall = 250 }, { modulus = "5 GPa", recall = 10 }])";
  elastic.applies = elastic_on_purpose<Place>;
  Option set{"hardening", Place::template slot<&S::hardening>,
             "A ready set of cyclic hardening by name (docs/material.md lists them), or \"estimated\": from "
             "tensile_strength or hardness. It begins to yield at its own stress; yield_strength then serves shakedown "
             "and fatigue alone"};
  set.applies = set_named<Place>;
  return {set, isotropic, kinematic, elastic};
}

template <class Place>
std::vector<Option> residual_options(const Depths& depths) {
  const Option along{"longitudinal stress", nullptr, "", kPressure, kResidual},
      across{"lateral stress", nullptr, "", kPressure, kResidual};
  Option both{"initial_stress", Place::template slot<&S::initial_stress>,
              "Residual stress of the process, longitudinal and lateral, tension positive", kPressure, kResidual};
  both.example = R"(["-344 MPa", "-200 MPa"])";
  Option table = table_of("initial_stress_table", Place::template slot<&S::initial_stress_table>,
                          "The same by depth: rows of depth, longitudinal and lateral stress, linear between", depths,
                          along, R"([["0 mm", "-300 MPa", "-200 MPa"], ["5 mm", "0 MPa", "0 MPa"]])");
  table.columns.push_back(across);
  return {both, table};
}

template <class Place>
std::vector<Option> fatigue_options() {
  return {{"tensile_strength", Place::template slot<&S::tensile_strength>,
           "Of the tensile test; for a brittle layer what its largest principal stress is held against", kPressure,
           kStrength},
          {"fracture_toughness",
           Place::template slot<&S::fracture_toughness>,
           "K_Ic of a brittle layer: gives the size of a surface flaw that its largest principal stress opens",
           kToughness,
           {1e5, 1e9}},
          {"fatigue_limit",
           Place::template slot<&S::fatigue_limit>,
           "Of Dang Van's criterion: the amplitude that alternating shear bears for ever",
           kPressure,
           {kMega, 1e4 * kMega}},
          {"dang_van_coefficient",
           Place::template slot<&S::dang_van_coefficient>,
           "Weight of the hydrostatic stress in Dang Van's criterion",
           kNumber,
           {0, 3}},
          {"fatemi_socie_coefficient",
           Place::template slot<&S::fatemi_socie_coefficient>,
           "Weight of the normal stress in Fatemi and Socie's parameter; it is divided by yield_strength",
           kNumber,
           {0, 10}},
          {"jiang_sehitoglu_coefficient",
           Place::template slot<&S::jiang_sehitoglu_coefficient>,
           "Weight J of the shear term in Jiang and Sehitoglu's parameter",
           kNumber,
           {0, 10}},
          {"wear_coefficient", Place::template slot<&S::wear_coefficient>,
           "Archard's k: worn volume is k times force times distance over hardness", kNumber, above(0, 1)},
          {"conductivity", Place::template slot<&S::conductivity>, "Of heat", kConductivity, {0.01, 5000}},
          {"heat_capacity", Place::template slot<&S::heat_capacity>, "Per mass", kHeatCapacity, {10, 20000}},
          {"austenitisation_rise",
           Place::template slot<&S::austenitisation_rise>,
           "Rise of temperature at which the surface turns to austenite, and to martensite when it cools: of pearlitic "
           "steel at 20 °C some 700 K without pressure; gives the share that the flash temperature reaches",
           kTemperature,
           {50, 3000}}};
}

template <class Place>
std::vector<Option> all_options(const Depths& depths) {
  std::vector<Option> out = yield_options<Place>(depths);
  for (const auto& more : {hardening_options<Place>(), residual_options<Place>(depths), fatigue_options<Place>()})
    out.insert(out.end(), more.begin(), more.end());
  return out;
}

std::vector<Option> bond_options() {
  return {{"bond_tension",
           OfLayer::slot<&S::bond_tension>,
           "Strength of the layer's lower interface against normal tension",
           kPressure,
           {0.1 * kMega, 1e4 * kMega}},
          {"bond_shear",
           OfLayer::slot<&S::bond_shear>,
           "Strength of the layer's lower interface against shear",
           kPressure,
           {0.1 * kMega, 1e4 * kMega}}};
}

}  // namespace

Option depth_column(std::string_view top, double deepest) {
  return {"depth", nullptr, top, dimension::kLength, {0, deepest}};
}

std::vector<Option> strength_options(StrengthPlace place) {
  const Depths below_surface{"the running surface", kDeepest}, below_top{"the layer's top", kDeepest};
  if (place == StrengthPlace::rail) return all_options<OfRail>(below_surface);
  if (place == StrengthPlace::wheel) return all_options<OfWheel>(below_surface);
  std::vector<Option> out = all_options<OfLayer>(below_top);
  for (const Option& option : bond_options()) out.push_back(option);
  return out;
}

std::vector<std::vector<std::string_view>> strength_rivals() {
  return {{"yield_strength", "shear_yield_strength", "strength_table"},
          {"hardness", "hardness_table"},
          {"hardening", "isotropic_hardening"},
          {"hardening", "kinematic_hardening"},
          {"initial_stress", "initial_stress_table"}};
}

}  // namespace railstrata
