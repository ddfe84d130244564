#include "options/case_tables.hpp"
#include "options/option_slots.hpp"

namespace railstrata {
namespace {

using Stretch = StretchSpec;

template <auto Member>
Slot stretch(CaseSpec& spec, std::size_t index) {
  return option_slot::entry<&CaseSpec::stretches, Member>(spec, index);
}

}  // namespace

OptionTable stretch_table() {
  using namespace option_slot;
  using namespace dimension;
  return {"stretch",
          "A stretch of rail or wheel where all materials, including the layers, are stiffer or stronger by a factor, "
          "such as a weld with its heat-affected zone; overlapping stretches multiply",
          {choice<&Stretch::on>("on", stretch<&Stretch::on>, "Body; on the wheel x is the arc from the first contact",
                                {{body_word(BodyId::rail), BodyId::rail}, {body_word(BodyId::wheel), BodyId::wheel}}),
           option("along", stretch<&Stretch::along>,
                  "Rows of place along the rail, factor of Young's modulus and factor of strength (yield stress, "
                  "hardening and fatigue limit); linear between rows, 1 outside them. Each element uses the factors at "
                  "its middle; two rows close together make a jump with node planes between them")
               .with_rows(RowForm::by_value,
                          {column("place", "", kLength, {-100, 100}),
                           column("young", "Factor of Young's modulus", kNumber, {1e-4, 20}),
                           column("strength", "Factor of strength", kNumber, {0.05, 20})},
                          R"([["190 mm", 1.0, 1.0], ["195 mm", 1.0, 0.75], ["200 mm", 1.0, 1.0]])"),
           option("depth", stretch<&Stretch::depth>,
                  "Depth below the running surface; not given: through the whole body", kLength, above(0, 1))},
          list_of<&CaseSpec::stretches>()};
}

}  // namespace railstrata
