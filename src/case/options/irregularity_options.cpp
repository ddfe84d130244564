#include "options/case_tables.hpp"
#include "options/option_slots.hpp"

namespace railstrata {
namespace {

using namespace dimension;
using namespace option_slot;
using I = Irregularity;
using Kind = IrregularityKind;

template <auto Member>
Slot irregularity(CaseSpec& spec, std::size_t index) {
  return entry<&CaseSpec::irregularities, Member>(spec, index);
}
template <Kind... Kinds>
bool is(const CaseSpec& spec, std::size_t index) {
  return ((spec.irregularities.at(index).kind == Kinds) || ...);
}

const Range kHeightWay{-100, 100};  // m

std::vector<Option> height_shape_options() {
  return {
      option("length", irregularity<&I::length>, "indentation, step, flat: length from end to end", kLength,
             above(0, 20)),
      option("wavelength", irregularity<&I::wavelength>, "corrugation: wavelength", kLength, above(0, 20)),
      option("order", irregularity<&I::order>, "out_of_round: number of waves around the wheel", kNumber, {1, 1000})
          .where(is<Kind::out_of_round>),
      option("depth", irregularity<&I::depth>,
             "Depth from peak to valley; for an indentation, and for a flat with worn, rounded edges. A fresh flat is "
             "a chord and needs only its length",
             kLength, {0, 0.02}),
      option("height", irregularity<&I::height>, "step: height of the following rail relative to the preceding one",
             kLength, {-0.02, 0.02}),
      option("width", irregularity<&I::width>, "Lateral width, with a cosine shape; not given: uniform across", kLength,
             above(0, 0.2)),
      option("offset", irregularity<&I::offset>,
             "Lateral position of the middle, from the first contact to the field side", kLength, {-0.1, 0.1}),
      option("angle", irregularity<&I::angle>, "dip: angle between its two ramps", kSlope, {0, 0.2}),
      option("ramp", irregularity<&I::ramp>, "dip: length of each ramp", kLength, above(0, 20)).where(is<Kind::dip>),
      choice<&I::shape>("shape", irregularity<&I::shape>, "dip: shape of the ramps",
                        {{"parabola", RampShape::parabola}, {"line", RampShape::line}})
          .where(is<Kind::dip>)};
}

std::vector<Option> height_spectrum_options() {
  return {option("rms", irregularity<&I::rms>, "roughness: root mean square height", kLength, above(0, 1e-3)),
          option("shortest", irregularity<&I::shortest>, "roughness: shortest wave", kLength, above(0, 20)),
          option("longest", irregularity<&I::longest>, "roughness: longest wave", kLength, above(0, 20)),
          option("exponent", irregularity<&I::exponent>,
                 "roughness: exponent e; the spectral density is proportional to the wave number to the power -e",
                 kNumber, {0, 10})
              .where(is<Kind::roughness>),
          option("seed", irregularity<&I::seed>, "roughness: seed of its random phases", kNumber, {0, 2147483647})
              .where(is<Kind::roughness>)};
}

std::vector<Option> height_point_options() {
  return {
      option("file", irregularity<&I::file>,
             "A CSV file with columns x and z, or x, y and z of a grid, with units, relative to the case file; the "
             "resolved case contains its values")
          .where(never),
      option("smoothing", irregularity<&I::smoothing>,
             "file: length of the cosine-weighted mean that smooths its heights along x; 0: not smoothed", kLength,
             {0, 1})
          .where(is<Kind::file>),
      option("x", irregularity<&I::x>, "Instead of the file: position along the way, from `at`", kLength, kHeightWay),
      option("y", irregularity<&I::y>, "Instead of the file: lateral position, from `offset`", kLength, {-0.2, 0.2}),
      option("z", irregularity<&I::z>, "Instead of the file: heights, positive out of the body", kLength,
             {-0.02, 0.02})};
}

}  // namespace

OptionTable irregularity_table() {
  OptionTable out{
      "irregularity",
      "A height along the running surface of rail or wheel, positive out of the body; several add up",
      {choice<&I::on>("on", irregularity<&I::on>, "Body; on the wheel x is the arc from the first contact",
                      {{body_word(BodyId::rail), BodyId::rail}, {body_word(BodyId::wheel), BodyId::wheel}}),
       choice<&I::kind>("kind", irregularity<&I::kind>, "Its shape",
                        {{"indentation", Kind::indentation},
                         {"corrugation", Kind::corrugation},
                         {"dip", Kind::dip},
                         {"step", Kind::step},
                         {"flat", Kind::flat},
                         {"out_of_round", Kind::out_of_round},
                         {"roughness", Kind::roughness},
                         {"file", Kind::file}}),
       option("at", irregularity<&I::at>, "Distance of its middle (waves: a crest; file: x = 0) from the first contact",
              kLength, kHeightWay),
       option("from", irregularity<&I::from>,
              "corrugation, roughness: start; the height grows smoothly over the longest wave", kLength, kHeightWay),
       option("to", irregularity<&I::to>, "corrugation, roughness: end; the height fades in the same way", kLength,
              kHeightWay)},
      list_of<&CaseSpec::irregularities>(),
      {{"file", "x"}, {"file", "y"}, {"file", "z"}}};
  for (const auto& rows : {height_shape_options(), height_spectrum_options(), height_point_options()})
    append(out.options, rows);
  return out;
}

}  // namespace railstrata
