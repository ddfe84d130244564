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

  static constexpr CheckRow of_engines(std::string_view key, std::string_view name, std::string_view what,
                                       double limit) {
    return {key, name, what, CheckKind::engines, unit::kShare, limit, limit};
  }
};

/// Von Mises stress above which a linear elastic rail is no longer to be believed, Pa: a round figure of the order of
/// the 0.2 % proof stress of common as-rolled rail steels (grade R260). Heat-treated grades stand more, so it is a
/// warning, not a check.
inline constexpr double kCommonRailYield = 500e6;

/// A cell or element, of the patch's shorter axis: where results suffer, and where they mean nothing. Reasons and
/// figures of this and of the following limits: docs/checks.md.
inline constexpr double kCellOfPatch = 0.1, kElementOfPatch = 0.2, kUnresolvedPatch = 0.35;
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
/// Share of p_max: a tension maximum at the edge of the searched region is reported only above it.
inline constexpr double kReportedTension = 0.01;

inline constexpr std::array kCheckRows{
    CheckRow{.key = "preload_residual",
             .name = "Static equilibrium",
             .what = "residual of the preload, relative to the load",
             .unit = unit::kNone,
             .case_option = "run.preload_tolerance"},
    CheckRow{.key = "F_z_relative_to_weight",
             .name = "Vertical load",
             .what = "F_z of the contact against the weight on the wheel",
             .fem_limit = 5e-3,
             .bem_limit = 1e-4},
    CheckRow{.key = "traction_coefficient_reached",
             .name = "Traction",
             .what = "F_x/F_z reached against the wanted traction coefficient",
             .fem_limit = 1e-2,
             .bem_limit = 1e-3},
    CheckRow{.key = "lateral_traction_reached",
             .name = "Lateral traction",
             .what = "lateral friction in the contact plane over the weight against the wanted coefficient",
             .fem_limit = 2e-2,
             .bem_limit = 1e-3},
    CheckRow{.key = "penetration_over_approach",
             .name = "Penetration",
             .what = "largest overlap of the bodies, of Hertz’s approach",
             .fem_limit = 1e-2},
    CheckRow{.key = "energy_closure",
             .name = "Energy closure",
             .what = "energy gained or lost by the time steps, of the largest energy turned over",
             .fem_limit = 1e-2},
    CheckRow{.key = "p_max_scatter",
             .name = "Scatter of p_max",
             .what = "standard deviation over the window, of the mean",
             .fem_limit = 1.5e-2},
    CheckRow{.key = "hourglass_share",
             .name = "Hourglass energy",
             .what = "energy of the hourglass modes of one-point elements, of the strain energy",
             .fem_limit = 2e-2},
    CheckRow{.key = "plastic_strain",
             .name = "Plastic strain",
             .what = "largest equivalent plastic strain; beyond, small strains make no claim of accuracy",
             .fem_limit = kNoClaimStrain},
    CheckRow{.key = "patch_reaches_edge_of_fine_zone",
             .name = "Patch inside the fine mesh",
             .what = "outside once it touches the border of the fine zone",
             .unit = unit::kInside,
             .fem_limit = 0},
    CheckRow{.key = "patch_reaches_edge_of_grid",
             .name = "Patch inside the grid",
             .what = "outside once it touches the border of the grid",
             .unit = unit::kInside,
             .bem_limit = 0},
    CheckRow{.key = "patch_cut_off",
             .name = "Patch within the profiles",
             .what = "outside once pressure reaches where a profile or the block ends",
             .unit = unit::kInside,
             .bem_limit = 0},
    CheckRow{.key = "cell_of_patch",
             .name = "Patch resolved",
             .what = "a cell, of the patch's shorter axis; of several patches the mean by their forces",
             .bem_limit = kUnresolvedPatch},
    CheckRow{.key = "film_of_patch",
             .name = "Film holds together",
             .what = "elastic shear of the third-body layer, of half the patch's shorter axis",
             .bem_limit = kFilmShearsAway},
    CheckRow::of_engines("p_max", "Largest pressure", "finite elements against half-space", 0.04),
    CheckRow::of_engines("patch_length", "Patch length", "finite elements against half-space", 0.06),
    CheckRow::of_engines("q_max", "Largest shear", "finite elements against half-space", 0.07),
    CheckRow::of_engines("von_mises_below_surface", "Largest von Mises stress below the surface",
                         "rail with its layers and interfaces, finite elements against half-space; judged where the "
                         "half-space’s largest lies deeper than one element",
                         0.08),
    CheckRow{.key = "patch_wider_than_layer",
             .name = "Patch beyond the layer",
             .what = "twice the distance of the patch's far edge from the layer's middle",
             .kind = CheckKind::warning,
             .unit = unit::kMillimetres,
             .case_option = "layer.width",
             .advice = "a larger layer.width holds it",
             .takes_back = true},
    CheckRow{.key = "patch_near_border_of_fine_zone",
             .name = "Patch near the border of the fine mesh",
             .what = "the contact patch nearly fills the fine mesh",
             .kind = CheckKind::warning,
             .unit = unit::kMillimetres,
             .case_option = "mesh.fine_width less two elements",
             .advice = "a larger mesh.fine_width gives it room"},
    CheckRow{.key = "von_mises_above_common_rail_yield",
             .name = "Von Mises stress above common rail yield",
             .what = "the elastic stress in the rail is above the proof stress of common rail steels",
             .kind = CheckKind::warning,
             .unit = unit::kMPa,
             .fem_limit = kCommonRailYield,
             .bem_limit = kCommonRailYield,
             .advice = "a real rail would yield there, and shake down or wear"},
    CheckRow{.key = "few_cells_over_patch",
             .name = "Few cells over the patch",
             .what = "a cell or element, of the patch's shorter axis",
             .kind = CheckKind::warning,
             .fem_limit = kElementOfPatch,
             .bem_limit = kCellOfPatch,
             .advice = "slip area, largest shear and surface stresses err by more than a few per cent; a smaller "
                       "--cell or mesh.element_size resolves it",
             .takes_back = true},
    CheckRow{.key = "patch_spans_angle",
             .name = "Patch on a turning profile",
             .what = "angle that the profiles' normal spans over the patch",
             .kind = CheckKind::warning,
             .unit = unit::kDegrees,
             .bem_limit = kLargestAngleSpanned,
             .advice = "conformal contact, which one contact plane does not describe; the finite elements follow the "
                       "profiles"},
    CheckRow{.key = "patch_large_against_radius",
             .name = "Patch large against the radius",
             .what = "half the patch, of the relative radius of the bodies there",
             .kind = CheckKind::warning,
             .bem_limit = kLargestOfRadius,
             .advice = "strains of this size are beyond linear elasticity and half-spaces"},
    CheckRow{.key = "patch_near_edge",
             .name = "Patch near an edge",
             .what = "half the patch's width, of the distance from its middle to the edge of a body or layer",
             .kind = CheckKind::warning,
             .bem_limit = kLargestOfEdgeDistance,
             .advice = "half-spaces have no edge; the finite elements have",
             .own_text = true,
             .takes_back = true},
    CheckRow{.key = "second_contact",
             .name = "Second contact",
             .what = "overlap of the bodies at a second place, which is left out",
             .kind = CheckKind::warning,
             .unit = unit::kMicrometres,
             .fem_limit = 0,
             .advice = "the load is shared there; `railstrata bem` shares it between both",
             .own_text = true,
             .takes_back = true},
    CheckRow{.key = "patches_near_each_other",
             .name = "Patches near each other",
             .what = "curvature that the other patches give the surfaces, of the contact's own",
             .kind = CheckKind::warning,
             .bem_limit = kLargestBending,
             .advice = "each patch is solved on its own; its largest pressure errs by about half as much"},
    CheckRow{.key = "soft_film",
             .name = "Soft third-body layer",
             .what = "elastic shear of the third-body layer, of half the patch's shorter axis",
             .kind = CheckKind::warning,
             .bem_limit = kLargestFilmShear,
             .advice = "the surfaces that face each other under pressure are no longer those of the model, and "
                       "creepages no longer small; a stiffer or thinner film, or one that yields, shears less"},
    CheckRow{.key = "plastic_strain_large",
             .name = "Large plastic strain",
             .what = "plastic strain that is split off additively from the Green strain",
             .kind = CheckKind::warning,
             .fem_limit = kLargeStrain,
             .advice = "strains are taken for small: 2 to 3 % of error at 5 % of strain, no claim of accuracy above "
                       "10 %; fewer passes or a lighter load, or the rate of ratchetting instead of its sum"},
    CheckRow{.key = "contact_on_flange_crest",
             .name = "Contact on the flange's crest",
             .what = "the wheel touches with its flange's crest, this far below the tape circle",
             .kind = CheckKind::warning,
             .unit = unit::kMillimetres,
             .case_option = "height of the flange less 2 mm",
             .advice = "check lateral_shift, gauge and back_to_back",
             .takes_back = true},
    CheckRow{.key = "flange_outside_gauge",
             .name = "Flange outside the gauge",
             .what = "the flange's crest stands beyond the rail's gauge face",
             .kind = CheckKind::warning,
             .unit = unit::kMillimetres,
             .fem_limit = 0,
             .bem_limit = 0,
             .advice = "such a wheel is derailed; check lateral_shift, gauge and back_to_back",
             .takes_back = true},
    CheckRow{.key = "stress_maximum_at_rim",
             .name = "Stress maximum at the rim",
             .what = "stress that still rises at the rim of the search, of the largest pressure",
             .kind = CheckKind::warning,
             .bem_limit = kReportedTension,
             .advice = "a larger one may lie beyond",
             .own_text = true,
             .takes_back = true},
    CheckRow{.key = "process_stress_beyond_yield",
             .name = "Residual stress beyond yield",
             .what = "von Mises stress of what the process leaves (initial_stress), of the yield strength there",
             .kind = CheckKind::warning,
             .fem_limit = 1,
             .bem_limit = 1,
             .advice =
                 "the material would have yielded or cracked before the first wheel; give the stress that is left "
                 "after that",
             .own_text = true,
             .takes_back = true},
    CheckRow{.key = "measured_within_torque_ramp",
             .name = "Measured while the torque rises",
             .what = "the measuring window begins before the torque has its full value",
             .kind = CheckKind::warning,
             .unit = unit::kMillimetres,
             .case_option = "run.positions less half of run.window",
             .advice = "the wanted traction cannot be reached there",
             .own_text = true},
    CheckRow{.key = "mass_scaling_adds_much",
             .name = "Mass added by scaling",
             .what = "largest share that mass scaling adds to a block’s mass",
             .kind = CheckKind::warning,
             .fem_limit = 0.01,
             .advice = "vibrations across thin layers are slowed",
             .own_text = true},
    CheckRow{.key = "short_friction_memory",
             .name = "Short friction memory",
             .what = "the memory distance that steady sliding needs, of friction.memory_distance",
             .kind = CheckKind::warning,
             .unit = unit::kNone,
             .fem_limit = 1,
             .advice = "vibration may grow; a longer friction.memory_distance or a gentler fall prevents it",
             .own_text = true},
    CheckRow{.key = "case_edited",
             .name = "Case unchanged since the run",
             .what = "case.toml against the one of the run",
             .kind = CheckKind::note,
             .unit = unit::kNone},
    CheckRow{.key = "summary_contradicted",
             .name = "Numbers agree with each other",
             .what = "summary.json against its own limits and against patch.csv",
             .kind = CheckKind::note,
             .unit = unit::kNone},
    CheckRow{.key = "other_version",
             .name = "Other version",
             .what = "the result was not written by this version",
             .kind = CheckKind::note,
             .unit = unit::kNone},
    CheckRow{.key = "cases_differ",
             .name = "Different cases",
             .what = "their options differ",
             .kind = CheckKind::note,
             .unit = unit::kNone},
};

/// Null for a name that is not in the table (a result of another version).
constexpr const CheckRow* find_check(std::string_view key) {
  for (const CheckRow& row : kCheckRows)
    if (row.key == key) return &row;
  return nullptr;
}

/// For names that stand in the program; in a constant expression a wrong name does not compile.
constexpr const CheckRow& check_row(std::string_view key) {
  if (const CheckRow* row = find_check(key)) return *row;
  throw std::invalid_argument("no such check");
}

}  // namespace railstrata
