#include "case/option_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "case/load_options.hpp"
#include "case/option_slots.hpp"
#include "case/strength_options.hpp"
#include "core/si_prefix.hpp"

namespace railstrata {
namespace {

using namespace dimension;
using namespace option_slot;
using C = CaseSpec;
using G = GeometrySpec;
using M = MaterialSpec;
using L = LayerSpec;
using V = VehicleSpec;
using D = DriveSpec;
using H = MeshSpec;
using R = RunSpec;
using T = TransientSpec;
using O = OutputSpec;

double of_matrix_modulus(const CaseSpec& spec, std::size_t index, double ratio) {
  return ratio * (spec.layers.at(index).on == BodyId::wheel ? spec.wheel_material : spec.rail_material).young;
}

/// A load is given by the sprung mass that makes it.
double sprung_mass_under(const CaseSpec& spec, std::size_t, double wheel_load) {
  return wheel_load / spec.vehicle.gravity - spec.vehicle.wheel_mass;
}
double sprung_mass_under_axle(const CaseSpec& spec, std::size_t index, double axle_load) {
  return sprung_mass_under(spec, index, 0.5 * axle_load);
}
double over_static_load(const CaseSpec& spec, std::size_t, double force) {
  return force / ((spec.vehicle.wheel_mass + spec.vehicle.sprung_mass) * spec.vehicle.gravity);
}
constexpr std::string_view kMoreLoad = "give more load, or less vehicle.wheel_mass",
                           kLessForce = "give less force, or more load";

bool traction_given(const CaseSpec& spec, std::size_t) { return spec.drive.traction().has_value(); }

bool load_given(const CaseSpec& spec, std::size_t) { return !spec.vehicle.approach; }
bool transient(const CaseSpec& spec, std::size_t) { return spec.transient.kind != TransientKind::none; }
bool starts(const CaseSpec& spec, std::size_t) {
  return spec.transient.kind == TransientKind::rolling || spec.transient.start != TransientStart::rest;
}
bool shifts(const CaseSpec& spec, std::size_t) {
  return spec.transient.kind == TransientKind::shift || spec.transient.increments != TransientSpec{}.increments;
}

bool uniform(const CaseSpec& spec, std::size_t index) { return !spec.layers.at(index).graded(); }
bool graded(const CaseSpec& spec, std::size_t index) { return spec.layers.at(index).graded(); }

std::vector<Option> shape_options() {
  return {
      {"rail_profile", at<&C::geometry, &G::rail_profile>,
       "A built-in name (see `railstrata info`), an arc, or a file (two columns, Simpack, MiniProf), relative to the "
       "case file"},
      {"wheel_profile", at<&C::geometry, &G::wheel_profile>,
       "A built-in name, an arc, or a file (two columns, Simpack, MiniProf), relative to the case file"},
      choice_at<&C::geometry, &G::rail_shape>("rail_shape",
                                              "Whole rail section, or a block with the profile on top (verification)",
                                              {{"rail", RailShape::rail}, {"block", RailShape::block}}),
      choice_at<&C::geometry, &G::wheel_shape>("wheel_shape", "Rim, web and hub, or a plain disc (verification)",
                                               {{"wheel", WheelShape::wheel}, {"disc", WheelShape::disc}}),
      choice_at<&C::geometry, &G::contact>("contact",
                                           "A patch, closed all round; or a line: a cylinder on a plane in plane "
                                           "strain (both profiles \"flat\", half-space engine)",
                                           {{"point", ContactShape::point}, {"line", ContactShape::line}}),
      {"line_length",
       at<&C::geometry, &G::line_length>,
       "contact = \"line\": length that bears the load evenly",
       kLength,
       {0.1 * kMilli, 10.0}}};
}

std::vector<Option> track_options() {
  return {
      {"gauge", at<&C::geometry, &G::gauge>, "Track gauge between the gauge faces", kLength, {0.5, 2.0}},
      {"gauge_depth",
       at<&C::geometry, &G::gauge_depth>,
       "Depth below the top of the rail at which the gauge is measured",
       kLength,
       {1 * kMilli, 50 * kMilli}},
      {"back_to_back",
       at<&C::geometry, &G::back_to_back>,
       "Distance between the inner faces of the two wheels",
       kLength,
       {0.4, 2.0}},
      {"flange_back_to_tape",
       at<&C::geometry, &G::flange_back_to_tape>,
       "Distance from the flange back to the tape circle",
       kLength,
       {10 * kMilli, 200 * kMilli}},
      {"cant",
       at<&C::geometry, &G::cant>,
       "Inclination of the rail towards the track centre (a tangent)",
       kSlope,
       {-0.2, 0.2}},
      {"lateral_shift",
       at<&C::geometry, &G::lateral_shift>,
       "Of the wheel, positive to the field side",
       kLength,
       {-0.05, 0.05}},
      {"yaw",
       at<&C::geometry, &G::yaw>,
       "Angle of attack: the wheel's rolling direction, turned about the vertical through the middle of its tape "
       "circle, positive towards the field side",
       kSlope,
       {-0.05, 0.05}},
      {"roll",
       at<&C::geometry, &G::roll>,
       "Of the wheelset, about the rolling direction through the middle of the tape circle's tread, positive with the "
       "field side up (a tangent); half-space engine",
       kSlope,
       {-0.1, 0.1}},
      {"curve_radius",
       at<&C::geometry, &G::curve_radius>,
       "Of the track, positive with the centre on the field side (the inner wheel); none: straight. Adds to the spin "
       "alone; half-space engine",
       kLength,
       {-1e6, 1e6}},
      {"wheel_radius", at<&C::geometry, &G::wheel_radius>, "At the tape circle", kLength, {0.05, 2.0}}};
}

std::vector<Option> body_options() {
  return {{"block_width",
           at<&C::geometry, &G::block_width>,
           "rail_shape = \"block\": width of the block",
           kLength,
           {kMilli, 2.0}},
          {"block_height",
           at<&C::geometry, &G::block_height>,
           "rail_shape = \"block\": height of the block",
           kLength,
           {kMilli, 2.0}},
          {"rim_thickness",
           at<&C::geometry, &G::rim_thickness>,
           "From the tape circle to the inner face of the rim",
           kLength,
           {5 * kMilli, 0.5}},
          {"web_thickness", at<&C::geometry, &G::web_thickness>, "Of the wheel's plate", kLength, {5 * kMilli, 0.2}},
          {"web_offset",
           at<&C::geometry, &G::web_offset>,
           "Lateral position of the plate's middle from the tape circle",
           kLength,
           {-0.07, 0.07}},
          {"hub_radius", at<&C::geometry, &G::hub_radius>, "Outer radius of the hub", kLength, {0.01, 1.0}},
          {"hub_width", at<&C::geometry, &G::hub_width>, "Lateral width of the hub", kLength, {0.01, 0.5}},
          {"bore_radius", at<&C::geometry, &G::bore_radius>, "Radius of the axle seat", kLength, {0.005, 1.0}}};
}

OptionTable geometry_table() {
  OptionTable out{"geometry", "Profiles, track and wheel", shape_options()};
  for (const auto& further : {track_options(), body_options()})
    out.options.insert(out.options.end(), further.begin(), further.end());
  return out;
}

// Thickness, Poisson's ratio and the ratio of moduli: what tests/bem/layer_range_test.cpp and
// tests/halfspace/layered_test.cpp hold against closed forms. The modulus leaves room for every ratio of steel's.
const Range kYoung{1e9, 1e14}, kPoisson{0.0, 0.499}, kYoungRatio{0.01, 100}, kDensityRange{100, 30000},
    kLayerThickness{0.01 * kMilli, 50 * kMilli};
constexpr std::string_view kBeyondPoisson = "0.5 is incompressible: take 0.499 for it",
                           kBeyondRatio = "the engines are verified in this range: take its end nearest to your layer",
                           kBeyondThickness =
                               "leave a thinner layer out; give a thicker one's modulus to the body that carries it";

template <auto Member>
OptionTable material_table(std::string_view name, std::string_view doc, StrengthPlace place) {
  OptionTable out{
      name,
      doc,
      {{"young", at<Member, &M::young>, "Young's modulus", kPressure, kYoung},
       {"poisson", at<Member, &M::poisson>, "Poisson's ratio", kNumber, kPoisson, {}, {}, nullptr, kBeyondPoisson},
       {"density", at<Member, &M::density>, "Mass density", kDensity, kDensityRange}},
      {},
      strength_rivals()};
  for (const Option& option : strength_options(place)) out.options.push_back(option);
  return out;
}

std::vector<Option> layer_modulus_options() {
  return {{"young", layer<&L::material, &M::young>, "Young's modulus", kPressure, kYoung, {}, {}, uniform},
          {"young_ratio",
           layer<&L::material, &M::young>,
           "Young's modulus as a multiple of the carrying body's",
           kNumber,
           kYoungRatio,
           {},
           {of_matrix_modulus, "choose a multiple in this range"},
           nullptr,
           kBeyondRatio},
          {"young_table",
           layer<&L::young_table>,
           "A modulus that varies with depth: depths below the layer's top and moduli, linear between",
           {},
           {},
           {},
           {},
           graded,
           {},
           {depth_column("the layer's top", kLayerThickness.max),
            {"modulus", nullptr, "Young's modulus", kPressure, kYoung}},
           R"([["0 mm", "420 GPa"], ["3 mm", "210 GPa"]])"},
          {"grading_tolerance",
           layer<&L::grading_tolerance>,
           "young_table, half-space engine: largest relative change of the modulus within a sub-layer",
           kNumber,
           {1e-3, 1.0}}};
}

OptionTable layer_table() {
  OptionTable out{
      "layer",
      "A bonded layer; the first of a body is its surface, the next lies below it. Each needs one of young, "
      "young_ratio and young_table",
      {{"name", layer<&L::name>,
        "What results call the layer; several of a body without one are \"layer 1\", \"layer 2\", … from the "
        "surface down"},
       choice<&L::on>("on", layer<&L::on>, "The body that carries the layer",
                      {{body_word(BodyId::rail), BodyId::rail}, {body_word(BodyId::wheel), BodyId::wheel}}),
       {"thickness",
        layer<&L::thickness>,
        "Along the normal of the surface; a young_table tells it itself",
        kLength,
        kLayerThickness,
        {},
        {},
        uniform,
        kBeyondThickness},
       {"width", layer<&L::width>, "Lateral extent, centred on the body's profile origin", kLength, {kMilli, 0.2}},
       {"poisson",
        layer<&L::material, &M::poisson>,
        "Poisson's ratio",
        kNumber,
        kPoisson,
        {},
        {},
        nullptr,
        kBeyondPoisson},
       {"density", layer<&L::material, &M::density>, "Mass density", kDensity, kDensityRange},
       {"elements",
        layer<&L::elements>,
        "Through the thickness; 0 chooses (height at most 1 mm, at least 2, at least 3 from 3 mm on). Of a "
        "young_table each row of elements has the mean modulus over its height",
        kNumber,
        {0, 50}}},
      list_of<&C::layers>(),
      strength_rivals()};
  const std::vector<Option> modulus = layer_modulus_options();
  const auto poisson =
      std::find_if(out.options.begin(), out.options.end(), [](const Option& o) { return o.key == "poisson"; });
  out.options.insert(poisson, modulus.begin(), modulus.end());
  for (const Option& option : strength_options(StrengthPlace::layer)) out.options.push_back(option);
  return out;
}

OptionTable vehicle_table() {
  return {
      "vehicle",
      "Masses and primary suspension of one wheel",
      {{"wheel_mass", at<&C::vehicle, &V::wheel_mass>, "Mass of the wheel with its share of the axle", kMass,
        above(0, 1e5)},
       {"sprung_mass", at<&C::vehicle, &V::sprung_mass>, "Mass on the suspension", kMass, {0, 1e6}, {}, {}, load_given},
       {"wheel_load",
        at<&C::vehicle, &V::sprung_mass>,
        "Load of the wheel on the rail, a force or a mass, instead of the sprung mass: that is load / gravity - "
        "wheel_mass; at least the wheel's own weight",
        kForce,
        above(0, 1e7),
        {},
        {sprung_mass_under, kMoreLoad, true}},
       {"axle_load",
        at<&C::vehicle, &V::sprung_mass>,
        "Load of both wheels on the track, a force or a mass, instead of the sprung mass; each wheel carries half, at "
        "least its own weight",
        kForce,
        above(0, 2e7),
        {},
        {sprung_mass_under_axle, kMoreLoad, true}},
       {"approach", at<&C::vehicle, &V::approach>,
        "By how much wheel and rail come together along the contact normal, instead of a load, which is then a result; "
        "half-space engine",
        kLength, above(0, 0.01)},
       {"suspension_stiffness",
        at<&C::vehicle, &V::suspension_stiffness>,
        "Of all groups together",
        kStiffness,
        {0, 1e10}},
       {"suspension_damping", at<&C::vehicle, &V::suspension_damping>, "Of all groups together", kDamping, {0, 1e8}},
       {"suspension_groups",
        at<&C::vehicle, &V::suspension_groups>,
        "Spring and dashpot groups around the axle",
        kNumber,
        {1, 64}},
       {"gravity", at<&C::vehicle, &V::gravity>, "Acceleration of gravity", kAcceleration, above(0, 100)},
       {"couple_sprung_mass", at<&C::vehicle, &V::couple_sprung_mass>,
        "The sprung mass rides along with the axle lengthwise and adds its inertia to it"}},
      {},
      {{"sprung_mass", "wheel_load", "axle_load", "approach"}}};
}

/// Not all of them are in both engines (case/engine_scope.hpp).
std::vector<Option> creepage_options() {
  return {{"creepage",
           at<&C::drive, &D::creepage>,
           "Longitudinal creepage (V - omega r) / V, instead of the traction; negative drives, 1 is a locked wheel",
           kNumber,
           {-10, 1}},
          {"lateral_force",
           at<&C::drive, &D::lateral_traction_coefficient>,
           "Friction force F_y on the wheel along the contact plane; positive towards the field side",
           kForce,
           {-1e7, 1e7},
           {},
           {over_static_load, kLessForce}},
          {"lateral_traction_coefficient",
           at<&C::drive, &D::lateral_traction_coefficient>,
           "The same force over G",
           kNumber,
           {-1, 1}},
          {"lateral_creepage",
           at<&C::drive, &D::lateral_creepage>,
           "Along the contact plane, positive where the wheel slips towards the field side; finite elements: the wheel "
           "moves "
           "sideways on its way",
           kNumber,
           {-10, 10}},
          {"spin",
           at<&C::drive, &D::spin>,
           "About the normal of the contact plane, over V, positive from the rolling direction towards the field side; "
           "half-space engine",
           kSpin,
           {-1000, 1000}}};
}

OptionTable drive_table() {
  OptionTable out{
      "drive",
      "Speed, traction and friction",
      {{"speed", at<&C::drive, &D::speed>, "Rolling speed", kSpeed, above(0, 200)},
       {"traction_coefficient",
        at<&C::drive, &D::traction_coefficient>,
        "Wanted F_T / G; positive drives, negative brakes",
        kNumber,
        {-1, 1},
        {},
        {},
        traction_given},
       {"tractive_force",
        at<&C::drive, &D::traction_coefficient>,
        "Wanted F_T, instead of the coefficient",
        kForce,
        {-1e7, 1e7},
        {},
        {over_static_load, kLessForce}},
       {"friction_coefficient",
        at<&C::drive, &D::friction_coefficient>,
        "Coulomb's coefficient; of friction that falls with slip the one at rest",
        kNumber,
        {0, 2}},
       {"torque_ramp", at<&C::drive, &D::torque_ramp>, "Smooth rise of the torque at the start", kTime, {0, 1}},
       {"creepage_start",
        at<&C::drive, &D::creepage_start>,
        "Longitudinal creepage at the start, (V - omega r) / V: negative drives",
        kNumber,
        {-0.1, 0.1}}},
      {},
      {{"traction_coefficient", "tractive_force", "creepage"},
       {"lateral_traction_coefficient", "lateral_force", "lateral_creepage"}}};
  for (const Option& option : creepage_options()) out.options.push_back(option);
  return out;
}

bool falls(const CaseSpec& spec, std::size_t) { return spec.friction.law != FrictionForm::coulomb; }

bool remembers(const CaseSpec& spec, std::size_t index) {
  return falls(spec, index) && spec.friction.memory_distance > 0;
}

OptionTable friction_table() {
  using F = FrictionSpec;
  return {"friction",
          "How friction depends on slip; at rest it is drive.friction_coefficient",
          {choice_at<&C::friction, &F::law>("law",
                                            "Coulomb's constant coefficient, or one that falls with the slip velocity "
                                            "v: by 2^(-v/half_velocity), or by 1/(1 + v/half_velocity)",
                                            {{"coulomb", FrictionForm::coulomb},
                                             {"falling_exponential", FrictionForm::falling_exponential},
                                             {"falling_rational", FrictionForm::falling_rational}}),
           {"kinetic_coefficient",
            at<&C::friction, &F::kinetic_coefficient>,
            "Falling laws: the coefficient's limit for fast slip",
            kNumber,
            {0, 2},
            {},
            {},
            falls},
           {"half_velocity",
            at<&C::friction, &F::half_velocity>,
            "Falling laws: slip velocity at which half of the fall is done",
            kSpeed,
            above(0, 100),
            {},
            {},
            falls},
           {"memory_distance",
            at<&C::friction, &F::memory_distance>,
            "Falling laws: sliding distance over which the coefficient follows the slip velocity; 0: at once. Finite "
            "elements need one, 10 to 50 um",
            kLength,
            {0, 10 * kMilli},
            {},
            {},
            falls},
           {"memory_velocity",
            at<&C::friction, &F::memory_velocity>,
            "With memory_distance: the coefficient follows as if slip were at least as fast, so that it comes back at "
            "rest",
            kSpeed,
            {0, 10},
            {},
            {},
            remembers}}};
}

bool has_film(const CaseSpec& spec, std::size_t) { return spec.third_body.thickness.has_value(); }

OptionTable third_body_table() {
  using Film = ThirdBodySpec;
  return {"third_body",
          "A layer of wear debris, sand, … between the surfaces, an elastic-plastic film in shear; none without a "
          "thickness",
          {{"thickness", at<&C::third_body, &Film::thickness>, "Of the film", kLength, above(0, kMilli)},
           {"shear_modulus", at<&C::third_body, &Film::shear_modulus>, "Of the film", kPressure, above(0, 1e12)},
           {"yield_shear", at<&C::third_body, &Film::yield_shear>,
            "Shear stress at which the film yields; none: it is elastic", kPressure, above(0, 1e11)},
           {"hardening",
            at<&C::third_body, &Film::hardening>,
            "Rise of yield_shear by plastic shear displacement",
            kPressureGradient,
            {0, 1e15},
            {},
            {},
            has_film,
            "a film that softens shears in one place and has no steady state: take 0"}}};
}

OptionTable mesh_table() {
  return {"mesh",
          "Element sizes",
          {{"element_size",
            at<&C::mesh, &H::element_size>,
            "Edge length at the running surfaces and in the studied subsurface",
            kLength,
            {0.05 * kMilli, 20 * kMilli}},
           {"fine_width",
            at<&C::mesh, &H::fine_width>,
            "Lateral width of the fine cap, centred on the contact point",
            kLength,
            {kMilli, 0.1}},
           {"fine_depth", at<&C::mesh, &H::fine_depth>, "Depth of the fine cap", kLength, {0.5 * kMilli, 0.05}},
           {"largest", at<&C::mesh, &H::largest>, "Largest edge far from the contact", kLength, {kMilli, 0.2}},
           {"coarse_ratio",
            at<&C::mesh, &H::coarse_ratio>,
            "Spacing along the path outside the cap, in element sizes",
            kNumber,
            {1, 20}},
           choice_at<&C::mesh, &H::element>(
               "element", "Fully integrated without locking, or one point with hourglass stiffness",
               {{"full", ElementFormulation::full}, {"one_point", ElementFormulation::one_point}}),
           {"hourglass_coefficient",
            at<&C::mesh, &H::hourglass_coefficient>,
            "element = \"one_point\": scale of the hourglass stiffness",
            kNumber,
            {0, 1}},
           {"end_length", at<&C::mesh, &H::end_length>, "Rail beyond both ends of the fine range", kLength, {1e-3, 5}},
           {"elements_through_layer_one", at<&C::mesh, &H::elements_through_layer_one>,
            "One element through every layer, as coarse published meshes have; `elements` of the layers is not used"}}};
}

OptionTable contact_table() {
  return {
      "contact",
      "Enforcement of the contact",
      {choice_at<&C::contact, &ContactSpec::method>(
           "method", "No penetration at the end of each step, or penalty springs",
           {{"mortar", ContactMethod::mortar}, {"penalty", ContactMethod::penalty}}),
       {"penalty_scale", at<&C::contact, &ContactSpec::penalty_scale>,
        "method = \"penalty\": stiffness in units of K A / V of the rail's surface elements", kNumber, above(0, 100)}}};
}

OptionTable run_table() {
  return {
      "run",
      "Path, damping and steps",
      {{"positions",
        at<&C::run, &R::positions>,
        "Wheel positions at which results are wanted, increasing",
        kLength,
        {0, 20}},
       {"window",
        at<&C::run, &R::window>,
        "Rolling distance, centred on each position, over which results are averaged",
        kLength,
        {0, 1}},
       {"run_up",
        at<&C::run, &R::run_up>,
        "Rolling distance over which the run-up damping fades to zero",
        kLength,
        {0, 10}},
       {"run_up_damping",
        at<&C::run, &R::run_up_damping>,
        "Mass-proportional damping of vibration at the start",
        kRate,
        {0, 1e6}},
       {"step_safety", at<&C::run, &R::step_safety>, "Time step as a share of the stable one", kNumber, above(0, 1)},
       choice_at<&C::run, &R::time_step_method>(
           "time_step_method",
           "Thin layers: selective mass scaling, the short step of the real masses, or inner steps for the thin rows "
           "alone; auto scales where the step grows by more than a fifth",
           {{"auto", TimeStepMethod::automatic},
            {"uniform", TimeStepMethod::uniform},
            {"mass_scaling", TimeStepMethod::mass_scaling},
            {"local", TimeStepMethod::local}}),
       {"mass_scaling_step", at<&C::run, &R::mass_scaling_step>,
        "Mass scaling: step it aims at, in element sizes over the matrix's pressure wave speed", kNumber, above(0, 10)},
       choice_at<&C::run, &R::precision>(
           "precision", "Element arithmetic while rolling; nodal values and the static preload are always double",
           {{"double", ArithmeticPrecision::double_precision}, {"single", ArithmeticPrecision::single_precision}}),
       choice_at<&C::run, &R::device>(
           "device", "Where steps of finite elements are computed (docs/gpu.md); emulated is for tests",
           {{"cpu", ComputeDevice::cpu}, {"gpu", ComputeDevice::gpu}, {"emulated", ComputeDevice::emulated}}),
       {"preload_tolerance",
        at<&C::run, &R::preload_tolerance>,
        "Relative residual of the static equilibrium",
        kNumber,
        {1e-13, 0.1}},
       {"history_interval", at<&C::run, &R::history_interval>, "Rolling distance between rows of history.csv", kLength,
        above(0, 1)},
       {"rolling", at<&C::run, &R::rolling>, "false stops after the static preload"},
       {"plasticity", at<&C::run, &R::plasticity>,
        "Finite elements: materials that say a strength or a hardening yield; the half-space engine stays elastic"},
       {"plastic_depth", at<&C::run, &R::plastic_depth>,
        "Depth of a box under the path whose elements follow the law of yielding from the start; without a box those "
        "that come near yielding do, as they do outside of one",
        kLength, above(0, 1)},
       {"plastic_width", at<&C::run, &R::plastic_width>,
        "Its reach to either side of the contact point; of a box that is given by one of the two, the depth is 2.5 "
        "times Hertz's larger half-axis, the reach 1.6 times his half-width and two elements",
        kLength, above(0, 1)}}};
}

OptionTable bem_table() {
  return {
      "bem",
      "The half-space engine",
      {choice_at<&C::bem, &BemSpec::leading_edge>(
           "leading_edge",
           "Where rows of cells meet the leading edge of the patch: inside a cell, as the gap tells, or between two "
           "cells, as Kalker's method and CONTACT have it",
           {{"sub_cell", LeadingEdge::sub_cell}, {"whole_cell", LeadingEdge::whole_cell}}),
       choice_at<&C::bem, &BemSpec::spin_angle>(
           "spin_angle",
           "The angle that the lateral slip of spin is taken with: the surfaces' own at each place of the patch, "
           "or that of the contact plane",
           {{"local", SpinAngle::local}, {"patch", SpinAngle::patch}})}};
}

template <auto Member>
Option column(std::string_view key, std::string_view doc, const Dimension& dimension, const Range& range) {
  return {key, at<&C::transient, Member>, doc, dimension, range};
}

std::vector<Option> row_columns() {
  return {
      column<&T::at_distance>("at_distance", "kind = \"rolling\": rolled distance of each row, from 0 on", kLength,
                              {0, 20}),
      column<&T::at_time>("at_time", "Time of each row, from 0 on; what rolls does so at drive.speed", kTime, {0, 1e6}),
      column<&T::wheel_load>("wheel_load", "Load of the wheel on the rail", kForce, above(0, 1e7)),
      column<&T::load_factor>("load_factor", "The same over the static load G", kNumber, above(0, 100))};
}

std::vector<Option> driven_columns() {
  return {
      column<&T::traction_coefficient>("traction_coefficient", "F_T over the static load G", kNumber, {-10, 10}),
      column<&T::tractive_force>("tractive_force", "F_T on the wheel; positive drives", kForce, {-1e7, 1e7}),
      column<&T::creepage>("creepage", "kind = \"rolling\": longitudinal creepage; negative drives", kNumber, {-10, 1}),
      column<&T::displacement>(
          "displacement", "kind = \"shift\": of the wheel over the rail in the rolling direction, from the start on",
          kLength, {-0.01, 0.01}),
      column<&T::lateral_traction_coefficient>("lateral_traction_coefficient", "F_y over the static load G", kNumber,
                                               {-10, 10}),
      column<&T::lateral_force>("lateral_force", "Friction force F_y on the wheel along the contact plane", kForce,
                                {-1e7, 1e7}),
      column<&T::lateral_creepage>("lateral_creepage", "kind = \"rolling\": along the contact plane", kNumber,
                                   {-10, 10}),
      column<&T::lateral_displacement>("lateral_displacement",
                                       "kind = \"shift\": of the wheel over the rail towards the field side, along "
                                       "the contact plane",
                                       kLength, {-0.01, 0.01}),
      column<&T::spin>("spin", "kind = \"rolling\": about the normal of the contact plane", kSpin, {-1000, 1000})};
}

/// One of several words, of a case that has it.
Option only_where(bool (*applies)(const CaseSpec&, std::size_t), Option option) {
  option.applies = applies;
  return option;
}

std::vector<Option> course_options() {
  return {
      only_where(
          transient,
          choice_at<&C::transient, &T::kind>(
              "kind",
              "Steady rolling; rolling from a beginning in steps of one cell; a shift without rolling "
              "(presliding, fretting)",
              {{"none", TransientKind::none}, {"rolling", TransientKind::rolling}, {"shift", TransientKind::shift}})),
      only_where(starts, choice_at<&C::transient, &T::start>(
                             "start",
                             "kind = \"rolling\" begins pressed together and shifted by the first forces, or in "
                             "steady rolling under the first row",
                             {{"rest", TransientStart::rest}, {"steady", TransientStart::steady}})),
      {"distance", at<&C::transient, &T::distance>,
       "kind = \"rolling\": rolled distance; that of the last row where it is not given", kLength, above(0, 20)},
      only_where(shifts, {"increments",
                          at<&C::transient, &T::increments>,
                          "kind = \"shift\": steps from row to row",
                          kNumber,
                          {1, 1000}}),
      only_where(never, {"history_file", at<&C::transient, &T::history_file>,
                         "A CSV file with the columns below, relative to the case file, instead of the lists; the "
                         "resolved case has what it says"})};
}

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

bool scatters(const CaseSpec& spec, std::size_t) { return spec.passes.lateral_deviation.has_value(); }

OptionTable passes_table() {
  using P = PassesSpec;
  return {"passes",
          "Passes over a rail that yields (`railstrata passes`); lists begin again after their last value",
          {{"lateral_positions",
            at<&C::passes, &P::lateral_positions>,
            "Of the wheel in pass 1, 2, …, positive to the field side; not given: every pass at 0",
            kLength,
            {-1, 1}},
           {"lateral_deviation", at<&C::passes, &P::lateral_deviation>,
            "Standard deviation of a normal distribution about these positions, cut at three of it", kLength,
            above(0, 0.01)},
           only_where(scatters, {"lateral_seed",
                                 at<&C::passes, &P::lateral_seed>,
                                 "Of the distribution's random numbers; pass n has its own, however the passes are cut",
                                 kNumber,
                                 {0, 1e9}}),
           {"traction_coefficients",
            at<&C::passes, &P::traction_coefficients>,
            "F_T over the static load G in pass 1, 2, …; not given: that of the drive",
            kNumber,
            {-10, 10}},
           {"ductility", at<&C::passes, &P::ductility>,
            "Net plastic strain that the material bears: passes are extrapolated to it", kNumber, above(0, 100)}}};
}

OptionTable output_table() {
  return {"output",
          "Files",
          {{"volume", at<&C::output, &O::volume>, "Write the fine zone as VTU"},
           {"patch_series", at<&C::output, &O::patch_series>, "Write the patch during the rolling as a VTP series"},
           {"series_frames", at<&C::output, &O::series_frames>, "Frames of the series", kNumber, {1, 10000}}}};
}

Slot title(CaseSpec& spec, std::size_t) { return &spec.title; }

std::string quantity(double value, const Dimension& dimension) {
  const std::string text = format_quantity(value, dimension);
  if (!(dimension == kNumber || dimension == kSlope)) return '"' + text + '"';
  return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
}

std::string_view word_of(const Option& option, const ChoiceSlot& slot) {
  const auto found =
      std::find_if(option.choices.begin(), option.choices.end(), [&](const Choice& c) { return c.value == *slot; });
  assert(found != option.choices.end());
  return found->word;
}

}  // namespace

const std::vector<OptionTable>& case_tables() {
  static const std::vector<OptionTable> tables{
      {"case", "What the case is", {{"title", title, "One line for reports"}}},
      geometry_table(),
      material_table<&C::rail_material>("material.rail", "The rail below its layers (the matrix)", StrengthPlace::rail),
      material_table<&C::wheel_material>("material.wheel", "The wheel below its layers", StrengthPlace::wheel),
      layer_table(),
      vehicle_table(),
      drive_table(),
      friction_table(),
      third_body_table(),
      mesh_table(),
      contact_table(),
      run_table(),
      bem_table(),
      transient_table(),
      load_table(),
      collective_table(),
      passes_table(),
      output_table()};
  return tables;
}

const OptionTable* find_table(std::string_view name) {
  for (const OptionTable& t : case_tables())
    if (t.name == name) return &t;
  return nullptr;
}

CaseSpec one_of_each() {
  CaseSpec spec;
  for (const OptionTable& table : case_tables())
    if (table.repeated) table.repeated.resize(spec, 1);
  return spec;
}

Slot any_slot(const Option& option) {
  static CaseSpec spec = one_of_each();
  return option.slot(spec, 0);
}

std::vector<std::string> words_of(const Option& option) {
  std::vector<std::string> out;
  for (const Choice& c : option.choices) out.emplace_back(c.word);
  return out;
}

std::string toml_quoted(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\')
      (out += '\\') += c;
    else if (byte < 0x20 || byte == 0x7F)
      out += fmt::format("\\u{:04X}", byte);
    else
      out += c;
  }
  return out + '"';
}

std::string toml_value(const Option& option, CaseSpec& spec, std::size_t index) {
  struct Writer {
    const Option& option;
    std::string operator()(const double* v) const { return quantity(*v, option.dimension); }
    std::string operator()(const std::optional<double>* v) const {
      return *v ? quantity(**v, option.dimension) : std::string();
    }
    std::string operator()(const int* v) const { return fmt::format("{}", *v); }
    std::string operator()(const bool* v) const { return *v ? "true" : "false"; }
    std::string operator()(const std::string* v) const { return toml_quoted(*v); }
    std::string operator()(const ChoiceSlot& v) const { return toml_quoted(word_of(option, v)); }
    std::string operator()(const std::vector<double>* v) const {
      std::string out;
      if (v->empty()) return out;
      for (double x : *v) out += (out.empty() ? "" : ", ") + quantity(x, option.dimension);
      return "[" + out + "]";
    }
    std::string operator()(const RowsSlot& v) const {
      const bool named = option.form != RowForm::by_depth;
      std::string out;
      for (const std::vector<double>& numbers : *v) {
        std::string row;
        for (std::size_t k = 0; k < numbers.size(); ++k)
          row += fmt::format("{}{}{}", k == 0 ? "" : ", ", named ? fmt::format("{} = ", option.columns.at(k).key) : "",
                             quantity(numbers[k], option.columns.at(k).dimension));
        out += fmt::format(fmt::runtime(named ? "{}{{ {} }}" : "{}[{}]"), out.empty() ? "" : ", ", row);
      }
      return out.empty() || option.form == RowForm::one_named ? out : "[" + out + "]";
    }
  };
  return std::visit(Writer{option}, option.slot(spec, index));
}

std::string describe(const Range& range, const Dimension& dimension) {
  const bool low = std::isfinite(range.min), high = std::isfinite(range.max);
  const auto show = [&](double v) { return format_quantity(v, dimension); };
  if (low && range.open)
    return fmt::format("above {}{}", show(range.min), high ? fmt::format(" and at most {}", show(range.max)) : "");
  if (low && high) return fmt::format("between {} and {}", show(range.min), show(range.max));
  if (low) return fmt::format("at least {}", show(range.min));
  return high ? fmt::format("at most {}", show(range.max)) : "";
}

}  // namespace railstrata
