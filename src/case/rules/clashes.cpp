#include "rules/clashes.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "geometry/profile_names.hpp"
#include "model/material_strength.hpp"
#include "rules/feature_keys.hpp"
#include "rules/support.hpp"
#include "spec/case_spec.hpp"

namespace railstrata {

using C = CaseSpec;

constexpr Use uses::kRollingElements{"rolling finite elements", &kFiniteElements,
                                     [](const C& c) { return c.run.rolling; }};
constexpr Use uses::kSteadyRolling{"steady rolling of half-spaces", &kHalfSpaces,
                                   [](const C& c) { return c.run.rolling && c.transient.kind == TransientKind::none; }};

namespace {

/// Poisson's ratio up to which elements do not lock.
constexpr double kLargestMeshedPoisson = 0.495;

bool is_flat(const std::string& profile) { return profile == "flat" || profile == "Flat" || profile == "FLAT"; }

bool any_material(const C& c, bool (*has)(const MaterialSpec&)) {
  return has(c.rail_material) || has(c.wheel_material) ||
         std::any_of(c.layers.begin(), c.layers.end(), [&](const LayerSpec& l) { return has(l.material); });
}

bool yields(const MaterialSpec& material) {
  const StrengthSpec& s = material.strength;
  return !s.elastic && !(hardening_name(s).empty() && std::isnan(MaterialStrength(s, {}, {}).yield(0)));
}

// The words of features name these limits.
static_assert(kThinnestMeshedLayer == 0.05e-3 && kLargestMeshedPoisson == 0.495 && kLargestRunCreepage == 0.1);

// Features that several rows name.
constexpr Feature kLine{"geometry.contact = \"line\""}, kShift{"transient.kind = \"shift\""},
    kCrack{"crack.depth | crack.length"}, kGpu{"run.device = \"gpu\""},
    kWarmTables{"friction.temperature_table | third_body.temperature_table"};
constexpr Feature kOfWheel{"drive.creepage_of = \"wheel\""}, kForces{"drive.tractive_force | drive.lateral_force"},
    kPlastic{"run.plasticity = true"};

// Features that are more than a value at a key.
constexpr Feature kWheelProfile{"geometry.wheel_profile", [](const C&c) { return !is_flat(c.geometry.wheel_profile); },
                                "a profile that is not flat"},
    kLiftedWheel{"vehicle.sprung_mass", [](const C&c) { return !(c.vehicle.sprung_mass >= 0); },
                 "a load below the weight of vehicle.wheel_mass"},
    kRailProfile{"geometry.rail_profile", [](const C&c) { return !is_flat(c.geometry.rail_profile); },
                 "a profile that is not flat"},
    kFlangeOnArc{"geometry.rail_profile",
                 [](const C&c) {
                   return names_primitive(c.geometry.rail_profile) && !names_primitive(c.geometry.wheel_profile);
                 },
                 "an arc or a plane below a wheel with a flange"},
    kCant{"geometry.cant", [](const C&c) { return c.geometry.cant != 0; }},
    kHollowRail{"geometry.rail_radius", [](const C&c) { return c.geometry.rail_radius.value_or(0) < 0; },
                "a hollow rail"},
    kJoint{"irregularity",
           [](const C&c) {
             return std::any_of(c.irregularities.begin(), c.irregularities.end(), [](const Irregularity& is) {
               return std::visit([]<class Kind>(const Kind&) { return Kind::kJoint; }, is.shape);
             });
           },
           "a dip or a step"},
    kThinLayer{"layer.thickness",
               [](const C&c, const CaseSource*) {
                 return keys_of_layers(c, "thickness",
                                       [](const LayerSpec& l) { return l.thickness < kThinnestMeshedLayer; });
               },
               "a layer thinner than 0.05 mm"},
    kLayerThickness{"layer.thickness",
                    [](const C&c, const CaseSource*text) { return given_in_layers(c, text, {"thickness"}); }},
    kLayerModulus{"layer.young_ratio",
                  [](const C&c, const CaseSource*text) {
                    return given_in_layers(c, text, {"young_ratio", "young"});
                  }},
    kIncompressible{"*.poisson",
                    [](const C&c, const CaseSource*) {
                      Keys out = keys_of_layers(
                          c, "poisson", [](const LayerSpec& l) { return l.material.poisson > kLargestMeshedPoisson; });
                      if (c.rail_material.poisson > kLargestMeshedPoisson) out.emplace_back("material.rail.poisson");
                      if (c.wheel_material.poisson > kLargestMeshedPoisson) out.emplace_back("material.wheel.poisson");
                      return out;
                    },
                    "a Poisson's ratio above 0.495"},
    kYieldStrength{"material.rail.yield_strength", [](const C&c) { return any_material(c, yields); }},
    kInitialStress{"material.rail.initial_stress",
                   [](const C&c) {
                     return c.run.plasticity && any_material(c, [](const MaterialSpec& m) {
                              return !m.strength.initial_stress.empty() || !m.strength.initial_stress_table.empty();
                            });
                   },
                   "stress from the start where materials yield"},
    kFriction{"drive.friction_coefficient", [](const C&c) { return c.drive.friction_coefficient > 0; }},
    kFrictionBeside{"drive.friction_coefficient",
                    [](const C&c) {
                      return !c.friction.lateral_table.empty() &&
                             c.drive.friction_coefficient != largest_value(c.friction.lateral_table);
                    }},
    kTraction{"drive.traction_coefficient",
              [](const C&c, const CaseSource*text) {
                const bool force = text && text->has("drive.tractive_force");
                const std::string key = force ? "drive.tractive_force" : "drive.traction_coefficient";
                const bool asked =
                    c.drive.traction_coefficient != DriveSpec{}.traction_coefficient || (text && text->has_origin(key));
                return c.drive.traction().value_or(0) != 0 && asked ? Keys{key} : Keys{};
              }},
    kCreepageAlone{"drive.creepage",
                   [](const C&c) {
                     return c.transient.kind == TransientKind::rolling && c.drive.creepage &&
                            c.transient.tractive_force.empty() && c.transient.traction_coefficient.empty();
                   },
                   "a creepage in a history"},
    kCreepageOfWheel{"drive.creepage_of = \"wheel\"",
                     [](const C&c) {
                       return c.drive.creepage_of == CreepageOf::wheel &&
                              (c.drive.creepage || c.drive.lateral_creepage);
                     },
                     "creepages of the wheel"},
    kLargeCreepage{"drive.creepage",
                   [](const C&c) { return std::abs(c.drive.creepage.value_or(0)) > kLargestRunCreepage; },
                   "a creepage beyond 0.1"},
    kLargeLateralCreepage{
        "drive.lateral_creepage",
        [](const C&c) { return std::abs(c.drive.lateral_creepage.value_or(0)) > kLargestRunCreepage; },
        "a creepage beyond 0.1"},
    kFallingAtOnce{
        "friction.law",
        [](const C&c) { return c.friction.law != FrictionForm::coulomb && !(c.friction.memory_distance > 0); },
        "friction that falls with slip at once"},
    kFilmSoftening{"third_body.hardening", [](const C&c) { return c.third_body.hardening < 0; }, "a film that softens"},
    kAtRest{"run.rolling = false",
            [](const C&c) { return !c.run.rolling && c.transient.kind != TransientKind::shift; }},
    kRollingDevice{"run.device = \"gpu\"",
                   [](const C&c) { return c.run.rolling && c.run.device != ComputeDevice::cpu; }},
    kWindow{"run.window", [](const C&c) { return c.run.rolling && c.run.window > 0; }},
    kUnreached{"life.until", [](const C&c) { return c.life.first_cracks.value_or(0) > c.life.until; },
               "a rail that is not followed so far"},
    kElastic{"run.plasticity = false", [](const C&c) { return !c.run.plasticity && c.life.until == 0; }},
    kTrackOfHalfSpaces{"track.preset",
                       [](const C&c) { return !c.track.held() && c.bem.bodies == ContactBodies::half_spaces; },
                       "a track without bem.bodies = \"sections\""},
    kSleepers{
        "track.phase | track.pad_damping | track.pad_length | track.sleeper_mass | track.ballast_damping | "
        "track.bays",
        keys_of_sleepers},
    kVariesAcross{"layer.thickness_table"}, kSections{"bem.bodies = \"sections\""}, kLocal{"bem.normals = \"local\""},
    kGivingInterface{
        "layer.interface_normal_stiffness | layer.interface_shear_stiffness | layer.interface_shear_limit | "
        "layer.interface_friction"},
    kSlidingInterface{"layer.interface_shear_limit | layer.interface_friction"},
    kSmoothInterface{"layer.interface_shear_stiffness",
                     [](const C&c, const CaseSource*) {
                       return keys_of_layers(c, "interface_shear_stiffness", [](const LayerSpec& l) {
                         return l.slides() && l.interface_shear_stiffness == 0.0;
                       });
                     },
                     "a shear stiffness of 0"},
    kRollingColumns{
        "transient.creepage | transient.lateral_creepage | transient.spin | transient.at_distance | "
        "transient.distance"},
    kLateralDrive{"drive.lateral_creepage | drive.lateral_traction_coefficient | drive.spin"},
    kLateralColumns{
        "transient.lateral_force | transient.lateral_traction_coefficient | transient.lateral_creepage | "
        "transient.lateral_displacement | transient.spin"},
    kShiftColumns{"transient.displacement | transient.lateral_displacement"},
    kStationaryGrid{"passes.patch_cells | passes.patch_rows | passes.first_row | passes.window"};

using enum ClashRule;
constexpr const Use *kInElements = &uses::kFiniteElements, *kInHalfSpaces = &uses::kHalfSpaces;

constexpr const char *kOneOut = "take one of them out", *kOut = "take it out",
                     *kByBem = "take it out, or solve the case with `railstrata bem`",
                     *kByRun = "take it out, or roll over it with `railstrata run`",
                     *kCpu = "give run.device = \"cpu\"",
                     *kPoint = "leave it out, or give geometry.contact = \"point\"";
constexpr const char* kOfHalfSpaces = "it is implemented for half-spaces";
constexpr const char* kOfPlane = "it is implemented for the contact plane";
constexpr const char* kEven = "it takes layers as even across";
constexpr const char* kOfBonded = "plastic strain is followed in bonded layers";
constexpr const char *kSlidesSteadily = "slip of an interface is followed in steady rolling",
                     *kSlidesInPassages = "slip of an interface is followed over passages of one wheel";
constexpr const char *kStraight = "its wheel rolls straight on and level", *kAcross = "all places across are the same",
                     *kUnknown = "displacements of distant points are not known in plane strain",
                     *kNoFriction = "the wheel is pressed on without friction",
                     *kLetRoll = "take it out, or give run.rolling = true",
                     *kRolls = "a shift takes from [drive] its friction alone";

constexpr Clash kClashes[] = {
    // Load and drive
    {kOfWheel, excludes, "geometry.rail_radius", "only creepages on a straight rail are converted",
     "give creepages of the contact"},
    {kOfWheel, excludes, kLine, "only creepages of a patch are converted", "give creepages of the contact"},
    {kOfWheel, excludes, "transient.kind", "only steady creepages are converted", "give creepages of the contact"},
    {kForces, excludes, "vehicle.approach", "the load is a result, and may be too small for this force",
     "give drive.traction_coefficient or lateral_traction_coefficient, which count over that load, or a creepage"},
    {kForces, excludes, "load.wheel_load", "the force would count over the load of the case, not of the row",
     "give a traction coefficient, which counts over the load of each row"},
    {"bogie", needs, "curve.radius", "", "give the radius of the curve: [curve] radius = \"800 m\""},
    {"curve.radius | curve.superelevation | curve.rail", needs, "bogie", "no vehicle runs through the curve",
     "write [[bogie]] with type = \"coach\" and mgt = 10"},
    {"bogie", excludes, "load", "the loads of a collective follow from the curve", kOneOut},
    {"bogie", excludes, "transient.kind", "a load collective needs steady rolling", kOneOut},
    {"transient.kind", excludes, "load", "a load collective needs steady rolling",
     "take out [transient], or the rows of [[load]]"},
    {"geometry.rail_radius", excludes, "geometry.roll", "the axles of a roller rig are parallel", kOneOut},
    {"geometry.rail_radius", excludes, "geometry.curve_radius", "a roller is a straight track", kOneOut},

    // Friction and third body
    {"friction.law", needs, "friction.kinetic_coefficient", "friction falls to this coefficient",
     "give the coefficient of fast slip, e.g. 0.4 times drive.friction_coefficient"},
    {"friction.law", needs, "friction.half_velocity", "half of the fall is done at this slip velocity",
     "give friction.half_velocity, e.g. \"1 m/s\""},
    {"friction.kinetic_coefficient | friction.half_velocity", needs, "friction.law",
     "a constant coefficient does not fall",
     "take it out, or give friction.law = \"falling_exponential\" or \"falling_rational\""},
    {kFrictionBeside, excludes, "friction.lateral_table", "the table gives the coefficients",
     "take drive.friction_coefficient out"},
    {"friction.lateral_table | layer.thickness_table", excludes, kLine, kAcross, "give one number for all places"},
    {"friction.lateral_coefficient", excludes, "friction.law | third_body.yield_shear",
     "that law counts slip the same along and across", kOneOut},
    {"friction.lateral_coefficient", needs, kFriction, "an ellipse of friction has two axes",
     "give drive.friction_coefficient above 0"},
    {kWarmTables, needs, "friction.rail_temperature", "the bodies come into the contact with a temperature",
     "give it with the zero of the table: \"20 K\" if that is 0 °C"},
    {kWarmTables, needs, "friction.wheel_temperature", "the bodies come into the contact with a temperature",
     "give it with the zero of the table: \"20 K\" if that is 0 °C"},
    {"friction.rail_temperature | friction.wheel_temperature", needs, kWarmTables, "nothing depends on the temperature",
     "give friction.temperature_table or third_body.temperature_table, or take it out"},
    {"third_body.thickness", needs, "third_body.shear_modulus", "a film is elastic in shear",
     "give the film's shear modulus, e.g. \"100 MPa\""},
    {"third_body.shear_modulus | third_body.yield_shear | third_body.modulus_by_pressure | "
     "third_body.temperature_table",
     needs, "third_body.thickness", "", "give the film's thickness, e.g. third_body.thickness = \"20 um\""},
    {"third_body.hardening", needs, "third_body.yield_shear", "", "give the stress at which the film begins to yield"},
    {"third_body.yield_by_pressure", needs, "third_body.yield_shear", "",
     "give the stress at which the film begins to yield without pressure"},
    {kFilmSoftening, needs, "third_body.residual_shear", "softening ends at this strength",
     "give the strength that much shear leaves, e.g. a tenth of yield_shear"},
    {"third_body.residual_shear", needs, kFilmSoftening, "", "take it out, or give a third_body.hardening below 0"},
    {"third_body.thickness", excludes, kFallingAtOnce, "there is no steady state: it would jump",
     "give friction.memory_distance, e.g. \"14 um\", or take friction.law = \"coulomb\""},

    // Line contact
    {kLine, needs, "geometry.line_length", "the length bears the load", "give e.g. line_length = \"20 mm\""},
    {"geometry.line_length", needs, kLine, "a patch has a length of its own",
     "take it out, or give contact = \"line\""},
    {kWheelProfile, excludes, kLine, "a cylinder touches a plane", "give wheel_profile = \"flat\""},
    {kRailProfile, excludes, kLine, "a cylinder touches a plane", "give rail_profile = \"flat\""},
    {kCant, excludes, kLine, kStraight, "give 0"},
    {"geometry.roll | geometry.yaw", excludes, kLine, kStraight, "give 0"},
    {"geometry.lateral_shift", excludes, kLine, kAcross, "give 0"},
    {"geometry.curve_radius", excludes, kLine, kStraight, kPoint},
    {kLateralDrive, excludes, kLine, kStraight, kPoint},
    {"vehicle.approach", excludes, kLine, "distant points come together without end", "give a load"},
    {"passes.lateral_positions | passes.lateral_deviation", excludes, kLine, kAcross, kPoint},
    {"transient.creepage | transient.displacement", excludes, kLine, kUnknown,
     "give transient.tractive_force or traction_coefficient"},
    {kCreepageAlone, excludes, kLine, kUnknown, "give transient.tractive_force or traction_coefficient"},
    {kLateralColumns, excludes, kLine, kStraight, kPoint},

    // Histories
    {"transient.kind", excludes, "run.rolling = false", "a static case has no friction",
     "take run.rolling out, or transient.kind"},
    {"transient.kind", needs, kFriction, "without friction nothing changes in time",
     "raise it above zero, or take transient.kind out"},
    {"vehicle.approach", excludes, "transient.kind", "a history is followed under loads",
     "give vehicle.wheel_load, or the rows transient.wheel_load"},
    {"friction.law", excludes, kShift, "the slip of a shift has no velocity",
     "give friction.law = \"coulomb\", or transient.kind = \"rolling\""},
    {kWarmTables, excludes, kShift, "a shift takes no time in which heat is made",
     "take the table out, or let it roll"},
    {"irregularity", excludes, kShift, "a shift does not roll over it",
     "take the irregularities out, or give transient.kind = \"rolling\""},
    {kShiftColumns, excludes, "transient.kind = \"rolling\"", "what rolls has creepages instead",
     "give creepage or lateral_creepage, or kind = \"shift\""},
    {kRollingColumns, excludes, kShift, "a shift does not roll", "give displacements or forces, or kind = \"rolling\""},
    {"transient", idle_without, "transient.kind", "", "give transient.kind = \"rolling\" or \"shift\""},
    {"transient.increments", idle_without, kShift, "what rolls goes on by one cell a step", ""},
    {"drive.creepage", idle_with, kShift, kRolls, ""},
    {kTraction, idle_with, kShift, kRolls, ""},
    {kLateralDrive, idle_with, kShift, kRolls, ""},

    // Layers, passes, lives
    {kLayerThickness, excludes, "layer.young_table | layer.thickness_table", "the table has it", "leave thickness out"},
    {kLayerModulus, excludes, "layer.young_table", "the table gives the modulus", "keep one of them"},
    {"layer.width", excludes, kVariesAcross, "the layer ends with the table's rows", "keep one of them"},
    {kVariesAcross, excludes, "layer.young_table | layer.from | layer.to | layer.unbonded", kEven, kOneOut},
    {kVariesAcross, excludes, kGivingInterface, kEven, kOneOut},
    {kVariesAcross, excludes, "crack.length | life.until", kEven, kOneOut},
    {kGivingInterface, excludes, "life.until", kOfBonded, "take out life.until, or the interface"},
    {kSlidingInterface, excludes, kSmoothInterface, "a smooth interface has no shear that a limit could bound",
     "leave the stiffness out, or give it above 0"},
    {kSlidingInterface, excludes, kCrack, "stress intensities would leave out the slip of the interface", kOneOut},
    {"passes.jump = \"auto\"", excludes, "passes.lateral_deviation",
     "wheels that scatter never repeat, so no round shows the next",
     "take passes.lateral_deviation out, or give passes.lateral_positions alone"},
    {"grinding.every", needs, "grinding.depth", "",
     "give both, e.g. every = \"15 Mt\" and depth = \"0.2 mm\", or none"},
    {"grinding.depth", needs, "grinding.every", "",
     "give both, e.g. every = \"15 Mt\" and depth = \"0.2 mm\", or none"},
    {"crack.top | crack.angle | crack.place | crack.fluid | crack.aspect | crack.law | crack.threshold | "
     "crack.detectable | crack.allowable",
     needs, "crack.depth", "without a depth there is no crack", "give crack.depth = \"1 mm\""},
    {"crack.azimuth | crack.lateral | crack.face_friction", needs, kCrack, "there is no crack",
     "give crack.depth = \"1 mm\""},
    {"crack.layer", needs, "crack.length", "a crack along an interface has a length", "give crack.length = \"4 mm\""},
    {"crack.length", excludes, "crack.depth", "a crack goes down, or lies along an interface", kOneOut},
    {"crack.length", excludes, "life.until", "no law of growth along an interface is known",
     "take out life.until; `railstrata bem` has the energy release rate"},
    {kCrack, idle_with, uses::kFiniteElements, "stress intensities come from half-spaces, `railstrata bem`", ""},
    {"crack.place", excludes, "crack.top", "in a life the crack breaks the surface", kOneOut},
    {"crack.fluid", excludes, "crack.top", "a crack inside has no mouth", kOneOut},

    // Steps and machines of a run
    {"mesh.element = \"one_point\"", excludes, kPlastic, "elements with one point stay too stiff after yield",
     "give mesh.element = \"full\""},
    {kGpu, excludes, kPlastic, "materials that yield are computed on processors", kCpu},
    {kGpu, excludes, "friction.lateral_table", "the GPU has one coefficient for all places", kCpu},
    {"track.preset", excludes, kGpu, "pads and sleepers are computed on processors", kCpu},
    {"track.preset", excludes, "geometry.rail_radius", "a roller turns about a shaft", kOneOut},
    {"track", needs, "track.preset", "without a preset the foot of the rail is held",
     "give track.preset = \"delft\", \"medium\" or \"cn60\"; it supplies the defaults of the other keys"},
    {"geometry.block_width | geometry.block_height", idle_without, "geometry.rail_shape = \"block\"", "", ""},
    {kGpu, idle_with, "run.rolling = false", "only rolling is computed on a GPU", ""},
    {"*.hardening | *.isotropic_hardening | *.kinematic_hardening | *.recall_power", idle_with, kElastic,
     "`run` and `bem` compute elastically, `railstrata passes` and `railstrata material` use it",
     "give run.plasticity = true to `run`"},
    {"life.first_cracks", idle_with, kUnreached, "the ductility comes from the strain that the rail has by then",
     "give a later life.until (or --until)"},
    {"drive.creepage", idle_with, kAtRest, kNoFriction, kLetRoll},
    {kTraction, idle_with, kAtRest, kNoFriction, kLetRoll},
    {kLateralDrive, idle_with, kAtRest, kNoFriction, kLetRoll},
    {"passes.traction_coefficients", idle_with, kAtRest, kNoFriction, kLetRoll},

    // The finite elements
    {kLiftedWheel, excludes, uses::kRollingElements, "the wheel rolls with its mass",
     "give more load, or less vehicle.wheel_mass"},
    {"vehicle.approach", excludes, uses::kFiniteElements, "masses press the wheel down, and the approach follows",
     kByBem},
    {"transient.kind", excludes, uses::kFiniteElements, "one drive leads to the wanted positions, with inertia",
     kByBem},
    {kLine, excludes, uses::kFiniteElements, "bodies end across the rail, and so do patches", kByBem},
    {"geometry.roll", excludes, uses::kFiniteElements, "the wheel is meshed upright", kByBem},
    {kHollowRail, excludes, uses::kFiniteElements, "there is no axle below a hollow rail", kByBem},
    {kThinLayer, excludes, uses::kFiniteElements, "so thin elements would need tiny time steps", kByBem},
    {kGivingInterface, excludes, uses::kFiniteElements, "layers of elements are bonded, or loose within layer.unbonded",
     kByBem},
    {kIncompressible, excludes, uses::kFiniteElements, "elements lock; to the contact the difference is small", kByBem},
    {kPlastic, needs, kYieldStrength, "nothing could yield",
     "give material.rail.yield_strength, or a steel: material.rail.grade = \"R260\"", kInElements},
    {"geometry.rail_shape = \"rail\"", excludes, "geometry.rail_radius", "web and foot do not close to a ring",
     "give rail_shape = \"block\": a disc as wide as its profile, block_height thick down to its bore", kInElements},
    {kCant, excludes, "geometry.rail_radius", "both axles are parallel",
     "give cant = 0, or solve the case with `railstrata bem`", kInElements},
    {kPlastic, excludes, "geometry.rail_radius", "elements of a ring that turns stay elastic", kOut, kInElements},
    {"geometry.rail_radius", excludes, "irregularity", "heights lie along a straight rail", kByBem, kInElements},
    {"geometry.rail_radius", excludes, "layer.from | layer.to | layer.unbonded | stretch",
     "a roller is the same all round", kOneOut, kInElements},
    {kGpu, excludes, "irregularity", "irregularities are not implemented on the GPU", kCpu, kInElements},
    {kGpu, excludes, "geometry.rail_radius", "the GPU supports straight rails only", kCpu, kInElements},
    {kGpu, excludes, "layer.from | layer.to | layer.unbonded | layer.thickness_table | stretch",
     "the GPU supports bonded layers and uniform bodies only", kCpu, kInElements},
    {kWindow, excludes, "irregularity | layer.from | layer.to | layer.unbonded | stretch",
     "averaging over the window would mix different sections of the rail", "give run.window = \"0 mm\"", kInElements},
    {kJoint, needs, "track.preset", "its forces are made by the springs and masses of a track",
     "give [track] preset = \"delft\", or kind = \"indentation\" for a short one, or solve the case with "
     "`railstrata bem`, under a given load",
     kInElements},
    {"run.rolling = false", excludes, "layer.unbonded", "the static wheel does not touch the unbonded stretch",
     "give run.rolling = true, or take unbonded out", kInElements},
    {kInitialStress, excludes, "layer.from | layer.to", "stress from the start is the same all along", kOut,
     kInElements},
    {kFallingAtOnce, excludes, uses::kRollingElements,
     "surfaces of finite elements chatter on a law that follows slip at once",
     "give friction.memory_distance, 10 to 50 um for a wheel on a rail, or solve the case with `railstrata bem`"},
    {kFilmSoftening, excludes, uses::kRollingElements, "a step would have several answers", kByBem},
    {kWarmTables, excludes, uses::kRollingElements, "heat that flows into the bodies is not computed", kByBem},
    {"third_body.yield_by_pressure | third_body.modulus_by_pressure", excludes, uses::kRollingElements,
     "each node has one film for its whole way", kByBem},
    {"geometry.curve_radius", excludes, uses::kRollingElements, "the track is straight", kByBem},
    {kLargeCreepage, excludes, uses::kRollingElements, "creepages reach to 0.1", kByBem},
    {kLargeLateralCreepage, excludes, uses::kRollingElements, "the wheel moves sideways on its way, by up to 0.1",
     kByBem},
    {"drive.spin", excludes, uses::kRollingElements, "spin follows from the geometry", kByBem},

    // Half-spaces
    {kTrackOfHalfSpaces, excludes, uses::kHalfSpaces, "half-spaces have nothing below them",
     "take it out, give bem.bodies = \"sections\", or roll over it with `railstrata run`"},
    {kSleepers, idle_with, uses::kHalfSpaces, "pads and ballast of sections are even along the rail", ""},
    {"layer.from | layer.to | layer.unbonded | stretch", excludes, uses::kHalfSpaces,
     "half-spaces are the same all along", kByRun},
    {"irregularity", excludes, uses::kSteadyRolling,
     "steady rolling needs a rail and a wheel that are the same all along",
     "take it out; half-spaces roll over it with transient.kind = \"rolling\", the finite elements with `railstrata "
     "run`"},
    {kLocal, excludes, kSections, "sections meet in the contact plane", kOneOut, kInHalfSpaces},
    {kLocal, excludes, "transient.kind | run.rolling = false | geometry.contact = \"line\" | geometry.rail_radius",
     kOfPlane, kOneOut, kInHalfSpaces},
    {kLocal, excludes, "drive.lateral_traction_coefficient", "part of the lateral force is pressure", kOneOut,
     kInHalfSpaces},
    {kLocal, excludes, uses::kStates, kOfPlane, kByBem},
    {kLocal, excludes, uses::kCollective, kOfPlane, kByBem},
    {kLocal, excludes, uses::kPasses, kOfPlane, kByBem},
    {kLocal, excludes, uses::kCreepTable, kOfPlane, kByBem},
    {kLocal, excludes, uses::kContactResult, kOfPlane, "export a case with bem.normals = \"plane\""},
    {kLocal, excludes, uses::kExplorer, kOfPlane, kByBem},
    {kLocal, excludes, kSlidingInterface, kOfPlane, kOneOut, kInHalfSpaces},
    {kSlidingInterface, excludes, kLine, "its slip would change far behind the patch", kOneOut, kInHalfSpaces},
    {kSlidingInterface, excludes, "transient.kind | run.rolling = false", kSlidesSteadily, kOneOut, kInHalfSpaces},
    {kSlidingInterface, excludes, uses::kStates, kSlidesInPassages, kByBem},
    {kSlidingInterface, excludes, uses::kCollective, kSlidesInPassages, kByBem},
    {kSlidingInterface, excludes, uses::kCreepCurve, kSlidesInPassages, kByBem},
    {kSlidingInterface, excludes, uses::kCreepTable, kSlidesInPassages, kByBem},
    {kSlidingInterface, excludes, uses::kExplorer, kSlidesInPassages, kByBem},
    {kSections, excludes, kLine, "sections meet in patches", kOneOut, kInHalfSpaces},
    {kSections, excludes, "geometry.rail_radius", "the section is that of a straight rail", kOneOut, kInHalfSpaces},
    {kSections, excludes, kGivingInterface, "layers of sections are bonded", kOneOut, kInHalfSpaces},
    {kSections, excludes, kIncompressible, "elements lock", kOneOut, kInHalfSpaces},
    {kSections, excludes, uses::kContactResult, kOfHalfSpaces, "export a case with bem.bodies = \"half_spaces\""},
    {kSections, excludes, uses::kExplorer, kOfHalfSpaces, kByBem},
    {kRollingDevice, idle_with, uses::kHalfSpaces, "half-spaces are computed on processors", ""},

    // Commands
    {kLine, excludes, uses::kCreepCurve, "the fast theories need elliptic patches",
     "take `railstrata sweep` over drive.creepage, or geometry.contact = \"point\""},
    {uses::kCreepCurve, needs, kFriction, "", "give drive.friction_coefficient above 0"},
    {"transient.kind", idle_with, uses::kCreepCurve, "it assumes steady rolling", ""},
    {kAtRest, idle_with, uses::kCreepCurve, "it assumes steady rolling, with the friction of the case", ""},
    {"transient.kind", idle_with, uses::kCreepTable, "it assumes steady rolling", ""},
    {kAtRest, idle_with, uses::kCreepTable, "it assumes steady rolling, with the friction of the case", ""},
    {"vehicle.approach", excludes, uses::kScaledTable, "its creepages are scaled by the load, which is a result",
     "give vehicle.wheel_load and --axis load=..., or make the table without --scaled"},
    {uses::kScaledTable, needs, kFriction, "its creepages are scaled by it",
     "give drive.friction_coefficient above 0, or make the table without --scaled"},
    {"transient.kind", excludes, uses::kPasses, "they roll steadily", "take out [transient]"},
    {kGivingInterface, excludes, uses::kPasses, kOfBonded, "take it out; `railstrata bem` has the elastic stresses"},
    {kAtRest, idle_with, uses::kPasses, "passes roll", ""},
    {kElastic, overlooked, uses::kPasses, "", ""},
    {"track.preset | irregularity | layer.from | layer.to | layer.unbonded | layer.thickness_table | stretch", excludes,
     uses::kRolledPasses, "a series of passes assumes a uniform rail", kByRun},
    {kVariesAcross, excludes, uses::kPasses, kEven, kOut},
    {kVariesAcross, excludes, uses::kWearLoop, kEven, kOut},
    {kVariesAcross, excludes, uses::kExplorer, kEven, kByBem},
    {"passes.jump = \"auto\"", excludes, uses::kRolledPasses, "every pass is rolled",
     "take it out, or use --engine bem"},
    {kStationaryGrid, excludes, uses::kRolledPasses, "the mesh is the grid",
     "take it out and give mesh.element_size, or use --engine bem"},
    {uses::kCollective, needs, "load | bogie", "",
     "write rows of [[load]], each with passages and what differs from the case, name a table with collective.file = "
     "\"loads.csv\", or give [curve] and [[bogie]]"},
    {"run.rolling = false", excludes, uses::kCollective, "a wheel at rest makes no wear and no fatigue",
     "take out run.rolling"},
    {kFlangeOnArc, excludes, uses::kWearLoop, "a worn arc is a list of points without a gauge face for the flange",
     "take a rail's profile, or an arc for the wheel too"},
    {"transient.kind", excludes, uses::kExplorer, "it shows steady rolling",
     "leave transient.kind out, or use `railstrata bem`"},
    {"transient.kind", excludes, uses::kStates, "it follows no history in time",
     "use `railstrata bem`, or rs.bem in Python"},
    {kCreepageOfWheel, excludes, uses::kStates, "each state gives the creepages of the contact",
     "take out drive.creepage and drive.lateral_creepage, and give them with each state"},
    {"geometry.rail_radius", excludes, uses::kWheelset, "a wheelset rolls on straight rails", kOut},
    {kLine, excludes, uses::kWheelset, "both wheels touch in patches", kOut},
    {kPlastic, excludes, uses::kElasticShakedown, "the theorems of shakedown judge elastic stresses",
     "leave run.plasticity out; `railstrata run` follows yielding itself"},
    {uses::kReceptance, needs, "track.preset", "the foot of this rail is held",
     "give [track] preset = \"delft\", \"medium\" or \"cn60\""},
    {"track.preset", excludes, uses::kDeck, "decks hold the foot of the rail", "take [track] out"},
    {"geometry.rail_radius", excludes, uses::kDeck, "decks have a rail at rest and a wheel that travels", kOut},
    {"transient.kind", excludes, uses::kContactResult, "one result cannot hold a history",
     "export a steady case: --set transient.kind=\"none\""},
    {kLine, excludes, uses::kContactResult, "a result holds a patch",
     "export a case with geometry.contact = \"point\""},
    {"layer | geometry.rail_radius | friction.law | third_body.thickness", excludes, uses::kContactInput, "",
     "compare with the result (.mat) alone"},
    {"geometry.rail_radius", excludes, uses::kRanks, "MPI exchange is implemented for straight rails only",
     "run the case in one process"},
    {"layer.unbonded", excludes, uses::kRanks, "both sides of the interface meet in one process",
     "run the case in one process"},
    {kGpu, excludes, uses::kRanks, "several ranks share a run on processors only",
     "start one rank, or give run.device = \"cpu\""},
};

}  // namespace

std::span<const Clash> clash_table() { return kClashes; }

}  // namespace railstrata
