#include "options/option_slots.hpp"

namespace railstrata {
namespace {

using namespace dimension;
using namespace option_slot;
using C = CaseSpec;
using T = TransientSpec;

bool transient(const CaseSpec& spec, std::size_t) { return spec.transient.kind != TransientKind::none; }
bool starts(const CaseSpec& spec, std::size_t) {
  return spec.transient.kind == TransientKind::rolling || spec.transient.start != TransientStart::rest;
}
bool shifts(const CaseSpec& spec, std::size_t) {
  return spec.transient.kind == TransientKind::shift || spec.transient.increments != TransientSpec{}.increments;
}

template <auto Member>
Option history_column(std::string_view key, std::string_view doc, const Dimension& dimension, const Range& range) {
  return option(key, at<&C::transient, Member>, doc, dimension, range);
}

std::vector<Option> row_columns() {
  return {history_column<&T::at_distance>("at_distance", "kind = \"rolling\": rolled distance of each row, from 0 on",
                                          kLength, {0, 20}),
          history_column<&T::at_time>(
              "at_time", "Time of each row, from 0 on; with kind = \"rolling\" the wheel rolls at drive.speed", kTime,
              {0, 1e6}),
          history_column<&T::wheel_load>("wheel_load", "Load of the wheel on the rail", kForce, above(0, 1e7)),
          history_column<&T::load_factor>("load_factor", "Wheel load divided by the static load G", kNumber,
                                          above(0, 100))};
}

std::vector<Option> driven_columns() {
  return {
      history_column<&T::traction_coefficient>("traction_coefficient", "F_T over the static load G", kNumber,
                                               {-10, 10}),
      history_column<&T::tractive_force>("tractive_force", "F_T on the wheel; positive drives", kForce, {-1e7, 1e7}),
      history_column<&T::creepage>("creepage", "kind = \"rolling\": longitudinal creepage; negative drives", kNumber,
                                   {-10, 1}),
      history_column<&T::displacement>(
          "displacement",
          "kind = \"shift\": displacement of the wheel against the rail in the rolling direction, from the start",
          kLength, {-0.01, 0.01}),
      history_column<&T::lateral_traction_coefficient>("lateral_traction_coefficient", "F_y over the static load G",
                                                       kNumber, {-10, 10}),
      history_column<&T::lateral_force>("lateral_force", "Friction force F_y on the wheel along the contact plane",
                                        kForce, {-1e7, 1e7}),
      history_column<&T::lateral_creepage>(
          "lateral_creepage", "kind = \"rolling\": lateral creepage along the contact plane", kNumber, {-10, 10}),
      history_column<&T::lateral_displacement>("lateral_displacement",
                                               "kind = \"shift\": displacement of the wheel against the rail towards "
                                               "the field side, along the contact plane",
                                               kLength, {-0.01, 0.01}),
      history_column<&T::spin>("spin", "kind = \"rolling\": spin about the normal of the contact plane", kSpin,
                               {-1000, 1000})};
}

std::vector<Option> course_options() {
  return {choice_at<&C::transient, &T::kind>(
              "kind",
              "none: steady rolling; rolling: rolling from a start in steps of one cell; shift: motion without rolling "
              "(presliding, fretting)",
              {{"none", TransientKind::none}, {"rolling", TransientKind::rolling}, {"shift", TransientKind::shift}})
              .where(transient),
          choice_at<&C::transient, &T::start>("start",
                                              "kind = \"rolling\": start at rest, pressed together and shifted by the "
                                              "first forces, or in steady rolling under the first row",
                                              {{"rest", TransientStart::rest}, {"steady", TransientStart::steady}})
              .where(starts),
          option("distance", at<&C::transient, &T::distance>,
                 "kind = \"rolling\": rolled distance; not given: that of the last row", kLength, above(0, 20)),
          option("increments", at<&C::transient, &T::increments>, "kind = \"shift\": number of steps from row to row",
                 kNumber, {1, 1000})
              .where(shifts),
          option("history_file", at<&C::transient, &T::history_file>,
                 "A CSV file with the columns below, relative to the case file, instead of the lists; the resolved "
                 "case contains its values")
              .where(never)};
}

}  // namespace

OptionTable transient_table() {
  OptionTable out{"transient",
                  "A history of loads and motions, followed step by step; half-space engine",
                  course_options(),
                  {},
                  {{"at_distance", "at_time"},
                   {"wheel_load", "load_factor"},
                   {"traction_coefficient", "tractive_force", "creepage", "displacement"},
                   {"lateral_traction_coefficient", "lateral_force", "lateral_creepage", "lateral_displacement"}}};
  for (const auto& columns : {row_columns(), driven_columns()})
    for (const Option& option : columns) {
      out.rivals.push_back({"history_file", option.key});
      out.options.push_back(option);
    }
  return out;
}

}  // namespace railstrata
