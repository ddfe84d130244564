#pragma once
// A rail through its traffic: one state of the metal, one surface, one count of gross tonnes.
//
// Stretch after stretch of traffic: all loads are solved on the profile of the day; wear and grinding take the surface
// down, and contacts are solved again (without stresses) step by step of wear, until a load's largest pressure or its
// place has changed by more than is allowed. The metal then rolls through that traffic under the stresses of the
// stretch's beginning (passes/metal.hpp), and its damage gathers at points that wear brings nearer to the surface
// (gathered_damage.hpp). Loads that are alike count as one.
//
// Assumptions: those of passes (one patch after the other, an endless rail, the pressure of elastic bodies) and of the
// wear laws; wheels of all loads come in any order, thoroughly mixed.
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "bem/bem_options.hpp"
#include "clock/gathered_damage.hpp"
#include "clock/worn_profile.hpp"
#include "collective/collective.hpp"
#include "passes/metal.hpp"

namespace railstrata {

struct ClockState;  // clock/clock_state.hpp

inline constexpr double kReached = 1 - 1e-12;  ///< of a mass that has been reached but for rounding

struct ClockOptions {
  BemOptions bem;
  double horizon = 0;         ///< kg, gross traffic until which to go
  double max_wear = 0.01e-3;  ///< m, at the deepest place between two solutions of the contacts
  double change = 0.2;        ///< share of a load's pressure, by which a stretch ends
  double moved = 1e-3;        ///< m, of a load's place, by which it ends
  double apart = 0.5e-3;      ///< m, of the metal's columns
  double first_row = 0.1e-3;  ///< m, thickness of the metal's first row
  double growth = 4;          ///< of the implicit steps of a stretch, from each to the next
  SettleLimits settle = {.tolerance = 0.02};
  const Control* control = nullptr;
  /// Called at the beginning and after each stretch that the horizon has not cut: from such a state on a run to any
  /// later horizon gives the bits of one in one go.
  std::function<void(const ClockState&)> keep = {};
  const ClockState* begun = nullptr;  ///< to go on from, of this case and these options; null: from the beginning
};

/// To life.until of the case.
ClockOptions clock_options(const CaseSpec& spec, const BemOptions& bem, const Control* control);

/// The rail at an instant.
struct ClockMoment {
  double kilograms = 0;                                        ///< gross traffic since the beginning
  double removed = 0, removed_y = 0;                           ///< m, where most has gone
  double gauge_widening = 0;                                   ///< m, of worn gauge faces, both rails alike
  double p_max = 0;                                            ///< Pa, largest of all loads
  double layer_left = kNotApplicable;                          ///< m, of the uppermost layer where least is left
  double ductility = 0, ductility_y = 0, ductility_depth = 0;  ///< largest share used from kShallowest on;
                                                               ///< where, m; depth below the surface of that time
  double exhausted = 0;                                        ///< m, so deep is the ductility of all metal used up
                                                               ///< from the surface on, where that is deepest
  double cycles = 0, fatigue = 0;                              ///< largest Miner's sums
  double net = 0;                                              ///< strain that stays, by a wheel, largest
  double contact_change = 0;                                   ///< of pressures and places in the stretch, over what
                                                               ///< ends one; above 1 by the last step of wear
  double unsettled = 0;                                        ///< SettledState::unsettled of the stretch, the largest
  int changes = 0;                                             ///< changes of the metal computed in the stretch
  double crack = kNotApplicable;         ///< m, depth of the crack below the surface of the day; NaN: none has begun
  double crack_growth = kNotApplicable;  ///< m of depth a kg, without wear, at the end of the stretch
};

struct ClockResult {
  std::vector<ClockMoment> history;  ///< the beginning, then the end of each stretch
  std::vector<LifeRow> lives;        ///< of the rail
  double wheels = 0, tonnes = 0;     ///< of one collective
  double reached = 0;                ///< kg, gross traffic that was followed
  std::string ended;                 ///< why before the horizon; empty: at it
  bool worn_through = false;         ///< because of a layer
  double groove = kNotApplicable;    ///< m, worn by one kind of wheels in one track; NaN: there are several
  std::vector<std::string> notes;    ///< loads that were left out or could not yield
  std::vector<Vec2> profile;         ///< m, at the end, frame of the unworn one
};

/// Throws CaseError: no loads, nothing solved on the first profile; Interrupted between two changes of the metal or
/// solutions of the loads.
ClockResult run_clock(const CaseSpec& spec, const std::filesystem::path& folder, const ClockOptions& options);

}  // namespace railstrata
