#include "result/result_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "result/result_rows.hpp"

namespace railstrata {
namespace {

using namespace unit;
using namespace result_rows;
using C = ContactSummary;
using P = PatchMeasures;
using R = RunSummary;

template <auto Member>
double count(const Summary& s) {
  return static_cast<double>(s.run.*Member);
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
constexpr double kNoise = 1e-7;
constexpr RoundOff kOfForce{kNoise, kNormalForce}, kOfMoment{kNoise, kNormalForce, "/contact/patch_length_m"},
    kOfPressure{kNoise, "/contact/p_max_Pa"}, kOfApproach{kNoise, "/contact/approach_m"},
    kOfWork{kNoise, kNormalForce, "/contact/approach_m"};
constexpr RoundOff kOfCreepage{1e-10}, kOfSpin{1e-8}, kOfAngle{1e-9};

constexpr const char* kErrorEnding = "_error";

std::vector<ResultNumber> field_numbers() {
  return {
      row("p_max", kMPa, patch<&P::p_max>, "p_max", "Largest pressure p",
          "Top of the parabola through the largest pressure and its neighbours", kMain),
      row("q_max", kMPa, patch<&P::q_max>, "q_max", "Largest shear |q|",
          "Largest magnitude of the tangential traction; in rolling contact it is at the front of slip", kMain,
          kOfPressure),
      row("q_max_point", kMPa, patch<&P::q_max_point>, "q_max of a point", "Largest shear |q| of a point",
          "Misses the cusp at the front of slip; use it to compare elements and cells of the same size", kColumn,
          kOfPressure),
      row("patch_length", kMillimetres, patch<&P::length>, "length", "Patch length (along x)",
          "Longest chord in the rolling direction, between the edges where p² extrapolates to zero", kMain),
      row("patch_width", kMillimetres, patch<&P::width>, "width", "Patch width (along y)",
          "Longest chord across the rolling direction; null for a line contact", kMain),
      row("patch_area", kSquareMillimetres, patch<&P::area>, "area", "Patch area",
          "Area between the edges of the columns' chords", kMain),
      row("slip_area_fraction", kShare, patch<&P::slip_area_fraction>, "slip area", "Slip area / patch area",
          "Area of the slipping points over the area of the points in contact; finite elements: mean over the "
          "window. Null without friction (half-space)",
          kMain),
      row("F_x", kKilonewtons, contact<&C::F_x>, "F_x", "F_x on the wheel",
          "Contact force on the wheel, rolling direction; positive drives", kMain | kOfAll, kOfForce),
      row("F_y", kKilonewtons, contact<&C::F_y>, "F_y", "F_y on the wheel",
          "Contact force on the wheel towards the field side, model frame", kColumn | kShown | kOfAll, kOfForce),
      row("F_z", kKilonewtons, contact<&C::F_z>, "F_z", "F_z on the wheel", "Contact force on the wheel, upwards",
          kMain | kOfAll),
      row("contact_angle", kDegrees, contact<&C::contact_angle>, "contact angle", "Contact angle",
          "Angle of the plane of the patch, the mean over the overlap of the profiles", kFile, kOfAngle),
      row("normal_force", kKilonewtons, contact<&C::normal_force>, "normal force", "Normal force in the contact plane",
          "Component of (F_y, F_z) along the normal of the contact plane", kMain),
      row("lateral_force", kKilonewtons, contact<&C::lateral_force>, "lateral force",
          "Lateral force in the contact plane",
          "Lateral friction. Half-spaces: component of (F_y, F_z) along the lateral tangent of the contact plane; "
          "finite elements: sum over the nodes, each in its own plane",
          kColumn | kShown, kOfForce),
      row("spin_moment", kNewtonMetres, contact<&C::spin_moment>, "spin moment", "Moment about the contact normal",
          "Moment of the friction on the wheel about the normal of the plane, at its place", kShown, kOfMoment)};
}

std::vector<ResultNumber> motion_numbers() {
  return {
      row("creepage_x", kPerMille, contact<&C::creepage_x>, "creepage", "Longitudinal creepage (negative: driving)",
          "(V - ω r)/V with the rolling radius r", kMain, kOfCreepage),
      row("creepage_y", kPerMille, contact<&C::creepage_y>, "lateral creepage", "Lateral creepage",
          "Along the contact plane, positive where the wheel slips to the field side", kColumn | kShown, kOfCreepage),
      row("spin", kPerMetre, contact<&C::spin_per_m>, "spin", "Spin",
          "Rotation of the wheel about the contact normal, divided by V", kMain, kOfSpin),
      row("approach", kMicrometres, contact<&C::approach>, "approach",
          "Approach (finite elements: with the bending of rail and wheel)",
          "Approach of the bodies under the load; finite elements: descent of the axle in the static preload, "
          "including bending of rail and wheel. Null for a line contact, whose approach has no finite value",
          kColumn | kShown),
      row("bending_stretch", kPerMille, contact<&C::bending_stretch>, "bending stretch",
          "Strain of the running surface by the bending of a rail on its track",
          "Beyond that of a rail whose foot is held; part of the creepage along x, which would be larger by it without "
          "bending. Sections on [track]; else null",
          kShown | kBem, kOfCreepage),
      row("penetration_max", kNanometres, contact<&C::penetration_max>, "penetration", "Largest penetration",
          "Largest overlap of the surfaces during the run", kShown | kFem),
      row("p_max_scatter", kShare, contact<&C::p_max_scatter>, "scatter of p_max", "Scatter of p_max",
          "Standard deviation over the window, divided by the mean", kFem),
      row("displacement_x", kMicrometres, contact<&C::displacement_x>, "displacement",
          "Displacement of the wheel over the rail", "In the rolling direction, since the start of the shift",
          kShown | kBem, kOfApproach),
      row("displacement_y", kMicrometres, contact<&C::displacement_y>, "lateral displ.",
          "Lateral displacement of the wheel over the rail", "Along the contact plane, since the start of the shift",
          kShown | kBem, kOfApproach),
      row("friction_work", kJoules, contact<&C::friction_work>, "friction work", "Friction work since the start",
          "Heat produced by friction in a transient", kColumn | kShown | kBem, kOfWork)};
}

template <auto Member>
constexpr auto error_of = &at<&Summary::contact, &C::error, Member>;

/// Each has the symbol of its number with kErrorEnding.
std::vector<ResultNumber> error_numbers() {
  using E = ContactErrors;
  return {
      row("p_max_error", kMPa, error_of<&E::p_max>, "± p_max", "Error bar of the largest pressure",
          "Half-space: half width of the error due to the cell size, and in `bem` to the points of profiles; 95 % of "
          "cases lie within. Null, as all error bars, for transients, line contacts, several patches (`bem`: of points "
          "alone), a given approach, whole cells at the leading edge, an edge in the patch. Finite elements without "
          "run.positions: change from the measuring window before",
          kColumn),
      row("q_max_error", kMPa, error_of<&E::q_max>, "± q_max", "Error bar of the largest shear", "As for p_max",
          kColumn),
      row("slip_area_fraction_error", kShare, error_of<&E::slip_area_fraction>, "± slip area",
          "Error bar of the slip area", "As for p_max", kColumn),
      row("F_x_error", kKilonewtons, error_of<&E::F_x>, "± F_x", "Error bar of F_x",
          "As for p_max; null where the case gives the force", kColumn),
      row("F_y_error", kKilonewtons, error_of<&E::F_y>, "± F_y", "Error bar of F_y",
          "As for p_max; null where the case gives the lateral force", kColumn),
      row("creepage_x_error", kPerMille, error_of<&E::creepage_x>, "± creepage",
          "Error bar of the longitudinal creepage", "As for p_max; null where the case gives the creepage", kColumn),
      row("creepage_y_error", kPerMille, error_of<&E::creepage_y>, "± lateral creepage",
          "Error bar of the lateral creepage", "As for p_max; null where no lateral force is given", kColumn)};
}

std::vector<ResultNumber> plastic_numbers() {
  return {row("strain", kShare, plastic<&PlasticSummary::strain>, "plastic strain", "Plastic strain",
              "Largest equivalent plastic strain of a point of either body at the end of the rolling", kFem),
          row("accumulated", kShare, plastic<&PlasticSummary::accumulated>, "accumulated plastic strain",
              "Accumulated plastic strain",
              "Largest accumulated plastic strain of a point of either body at the end of the rolling", kFem),
          row("elements", kNone, plastic<&PlasticSummary::elements>, "yielded elements", "Elements that yielded",
              "Elements of both bodies with plastic strain at any of their points", kFem),
          row("work", kJoules, plastic<&PlasticSummary::work>, "plastic work", "Plastic work",
              "Work done on the plastic strains of both bodies", kFem),
          row("dissipated", kJoules, plastic<&PlasticSummary::dissipated>, "dissipated", "Dissipated plastic work",
              "Plastic work minus the energy stored by the backstresses", kFem),
          row("x", kMillimetres, plastic<&PlasticSummary::x>, "yielded at x", "Largest accumulated plastic strain, x",
              "Along the rail, from the start of the wheel; null in the wheel", kFem),
          row("y", kMillimetres, plastic<&PlasticSummary::y>, "yielded at y", "Largest accumulated plastic strain, y",
              "From the rigid contact point to the field side", kFem),
          row("depth", kMillimetres, plastic<&PlasticSummary::depth>, "yielded at depth",
              "Largest accumulated plastic strain, depth", "Depth of the element's centre below the surface", kFem)};
}

template <auto Member>
constexpr auto on_way = &at<&Summary::passage, Member>;

std::vector<ResultNumber> passage_numbers() {
  using W = PassageSummary;
  constexpr unsigned marks = kMain | kFem;
  return {
      row("F_z_max", kKilonewtons, on_way<&W::F_z_max>, "F_z, largest", "Largest wheel force on the way",
          "From the end of run.run_up, over all rows of history.csv", marks),
      row("F_z_max_position", kMillimetres, on_way<&W::F_z_max_position>, "at position",
          "Position of the wheel at its largest wheel force", "Of the axle along the rail", marks),
      row("F_z_min", kKilonewtons, on_way<&W::F_z_min>, "F_z, smallest", "Smallest wheel force on the way",
          "From the end of run.run_up; 0: the wheel left the rail", marks),
      row("F_z_min_position", kMillimetres, on_way<&W::F_z_min_position>, "at position",
          "Position of the wheel at its smallest wheel force", "Of the axle along the rail", marks),
      row("p_max_on_way", kMPa, on_way<&W::p_max>, "p_max on the way", "Largest pressure on the way",
          "At the nodes, without interpolating the peak between them", marks),
      row("p_max_position", kMillimetres, on_way<&W::p_max_position>, "at position",
          "Position of the wheel at the largest pressure", "Of the axle along the rail", marks),
      row("patch_parts", kCount, on_way<&W::parts>, "parts of the patch", "Most parts of the patch on the way",
          "2: the wheel bridged a hollow; null if only the sleepers vary along the rail", marks),
      row("von_mises_on_way", kMPa, on_way<&W::von_mises>, "von Mises on the way",
          "Largest von Mises stress of the rail on the way", "At the centres of elements around the wheel", marks),
      row("von_mises_x", kMillimetres, on_way<&W::von_mises_x>, "at x",
          "Position of the largest von Mises stress along the rail", "From the start of the wheel", marks),
      row("von_mises_depth", kMillimetres, on_way<&W::von_mises_depth>, "at depth",
          "Depth of the largest von Mises stress", "Below the running surface", marks),
      row("P1", kKilonewtons, on_way<&W::P1>, "P1", "Largest force within 2 ms of a dip's tip", "On a track", marks),
      row("P2", kKilonewtons, on_way<&W::P2>, "P2", "Largest mean of 2 ms, from 2.2 ms after the tip on",
          "On a track; null where the path ends before", marks),
      row("P1_jenkins_low", kKilonewtons, on_way<&W::P1_jenkins_low>, "P1 by Jenkins, low",
          "P1 by Jenkins' formula with 0.4 m of rail", "Lower end of the expected range (docs/track.md)",
          kShown | kFem),
      row("P1_jenkins_high", kKilonewtons, on_way<&W::P1_jenkins_high>, "P1 by Jenkins, high",
          "P1 by Jenkins' formula with 1 m of rail", "Upper end of the expected range", kShown | kFem),
      row("P2_jenkins_low", kKilonewtons, on_way<&W::P2_jenkins_low>, "P2 by Jenkins, low",
          "P2 by Jenkins' formula less its errors", "Lower end of the expected range", kShown | kFem),
      row("P2_jenkins_high", kKilonewtons, on_way<&W::P2_jenkins_high>, "P2 by Jenkins, high",
          "P2 by Jenkins' formula with its errors", "Upper end of the expected range", kShown | kFem),
      row("passing_frequency", kHertz, on_way<&W::passing_frequency>, "passing frequency",
          "Speed divided by the wavelength of rail or wheel",
          "For corrugation and out-of-round wheels; null without such waves", marks),
      row("F_z_passing", kKilonewtons, on_way<&W::F_z_passing>, "F_z at it",
          "Amplitude of the wheel force at the passing frequency",
          "Over the last whole waves of one sleeper spacing, or over eight waves on a fixed foot", marks),
      row("interface_opening_max", kMicrometres, on_way<&W::interface_opening>, "interface opening",
          "Largest opening of an unbonded interface on the way", "At its nodes; null where all layers are bonded",
          marks),
      row("interface_slip_max", kMicrometres, on_way<&W::interface_slip>, "interface slip",
          "Largest shift along an unbonded interface on the way",
          "At its nodes, including open ones; null where all layers are bonded", marks)};
}

std::vector<ResultNumber> energy_numbers() {
  return {row("closure", kShare, energy<&EnergySummary::closure>, "energy closure", "Energy closure",
              "Energy gained or lost by the time stepping, over the largest energy exchanged", kFem),
          row("hourglass_share", kShare, energy<&EnergySummary::hourglass_share>, "hourglass energy",
              "Hourglass energy", "Largest hourglass energy over the strain energy", kFem)};
}

std::vector<ResultNumber> run_numbers() {
  return {
      row("wall", kSeconds, run<&R::wall_s>, "wall time", "Wall time", "Time for the solution and its output", kColumn),
      row("preload_wall", kSeconds, run<&R::preload_wall_s>, "preload", "Wall time of the preload",
          "Part of the wall time spent on the static preload", kFem),
      row("output_wall", kSeconds, run<&R::output_wall_s>, "output", "Wall time of the output",
          "Part of the wall time spent on writing", kFem),
      row("elements", kCount, count<&R::elements>, "elements", "Elements",
          "Finite elements, or cells of the half-space's grid"),
      row("nodes", kCount, count<&R::nodes>, "nodes", "Nodes", "Nodes of both bodies; half-space: 0"),
      row("steps", kCount, count<&R::steps>, "steps", "Time steps",
          "Half-space: steps of a transient, otherwise 0; static cases: 0"),
      row("dt", kNanoseconds, run<&R::dt_s>, "time step", "Time step", "Length of a step", kFem),
      row("stable_step", kNanoseconds, run<&R::stable_step>, "stable step", "Stable step",
          "With selective mass scaling, where used", kFem),
      row("unscaled_step", kNanoseconds, run<&R::unscaled_step>, "unscaled step", "Stable step of the real masses",
          "Without mass scaling", kFem),
      row("added_mass", kKilograms, run<&R::added_mass>, "added mass", "Added mass",
          "Added by selective mass scaling of thin rows; 0: real masses", kFem),
      row("element_steps", kPerSecond, run<&R::element_steps_per_s>, "element steps", "Element steps per second",
          "Elements times steps, divided by the wall time without the preload", kFem),
      row("threads", kCount, count<&R::threads>, "threads", "Threads", "Threads used; results do not depend on them"),
      row("peak_memory", kMegabytes, run<&R::peak_memory_bytes>, "memory", "Largest memory",
          "Largest resident memory of the program")};
}

}  // namespace

std::string ResultNumber::path() const { return fmt::format("{}{}/{}", group.empty() ? "" : "/", group, key()); }
std::string ResultNumber::column_name() const {
  const std::string_view prefix = group == kShakedownGroup   ? "shakedown_"
                                  : group == kLayersGroup    ? "layers_"
                                  : group == kLifeGroup      ? "life_"
                                  : group == kCrackGroup     ? "crack_"
                                  : group == kInterfaceGroup ? "interface_"
                                                             : "";
  return fmt::format("{}{}{}", prefix, symbol, unit.column_ending);
}

bool ResultColumn::is_error_bar() const { return symbol().ends_with(kErrorEnding); }

const std::vector<ResultNumber>& result_numbers() {
  static const std::vector<ResultNumber> numbers = [] {
    std::vector<ResultNumber> out;
    const auto add = [&](std::string_view group, const std::vector<ResultNumber>& numbers_of_group) {
      for (const ResultNumber& number : numbers_of_group) {
        out.push_back(number);
        out.back().group = group;
      }
    };
    add("", {row("position", kMillimetres, at<&Summary::position>, "position", "Position of the wheel",
                 "Position of the axle along the rail; half-space: the last of the case's positions, in a transient "
                 "the rolled distance; static cases: 0")});
    add("contact", field_numbers());
    add("contact", motion_numbers());
    add("contact", error_numbers());
    add("damage", damage_numbers());
    add(kShakedownGroup, shakedown_numbers());
    add(kLayersGroup, layer_numbers());
    add(kLifeGroup, life_numbers());
    add(kCrackGroup, crack_numbers());
    add(kInterfaceGroup, interface_numbers());
    add(kPassageGroup, passage_numbers());
    add("plastic", plastic_numbers());
    add("energy", energy_numbers());
    add("run", run_numbers());
    return out;
  }();
  return numbers;
}

const ResultNumber* find_number(std::string_view path) {
  const std::vector<ResultNumber>& all = result_numbers();
  const auto found = std::find_if(all.begin(), all.end(), [&](const ResultNumber& n) { return n.path() == path; });
  return found == all.end() ? nullptr : &*found;
}

const ResultNumber* find_error_bar(const ResultNumber& number) {
  const std::vector<ResultNumber>& all = result_numbers();
  const auto found = std::find_if(all.begin(), all.end(), [&](const ResultNumber& n) {
    return n.group == number.group && n.symbol == number.symbol + kErrorEnding;
  });
  return found == all.end() ? nullptr : &*found;
}

double round_off_size(const RoundOff& row, const std::function<double(std::string_view)>& number) {
  double size = row.share;
  for (const std::string_view path : {row.of, row.times})
    if (!path.empty()) size *= std::abs(number(path));
  return std::isfinite(size) ? size : 0;
}

double shown_value(const ResultNumber& row, const Summary& s) {
  const double value = row.value(s);
  const auto at = [&](std::string_view path) { return find_number(path)->value(s); };
  return row.round_off.share > 0 && std::abs(value) <= round_off_size(row.round_off, at) ? 0 : value;
}

double shown_beside_limit(double value, double limit) {
  constexpr double kNegligible = 1e-6;
  return std::abs(value) < kNegligible * limit ? 0 : value;
}

}  // namespace railstrata
