#pragma once
// A load collective: half-space solutions of the case's rows of [[load]], and what all their passages do to the rail.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "ask/answer.hpp"
#include "bem/bem_options.hpp"
#include "core/control.hpp"
#include "fatigue/rail_damage.hpp"
#include "fatigue/wheel_damage.hpp"
#include "lives/zone_life.hpp"
#include "model/model.hpp"
#include "result/summary.hpp"
#include "spec/case_spec.hpp"

namespace railstrata {

/// m, as far as collective.match_guiding_force moves the shift of a row.
inline constexpr double kFarthestMatch = 0.2e-3;

/// A row of the collective with what came out of it.
struct CollectiveRow {
  std::string name;
  double passages = 0;
  CaseSpec spec;                        ///< the case of this row
  TrackGeometry track;                  ///< where it is solved
  Summary summary;                      ///< where it is solved
  nlohmann::ordered_json summary_json;  ///< the same; null: there is none
  std::optional<BemResult> result;      ///< where CollectiveOptions::keep_results asks for it
  std::vector<PatchDamage> patches;
  std::vector<double> wheel_y;  ///< m, of the patches on a wheel with a profile of its own; empty: the case's
  std::vector<SectionShakedown> sections;  ///< of the bodies with strengths
  LoadSpec given;                          ///< of the case
  double moved = 0;   ///< m of the shift for the given guiding force; NaN: none within kFarthestMatch has it
  std::string fault;  ///< empty: solved, and its checks hold
  bool done = false;
  double tonnes() const { return passages * given.tonnes(summary.contact.F_z); }  ///< gross, of all passages
  bool solved() const { return !summary_json.is_null(); }
  bool sound() const { return solved() && fault.empty(); }
};

/// The rows, nothing solved. Throws CaseError where the case has none, or where nothing rolls.
std::vector<CollectiveRow> plan_collective(const CaseSpec& spec);

struct CollectiveOptions {
  BemOptions bem;
  Wanted wanted{
      .rail = false, .wheel = false, .crack = false, .life = false};  ///< of each row; the life is that of all rows
  const Profile* rail = nullptr;                                      ///< instead of the case's
  bool keep_results = false;                                          ///< CollectiveRow::result
  const Control* control = nullptr;  ///< asked to stop, rows that have not begun are left out; progress: "loads"
};

/// Solves the rows side by side, one thread each. What goes wrong with a row is its fault, and the others go on; what
/// `ended` throws is thrown at the end. Profile files are relative to `folder`.
void solve_collective(std::vector<CollectiveRow>& rows, const std::filesystem::path& folder,
                      const CollectiveOptions& options);

/// The sum over the rows that are sound, each times its passages. `placement` is that of the case (profile, track);
/// `cell` [m] the length of the rail's cells.
RailDamage rail_damage(const std::vector<CollectiveRow>& rows, const Placement& placement, double cell);

/// Damage of one wheel that runs the sound rows in the shares of their passages.
WheelDamage wheel_damage(const std::vector<CollectiveRow>& rows, const Placement& placement, double cell);

/// Lives under the sound rows (lives/zone_life.hpp).
Lives collective_lives(const CaseSpec& spec, const std::vector<CollectiveRow>& rows, const RailDamage& rail,
                       const WheelDamage& wheel);

/// Of the sound rows.
double passages_of(const std::vector<CollectiveRow>& rows);

/// m² per `passages` of all sound rows: the sum over their streamlines of depth times width, times
/// collective.wear_factor. What rail_damage must conserve.
double streamline_area(const std::vector<CollectiveRow>& rows, WearLaw law);

/// The sound row with the smallest factor for wandering traffic; null where none is known.
const CollectiveRow* worst_row(const std::vector<CollectiveRow>& rows);

/// The sound row with the largest pressure; null: none is sound.
const CollectiveRow* most_pressed_row(const std::vector<CollectiveRow>& rows);

/// Rows that were not solved, or whose checks failed.
long faults(const std::vector<CollectiveRow>& rows);

}  // namespace railstrata
