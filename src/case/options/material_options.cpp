#include "options/case_tables.hpp"

#include <algorithm>

#include "options/option_slots.hpp"
#include "options/strength_options.hpp"
#include "record/unit.hpp"

namespace railstrata {
namespace {

using namespace dimension;
using namespace option_slot;
using C = CaseSpec;
using M = MaterialSpec;
using L = LayerSpec;

double of_matrix_modulus(const CaseSpec& spec, std::size_t index, double ratio) {
  return ratio * (spec.layers.at(index).on == BodyId::wheel ? spec.wheel_material : spec.rail_material).young;
}

bool uniform(const CaseSpec& spec, std::size_t index) { return !spec.layers.at(index).graded(); }
bool ends(const CaseSpec& spec, std::size_t index) { return spec.layers.at(index).ends(); }
bool unbonded(const CaseSpec& spec, std::size_t index) { return !spec.layers.at(index).unbonded.empty(); }
bool graded(const CaseSpec& spec, std::size_t index) { return spec.layers.at(index).graded(); }

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
OptionTable material_table(std::string_view name, std::string_view doc, StrengthPlace place) {
  OptionTable out{
      name,
      doc,
      {option("young", at<Member, &M::young>, "Young's modulus", kPressure, kYoung),
       option("poisson", at<Member, &M::poisson>, "Poisson's ratio", kNumber, kPoisson).with_remedy(kBeyondPoisson),
       option("density", at<Member, &M::density>, "Mass density", kDensity, kDensityRange)},
      {},
      strength_rivals()};
  append(out.options, strength_options(place));
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
                         R"([["0 mm", "420 GPa"], ["3 mm", "210 GPa"]])"),
          option("grading_tolerance", layer<&L::grading_tolerance>,
                 "young_table, half-space engine: largest relative change of the modulus within a sub-layer", kNumber,
                 {1e-3, 1.0})};
}

}  // namespace

OptionTable layer_table() {
  OptionTable out{
      "layer",
      "A bonded layer. The first layer of a body is its surface; each further layer lies below the one before. Each "
      "needs one of young, young_ratio and young_table",
      {option("name", layer<&L::name>,
              "Name of the layer in results; default, where a body has several: \"layer 1\", \"layer 2\", … from the "
              "surface down"),
       choice<&L::on>("on", layer<&L::on>, "The body that carries the layer",
                      {{body_word(BodyId::rail), BodyId::rail}, {body_word(BodyId::wheel), BodyId::wheel}}),
       option("thickness", layer<&L::thickness>,
              "Thickness along the surface normal; with young_table it is the table's last depth", kLength,
              kLayerThickness)
           .where(uniform)
           .with_remedy(kBeyondThickness),
       option("width", layer<&L::width>, "Lateral extent, centred on the body's profile origin", kLength,
              {kMilli, 0.2}),
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
  append(out.options, strength_options(StrengthPlace::layer));
  return out;
}

OptionTable rail_material_table() {
  return material_table<&C::rail_material>("material.rail", "The rail below its layers (the matrix)",
                                           StrengthPlace::rail);
}

OptionTable wheel_material_table() {
  return material_table<&C::wheel_material>("material.wheel", "The wheel below its layers", StrengthPlace::wheel);
}

}  // namespace railstrata
