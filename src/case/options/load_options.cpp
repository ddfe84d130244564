#include "options/option_slots.hpp"
#include "record/unit.hpp"

namespace railstrata {
namespace {

using namespace dimension;
using namespace option_slot;

template <auto Member>
constexpr auto load = entry<&CaseSpec::loads, Member>;

bool has_loads(const CaseSpec& spec, std::size_t) { return !spec.loads.empty(); }
bool has_wheel(const CaseSpec& spec, std::size_t index) { return !spec.loads.at(index).wheel_profile.empty(); }
bool has_name(const CaseSpec& spec, std::size_t index) { return !spec.loads.at(index).name.empty(); }

/// Each axle has this wheel and another like it, N = MGT / (2 wheel loads), or its weight is given.
double passages_of(const CaseSpec& spec, std::size_t index, double million_tonnes) {
  const LoadSpec& load = spec.loads.at(index);
  return 1e6 * million_tonnes / load.tonnes(load.wheel_load.value_or(spec.vehicle.load()));
}

bool has_life(const CaseSpec& spec, std::size_t i) { return has_loads(spec, i) || spec.life.until > 0; }
bool grinds(const CaseSpec& spec, std::size_t) { return spec.life.grinding.every.has_value(); }

/// A coefficient of variation that leaves a number above zero two deviations lower.
Option scatter(std::string_view key, Slot (*slot)(CaseSpec&, std::size_t), std::string_view doc) {
  return option(key, slot, doc, kNumber, {0, 0.45}).where(has_loads);
}

double half(const CaseSpec&, std::size_t, double axle_load) { return 0.5 * axle_load; }

std::vector<Option> force_options() {
  return {option("traction_coefficient", load<&LoadSpec::traction_coefficient>,
                 "Wanted F_T / G; positive drives. A wheel whose row and [drive] give no traction, creepage or force "
                 "rolls free",
                 kNumber, {-1, 1}),
          option("creepage", load<&LoadSpec::creepage>,
                 "Longitudinal creepage, instead of the traction; negative drives. Measured at the contact or the "
                 "wheel: see drive.creepage_of",
                 kNumber, {-10, 1}),
          option("lateral_traction_coefficient", load<&LoadSpec::lateral_traction_coefficient>,
                 "Friction force F_y on the wheel along the contact plane, over G", kNumber, {-1, 1}),
          option("lateral_creepage", load<&LoadSpec::lateral_creepage>,
                 "Lateral creepage, instead of the lateral force; if neither is given, it follows from the yaw",
                 kNumber, {-10, 10}),
          option("friction_coefficient", load<&LoadSpec::friction_coefficient>, "Friction coefficient at rest", kNumber,
                 {0, 2})};
}

}  // namespace

OptionTable load_table() {
  OptionTable out{
      "load",
      "A row of a load collective for `railstrata collective`: one wheel and how often it passes. Keys that a row does "
      "not give take the case's values, with the same signs and meanings",
      {option("name", load<&LoadSpec::name>, "Name of the row in results; default \"load 1\", \"load 2\", …")
           .where(has_name),
       option("passages", load<&LoadSpec::passages>, "Number of passages of such a wheel", kNumber, above(0, 1e12)),
       option("wheel_load", load<&LoadSpec::wheel_load>, "Load of the wheel on the rail, a force or a mass", kForce,
              above(0, 1e7))
           .or_mass(),
       option("axle_load", load<&LoadSpec::wheel_load>,
              "Load of both wheels on the track, a force or a mass; this wheel carries half", kForce, above(0, 2e7))
           .derived({half, "choose a load in this range"})
           .or_mass(),
       option("axle_weight", load<&LoadSpec::axle_weight>,
              "Weight of the axle, a force or a mass, for gross tonnes where a curve loads its wheels differently; not "
              "given: twice the wheel's load",
              kForce, above(0, 2e7))
           .or_mass(),
       option("mgt", load<&LoadSpec::passages>,
              "Traffic in million gross tonnes of such axles, instead of passages. Each axle has two wheels of the "
              "row's load, one of them on this rail: passages = mgt / (2 wheel_load), or over axle_weight",
              kNumber, above(0, 1e6))
           .derived({passages_of, "choose a smaller value, or give passages instead"}),
       option("wheel_profile", load<&LoadSpec::wheel_profile>,
              "Profile of this wheel, as geometry.wheel_profile. A folder of measured profiles, or a CSV list with the "
              "columns file and share [%], makes one row of each, with its share of the passages; equal shares without "
              "a list")
           .where(has_wheel),
       option("wheel_radius", load<&LoadSpec::wheel_radius>, "Radius of this wheel, as geometry.wheel_radius", kLength,
              {5 * kMilli, 2.0}),
       option("lateral_shift", load<&LoadSpec::lateral_shift>, "Lateral shift of the wheel, positive to the field side",
              kLength, {-0.05, 0.05}),
       option("yaw", load<&LoadSpec::yaw>, "Angle of attack, a tangent", kSlope, {-0.05, 0.05}),
       option("roll", load<&LoadSpec::roll>,
              "Roll of the wheelset, as in geometry.roll; a few tenths of a mrad move load between tread and flange",
              kSlope, {-0.05, 0.05}),
       option("curve_radius", load<&LoadSpec::curve_radius>,
              "Curve radius of the track, positive with the centre on the field side", kLength, {-1e6, 1e6}),
       option("speed", load<&LoadSpec::speed>, "Rolling speed", kSpeed, above(0, 200)),
       option("guiding_force", load<&LoadSpec::guiding_force>,
              "Guiding force Y of the vehicle code, from the wheel on the rail, positive to the field side; compared "
              "with the result, not used as input",
              kForce, {-1e6, 1e6}),
       option("t_gamma", load<&LoadSpec::t_gamma>,
              "T-gamma of the vehicle code, without spin; compared with the result, not used as input", kForce,
              {-1e6, 1e6}),
       option("friction_energy", load<&LoadSpec::friction_energy>,
              "Friction power of the vehicle code divided by the speed, with spin; compared with the result, not used "
              "as input",
              kForce, {-1e6, 1e6})},
      list_of<&CaseSpec::loads>(),
      {{"wheel_load", "axle_load"},
       {"passages", "mgt"},
       {"traction_coefficient", "creepage"},
       {"lateral_traction_coefficient", "lateral_creepage"}}};
  append(out.options, force_options());
  return out;
}

OptionTable collective_table() {
  using C = CollectiveSpec;
  const Option file =
      option("file", at<&CaseSpec::collective, &C::file>,
             "A CSV file with the rows, instead of [[load]]; its columns are the keys of [[load]] with units")
          .where(never);
  const Option law =
      choice_at<&CaseSpec::collective, &C::wear_law>(
          "wear_law",
          "Wear law of `railstrata collective --steps`. usfd: University of Sheffield, from T-gamma; kth: "
          "Archard with Jendel's map; archard: Archard with the rail's wear_coefficient",
          {{"usfd", WearLaw::usfd}, {"kth", WearLaw::kth}, {"archard", WearLaw::archard}})
          .where(has_loads);
  const Option deviation =
      option("lateral_deviation", at<&CaseSpec::collective, &C::lateral_deviation>,
             "Standard deviation of the lateral positions of a row's wheels: wear, rolling contact fatigue and damage "
             "are spread by a normal distribution, cut at three deviations; 2 to 6 mm on straight track",
             kLength, {0, 0.03})
          .where(has_life);
  const Option factor = option("wear_factor", at<&CaseSpec::collective, &C::wear_factor>,
                               "Factor on the wear of rail and wheel. The wear laws describe dry laboratory surfaces; "
                               "calibrate the factor with a measured depth. A lubricated or wet rail has 0.2 or less",
                               kNumber, above(0, 1000))
                            .where(has_life);
  const Option bins =
      option("bin_scale", at<&CaseSpec::collective, &C::bin_scale>,
             "Factor on the bin widths used to sort a series of samples; 0.5 halves them", kNumber, {0.02, 50})
          .where(never);
  const Option match =
      option("match_guiding_force", at<&CaseSpec::collective, &C::match_guiding_force>,
             "Moves the shift of each row with a guiding_force, by at most 0.2 mm, until its wheel has that force: "
             "with contact on tread and flange, some µm of shift move the load between them")
          .where(has_loads);
  return {"collective", "Settings for all rows of [[load]]", {file, law, factor, deviation, bins, match}};
}

OptionTable life_table() {
  return {
      "life",
      "Settings for lives of rail and wheel; they also need strengths",
      {option(
           "until", at<&CaseSpec::life, &LifeSpec::until>,
           "Gross traffic through which the rail is followed, a mass: \"50 Mt\" are 50 million tonnes. Wear and "
           "grinding change the profile, plastic strain adds up in the metal; from it come the lives of zones that "
           "yield. 0: the rail is not followed. `railstrata collective --until` sets it. Without [[load]] every wheel "
           "is that of the case",
           kMass, {0, 1e13}),
       option("first_cracks", at<&CaseSpec::life, &LifeSpec::first_cracks>,
              "Gross traffic after which this rail had its first cracks, at most until: the answer then names the "
              "passes.ductility that gives this",
              kMass, above(0, 1e13)),
       option("strength_scatter", at<&CaseSpec::life, &LifeSpec::strength_scatter>,
              "Coefficient of variation of the strengths of rail, wheel and layers. The range of a life by fatigue or "
              "by a first wheel covers strengths two deviations lower and higher. Not given: 0; with `collective "
              "--range` 0.035, the hardness that EN 13674-1 allows R260",
              kNumber, {0, 0.2})
           .where(has_life),
       scatter("ductility_scatter", at<&CaseSpec::life, &LifeSpec::ductility_scatter>,
               "Coefficient of variation of passes.ductility for `collective --range`, which computes two deviations "
               "lower and higher. 0: as known. The default is an estimate"),
       scatter("friction_scatter", at<&CaseSpec::life, &LifeSpec::friction_scatter>,
               "The same of all friction coefficients together: the default takes 0.35 from 0.245 to 0.455, an "
               "estimate for a dry curve"),
       scatter("wear_scatter", at<&CaseSpec::life, &LifeSpec::wear_scatter>,
               "The same of collective.wear_factor. The default is an estimate for a factor measured on the line"),
       option("place_scatter", at<&CaseSpec::life, &LifeSpec::place_scatter>,
              "Standard deviation of what is not known of the lateral shift of all wheels together, for `collective "
              "--range`; the wheels' scatter about it is collective.lateral_deviation. The default is an estimate",
              kLength, {0, 0.01})
           .where(has_loads)}};
}

OptionTable grinding_table() {
  using G = GrindingSpec;
  return {"grinding",
          "Grinding of the rail, for the life prediction of `railstrata collective`",
          {option("every", at<&CaseSpec::life, &LifeSpec::grinding, &G::every>,
                  "Gross traffic between grindings, a mass: \"15 Mt\" are 15 million tonnes", kMass, {1e6, 1e13}),
           option("depth", at<&CaseSpec::life, &LifeSpec::grinding, &G::depth>,
                  "Depth removed by each grinding, everywhere", kLength, {0, 0.01})
               .where(grinds)}};
}

}  // namespace railstrata
