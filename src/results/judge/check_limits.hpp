#pragma once
// The checks and warnings of a result: their limits and their words. This is the only place of either: both engines'
// checks, the comparison of the engines, the study, the page, the screen, docs/results-reference.md and
// `railstrata info --schema --results`, which tools read, all take them from here.
#include <array>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string_view>

#include "material/strain_claim.hpp"
#include "record/unit.hpp"

namespace railstrata {

enum class CheckKind {
  run,      ///< asked of a single result; the exit code depends on it
  engines,  ///< asked of a finite element result against the half-space result of its case: |a/b - 1|
  warning,  ///< a sound result that is not plausible: value above limit; no check depends on it
  note      ///< reported without a limit
};

/// Marks of a warning: its own_text, its takes_back.
enum WarningMark : unsigned { kOwnText = 1, kTakesBack = 2 };

/// A check holds where value <= limit. A limit that is NaN is not asked of that engine, or comes from the case.
struct CheckRow {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

  std::string_view key;   ///< its name in summary.json
  std::string_view name;  ///< for people
  std::string_view what;  ///< what the value is, or the warning's text
  CheckKind kind = CheckKind::run;
  Unit unit = unit::kShare;
  double fem_limit = kNone, bem_limit = kNone;  ///< SI; of kind `engines` the same
  std::string_view case_option{};               ///< where the limit comes from, if from the case
  std::string_view advice{};                    ///< of a warning: what follows, what to do
  bool own_text = false;    ///< of a warning: its text in the result names this case's numbers and is shown
  bool takes_back = false;  ///< of a warning: the stresses are not those of the case; no "it lasts" stands beside it

  /// Limits of either engine, SI, or the option of the case that gives them.
  struct Limits {
    double fem = kNone, bem = kNone;
    std::string_view of_case{};
  };
  static constexpr CheckRow of_run(std::string_view key, std::string_view name, std::string_view what,
                                   const Limits& limits, const Unit& unit = unit::kShare) {
    return {key, name, what, CheckKind::run, unit, limits.fem, limits.bem, limits.of_case};
  }
  static constexpr CheckRow of_engines(std::string_view key, std::string_view name, std::string_view what,
                                       double limit) {
    return {key, name, what, CheckKind::engines, unit::kShare, limit, limit};
  }
  static constexpr CheckRow warning(std::string_view key, std::string_view name, std::string_view what,
                                    std::string_view advice, const Limits& limits, const Unit& unit = unit::kShare,
                                    unsigned marks = 0) {
    CheckRow row{key, name, what, CheckKind::warning, unit, limits.fem, limits.bem, limits.of_case, advice};
    row.own_text = marks & kOwnText;
    row.takes_back = marks & kTakesBack;
    return row;
  }
  static constexpr CheckRow note(std::string_view key, std::string_view name, std::string_view what) {
    return {key, name, what, CheckKind::note, unit::kNone};
  }
};

/// Von Mises stress above which a linear elastic rail is no longer to be believed, Pa: a round figure of the order of
/// the 0.2 % proof stress of common as-rolled rail steels (grade R260). Heat-treated grades stand more, so it is a
/// warning, not a check.
inline constexpr double kCommonRailYield = 500e6;

/// A cell or element, of the patch's shorter axis: where results suffer, and where they mean nothing. Reasons and
/// figures of this and of the following limits: docs/checks.md.
inline constexpr double kCellOfPatch = 0.1, kUnresolvedPatch = 0.35;
inline constexpr double kLargestOfLayer = 0.1;  // 3 mm at 4 E0: 2 % of p_max
inline constexpr double kLargestAngleSpanned = 20 * std::numbers::pi / 180;
inline constexpr double kLargestOfRadius = 0.05;
inline constexpr double kLargestOfEdgeDistance = 0.5;
/// Largest change of the contact's curvature by other patches, relative to it.
inline constexpr double kLargestBending = 0.02;
/// Elastic shear of a third-body layer, of half the patch's shorter axis: where what faces each other has moved apart
/// by as much as linear theory errs elsewhere, and where the model's pairs mean nothing.
inline constexpr double kLargestFilmShear = 0.05, kFilmShearsAway = 0.5;
/// m, below its crest a flange has its working face. [EN15313]
inline constexpr double kFlangeTip = 2e-3;
/// Share of the wear by Jendel's map from outside it.
inline constexpr double kLargestOutsideMap = 0.05;
/// m, of wear in one track.
inline constexpr double kGroove = 0.01e-3;
/// Share of p_max: a tension maximum at the edge of the searched region is reported only above it.
inline constexpr double kReportedTension = 0.01;

inline constexpr std::array kCheckRows{
    CheckRow::of_run("preload_residual", "Static equilibrium", "residual of the preload, relative to the load",
                     {.of_case = "run.preload_tolerance"}, unit::kNone),
    CheckRow::of_run("F_z_relative_to_weight", "Vertical load", "F_z of the contact against the weight on the wheel",
                     {.fem = 5e-3, .bem = 1e-4}),
    CheckRow::of_run("traction_coefficient_reached", "Traction",
                     "F_x/F_z reached against the wanted traction coefficient", {.fem = 1e-2, .bem = 1e-3}),
    CheckRow::of_run("lateral_traction_reached", "Lateral traction",
                     "lateral friction in the contact plane over the weight against the wanted coefficient",
                     {.fem = 2e-2, .bem = 1e-3}),
    CheckRow::of_run("penetration_over_approach", "Penetration", "largest overlap of the bodies, of Hertz’s approach",
                     {.fem = 1e-2}),
    CheckRow::of_run("energy_closure", "Energy closure",
                     "energy gained or lost by the time steps, of the largest energy turned over", {.fem = 1e-2}),
    CheckRow::of_run("p_max_scatter", "Scatter of p_max", "standard deviation over the window, of the mean",
                     {.fem = 1.5e-2}),
    CheckRow::of_run("hourglass_share", "Hourglass energy",
                     "energy of the hourglass modes of one-point elements, of the strain energy", {.fem = 2e-2}),
    CheckRow::of_run("plastic_strain", "Plastic strain",
                     "largest equivalent plastic strain; beyond, small strains make no claim of accuracy",
                     {.fem = kNoClaimStrain}),
    CheckRow::of_run("patch_reaches_edge_of_fine_zone", "Patch inside the fine mesh",
                     "outside once it touches the border of the fine zone", {.fem = 0}, unit::kInside),
    CheckRow::of_run("patch_reaches_edge_of_grid", "Patch inside the grid",
                     "outside once it touches the border of the grid", {.bem = 0}, unit::kInside),
    CheckRow::of_run("patch_cut_off", "Patch within the profiles",
                     "outside once pressure reaches where a profile or the block ends", {.bem = 0}, unit::kInside),
    CheckRow::of_run("cell_of_patch", "Patch resolved",
                     "a cell, of the patch's shorter axis; of several patches the mean by their forces",
                     {.bem = kUnresolvedPatch}),
    CheckRow::of_run("film_of_patch", "Film holds together",
                     "elastic shear of the third-body layer, of half the patch's shorter axis",
                     {.bem = kFilmShearsAway}),
    CheckRow::of_engines("p_max", "Largest pressure", "finite elements against half-space", 0.04),
    CheckRow::of_engines("patch_length", "Patch length", "finite elements against half-space", 0.06),
    CheckRow::of_engines("q_max", "Largest shear", "finite elements against half-space", 0.07),
    CheckRow::of_engines(
        "von_mises_below_surface", "Largest von Mises stress below the surface",
        "rail (`subsurface`), finite elements against half-space; judged where the half-space’s largest lies "
        "deeper than one element",
        0.08),
    CheckRow::warning("patch_wider_than_layer", "Patch beyond the layer",
                      "twice the distance of the patch's far edge from the layer's middle",
                      "a larger layer.width holds it", {.of_case = "layer.width"}, unit::kMillimetres, kTakesBack),
    CheckRow::warning(
        "layer_varies_below_patch", "Layer varies below the patch",
        "difference of a layer's thickness below the patch, of its largest thickness",
        "half-spaces have the layer as thick as it is at the contact; pressure and stresses of bem.bodies = "
        "\"sections\" follow it; lives have its material down to that depth all across",
        {.bem = kLargestOfLayer}, unit::kShare, kTakesBack),
    CheckRow::warning("patch_near_border_of_fine_zone", "Patch near the border of the fine mesh",
                      "the contact patch nearly fills the fine mesh", "a larger mesh.fine_width gives it room",
                      {.of_case = "mesh.fine_width less two elements"}, unit::kMillimetres),
    CheckRow::warning("von_mises_above_common_rail_yield", "Von Mises stress above common rail yield",
                      "the elastic stress in the rail is above the proof stress of common rail steels",
                      "a real rail would yield there, and shake down or wear",
                      {.fem = kCommonRailYield, .bem = kCommonRailYield}, unit::kMPa),
    CheckRow::warning("few_cells_over_patch", "Few cells over the patch",
                      "a cell or element, of the patch's shorter axis",
                      "slip area, largest shear and surface stresses err by more than a few per cent (at six elements: "
                      "p_max -3 %, q_max -7 %, slip area +12 %, creepage -2 %); a smaller --cell or mesh.element_size "
                      "resolves it",
                      {.fem = kCellOfPatch, .bem = kCellOfPatch}, unit::kShare, kTakesBack),
    CheckRow::warning("patch_spans_angle", "Patch on a turning profile",
                      "angle that the profiles' normal spans over the patch",
                      "conformal contact, which one contact plane does not describe; the finite elements follow the "
                      "profiles",
                      {.bem = kLargestAngleSpanned}, unit::kDegrees),
    CheckRow::warning("patch_large_against_radius", "Patch large against the radius",
                      "half the patch, of the relative radius of the bodies there",
                      "strains of this size are beyond linear elasticity and half-spaces", {.bem = kLargestOfRadius}),
    CheckRow::warning("patch_near_edge", "Patch near an edge",
                      "half the patch's width, of the distance from its middle to the edge of a body or layer",
                      "half-spaces have no edge; the finite elements have", {.bem = kLargestOfEdgeDistance},
                      unit::kShare, kOwnText | kTakesBack),
    CheckRow::warning("second_contact", "Second contact", "overlap of the bodies at a second place, which is left out",
                      "the load is shared there; `railstrata bem` shares it between both", {.fem = 0},
                      unit::kMicrometres, kOwnText | kTakesBack),
    CheckRow::warning("patches_near_each_other", "Patches near each other",
                      "curvature that the other patches give the surfaces, of the contact's own",
                      "each patch is solved on its own; its largest pressure errs by about half as much",
                      {.bem = kLargestBending}),
    CheckRow::warning("soft_film", "Soft third-body layer",
                      "elastic shear of the third-body layer, of half the patch's shorter axis",
                      "the surfaces that face each other under pressure are no longer those of the model, and "
                      "creepages no longer small; a stiffer or thinner film, or one that yields, shears less",
                      {.bem = kLargestFilmShear}),
    CheckRow::warning("plastic_strain_large", "Large plastic strain",
                      "plastic strain that is split off additively from the Green strain",
                      "strains are taken for small: 2 to 3 % of error at 5 % of strain, no claim of accuracy above "
                      "10 %; fewer passes or a lighter load, or the rate of ratchetting instead of its sum",
                      {.fem = kLargeStrain}),
    CheckRow::warning("contact_on_flange_crest", "Contact on the flange's crest",
                      "the wheel touches with its flange's crest, this far below the tape circle",
                      "check lateral_shift, gauge and back_to_back", {.of_case = "height of the flange less 2 mm"},
                      unit::kMillimetres, kTakesBack),
    CheckRow::warning("flange_outside_gauge", "Flange outside the gauge",
                      "the flange's crest stands beyond the rail's gauge face",
                      "such a wheel is derailed; check lateral_shift, gauge and back_to_back", {.fem = 0, .bem = 0},
                      unit::kMillimetres, kTakesBack),
    CheckRow::warning("stress_maximum_at_rim", "Stress maximum at the rim",
                      "stress that still rises at the rim of the search, of the largest pressure",
                      "a larger one may lie beyond", {.bem = kReportedTension}, unit::kShare, kOwnText | kTakesBack),
    CheckRow::warning("process_stress_beyond_yield", "Residual stress beyond yield",
                      "von Mises stress of what the process leaves (initial_stress), of the yield strength there",
                      "the material would have yielded or cracked before the first wheel; give the stress that is left "
                      "after that",
                      {.fem = 1, .bem = 1}, unit::kShare, kOwnText | kTakesBack),
    CheckRow::warning("kth_outside_map", "KTH wear outside its map",
                      "share of the rail's wear by Jendel's map that comes from seizure or from slip beyond its chart",
                      "the map has few tests there, and seizure some 70 times the wear of mild slip: take usfd, or a "
                      "measured wear_factor, or a pressure that the metal bears",
                      {.bem = kLargestOutsideMap}, unit::kShare, kOwnText),
    CheckRow::warning("wheels_in_one_track", "Wheels in one track",
                      "depth of the groove that wheels wear that are alike and run in one track",
                      "no other wheel levels its edges, which bear peaks: with cells of 0.25 mm up to twice the "
                      "pressure beside them; give collective.lateral_deviation (2 to 6 mm), or a load for each place",
                      {.bem = kGroove}, unit::kMicrometres),
    CheckRow::warning("measured_within_torque_ramp", "Measured while the torque rises",
                      "the measuring window begins before the torque has its full value",
                      "the wanted traction cannot be reached there",
                      {.of_case = "run.positions less half of run.window"}, unit::kMillimetres, kOwnText),
    CheckRow::warning(
        "windows_differ", "Windows differ", "change from the window before to the last one, of what counts as repeated",
        "the rolling is not steady yet; give run.positions farther on", {.fem = 1}, unit::kNone, kOwnText),
    CheckRow::warning("mass_scaling_adds_much", "Mass added by scaling",
                      "largest share that mass scaling adds to a block’s mass",
                      "vibrations across thin layers are slowed", {.fem = 0.01}, unit::kShare, kOwnText),
    CheckRow::warning("short_friction_memory", "Short friction memory",
                      "the memory distance that steady sliding needs, of friction.memory_distance",
                      "vibration may grow; a longer friction.memory_distance or a gentler fall prevents it", {.fem = 1},
                      unit::kNone, kOwnText),
    CheckRow::note("case_edited", "Case unchanged since the run", "case.toml against the one of the run"),
    CheckRow::note("summary_contradicted", "Numbers agree with each other",
                   "summary.json against its own limits and against patch.csv"),
    CheckRow::note("other_version", "Other version", "the result was not written by this version"),
    CheckRow::note("cases_differ", "Different cases", "their options differ"),
};

/// Null for a name that is not in the table (a result of another version).
constexpr const CheckRow* find_check(std::string_view key) {
  for (const CheckRow& row : kCheckRows)
    if (row.key == key) return &row;
  return nullptr;
}

/// What a check or warning is called; for a name that is not in the table the name itself, without a unit.
struct CheckWords {
  std::string_view name;
  Unit unit = unit::kNone;
};
constexpr CheckWords check_words(std::string_view key) {
  const CheckRow* row = find_check(key);
  return row ? CheckWords{row->name, row->unit} : CheckWords{key};
}

/// For names that stand in the program; in a constant expression a wrong name does not compile.
constexpr const CheckRow& check_row(std::string_view key) {
  if (const CheckRow* row = find_check(key)) return *row;
  throw std::invalid_argument("no such check");
}

}  // namespace railstrata
