#include "options/option_slots.hpp"

#include <algorithm>
#include <numbers>

#include "record/unit.hpp"

namespace railstrata {
namespace {

using namespace dimension;
using namespace option_slot;
using C = CaseSpec;
using M = MaterialSpec;
using S = StrengthSpec;
using L = LayerSpec;

/// The depth of a table by depth, which begins at `top` and ends at most at `deepest` [m].
Option depth_column(std::string_view top, double deepest) { return column("depth", top, kLength, {0, deepest}); }

constexpr double kDeepest = 0.2;
const Range kStrength = {10 * kMega, 2e4 * kMega}, kHardnessRange = {50, 2000}, kResidual = {-5e3 * kMega, 5e3 * kMega};
constexpr std::string_view kBeyondStrength = "rail steel yields at 400 to 1000 MPa: look at the unit";
constexpr std::string_view kBeyondHardness = "rail steel has 220 to 450 HV, martensite up to 1000 HV";

double of_pure_shear(const CaseSpec&, std::size_t, double shear) { return std::numbers::sqrt3 * shear; }

template <auto Material>
struct OfBody {
  static const S& strength(const CaseSpec& spec, std::size_t) { return (spec.*Material).strength; }
  template <auto... Path>
  static constexpr auto slot = at<Material, &M::strength, Path...>;
};
struct OfLayer {
  static const S& strength(const CaseSpec& spec, std::size_t index) { return spec.layers.at(index).material.strength; }
  template <auto... Path>
  static constexpr auto slot = layer<&LayerSpec::material, &M::strength, Path...>;
};

template <class Place>
std::vector<Option> yield_options(const Option& depth) {
  const Option strength = column("strength", "", kPressure, kStrength).with_remedy(kBeyondStrength),
               hardness = column("hardness", "", kHardness, kHardnessRange).with_remedy(kBeyondHardness);
  return {option("grade", Place::template slot<&S::grade>,
                 "A steel grade (R260, R350HT, ER8, …; `railstrata info` lists them); gives what no other key gives: "
                 "strengths, cyclic hardening, fatigue, wear"),
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
             "tensile_strength or hardness. Not given: the grade's, without a yield_strength. The set contains its own "
             "yield stress; yield_strength is then used for "
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
      option("recall_power", Place::template slot<&S::recall_power>,
             "Ohno and Wang's power m of the recall of every backstress: the larger it is, the less strain a repeated "
             "load adds with each cycle; 0 is Armstrong-Frederick",
             kNumber, {0, 100}),
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
             "indefinitely. Not given: estimated from the tensile strength of the grade",
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
      option("wear_factor", Place::template slot<&S::wear_factor>,
             "Wear of this steel over that of 900A (R260), on wheels of R8T (ER8), in the same contact; for wear_law "
             "usfd and, if given, kth. Not given: that of the grade, else an estimate from the hardness, else 1",
             kNumber, above(0, 100)),
      option("conductivity", Place::template slot<&S::heat, &HeatSpec::conductivity>, "Thermal conductivity",
             kConductivity, {0.01, 5000}),
      option("heat_capacity", Place::template slot<&S::heat, &HeatSpec::capacity>, "Specific heat capacity",
             kHeatCapacity, {10, 20000}),
      option("austenitisation_rise", Place::template slot<&S::heat, &HeatSpec::austenitisation_rise>,
             "Temperature rise at which the surface becomes austenite, and martensite after cooling: about 700 K for "
             "pearlitic steel at 20 °C without pressure. Results give the flash temperature as a share of it",
             kTemperature, {50, 3000})};
}

/// What a material bears (spec/strength_spec.hpp), the same for rail, wheel and layers. top: where depth begins.
template <class Place>
std::vector<Option> strength_options(std::string_view top) {
  const Option depth = depth_column(top, kDeepest);
  std::vector<Option> out = yield_options<Place>(depth);
  for (const auto& more : {hardening_options<Place>(), residual_options<Place>(depth), fatigue_options<Place>()})
    append(out, more);
  return out;
}

std::vector<Option> bond_options() {
  const Range springs{0, kStiffestInterface};
  return {option("interface_normal_stiffness", layer<&L::interface_normal_stiffness>,
                 "Half-spaces: stiffness per area of the layer's lower interface against opening and closing. Not "
                 "given: it does neither. The interface transmits tension as well as pressure",
                 kPressureGradient, {kSoftestInterface, kStiffestInterface}),
          option("interface_shear_stiffness", layer<&L::interface_shear_stiffness>,
                 "Half-spaces: stiffness per area of the layer's lower interface against slip; 0: smooth, without "
                 "shear. Not given: no slip",
                 kPressureGradient, springs),
          option("interface_shear_limit", layer<&L::interface_shear_limit>,
                 "Half-spaces: shear at which the layer's lower interface slides, without pressure. With one of both "
                 "keys the other counts as 0",
                 kPressure, {0, 1e4 * kMega}),
          option("interface_friction", layer<&L::interface_friction>,
                 "Half-spaces: share of the pressure on the interface by which that shear is larger", kNumber, {0, 2}),
          option("bond_tension", OfLayer::slot<&S::bond, &BondSpec::tension>,
                 "Tensile strength of the layer's lower interface", kPressure, {0.1 * kMega, 1e4 * kMega}),
          option("bond_shear", OfLayer::slot<&S::bond, &BondSpec::shear>,
                 "Shear strength of the layer's lower interface", kPressure, {0.1 * kMega, 1e4 * kMega})};
}

/// Keys for the same quantity of a strength.
std::vector<std::vector<std::string_view>> strength_rivals() {
  return {{"yield_strength", "shear_yield_strength", "strength_table"},
          {"hardness", "hardness_table"},
          {"hardening", "isotropic_hardening"},
          {"hardening", "kinematic_hardening"},
          {"initial_stress", "initial_stress_table"}};
}

double of_matrix_modulus(const CaseSpec& spec, std::size_t index, double ratio) {
  return ratio * (spec.layers.at(index).on == BodyId::wheel ? spec.wheel_material : spec.rail_material).young;
}

bool uniform(const CaseSpec& spec, std::size_t index) { return !spec.layers.at(index).graded(); }
bool ends(const CaseSpec& spec, std::size_t index) { return spec.layers.at(index).ends(); }
bool unbonded(const CaseSpec& spec, std::size_t index) { return !spec.layers.at(index).unbonded.empty(); }
bool graded(const CaseSpec& spec, std::size_t index) { return spec.layers.at(index).graded(); }
bool varies_across(const CaseSpec& spec, std::size_t index) { return spec.layers.at(index).varies_across(); }
bool even_across(const CaseSpec& spec, std::size_t index) { return !varies_across(spec, index); }
bool has_thickness(const CaseSpec& spec, std::size_t index) { return uniform(spec, index) && even_across(spec, index); }

// Thickness, Poisson's ratio and the ratio of moduli: what tests/bem/layer_range_test.cpp and
// tests/halfspace/layered_test.cpp hold against closed forms. The modulus leaves room for every ratio of steel's.
const Range kYoung{1e9, 1e14}, kPoisson{0.0, 0.499}, kYoungRatio{0.01, 100}, kDensityRange{100, 30000},
    kLayerThickness{kThinnestLayer, kThickestLayer}, kLayerWay{-100, 100};
constexpr std::string_view kBeyondPoisson = "0.5 is incompressible: take 0.499 for it",
                           kBeyondRatio =
                               "the engines are verified in this range only; use the limit nearest to your layer",
                           kBeyondThickness =
                               "leave a thinner layer out; give a thicker one's modulus to the body that carries it";

template <auto Member>
OptionTable material_table(std::string_view name, std::string_view doc) {
  OptionTable out{
      name,
      doc,
      {option("young", at<Member, &M::young>, "Young's modulus", kPressure, kYoung),
       option("poisson", at<Member, &M::poisson>, "Poisson's ratio", kNumber, kPoisson).with_remedy(kBeyondPoisson),
       option("density", at<Member, &M::density>, "Mass density", kDensity, kDensityRange)},
      {},
      strength_rivals()};
  append(out.options, strength_options<OfBody<Member>>("the running surface"));
  return out;
}

std::vector<Option> layer_modulus_options() {
  return {option("young", layer<&L::material, &M::young>, "Young's modulus", kPressure, kYoung).where(uniform),
          option("young_ratio", layer<&L::material, &M::young>, "Young's modulus as a multiple of the carrying body's",
                 kNumber, kYoungRatio)
              .derived({of_matrix_modulus, "choose a multiple in this range"})
              .with_remedy(kBeyondRatio),
          option("young_table", layer<&L::young_table>,
                 "Young's modulus as a function of depth: rows of depth below the layer's top and modulus, linear "
                 "between rows")
              .where(graded)
              .with_rows(RowForm::by_depth,
                         {depth_column("the layer's top", kLayerThickness.max),
                          column("modulus", "Young's modulus", kPressure, kYoung)},
                         R"([["0 mm", "420 GPa"], ["3 mm", "210 GPa"]])")};
}

Option thickness_table_option() {
  return option("thickness_table", layer<&L::thickness_table>,
                "Thickness as a function of lateral position, in place of thickness and width: rows of the body "
                "profile's y and the thickness, linear between rows. Outside the rows the layer is absent; where it is "
                "thinner, the material below fills the space")
      .where(varies_across)
      .with_rows(RowForm::by_value,
                 {column("y", "", kLength, {-0.2, 0.2}), column("thickness", "", kLength, {0, kLayerThickness.max})},
                 R"([["-20 mm", "0 mm"], ["-10 mm", "3 mm"], ["35 mm", "3 mm"]])");
}

}  // namespace

OptionTable layer_table() {
  OptionTable out{
      "layer",
      "A layer, bonded to what lies below it unless its interface gives. The first layer "
      "of a body is its surface; each further layer lies below the one before. Each "
      "needs one of young, young_ratio and young_table",
      {option("name", layer<&L::name>,
              "Name of the layer in results; default, where a body has several: \"layer 1\", \"layer 2\", … from the "
              "surface down"),
       body_choice<&L::on>(layer<&L::on>, "The body that carries the layer"),
       option("thickness", layer<&L::thickness>,
              "Thickness along the surface normal; with young_table it is the table's last depth", kLength,
              kLayerThickness)
           .where(has_thickness)
           .with_remedy(kBeyondThickness),
       option("width", layer<&L::width>, "Lateral extent, centred on the body's profile origin", kLength, {kMilli, 0.2})
           .where(even_across),
       thickness_table_option(),
       option("poisson", layer<&L::material, &M::poisson>, "Poisson's ratio", kNumber, kPoisson)
           .with_remedy(kBeyondPoisson),
       option("density", layer<&L::material, &M::density>, "Mass density", kDensity, kDensityRange),
       option("elements", layer<&L::elements>,
              "Number of elements through the thickness; 0: automatic (height at most 1 mm, at least 2, at least 3 "
              "from 3 mm thickness on). With young_table, each row of elements has the mean modulus over its height",
              kNumber, {0, 50}),
       option("from", layer<&L::from>,
              "Start of the layer along the rail, from the first contact; on a wheel along its arc. Outside [from, to] "
              "the material below fills the space. Not given: unlimited on this side",
              kLength, kLayerWay),
       option("to", layer<&L::to>, "End of the layer, measured as `from`", kLength, kLayerWay),
       option("taper_length", layer<&L::taper_length>,
              "Length over which the thickness tapers to zero at from and to, inside the layer, in steps of one row of "
              "elements; 0: a step",
              kLength, {0, 20})
           .where(ends),
       option("unbonded", layer<&L::unbonded>,
              "Finite elements, rail: stretches where the layer is detached from its base. The interface there "
              "transmits pressure and friction but no tension, across the fine columns of the mesh (mesh.fine_width) "
              "within the layer, except at its edges")
           .with_rows(RowForm::ranges, {column("from", "", kLength, kLayerWay), column("to", "", kLength, kLayerWay)},
                      R"([["180 mm", "192 mm"]])"),
       option("unbonded_friction", layer<&L::unbonded_friction>, "Friction coefficient on the unbonded interface",
              kNumber, {0, 2})
           .where(unbonded)},
      list_of<&C::layers>(),
      strength_rivals()};
  const std::vector<Option> modulus = layer_modulus_options();
  const auto poisson =
      std::find_if(out.options.begin(), out.options.end(), [](const Option& o) { return o.key == "poisson"; });
  out.options.insert(poisson, modulus.begin(), modulus.end());
  append(out.options, strength_options<OfLayer>("the layer's top"));
  append(out.options, bond_options());
  return out;
}

OptionTable rail_material_table() {
  return material_table<&C::rail_material>("material.rail", "The rail below its layers (the matrix)");
}

OptionTable wheel_material_table() {
  return material_table<&C::wheel_material>("material.wheel", "The wheel below its layers");
}

}  // namespace railstrata
