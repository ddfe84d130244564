#include "options/strength_options.hpp"

#include <numbers>

#include "options/option_slots.hpp"
#include "record/unit.hpp"

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

template <class Place>
std::vector<Option> yield_options(const Option& depth) {
  const Option strength = column("strength", "", kPressure, kStrength).with_remedy(kBeyondStrength),
               hardness = column("hardness", "", kHardness, kHardnessRange).with_remedy(kBeyondHardness);
  return {option("grade", Place::template slot<&S::grade>,
                 "A steel grade (R260, R350HT, ER8, …; `railstrata info` lists them); supplies the strengths that no "
                 "other key gives"),
          option("yield_strength", Place::template slot<&S::yield_strength>,
                 "Uniaxial yield strength (0.2 % proof stress); shakedown and fatigue are computed where it is known",
                 kPressure, kStrength)
              .with_remedy(kBeyondStrength),
          option("shear_yield_strength", Place::template slot<&S::yield_strength>,
                 "Yield strength in pure shear, k; yield_strength is √3 k", kPressure, kStrength)
              .derived({of_pure_shear})
              .with_remedy(kBeyondStrength),
          option("strength_table", Place::template slot<&S::strength_table>,
                 "yield_strength as a function of depth: rows of depth and strength, linear between rows")
              .with_rows(RowForm::by_depth, {depth, strength}, R"([["0 mm", "750 MPa"], ["10 mm", "500 MPa"]])"),
          option("hardness", Place::template slot<&S::hardness>,
                 "Vickers hardness, or Brinell hardness as \"300 HBW\"; a missing strength is estimated from it",
                 kHardness, kHardnessRange)
              .with_remedy(kBeyondHardness),
          option("hardness_table", Place::template slot<&S::hardness_table>,
                 "hardness as a function of depth: rows of depth and hardness, linear between rows")
              .with_rows(RowForm::by_depth, {depth, hardness}, R"([["0 mm", "380 HV"], ["10 mm", "300 HV"]])"),
          option("yield_to_tensile", Place::template slot<&S::yield_to_tensile>,
                 "Ratio of yield to tensile strength, used to estimate the yield strength from hardness: "
                 "yield_to_tensile * 3.2 MPa * HV. Usual values: 0.53 to 0.57 for R260, 0.65 to 0.70 for R350HT",
                 kNumber, {0.2, 1.0})};
}

template <class Place>
bool elastic_on_purpose(const CaseSpec& spec, std::size_t index) {
  return Place::strength(spec, index).elastic;
}

template <class Place>
bool has_sigma_n(const CaseSpec& spec, std::size_t index) {
  return Place::strength(spec, index).fatigue.exponent.has_value();
}

template <class Place>
bool set_named(const CaseSpec& spec, std::size_t index) {
  return !Place::strength(spec, index).hardening.empty();
}

/// Options of hardening, the law of docs/material.md.
template <class Place>
std::vector<Option> hardening_options() {
  return {
      option("hardening", Place::template slot<&S::hardening>,
             "Name of a set of cyclic hardening data (docs/material.md lists them), or \"estimated\" from "
             "tensile_strength or hardness. The set contains its own yield stress; yield_strength is then used for "
             "shakedown and fatigue only")
          .where(set_named<Place>),
      option("isotropic_hardening", Place::template slot<&S::isotropic_hardening>,
             "The yield stress increases by saturation * (1 - exp(-rate p)) with the accumulated plastic strain p; a "
             "negative saturation softens")
          .with_rows(RowForm::one_named,
                     {column("saturation", "", kPressure, kResidual).with_remedy(kBeyondStrength),
                      column("rate", "", kNumber, {0, 1e5})},
                     R"({ saturation = "80 MPa", rate = 12 })"),
      option("kinematic_hardening", Place::template slot<&S::kinematic_hardening>,
             "Up to four Armstrong-Frederick backstresses, each with modulus C and recall gamma; recall = 0 is linear")
          .with_rows(RowForm::named,
                     {column("modulus", "", kPressure, {0, 1e13}), column("recall", "", kNumber, {0, 1e6})},
                     R"([{ modulus = "60 GPa", recall = 250 }, { modulus = "5 GPa", recall = 10 }])"),
      option("elastic", Place::template slot<&S::elastic>,
             "The material never yields, whatever its strength; for brittle layers")
          .where(elastic_on_purpose<Place>)};
}

template <class Place>
std::vector<Option> residual_options(const Option& depth) {
  return {
      option("initial_stress", Place::template slot<&S::initial_stress>,
             "Residual stress of manufacture, longitudinal and lateral, tension positive", kPressure, kResidual)
          .with_example(R"(["-344 MPa", "-200 MPa"])"),
      option(
          "initial_stress_table", Place::template slot<&S::initial_stress_table>,
          "initial_stress as a function of depth: rows of depth, longitudinal and lateral stress, linear between rows")
          .with_rows(RowForm::by_depth,
                     {depth, column("longitudinal stress", "", kPressure, kResidual),
                      column("lateral stress", "", kPressure, kResidual)},
                     R"([["0 mm", "-300 MPa", "-200 MPa"], ["5 mm", "0 MPa", "0 MPa"]])")};
}

template <class Place>
std::vector<Option> fatigue_options() {
  return {
      option("tensile_strength", Place::template slot<&S::tensile_strength>,
             "Tensile strength; for a brittle layer, the limit of its largest principal stress", kPressure, kStrength),
      option("fracture_toughness", Place::template slot<&S::fracture_toughness>,
             "K_Ic of a brittle layer; gives the size of the surface flaw that its largest principal stress opens",
             kToughness, {1e5, 1e9}),
      option("fatigue_limit", Place::template slot<&S::fatigue, &FatigueSpec::limit>,
             "Fatigue limit of Dang Van's criterion: the amplitude of alternating shear that the material endures "
             "indefinitely",
             kPressure, {kMega, 1e4 * kMega}),
      option("fatigue_exponent", Place::template slot<&S::fatigue, &FatigueSpec::exponent>,
             "Exponent k of the sigma-N line through the limit, N = fatigue_cycles (fatigue_limit / stress)^k; gives a "
             "life where the material stays elastic",
             kNumber, {1, 50}),
      option("fatigue_cycles", Place::template slot<&S::fatigue, &FatigueSpec::cycles>,
             "Cycles at the limit, the knee of the sigma-N line", kNumber, {1e3, 1e12})
          .where(has_sigma_n<Place>),
      option("dang_van_coefficient", Place::template slot<&S::fatigue, &FatigueSpec::dang_van>,
             "Weight of the hydrostatic stress in Dang Van's criterion", kNumber, {0, 3}),
      option("fatemi_socie_coefficient", Place::template slot<&S::fatigue, &FatigueSpec::fatemi_socie>,
             "Weight of the normal stress in the Fatemi-Socie parameter, divided by yield_strength", kNumber, {0, 10}),
      option("jiang_sehitoglu_coefficient", Place::template slot<&S::fatigue, &FatigueSpec::jiang_sehitoglu>,
             "Weight J of the shear term in the Jiang-Sehitoglu parameter", kNumber, {0, 10}),
      option("fatigue_strength_coefficient", Place::template slot<&S::fatigue, &FatigueSpec::strength_coefficient>,
             "σ_f' of the strain-life curve Δε/2 = σ_f'/E (2N)^b + ε_f' (2N)^c in alternating tension; not given: "
             "estimated from the tensile strength of the material or its grade",
             kPressure, {10 * kMega, 1e4 * kMega}),
      option("fatigue_strength_exponent", Place::template slot<&S::fatigue, &FatigueSpec::strength_exponent>,
             "b of the strain-life curve", kNumber, {-0.5, -0.01}),
      option("fatigue_ductility_coefficient", Place::template slot<&S::fatigue, &FatigueSpec::ductility_coefficient>,
             "ε_f' of the strain-life curve", kNumber, above(0, 100)),
      option("fatigue_ductility_exponent", Place::template slot<&S::fatigue, &FatigueSpec::ductility_exponent>,
             "c of the strain-life curve", kNumber, {-1.5, -0.1}),
      option("wear_coefficient", Place::template slot<&S::wear_coefficient>,
             "Archard's k: worn volume = k * force * distance / hardness", kNumber, above(0, 1)),
      option("conductivity", Place::template slot<&S::heat, &HeatSpec::conductivity>, "Thermal conductivity",
             kConductivity, {0.01, 5000}),
      option("heat_capacity", Place::template slot<&S::heat, &HeatSpec::capacity>, "Specific heat capacity",
             kHeatCapacity, {10, 20000}),
      option("austenitisation_rise", Place::template slot<&S::heat, &HeatSpec::austenitisation_rise>,
             "Temperature rise at which the surface becomes austenite, and martensite after cooling: about 700 K for "
             "pearlitic steel at 20 °C without pressure. Results give the flash temperature as a share of it",
             kTemperature, {50, 3000})};
}

template <class Place>
std::vector<Option> all_options(std::string_view top) {
  const Option depth = depth_column(top, kDeepest);
  std::vector<Option> out = yield_options<Place>(depth);
  for (const auto& more : {hardening_options<Place>(), residual_options<Place>(depth), fatigue_options<Place>()})
    append(out, more);
  return out;
}

std::vector<Option> bond_options() {
  return {option("bond_tension", OfLayer::slot<&S::bond_tension>, "Tensile strength of the layer's lower interface",
                 kPressure, {0.1 * kMega, 1e4 * kMega}),
          option("bond_shear", OfLayer::slot<&S::bond_shear>, "Shear strength of the layer's lower interface",
                 kPressure, {0.1 * kMega, 1e4 * kMega})};
}

}  // namespace

Option depth_column(std::string_view top, double deepest) {
  return column("depth", top, dimension::kLength, {0, deepest});
}

std::vector<Option> strength_options(StrengthPlace place) {
  if (place == StrengthPlace::rail) return all_options<OfRail>("the running surface");
  if (place == StrengthPlace::wheel) return all_options<OfWheel>("the running surface");
  std::vector<Option> out = all_options<OfLayer>("the layer's top");
  append(out, bond_options());
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
