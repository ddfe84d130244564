#include "options/option_slots.hpp"

namespace railstrata {
namespace {

using namespace dimension;
using namespace option_slot;

bool curved(const CaseSpec& spec, std::size_t) { return !spec.collective.curve.bogies.empty(); }
bool has_worn_wheel(const CaseSpec& spec, std::size_t index) {
  return !spec.collective.curve.bogies.at(index).wheel_profile.empty();
}
bool has_own_name(const CaseSpec& spec, std::size_t index) {
  return !spec.collective.curve.bogies.at(index).name.empty();
}

template <auto Member>
Slot bogie(CaseSpec& spec, std::size_t index) {
  return slot_of(spec.collective.curve.bogies.at(index).*Member);
}

Option type_option() {
  Option out = option(
      "type",
      [](CaseSpec& spec, std::size_t index) -> Slot { return ChoiceSlot(spec.collective.curve.bogies.at(index).type); },
      "Kind of vehicle, which supplies the numbers below that are not given");
  for (const BogieType& t : bogie_types()) out.choices.push_back({t.name, static_cast<int>(out.choices.size())});
  return out;
}

}  // namespace

OptionTable curve_table() {
  using C = CurveSpec;
  return {
      "curve",
      "A curve in the track, through which the vehicles of [[bogie]] run: `railstrata collective` finds where their "
      "wheelsets stand and takes the wheels on one rail as its loads",
      {option("radius", at<&CaseSpec::collective, &CollectiveSpec::curve, &C::radius>, "Radius of the track's axis",
              kLength, {50, 1e5})
           .where(curved),
       option("superelevation", at<&CaseSpec::collective, &CollectiveSpec::curve, &C::superelevation>,
              "Height of the outer rail above the inner one, the cant of the track (geometry.cant is the "
              "inclination of the rail)",
              kLength, {0, 0.2})
           .where(curved),
       choice<&C::rail>("rail", at<&CaseSpec::collective, &CollectiveSpec::curve, &C::rail>,
                        "Rail that the collective is of; both: one after the other, in folders outer and inner",
                        {{"outer", CurveRail::outer}, {"inner", CurveRail::inner}, {"both", CurveRail::both}})
           .where(curved)}};
}

OptionTable bogie_table() {
  using B = BogieSpec;
  return {
      "bogie",
      "A bogie of two wheelsets that runs through the [curve] and how much traffic it carries. Its leading and "
      "trailing "
      "wheels are two loads of the collective",
      {type_option(), option("name", bogie<&B::name>, "Name in results; default: the type").where(has_own_name),
       option("mgt", bogie<&B::mgt>, "Traffic on such bogies in million gross tonnes", kNumber, above(0, 1e6)),
       option("speed", bogie<&B::speed>, "Speed; default: drive.speed", kSpeed, above(0, 200)),
       option("axle_load", bogie<&B::axle_load>, "Load of an axle on the track, a force or a mass", kForce,
              above(0, 5e5))
           .or_mass(),
       option("wheelbase", bogie<&B::wheelbase>, "Distance between the axles of the bogie", kLength, {0.5, 10}),
       option("wheelset_mass", bogie<&B::wheelset_mass>, "Mass of a wheelset with its boxes", kMass, {100, 1e4}),
       option("longitudinal_stiffness", bogie<&B::longitudinal>, "Primary suspension of one axle box, along the track",
              kStiffness, {1e4, 1e10}),
       option("lateral_stiffness", bogie<&B::lateral>, "Primary suspension of one axle box, across the track",
              kStiffness, {1e4, 1e10}),
       option("box_distance", bogie<&B::box_distance>, "Distance between the axle boxes of a wheelset", kLength,
              {0.5, 4}),
       option("centre_of_gravity", bogie<&B::centre_of_gravity>,
              "Height of the centre of gravity of all above the axles over the top of rail", kLength, {0.5, 4}),
       option("traction_coefficient", bogie<&B::traction_coefficient>,
              "Longitudinal force of a wheelset over its load; positive drives", kNumber, {-0.5, 0.5}),
       option("wheel_profile", bogie<&B::wheel_profile>,
              "Profile of its wheels, as load.wheel_profile: a folder or a list of measured ones makes a bogie of each")
           .where(has_worn_wheel),
       option("wheel_radius", bogie<&B::wheel_radius>, "Radius of its wheels, as geometry.wheel_radius", kLength,
              {5e-3, 2.0})},
      {[](const CaseSpec& spec) { return spec.collective.curve.bogies.size(); },
       [](CaseSpec& spec, std::size_t n) { spec.collective.curve.bogies.resize(n); }}};
}

}  // namespace railstrata
