#include "options/irregularity_options.hpp"

#include <cassert>

#include "options/option_slots.hpp"

namespace railstrata {
namespace {

using namespace dimension;
using namespace option_slot;
using I = Irregularity;

template <auto Member>
constexpr auto irregularity = entry<&CaseSpec::irregularities, Member>;

template <class Kind, class Part, class T>
constexpr bool belongs(T Part::*) {
  return std::is_base_of_v<Part, Kind>;
}
/// Whether the entry is of a kind with one of these members.
template <auto... Members>
bool has(const CaseSpec& spec, std::size_t index) {
  return std::visit([]<class Kind>(const Kind&) { return (belongs<Kind>(Members) || ...); },
                    spec.irregularities.at(index).shape);
}
/// The first of the members that the kind of the entry has; else that of the first of these kinds, with its default:
/// the key is read and refused (rules/irregularity_rules.hpp).
template <class Kind, auto First, auto... More>
Slot slot_in(Kind& kind) {
  if constexpr (belongs<Kind>(First))
    return slot_of(kind.*First);
  else if constexpr (sizeof...(More) > 0)
    return slot_in<Kind, More...>(kind);
}
template <class Part, class T>
Part part_of(T Part::*);
template <auto First, auto... More>
Slot of_kinds(CaseSpec& spec, std::size_t index) {
  return std::visit(
      []<class Kind>(Kind& kind) -> Slot {
        if constexpr (belongs<Kind>(First) || (belongs<Kind>(More) || ...)) {
          return slot_in<Kind, First, More...>(kind);
        } else {
          thread_local decltype(part_of(First)) nowhere;
          nowhere = {};
          return slot_of(nowhere.*First);
        }
      },
      spec.irregularities.at(index).shape);
}
template <auto... Members>
Option row(std::string_view key, std::string_view doc, const Dimension& dimension, const Range& range) {
  return option(key, of_kinds<Members...>, doc, dimension, range).where(has<Members...>);
}
bool has_middle(const CaseSpec& spec, std::size_t index) {
  const IrregularityShape& shape = spec.irregularities.at(index).shape;
  return !std::holds_alternative<Roughness>(shape) && !std::holds_alternative<RoughnessLevels>(shape);
}

const Range kHeightWay{-100, 100};  // m

std::vector<Option> height_shape_options() {
  return {row<&Indentation::length, &Step::length, &Flat::length>(
              "length", "indentation, step, flat: length from end to end", kLength, above(0, 20)),
          row<&Corrugation::wavelength>("wavelength", "corrugation: wavelength", kLength, above(0, 20)),
          row<&OutOfRound::order>("order", "out_of_round: number of waves around the wheel", kNumber, {1, 1000}),
          row<&Indentation::depth, &Corrugation::depth, &Flat::depth, &OutOfRound::depth>(
              "depth",
              "Depth from peak to valley; for an indentation, and for a flat with worn, rounded edges. A fresh flat is "
              "a chord and needs only its length",
              kLength, {0, 0.02}),
          row<&Step::height_behind>("height", "step: height of the following rail relative to the preceding one",
                                    kLength, {-0.02, 0.02}),
          option("width", irregularity<&I::width>, "Lateral width, with a cosine shape; not given: uniform across",
                 kLength, above(0, 0.2)),
          option("offset", irregularity<&I::offset>,
                 "Lateral position of the middle, from the first contact to the field side; half-spaces: from the "
                 "place of the patch",
                 kLength, {-0.1, 0.1}),
          row<&Dip::angle>("angle", "dip: angle between its two ramps", kSlope, {0, 0.2}),
          row<&Dip::ramp>("ramp", "dip: length of each ramp", kLength, above(0, 20)),
          choice<&Dip::shape>("shape", of_kinds<&Dip::shape>, "dip: shape of the ramps",
                              {{"parabola", RampShape::parabola}, {"line", RampShape::line}})
              .where(has<&Dip::shape>)};
}

std::vector<Option> height_spectrum_options() {
  return {
      row<&Roughness::rms>("rms", "roughness: root mean square height", kLength, above(0, 1e-3)),
      row<&Roughness::shortest>("shortest", "roughness: shortest wave", kLength, above(0, 20)),
      row<&Roughness::longest>("longest", "roughness: longest wave", kLength, above(0, 20)),
      row<&Roughness::exponent>(
          "exponent", "roughness: exponent e; the spectral density is proportional to the wave number to the power -e",
          kNumber, {0, 10}),
      row<&Roughness::seed, &RoughnessLevels::seed>("seed", "roughness, levels: seed of its random phases", kNumber,
                                                    {0, 2147483647}),
      row<&RoughnessLevels::wavelengths>("wavelengths", "levels: middles of third-octave bands", kLength, above(0, 2)),
      row<&RoughnessLevels::levels>("levels", "levels: 20 log10 of the root mean square height in each band over 1 µm",
                                    kLevel, {-60, 60})};
}

std::vector<Option> height_point_options() {
  using P = HeightPoints;
  return {option("file", of_kinds<&P::file, &RoughnessLevels::file>,
                 "A CSV file with units, relative to the case file, with columns x and z, or x, y and z of a grid; "
                 "levels: with columns wavelength and level. The resolved case contains its values")
              .where(never),
          row<&P::smoothing>(
              "smoothing", "file: length of the cosine-weighted mean that smooths its heights along x; 0: not smoothed",
              kLength, {0, 1}),
          row<&P::x>("x", "Instead of the file: position along the way, from `at`", kLength, kHeightWay),
          row<&P::y>("y", "Instead of the file: lateral position, from `offset`", kLength, {-0.2, 0.2}),
          row<&P::z>("z", "Instead of the file: heights, positive out of the body", kLength, {-0.02, 0.02})};
}

Option kind_option() {
  Option out = option("kind", irregularity<&I::shape>, "Its shape");
  out.first = true;
  for (const IrregularityKind& kind : irregularity_kinds())
    out.choices.push_back({kind.word, static_cast<int>(out.choices.size())});
  return out;
}

}  // namespace

const std::vector<IrregularityKind>& irregularity_kinds() {
  static const std::vector<IrregularityKind> all{{"indentation", {"at", "length", "depth"}},
                                                 {"corrugation", {"wavelength", "depth"}},
                                                 {"dip", {"at", "angle"}},
                                                 {"step", {"at", "length", "height"}},
                                                 {"flat", {"at", "length"}},
                                                 {"out_of_round", {"depth"}},
                                                 {"roughness", {"rms", "shortest", "longest"}},
                                                 {"levels", {"wavelengths", "levels"}},
                                                 {"file", {"x", "z"}}};
  assert(all.size() == std::variant_size_v<IrregularityShape>);
  return all;
}

OptionTable irregularity_table() {
  OptionTable out{
      "irregularity",
      "A height along the running surface of rail or wheel, positive out of the body; several add up",
      {body_choice<&I::on>(irregularity<&I::on>, "Body; on the wheel x is the arc from the first contact"),
       kind_option(),
       option("at", irregularity<&I::at>, "Distance of its middle (waves: a crest; file: x = 0) from the first contact",
              kLength, kHeightWay)
           .where(has_middle),
       row<&Corrugation::from, &Roughness::from, &RoughnessLevels::from>(
           "from", "corrugation, roughness, levels: start; the height grows smoothly over the longest wave", kLength,
           kHeightWay),
       row<&Corrugation::to, &Roughness::to, &RoughnessLevels::to>(
           "to", "corrugation, roughness, levels: end; the height fades in the same way", kLength, kHeightWay)},
      list_of<&CaseSpec::irregularities>(),
      {{"file", "x"}, {"file", "y"}, {"file", "z"}, {"file", "wavelengths"}, {"file", "levels"}}};
  for (const auto& rows : {height_shape_options(), height_spectrum_options(), height_point_options()})
    append(out.options, rows);
  return out;
}

OptionTable stretch_table() {
  using Stretch = StretchSpec;
  return {"stretch",
          "A stretch of rail or wheel where all materials, including the layers, are stiffer or stronger by a factor, "
          "such as a weld with its heat-affected zone; overlapping stretches multiply",
          {body_choice<&Stretch::on>(entry<&CaseSpec::stretches, &Stretch::on>,
                                     "Body; on the wheel x is the arc from the first contact"),
           option("along", entry<&CaseSpec::stretches, &Stretch::along>,
                  "Rows of place along the rail, factor of Young's modulus and factor of strength (yield stress, "
                  "hardening and fatigue limit); linear between rows, 1 outside them. Each element uses the factors at "
                  "its middle; two rows close together make a jump with node planes between them")
               .with_rows(RowForm::by_value,
                          {column("place", "", kLength, {-100, 100}),
                           column("young", "Factor of Young's modulus", kNumber, {1e-4, 20}),
                           column("strength", "Factor of strength", kNumber, {0.05, 20})},
                          R"([["190 mm", 1.0, 1.0], ["195 mm", 1.0, 0.75], ["200 mm", 1.0, 1.0]])"),
           option("depth", entry<&CaseSpec::stretches, &Stretch::depth>,
                  "Depth below the running surface; not given: through the whole body", kLength, above(0, 1))},
          list_of<&CaseSpec::stretches>()};
}

}  // namespace railstrata
