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
      option("length", irregularity<&I::length>, "indentation, step, flat: from end to end", kLength, above(0, 20)),
      option("wavelength", irregularity<&I::wavelength>, "corrugation", kLength, above(0, 20)),
      option("order", irregularity<&I::order>, "out_of_round: waves round the wheel", kNumber, {1, 1000})
          .where(is<Kind::out_of_round>),
      option("depth", irregularity<&I::depth>,
             "Peak to valley, of an indentation and of a flat that is worn round; a fresh flat is a chord of its "
             "length",
             kLength, {0, 0.02}),
      option("height", irregularity<&I::height>,
             "step: of the rail behind it over the rail before it; negative: it lies lower", kLength, {-0.02, 0.02}),
      option("width", irregularity<&I::width>, "Across, falling off as a cosine; not given: the same all across",
             kLength, above(0, 0.2)),
      option("offset", irregularity<&I::offset>, "Of the middle across, from the first contact to the field side",
             kLength, {-0.1, 0.1}),
      option("angle", irregularity<&I::angle>, "dip: between its two ramps", kSlope, {0, 0.2}),
      option("ramp", irregularity<&I::ramp>, "dip: length of each", kLength, above(0, 20)).where(is<Kind::dip>),
      choice<&I::shape>("shape", irregularity<&I::shape>, "dip: how the ramps run to their ends",
                        {{"parabola", RampShape::parabola}, {"line", RampShape::line}})
          .where(is<Kind::dip>)};
}

std::vector<Option> height_spectrum_options() {
  return {
      option("rms", irregularity<&I::rms>, "roughness: root mean square height", kLength, above(0, 1e-3)),
      option("shortest", irregularity<&I::shortest>, "roughness: shortest wave", kLength, above(0, 20)),
      option("longest", irregularity<&I::longest>, "roughness: longest wave", kLength, above(0, 20)),
      option("exponent", irregularity<&I::exponent>,
             "roughness: e of the spectral density, which falls with the wave number to the power -e", kNumber, {0, 10})
          .where(is<Kind::roughness>),
      option("seed", irregularity<&I::seed>, "roughness: of its random phases", kNumber, {0, 2147483647})
          .where(is<Kind::roughness>)};
}

std::vector<Option> height_point_options() {
  return {
      option("file", irregularity<&I::file>,
             "A CSV file with the columns x and z, or x, y and z of a grid, with units, relative to the case file; "
             "the resolved case has its values")
          .where(never),
      option("smoothing", irregularity<&I::smoothing>,
             "file: length of the mean with cosine weights that its heights are smoothed by along x; 0: as they are",
             kLength, {0, 1})
          .where(is<Kind::file>),
      option("x", irregularity<&I::x>, "In place of the file: along the way, from `at`", kLength, kHeightWay),
      option("y", irregularity<&I::y>, "In place of the file: across, from `offset`", kLength, {-0.2, 0.2}),
      option("z", irregularity<&I::z>, "In place of the file: heights, positive out of the body", kLength,
             {-0.02, 0.02})};
}

}  // namespace

OptionTable irregularity_table() {
  OptionTable out{
      "irregularity",
      "A height along the running surface of rail or wheel, positive out of the body; several are added up",
      {choice<&I::on>("on", irregularity<&I::on>, "Of the wheel x is the arc from the first contact",
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
       option("at", irregularity<&I::at>, "Its middle, of waves a crest, of a file x = 0: from the first contact on",
              kLength, kHeightWay),
       option("from", irregularity<&I::from>, "corrugation, roughness: begin, eased in over the longest wave", kLength,
              kHeightWay),
       option("to", irregularity<&I::to>, "corrugation, roughness: end, eased out likewise", kLength, kHeightWay)},
      list_of<&CaseSpec::irregularities>(),
      {{"file", "x"}, {"file", "y"}, {"file", "z"}}};
  for (const auto& rows : {height_shape_options(), height_spectrum_options(), height_point_options()})
    append(out.options, rows);
  return out;
}

}  // namespace railstrata
