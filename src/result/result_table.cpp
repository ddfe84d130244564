#include "result/result_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "result/layer_worst.hpp"

namespace railstrata {
namespace {

using namespace result_unit;
using C = ContactSummary;
using P = PatchMeasures;
using R = RunSummary;

template <auto... Path>
ResultValue at(const Summary& s) {
  return (s.*....*Path);
}
template <auto Member>
ResultValue count(const Summary& s) {
  return static_cast<long>(s.run.*Member);
}
template <auto Member>
constexpr auto patch = &at<&Summary::contact, &C::patch, Member>;
template <auto Member>
constexpr auto contact = &at<&Summary::contact, Member>;
template <auto Member>
constexpr auto energy = &at<&Summary::energy, Member>;
template <auto Member>
constexpr auto plastic = &at<&Summary::plastic, Member>;
template <auto Member>
constexpr auto run = &at<&Summary::run, Member>;

// The forces of several patches close to 1e-6 of the load (docs/bem-theory.md), those that symmetry cancels to 1e-9:
// below 1e-7 of the normal force there is no result, nor in what follows from forces. A creepage of 1e-10 is a slip of
// a picometre over a patch of 10 mm, a spin of 1e-8/m as much.
constexpr std::string_view kNormalForce = "/contact/normal_force_N";
constexpr double kNoise = 1e-7;
constexpr RoundOff kOfForce{kNoise, kNormalForce}, kOfMoment{kNoise, kNormalForce, "/contact/patch_length_m"},
    kOfPressure{kNoise, "/contact/p_max_Pa"}, kOfApproach{kNoise, "/contact/approach_m"},
    kOfWork{kNoise, kNormalForce, "/contact/approach_m"};
constexpr RoundOff kOfCreepage{1e-10}, kOfSpin{1e-8}, kOfAngle{1e-9};

std::vector<ResultNumber> traction_numbers() {
  return {{.group = "contact",
           .symbol = "p_max",
           .unit = kMPa,
           .value = patch<&P::p_max>,
           .label = "p_max",
           .name = "Largest pressure p",
           .doc = "Top of the parabola through the largest pressure and its neighbours",
           .column = true,
           .shown = true,
           .comparable = true},
          {.group = "contact",
           .symbol = "q_max",
           .unit = kMPa,
           .value = patch<&P::q_max>,
           .label = "q_max",
           .name = "Largest shear |q|",
           .doc = "Largest magnitude of the tangential traction; half-spaces: at the front of slip, else at a point",
           .column = true,
           .shown = true,
           .comparable = true,
           .round_off = kOfPressure},
          {.group = "contact",
           .symbol = "q_max_point",
           .unit = kMPa,
           .value = patch<&P::q_max_point>,
           .label = "q_max of a point",
           .name = "Largest shear |q| of a point",
           .doc = "Misses the cusp at the front of slip: to be compared between elements and cells of one size",
           .column = true,
           .round_off = kOfPressure}};
}

std::vector<ResultNumber> extent_numbers() {
  return {{.group = "contact",
           .symbol = "patch_length",
           .unit = kMillimetres,
           .value = patch<&P::length>,
           .label = "length",
           .name = "Patch length (along x)",
           .doc = "Longest chord in the rolling direction, between the edges where p² extrapolates to zero",
           .column = true,
           .shown = true,
           .comparable = true},
          {.group = "contact",
           .symbol = "patch_width",
           .unit = kMillimetres,
           .value = patch<&P::width>,
           .label = "width",
           .name = "Patch width (along y)",
           .doc = "Longest chord across the rolling direction; a line contact has none",
           .column = true,
           .shown = true,
           .comparable = true},
          {.group = "contact",
           .symbol = "patch_area",
           .unit = kSquareMillimetres,
           .value = patch<&P::area>,
           .label = "area",
           .name = "Patch area",
           .doc = "Area between the edges of the columns' chords",
           .column = true,
           .shown = true,
           .comparable = true},
          {.group = "contact",
           .symbol = "slip_area_fraction",
           .unit = kShare,
           .value = patch<&P::slip_area_fraction>,
           .label = "slip area",
           .name = "Slip area / patch area",
           .doc = "Area of the slipping points, of the points in contact; finite elements: mean over the window. Null "
                  "without friction (half-space)",
           .column = true,
           .shown = true,
           .comparable = true}};
}

std::vector<ResultNumber> force_numbers() {
  return {{.group = "contact",
           .symbol = "F_x",
           .unit = kKilonewtons,
           .value = contact<&C::F_x>,
           .label = "F_x",
           .name = "F_x on the wheel",
           .doc = "Contact force on the wheel, rolling direction; positive drives",
           .column = true,
           .shown = true,
           .comparable = true,
           .round_off = kOfForce,
           .of_all_patches = true},
          {.group = "contact",
           .symbol = "F_y",
           .unit = kKilonewtons,
           .value = contact<&C::F_y>,
           .label = "F_y",
           .name = "F_y on the wheel",
           .doc = "Contact force on the wheel towards the field side, model frame",
           .column = true,
           .shown = true,
           .round_off = kOfForce,
           .of_all_patches = true},
          {.group = "contact",
           .symbol = "F_z",
           .unit = kKilonewtons,
           .value = contact<&C::F_z>,
           .label = "F_z",
           .name = "F_z on the wheel",
           .doc = "Contact force on the wheel, upwards",
           .column = true,
           .shown = true,
           .comparable = true,
           .of_all_patches = true}};
}

std::vector<ResultNumber> contact_plane_numbers() {
  return {{.group = "contact",
           .symbol = "contact_angle",
           .unit = kDegrees,
           .value = contact<&C::contact_angle>,
           .label = "contact angle",
           .name = "Contact angle",
           .doc = "Of the common tangent at the rigid contact point",
           .round_off = kOfAngle},
          {.group = "contact",
           .symbol = "normal_force",
           .unit = kKilonewtons,
           .value = contact<&C::normal_force>,
           .label = "normal force",
           .name = "Normal force in the contact plane",
           .doc = "(F_y, F_z) along the normal of the contact plane",
           .column = true,
           .shown = true,
           .comparable = true},
          {.group = "contact",
           .symbol = "lateral_force",
           .unit = kKilonewtons,
           .value = contact<&C::lateral_force>,
           .label = "lateral force",
           .name = "Lateral force in the contact plane",
           .doc = "Lateral friction: of half-spaces (F_y, F_z) along the lateral tangent of the contact plane, of "
                  "finite elements "
                  "the sum over the nodes, each in its own plane",
           .column = true,
           .shown = true,
           .round_off = kOfForce},
          {.group = "contact",
           .symbol = "spin_moment",
           .unit = kNewtonMetres,
           .value = contact<&C::spin_moment>,
           .label = "spin moment",
           .name = "Moment about the contact normal",
           .doc = "Of the friction on the wheel, about the normal at the rigid contact point",
           .engine = HadBy::half_spaces,
           .shown = true,
           .round_off = kOfMoment}};
}

std::vector<ResultNumber> motion_numbers() {
  return {
      {.group = "contact",
       .symbol = "creepage_x",
       .unit = kPerMille,
       .value = contact<&C::creepage_x>,
       .label = "creepage",
       .name = "Longitudinal creepage (negative: driving)",
       .doc = "(V - ω r)/V with the rolling radius r",
       .column = true,
       .shown = true,
       .comparable = true,
       .round_off = kOfCreepage},
      {.group = "contact",
       .symbol = "creepage_y",
       .unit = kPerMille,
       .value = contact<&C::creepage_y>,
       .label = "lateral creepage",
       .name = "Lateral creepage",
       .doc = "Along the contact plane, positive where the wheel slips to the field side; finite elements: 0, the axle "
              "is guided",
       .column = true,
       .shown = true,
       .round_off = kOfCreepage},
      {.group = "contact",
       .symbol = "spin",
       .unit = kPerMetre,
       .value = contact<&C::spin_per_m>,
       .label = "spin",
       .name = "Spin",
       .doc = "Spin of the wheel about the contact normal, over V",
       .column = true,
       .shown = true,
       .comparable = true,
       .round_off = kOfSpin}};
}

std::vector<ResultNumber> approach_numbers() {
  return {
      {.group = "contact",
       .symbol = "approach",
       .unit = kMicrometres,
       .value = contact<&C::approach>,
       .label = "approach",
       .name = "Approach (finite elements: with the bending of rail and wheel)",
       .doc = "Of the bodies under the load; finite elements: descent of the axle in the static preload, bending of "
              "rail and wheel included. A line contact has none: its distant points come together without end",
       .column = true,
       .shown = true},
      {.group = "contact",
       .symbol = "penetration_max",
       .unit = kNanometres,
       .value = contact<&C::penetration_max>,
       .label = "penetration",
       .name = "Largest penetration",
       .doc = "Largest overlap of the surfaces during the run",
       .engine = HadBy::finite_elements,
       .shown = true},
      {.group = "contact",
       .symbol = "p_max_scatter",
       .unit = kShare,
       .value = contact<&C::p_max_scatter>,
       .label = "scatter of p_max",
       .name = "Scatter of p_max",
       .doc = "Standard deviation over the window, of the mean",
       .engine = HadBy::finite_elements}};
}

std::vector<ResultNumber> transient_numbers() {
  return {{.group = "contact",
           .symbol = "displacement_x",
           .unit = kMicrometres,
           .value = contact<&C::displacement_x>,
           .label = "displacement",
           .name = "Displacement of the wheel over the rail",
           .doc = "In the rolling direction, by a shift since its start",
           .engine = HadBy::half_spaces,
           .shown = true,
           .round_off = kOfApproach},
          {.group = "contact",
           .symbol = "displacement_y",
           .unit = kMicrometres,
           .value = contact<&C::displacement_y>,
           .label = "lateral displ.",
           .name = "Lateral displacement of the wheel over the rail",
           .doc = "Along the contact plane, by a shift since its start",
           .engine = HadBy::half_spaces,
           .shown = true,
           .round_off = kOfApproach},
          {.group = "contact",
           .symbol = "friction_work",
           .unit = kJoules,
           .value = contact<&C::friction_work>,
           .label = "friction work",
           .name = "Friction work since the start",
           .doc = "Of a transient: heat that friction has made on the way",
           .engine = HadBy::half_spaces,
           .column = true,
           .shown = true,
           .round_off = kOfWork}};
}

std::vector<ResultNumber> plastic_numbers() {
  return {{.group = "plastic",
           .symbol = "strain",
           .unit = kShare,
           .value = plastic<&PlasticSummary::strain>,
           .label = "plastic strain",
           .name = "Plastic strain",
           .doc = "Largest equivalent plastic strain of a point of either body at the end of the rolling",
           .engine = HadBy::finite_elements},
          {.group = "plastic",
           .symbol = "accumulated",
           .unit = kShare,
           .value = plastic<&PlasticSummary::accumulated>,
           .label = "accumulated plastic strain",
           .name = "Accumulated plastic strain",
           .doc = "Largest accumulated plastic strain of a point of either body at the end of the rolling",
           .engine = HadBy::finite_elements},
          {.group = "plastic",
           .symbol = "elements",
           .unit = kNone,
           .value = plastic<&PlasticSummary::elements>,
           .label = "yielded elements",
           .name = "Elements that yielded",
           .doc = "Of both bodies, with plastic strain at any of their points",
           .engine = HadBy::finite_elements},
          {.group = "plastic",
           .symbol = "work",
           .unit = kJoules,
           .value = plastic<&PlasticSummary::work>,
           .label = "plastic work",
           .name = "Plastic work",
           .doc = "Done on the plastic strains of both bodies",
           .engine = HadBy::finite_elements},
          {.group = "plastic",
           .symbol = "dissipated",
           .unit = kJoules,
           .value = plastic<&PlasticSummary::dissipated>,
           .label = "dissipated",
           .name = "Dissipated plastic work",
           .doc = "The plastic work less what the backstresses hold",
           .engine = HadBy::finite_elements}};
}

std::vector<ResultNumber> plastic_place_numbers() {
  return {{.group = "plastic",
           .symbol = "x",
           .unit = kMillimetres,
           .value = plastic<&PlasticSummary::x>,
           .label = "yielded at x",
           .name = "Largest accumulated plastic strain, x",
           .doc = "Along the rail from where the wheel was put on; none in the wheel",
           .engine = HadBy::finite_elements},
          {.group = "plastic",
           .symbol = "y",
           .unit = kMillimetres,
           .value = plastic<&PlasticSummary::y>,
           .label = "yielded at y",
           .name = "Largest accumulated plastic strain, y",
           .doc = "From the rigid contact point to the field side",
           .engine = HadBy::finite_elements},
          {.group = "plastic",
           .symbol = "depth",
           .unit = kMillimetres,
           .value = plastic<&PlasticSummary::depth>,
           .label = "yielded at depth",
           .name = "Largest accumulated plastic strain, depth",
           .doc = "Of the element's centre below the surface",
           .engine = HadBy::finite_elements}};
}

std::vector<ResultNumber> energy_numbers() {
  return {{.group = "energy",
           .symbol = "closure",
           .unit = kShare,
           .value = energy<&EnergySummary::closure>,
           .label = "energy closure",
           .name = "Energy closure",
           .doc = "Energy gained or lost by the time steps, of the largest energy turned over",
           .engine = HadBy::finite_elements},
          {.group = "energy",
           .symbol = "hourglass_share",
           .unit = kShare,
           .value = energy<&EnergySummary::hourglass_share>,
           .label = "hourglass energy",
           .name = "Hourglass energy",
           .doc = "Largest hourglass energy, of the strain energy",
           .engine = HadBy::finite_elements}};
}

std::vector<ResultNumber> time_numbers() {
  return {{.group = "run",
           .symbol = "wall",
           .unit = kSeconds,
           .value = run<&R::wall_s>,
           .label = "wall time",
           .name = "Wall time",
           .doc = "Of the solution, with its output",
           .column = true},
          {.group = "run",
           .symbol = "preload_wall",
           .unit = kSeconds,
           .value = run<&R::preload_wall_s>,
           .label = "preload",
           .name = "Wall time of the preload",
           .doc = "Share of the static preload in the wall time",
           .engine = HadBy::finite_elements},
          {.group = "run",
           .symbol = "output_wall",
           .unit = kSeconds,
           .value = run<&R::output_wall_s>,
           .label = "output",
           .name = "Wall time of the output",
           .doc = "Share of writing in the wall time",
           .engine = HadBy::finite_elements},
          {.group = "run",
           .symbol = "elements",
           .unit = kNone,
           .value = count<&R::elements>,
           .label = "elements",
           .name = "Elements",
           .doc = "Finite elements, or cells of the half-space's grid"},
          {.group = "run",
           .symbol = "nodes",
           .unit = kNone,
           .value = count<&R::nodes>,
           .label = "nodes",
           .name = "Nodes",
           .doc = "Of both bodies; half-space: 0"},
          {.group = "run",
           .symbol = "steps",
           .unit = kNone,
           .value = count<&R::steps>,
           .label = "steps",
           .name = "Time steps",
           .doc = "Half-space: of a transient, else 0; static cases: 0"}};
}

std::vector<ResultNumber> step_numbers() {
  return {{.group = "run",
           .symbol = "dt",
           .unit = kNanoseconds,
           .value = run<&R::dt_s>,
           .label = "time step",
           .name = "Time step",
           .doc = "Length of a step",
           .engine = HadBy::finite_elements},
          {.group = "run",
           .symbol = "stable_step",
           .unit = kNanoseconds,
           .value = run<&R::stable_step>,
           .label = "stable step",
           .name = "Stable step",
           .doc = "With selective mass scaling or local steps, if there are any",
           .engine = HadBy::finite_elements},
          {.group = "run",
           .symbol = "unscaled_step",
           .unit = kNanoseconds,
           .value = run<&R::unscaled_step>,
           .label = "unscaled step",
           .name = "Stable step of the real masses",
           .doc = "Without mass scaling and local steps",
           .engine = HadBy::finite_elements},
          {.group = "run",
           .symbol = "added_mass",
           .unit = kKilograms,
           .value = run<&R::added_mass>,
           .label = "added mass",
           .name = "Added mass",
           .doc = "By selective mass scaling of thin rows; 0: real masses",
           .engine = HadBy::finite_elements},
          {.group = "run",
           .symbol = "local_stages",
           .unit = kNone,
           .value = run<&R::local_stages>,
           .label = "stages",
           .name = "Stages of local steps",
           .doc = "The forces of the fine elements are evaluated so often a step; 1: one step for all",
           .engine = HadBy::finite_elements},
          {.group = "run",
           .symbol = "fine_elements",
           .unit = kNone,
           .value = run<&R::fine_elements>,
           .label = "fine elements",
           .name = "Elements in local steps",
           .doc = "0: one step for all",
           .engine = HadBy::finite_elements}};
}

std::vector<ResultNumber> effort_numbers() {
  return {{.group = "run",
           .symbol = "element_steps",
           .unit = kPerSecond,
           .value = run<&R::element_steps_per_s>,
           .label = "element steps",
           .name = "Element steps per second",
           .doc = "Elements times steps over the wall time without the preload",
           .engine = HadBy::finite_elements},
          {.group = "run",
           .symbol = "threads",
           .unit = kNone,
           .value = count<&R::threads>,
           .label = "threads",
           .name = "Threads",
           .doc = "That computed; results do not depend on them"},
          {.group = "run",
           .symbol = "peak_memory",
           .unit = kMegabytes,
           .value = run<&R::peak_memory_bytes>,
           .label = "memory",
           .name = "Largest memory",
           .doc = "Largest resident memory of the program"}};
}

template <auto Member>
ResultValue shakedown_number(const Summary& s) {
  return s.shakedown.least(Member);
}

/// Left out of summary.json, and of tables, where no strength is known.
std::vector<ResultNumber> shakedown_numbers() {
  using F = ShakedownFactors;
  const auto row = [](std::string_view symbol, ResultValue (*value)(const Summary&), std::string_view name,
                      std::string_view doc) {
    return ResultNumber{.group = kShakedownGroup,
                        .symbol = symbol,
                        .unit = kNone,
                        .value = value,
                        .label = symbol,
                        .name = name,
                        .doc = doc,
                        .column = true,
                        .shown = true,
                        .comparable = true};
  };
  return {row("first_yield", shakedown_number<&F::first_yield>, "Load factor to first yield",
              "What the elastic stress may be multiplied by until the first point yields, residual stress of the "
              "process included"),
          row("wandering", shakedown_number<&F::wandering>, "Load factor to shakedown, any traffic",
              "Elastic shakedown with residual stresses of depth alone: safe for every traffic, the limit itself where "
              "wheels wander sideways over more than the patch"),
          row("single_track", shakedown_number<&F::single_track>, "Load factor to shakedown, one track",
              "Elastic shakedown where every wheel runs in the same place; null where it was not asked for"),
          row("upper", shakedown_number<&F::upper>, "Upper bound of shakedown",
              "No load beyond it can shake down elastically, whatever the residual stress"),
          row("kinematic", shakedown_number<&F::kinematic>, "Load factor to ratchetting with hardening",
              "Elastic shakedown of a material with unlimited linear kinematic hardening")};
}

template <auto Member>
ResultValue of_layers(const Summary& s) {
  return layer_worst(s).*Member;
}

/// Left out of summary.json where there is no layer, or where nothing asks for its stress.
std::vector<ResultNumber> layer_numbers() {
  using L = LayerWorst;
  const auto row = [](std::string_view symbol, const ResultUnit& unit, ResultValue (*value)(const Summary&),
                      std::string_view label, std::string_view name, std::string_view doc) {
    return ResultNumber{.group = kLayersGroup,
                        .symbol = symbol,
                        .unit = unit,
                        .value = value,
                        .label = label,
                        .name = name,
                        .doc = doc,
                        .column = true,
                        .shown = true,
                        .comparable = true};
  };
  return {
      row("sigma_1", kMPa, of_layers<&L::sigma_1>, "layer σ₁", "Largest principal stress of the layers",
          "Residual stress of the process included"),
      row("share_of_tensile", kNone, of_layers<&L::share_of_tensile>, "layer σ₁/R_m", "Share of tensile strength",
          "Largest principal stress over the layer's tensile strength; at 1 a brittle layer cracks"),
      row("critical_flaw", kMillimetres, of_layers<&L::critical_flaw>, "critical flaw", "Critical flaw of the layers",
          "Depth of the smallest edge crack that runs under that stress, of K_Ic; counts while it is small against "
          "the layer's thickness"),
      row("interface_tension", kMPa, of_layers<&L::interface_tension>, "interface tension", "Tension at the interfaces",
          "Largest normal traction"),
      row("interface_shear", kMPa, of_layers<&L::interface_shear>, "interface shear", "Shear at the interfaces",
          "Largest shear traction"),
      row("interface_shear_range", kMPa, of_layers<&L::shear_range>, "interface Δτ", "Range of shear at the interfaces",
          "Of tau_xz over a passage: what drives a crack along the interface"),
      row("delamination", kNone, of_layers<&L::delamination>, "delamination", "Delamination index",
          "(tension over bond_tension)² + (shear over bond_shear)²; at 1 the bond gives way")};
}

template <auto Member>
constexpr auto damage = &at<&Summary::damage, Member>;

std::vector<ResultNumber> damage_numbers() {
  using D = DamageSummary;
  const auto row = [](std::string_view symbol, const ResultUnit& unit, ResultValue (*value)(const Summary&),
                      std::string_view label, std::string_view name, std::string_view doc, bool shown) {
    return ResultNumber{.group = "damage",
                        .symbol = symbol,
                        .unit = unit,
                        .value = value,
                        .label = label,
                        .name = name,
                        .doc = doc,
                        .column = shown,
                        .shown = shown,
                        .comparable = true};
  };
  return {row("t_gamma", kNewtons, damage<&D::t_gamma>, "T-gamma", "T-gamma",
              "|F_x creepage_x| + |F_y creepage_y|, of several patches their sum; J per m rolled", true),
          row("t_gamma_with_spin", kNewtons, damage<&D::t_gamma_with_spin>, "with spin", "T-gamma with spin",
              "And |M_z spin|", false),
          row("friction_energy", kJoulesPerMetre, damage<&D::friction_energy>, "friction energy",
              "Friction energy per distance", "Sum over the points of traction times slip times area, over the speed",
              false),
          row("motion_energy", kJoulesPerMetre, damage<&D::motion_energy>, "energy by motion",
              "Energy of the rigid motion per distance",
              "Tractions times the rigid slip of the cells, over the speed: T-gamma with spin and the rolling radii of "
              "the rows, which a spin leaves out. In steady rolling it is the friction energy. Half-spaces",
              false),
          row("rcf_damage", kNone, damage<&D::rcf_damage>, "RCF damage", "RCF damage of a passage",
              "Burstow's function of a patch's T-gamma for R260, of several the largest; break points 15, 65 and 175 "
              "N; 1 is a visible crack, below zero "
              "wear removes",
              false),
          row("brr_wear", kWornArea, damage<&D::brr_wear>, "BRR wear", "BRR wear",
              "Area worn off over distance, of T-gamma and the wheel's diameter", false),
          row("usfd_depth", kNanometres, damage<&D::usfd_depth>, "USFD wear", "Wear of a passage, USFD",
              "Deepest, R8T wheel on 900A rail, dry, laboratory", true),
          row("kth_depth", kNanometres, damage<&D::kth_depth>, "KTH wear", "Wear of a passage, KTH map",
              "Deepest, Jendel's map for dry laboratory surfaces over the rail's hardness", false),
          row("archard_depth", kNanometres, damage<&D::archard_depth>, "Archard wear", "Wear of a passage, Archard",
              "Deepest, with the rail's wear_coefficient over its hardness", false),
          row("temperature_rise", kKelvins, damage<&D::temperature_rise>, "flash temperature", "Flash temperature",
              "Largest rise of the surfaces' temperature in the patch", true),
          row("surface_fatigue", kNone, damage<&D::surface_fatigue>, "FI_surf", "Surface fatigue index",
              "Utilised friction less k over p_max; above zero surface fatigue is to be expected", false),
          row("local_fatigue", kNone, damage<&D::local_fatigue>, "local FI", "Local fatigue index",
              "Largest |q|/p - k/p of a point", false)};
}

/// What stands beside the flash temperature.
std::vector<ResultNumber> heat_numbers() {
  using D = DamageSummary;
  return {{.group = "damage",
           .symbol = "temperature_rise_lower",
           .unit = kKelvins,
           .value = damage<&D::temperature_rise_lower>,
           .label = "flash temperature, at least",
           .name = "Flash temperature, lower bound",
           .doc = "With the bodies as half-spaces of their most effusive material"},
          {.group = "damage",
           .symbol = "temperature_rise_upper",
           .unit = kKelvins,
           .value = damage<&D::temperature_rise_upper>,
           .label = "flash temperature, at most",
           .name = "Flash temperature, upper bound",
           .doc = "With the bodies as half-spaces of their least effusive material, whichever layer that is"},
          {.group = "damage",
           .symbol = "austenitisation",
           .unit = kNone,
           .value = damage<&D::austenitisation>,
           .label = "austenitisation",
           .name = "Share of austenitisation",
           .doc = "Flash temperature over the austenitisation_rise of the rail's running surface; from 1 on martensite "
                  "can form; null where the case does not give it",
           .shown = true}};
}

/// The stresses that tables hold, in their order.
struct StressColumn {
  std::string_view body, zone, measure, number;
};
constexpr StressColumn kStressColumns[] = {
    {"rail", "surface", "von_mises_max", "value"},    {"rail", "surface", "sigma1_max", "value"},
    {"rail", "subsurface", "von_mises_max", "value"}, {"rail", "subsurface", "von_mises_max", "depth"},
    {"rail", "layer", "von_mises_max", "value"},      {"rail", "layer", "sigma1_max", "value"},
    {"rail", "interface", "von_mises_max", "value"},  {"rail", "matrix", "von_mises_max", "value"}};

template <class Row>
const Row& row_of(const std::vector<Row>& rows, std::string_view key) {
  return *std::find_if(rows.begin(), rows.end(), [&](const Row& r) { return r.key == key; });
}

bool of_strength(const ResultNumber& n) { return n.group == kShakedownGroup || n.group == kLayersGroup; }

ResultColumn column_of(const ResultNumber& n) {
  const bool same = n.unit.factor == n.unit.column_factor;
  return {.name = n.column_name(),
          .path = n.path(),
          .factor = n.unit.column_factor,
          .title = std::string(n.label),
          .unit = same ? n.unit.shown : "",
          .shown_unit = n.unit,
          .doc = n.name,
          .of_stress = of_strength(n),
          .of_strength = of_strength(n),
          .of_all_patches = n.of_all_patches,
          .comparable = n.comparable,
          .digits = n.digits};
}

ResultColumn column_of(const StressColumn& c) {
  const StressZone& zone = row_of(stress_zones(), c.zone);
  const StressMeasure& measure = row_of(stress_measures(), c.measure);
  const StressNumber& number = row_of(stress_numbers(), c.number);
  const bool value = c.number == "value";
  return {
      .name = fmt::format("{}_{}_{}{}{}", c.body, c.zone, measure.symbol, value ? "" : fmt::format("_{}", c.number),
                          number.unit.column_ending),
      .path = fmt::format("/stress/{}/{}/{}/{}{}", c.body, c.zone, c.measure, c.number, number.unit.key_ending),
      .factor = number.unit.column_factor,
      .title = fmt::format("{} {} {}{}", c.body, measure.name, zone.name, value ? "" : ", " + std::string(c.number)),
      .unit = number.unit.shown,
      .shown_unit = number.unit,
      .doc = number.doc,
      .of_stress = true};
}

}  // namespace

std::string ResultNumber::key() const { return fmt::format("{}{}", symbol, unit.key_ending); }
std::string ResultNumber::path() const { return fmt::format("{}{}/{}", group.empty() ? "" : "/", group, key()); }
std::string ResultNumber::column_name() const {
  const std::string_view prefix = group == kShakedownGroup ? "shakedown_" : group == kLayersGroup ? "layers_" : "";
  return fmt::format("{}{}{}", prefix, symbol, unit.column_ending);
}

const std::vector<ResultNumber>& result_numbers() {
  static const std::vector<ResultNumber> numbers = [] {
    std::vector<ResultNumber> out{
        {.group = "",
         .symbol = "position",
         .unit = kMillimetres,
         .value = at<&Summary::position>,
         .label = "position",
         .name = "Position of the wheel",
         .doc =
             "Of the axle along the rail; half-space: the case's last one, of a transient what it has rolled, static "
             "cases 0"}};
    for (const auto& part :
         {traction_numbers(), extent_numbers(), force_numbers(), contact_plane_numbers(), motion_numbers(),
          approach_numbers(), transient_numbers(), damage_numbers(), heat_numbers(), shakedown_numbers(),
          layer_numbers(), plastic_numbers(), plastic_place_numbers(), energy_numbers(), time_numbers(), step_numbers(),
          effort_numbers()})
      out.insert(out.end(), part.begin(), part.end());
    return out;
  }();
  return numbers;
}

const std::vector<StressBody>& stress_bodies() {
  static const std::vector<StressBody> bodies{{"rail", &Summary::rail}, {"wheel", &Summary::wheel}};
  return bodies;
}

const std::vector<StressZone>& stress_zones() {
  using S = StressSummary;
  static const std::vector<StressZone> zones{
      {"surface", &S::surface, "at the surface", "At the running surface, from its tractions and strains"},
      {"subsurface", &S::subsurface, "below the surface",
       "Deeper than a tenth of the patch's shorter semi-axis, or half a thinner surface layer; finite elements: and "
       "than "
       "one element edge"},
      {"layer", &S::layer, "in the layers", "In the layers, from their own points"},
      {"interface", &S::interface, "at the interfaces", "On either side of every border between materials"},
      {"matrix", &S::matrix, "in the matrix", "Below all layers"}};
  return zones;
}

const std::vector<StressMeasure>& stress_measures() {
  static const std::vector<StressMeasure> measures{{"von_mises_max", "von_mises", &StressPair::von_mises, "von Mises"},
                                                   {"sigma1_max", "sigma_1", &StressPair::sigma1, "σ₁"}};
  return measures;
}

const std::vector<StressNumber>& stress_numbers() {
  static const std::vector<StressNumber> numbers{
      {"value", kMPa, &StressMaximum::value, "Largest value"},
      {"x", kMillimetres, &StressMaximum::x, "Its place from the axle in the rolling direction"},
      {"y", kMillimetres, &StressMaximum::y, "Its place from the rigid contact point towards the field side"},
      {"depth", kMillimetres, &StressMaximum::depth, "Its depth below the surface along the normal"}};
  return numbers;
}

std::vector<ResultColumn> table_columns() {
  std::vector<ResultColumn> contact_columns, strength_columns, run_columns;
  for (const ResultNumber& n : result_numbers())
    if (n.column)
      (n.group == "run" ? run_columns : of_strength(n) ? strength_columns : contact_columns).push_back(column_of(n));
  std::vector<ResultColumn> out = std::move(contact_columns);
  for (const StressColumn& c : kStressColumns) out.push_back(column_of(c));
  out.insert(out.end(), strength_columns.begin(), strength_columns.end());
  out.insert(out.end(), run_columns.begin(), run_columns.end());
  return out;
}

const ResultNumber* find_number(std::string_view path) {
  const std::vector<ResultNumber>& all = result_numbers();
  const auto found = std::find_if(all.begin(), all.end(), [&](const ResultNumber& n) { return n.path() == path; });
  return found == all.end() ? nullptr : &*found;
}

double round_off_size(const RoundOff& row, const std::function<double(std::string_view)>& number) {
  double size = row.share;
  for (const std::string_view path : {row.of, row.times})
    if (!path.empty()) size *= std::abs(number(path));
  return std::isfinite(size) ? size : 0;
}

double shown_value(const ResultNumber& row, const Summary& s) {
  const auto number = [&](const ResultNumber& n) {
    return std::visit([](auto v) { return static_cast<double>(v); }, n.value(s));
  };
  const double value = number(row);
  const auto at = [&](std::string_view path) { return number(*find_number(path)); };
  return row.round_off.share > 0 && std::abs(value) <= round_off_size(row.round_off, at) ? 0 : value;
}

double shown_beside_limit(double value, double limit) {
  constexpr double kTelling = 1e-6;
  return std::abs(value) < kTelling * limit ? 0 : value;
}

std::string fixed(double value, int decimals) {
  const std::string text = fmt::format("{:.{}f}", value, decimals);
  const bool zero = text.find_first_of("123456789") == std::string::npos;
  return zero && text.starts_with('-') ? text.substr(1) : text;
}

std::string significant(double value, int digits) {
  if (!std::isfinite(value)) return "-";
  const double size = std::abs(value);
  if (size == 0) return "0";
  if (size < 1e-4 || size >= 1e7) return fmt::format("{:.{}g}", value, digits);
  const int decimals = std::max(0, digits - 1 - static_cast<int>(std::floor(std::log10(size))));
  return fmt::format("{:.{}f}", value, decimals);
}

namespace {

std::string in_unit(const ResultUnit& unit, double value_si, const std::string& number) {
  const auto bar = unit.shown.find('|');
  if (bar != std::string_view::npos)
    return std::string(value_si == 0 ? unit.shown.substr(0, bar) : unit.shown.substr(bar + 1));
  return fmt::format("{}{}{}", number, unit.shown.empty() ? "" : " ", unit.shown);
}

}  // namespace

std::string with_unit(const ResultUnit& unit, double value_si, int digits) {
  return in_unit(unit, value_si, significant(unit.factor * value_si, digits));
}

std::string limit_text(const ResultUnit& unit, double value_si) {
  return in_unit(unit, value_si, fmt::format("{:.6g}", unit.factor * value_si));
}

}  // namespace railstrata
