#include "options/option_slots.hpp"
#include "record/unit.hpp"

namespace railstrata {
namespace {

using namespace dimension;
using namespace option_slot;
using C = CaseSpec;
using V = VehicleSpec;
using D = DriveSpec;

double sprung_mass_under(const CaseSpec& spec, std::size_t, double wheel_load) {
  VehicleSpec loaded = spec.vehicle;
  loaded.set_load(wheel_load);
  return loaded.sprung_mass;
}
double sprung_mass_under_axle(const CaseSpec& spec, std::size_t index, double axle_load) {
  return sprung_mass_under(spec, index, 0.5 * axle_load);
}
double over_static_load(const CaseSpec& spec, std::size_t, double force) { return force / spec.vehicle.load(); }
constexpr std::string_view kLessForce = "give less force, or more load",
                           kLessLoad = "give less load, or another vehicle.wheel_mass";

/// Speeds of spindles give the rail's surface speed V and the creepage 1 - omega r / V.
double surface_speed(const CaseSpec& spec, std::size_t, double rotation) {
  return rotation * std::abs(spec.geometry.rail_radius.value_or(0));
}
double creepage_of_rotation(const CaseSpec& spec, std::size_t, double rotation) {
  return 1 - rotation * spec.geometry.wheel_radius / spec.drive.speed;
}

bool traction_given(const CaseSpec& spec, std::size_t) { return spec.drive.traction().has_value(); }
bool load_given(const CaseSpec& spec, std::size_t) { return !spec.vehicle.approach; }

/// Not all of them are in both engines (rules/support.hpp).
std::vector<Option> creepage_options() {
  return {
      option("creepage", at<&C::drive, &D::creepage>,
             "Longitudinal creepage (V - omega r) / V, instead of the traction; negative drives, 1 is a locked wheel",
             kNumber, {-10, 1}),
      option("wheel_rotation", at<&C::drive, &D::creepage>,
             "Rotation of the wheel's spindle, instead of the creepage, which is 1 - rotation * wheel_radius / speed",
             kRotation, {0, 1e5})
          .derived({creepage_of_rotation, "change the rotation, geometry.wheel_radius or the speed"}),
      option("lateral_force", at<&C::drive, &D::lateral_traction_coefficient>,
             "Friction force F_y on the wheel along the contact plane, positive towards the field side", kForce,
             {-1e7, 1e7})
          .derived({over_static_load, kLessForce}),
      option("lateral_traction_coefficient", at<&C::drive, &D::lateral_traction_coefficient>, "The same force over G",
             kNumber, {-1, 1}),
      option("lateral_creepage", at<&C::drive, &D::lateral_creepage>,
             "Lateral creepage along the contact plane, positive where the wheel slips towards the field side; finite "
             "elements: the wheel moves sideways as it rolls",
             kNumber, {-10, 10}),
      choice_at<&C::drive, &D::creepage_of>(
          "creepage_of",
          "Where creepages are measured, here and in a collective. contact: in the plane of the patch; wheel: (V - "
          "omega wheel_radius) / V at the tape circle and the horizontal lateral slip, from which each contact's "
          "creepages follow by its radius and angle. Use \"wheel\" where tread and flange touch: there \"contact\" is "
          "a place between the two",
          {{"contact", CreepageOf::contact}, {"wheel", CreepageOf::wheel}}),
      option("spin", at<&C::drive, &D::spin>,
             "Rotation about the normal of the contact plane, divided by V; positive from the rolling direction "
             "towards the field side; half-space engine",
             kSpin, {-1000, 1000})};
}

bool falls(const CaseSpec& spec, std::size_t) { return spec.friction.law != FrictionForm::coulomb; }

bool named_condition(const CaseSpec& spec, std::size_t) { return !spec.friction.condition.empty(); }

bool remembers(const CaseSpec& spec, std::size_t index) {
  return falls(spec, index) && spec.friction.memory_distance > 0;
}

/// [["-20 mm", 0.2], ["10 mm", 0.4]].
Option table_over(Option place, Option value, std::string_view key, Slot (*slot)(CaseSpec&, std::size_t),
                  std::string_view doc, std::string_view example) {
  return option(key, slot, doc).with_rows(RowForm::by_value, {std::move(place), std::move(value)}, example);
}
Option temperature_column() { return column("temperature", "", kTemperature, {-300, 3000}); }

bool has_temperature(const CaseSpec& spec, std::size_t) {
  return !spec.friction.temperature_table.empty() || !spec.third_body.temperature_table.empty();
}

bool has_film(const CaseSpec& spec, std::size_t) { return spec.third_body.thickness.has_value(); }
bool softens(const CaseSpec& spec, std::size_t) { return spec.third_body.hardening < 0; }

}  // namespace

OptionTable vehicle_table() {
  return {"vehicle",
          "Masses and primary suspension of one wheel",
          {option("wheel_mass", at<&C::vehicle, &V::wheel_mass>, "Mass of the wheel with its share of the axle", kMass,
                  above(0, 1e5)),
           option("sprung_mass", at<&C::vehicle, &V::sprung_mass>,
                  "Mass on the suspension; below 0 the load is less than the weight of "
                  "wheel_mass, which half-spaces alone take",
                  kMass, {-1e5, 1e6})
               .where(load_given),
           option("wheel_load", at<&C::vehicle, &V::sprung_mass>,
                  "Load of the wheel on the rail, a force or a mass, instead of the sprung mass, which is load / "
                  "g - wheel_mass",
                  kForce, above(0, 1e7))
               .derived({sprung_mass_under, kLessLoad})
               .or_mass(),
           option("axle_load", at<&C::vehicle, &V::sprung_mass>,
                  "Load of both wheels on the track, a force or a mass, instead of the sprung mass; each wheel carries "
                  "half",
                  kForce, above(0, 2e7))
               .derived({sprung_mass_under_axle, kLessLoad})
               .or_mass(),
           option("approach", at<&C::vehicle, &V::approach>,
                  "Approach of wheel and rail along the contact normal, instead of a load, which is then a result; "
                  "half-space engine",
                  kLength, above(0, 0.01)),
           option("suspension_stiffness", at<&C::vehicle, &V::suspension_stiffness>, "Vertical, of one wheel",
                  kStiffness, {0, 1e10}),
           option("suspension_damping", at<&C::vehicle, &V::suspension_damping>, "Vertical, of one wheel", kDamping,
                  {0, 1e8}),
           option("couple_sprung_mass", at<&C::vehicle, &V::couple_sprung_mass>,
                  "The sprung mass moves longitudinally with the axle and adds its inertia")},
          {},
          {{"sprung_mass", "wheel_load", "axle_load", "approach"}}};
}

OptionTable drive_table() {
  OptionTable out{
      "drive",
      "Speed, traction and friction",
      {option("speed", at<&C::drive, &D::speed>, "Rolling speed; of a rotating rail the speed of its surface", kSpeed,
              above(0, 200)),
       option("rail_rotation", at<&C::drive, &D::speed>,
              "Rotation of the roller's spindle, instead of the speed, which is rotation * rail_radius", kRotation,
              above(0, 1e5))
           .derived({surface_speed, "give geometry.rail_radius, or another rotation"}),
       option("traction_coefficient", at<&C::drive, &D::traction_coefficient>,
              "Wanted F_T / G; positive drives, negative brakes", kNumber, {-1, 1})
           .where(traction_given),
       option("tractive_force", at<&C::drive, &D::traction_coefficient>, "Wanted F_T, instead of the coefficient",
              kForce, {-1e7, 1e7})
           .derived({over_static_load, kLessForce}),
       option("friction_coefficient", at<&C::drive, &D::friction_coefficient>,
              "Coulomb's coefficient; with falling friction the coefficient at rest", kNumber, {0, 2}),
       option("torque_ramp", at<&C::drive, &D::torque_ramp>, "Smooth rise of the torque at the start", kTime, {0, 1}),
       option("creepage_start", at<&C::drive, &D::creepage_start>,
              "Longitudinal creepage at the start, (V - omega r) / V: negative drives", kNumber, {-0.1, 0.1})},
      {},
      {{"speed", "rail_rotation"},
       {"traction_coefficient", "tractive_force", "creepage", "wheel_rotation"},
       {"lateral_traction_coefficient", "lateral_force", "lateral_creepage"}}};
  append(out.options, creepage_options());
  return out;
}

OptionTable friction_table() {
  using F = FrictionSpec;
  return {
      "friction",
      "How friction depends on slip; at rest it is drive.friction_coefficient",
      {option("condition", at<&C::friction, &F::condition>,
              "Name of a set that supplies drive.friction_coefficient, this table and third_body; keys that are given "
              "override it")
           .where(named_condition),
       choice_at<&C::friction, &F::law>("law",
                                        "Coulomb's constant coefficient, or one that falls with the slip velocity "
                                        "v: by 2^(-v/half_velocity), or by 1/(1 + v/half_velocity)",
                                        {{"coulomb", FrictionForm::coulomb},
                                         {"falling_exponential", FrictionForm::falling_exponential},
                                         {"falling_rational", FrictionForm::falling_rational}}),
       option("kinetic_coefficient", at<&C::friction, &F::kinetic_coefficient>,
              "Falling laws: the coefficient at very fast slip", kNumber, {0, 2})
           .where(falls),
       option("half_velocity", at<&C::friction, &F::half_velocity>,
              "Falling laws: slip velocity at which the coefficient has fallen by half of its range", kSpeed,
              above(0, 100))
           .where(falls),
       option("memory_distance", at<&C::friction, &F::memory_distance>,
              "Falling laws: sliding distance over which the coefficient follows the slip velocity; 0: immediately. "
              "Finite elements need a value, 10 to 50 um",
              kLength, {0, 10 * kMilli})
           .where(falls),
       option("memory_velocity", at<&C::friction, &F::memory_velocity>,
              "With memory_distance: smallest slip velocity that the memory assumes, so that the coefficient recovers "
              "at rest",
              kSpeed, {0, 10})
           .where(remembers),
       table_over(column("y", "", kLength, {-0.2, 0.2}), column("coefficient", "", kNumber, {0, 2}), "lateral_table",
                  at<&C::friction, &F::lateral_table>,
                  "drive.friction_coefficient as a function of lateral position, e.g. gauge corner and top: rows of "
                  "the rail profile's y and the coefficient, linear between rows and constant beyond them",
                  R"([["-25 mm", 0.15], ["-15 mm", 0.4]])"),
       option("lateral_coefficient", at<&C::friction, &F::lateral_coefficient>,
              "Coefficient across the rolling direction, if it differs from drive.friction_coefficient along it; the "
              "traction bound is then an ellipse, and slip is normal to it",
              kNumber, above(0, 2)),
       table_over(temperature_column(), column("factor", "", kNumber, {0, 10}), "temperature_table",
                  at<&C::friction, &F::temperature_table>,
                  "Factor on the coefficient as a function of the contact temperature, which follows from "
                  "rail_temperature, wheel_temperature and the flash temperature: rows of temperature, with any zero "
                  "point, and factor; half-space engine",
                  R"([["20 K", 1], ["400 K", 0.6]])"),
       option("rail_temperature", at<&C::friction, &F::rail_temperature>,
              "Temperature of the rail before the contact, with the same zero point as the temperature tables",
              kTemperature, {-300, 3000})
           .where(has_temperature),
       option("wheel_temperature", at<&C::friction, &F::wheel_temperature>, "The same for the wheel", kTemperature,
              {-300, 3000})
           .where(has_temperature)}};
}

OptionTable third_body_table() {
  using Film = ThirdBodySpec;
  return {
      "third_body",
      "A film of wear debris, sand, … between the surfaces, elastic-plastic in shear; without a thickness there is no "
      "film",
      {option("thickness", at<&C::third_body, &Film::thickness>, "Of the film", kLength, above(0, kMilli)),
       option("shear_modulus", at<&C::third_body, &Film::shear_modulus>, "Of the film", kPressure, above(0, 1e12)),
       option("yield_shear", at<&C::third_body, &Film::yield_shear>,
              "Shear stress at which the film yields; not given: the film stays elastic", kPressure, above(0, 1e11)),
       option("hardening", at<&C::third_body, &Film::hardening>,
              "Increase of yield_shear per plastic shear displacement; below 0 the film softens (half-space engine)",
              kPressureGradient, {-1e15, 1e15})
           .where(has_film),
       option("residual_shear", at<&C::third_body, &Film::residual_shear>,
              "Softening film: yield_shear after large shear", kPressure, above(0, 1e11))
           .where(softens),
       option("yield_by_pressure", at<&C::third_body, &Film::yield_by_pressure>,
              "Increase of yield_shear per unit of local pressure; half-space engine", kNumber, {0, 10})
           .where(has_film),
       option("modulus_by_pressure", at<&C::third_body, &Film::modulus_by_pressure>,
              "Increase of shear_modulus per unit of local pressure; half-space engine", kNumber, {0, 1000})
           .where(has_film),
       table_over(temperature_column(), column("factor", "", kNumber, above(0, 10)), "temperature_table",
                  at<&C::third_body, &Film::temperature_table>,
                  "Factor on shear_modulus and yield_shear as a function of contact temperature, as in "
                  "friction.temperature_table",
                  R"([["20 K", 1], ["400 K", 0.6]])")
           .where(has_film)}};
}

}  // namespace railstrata
