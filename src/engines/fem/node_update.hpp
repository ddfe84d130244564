#pragma once
// The central-difference update of nodes, and the traversal that feeds it.
#include <array>

#include "body/plastic_pass.hpp"
#include "fem/rolling_body.hpp"
#include "fem/step_laps.hpp"

namespace railstrata {

/// Data that the functions of one step share.
struct StepScope {
  double dt = 0;            ///< s
  double gravity = 0;       ///< m/s²
  double damping_rate = 0;  ///< 1/s, run-up damping
  bool energy_wanted = false;
  PlasticLook look = PlasticLook::all;  ///< at elements that may yield
  StepLaps* laps = nullptr;             ///< null: not measured
  bool sums_wanted() const { return damping_rate > 0 || energy_wanted; }
  void lap(StepPart part) const {
    if (laps) laps->lap(part);
  }
};

/// Rate of a body's run-up damping [1/s]. It would drag on the bending of a rail on a track, which travels with the
/// wheel; pads damp it.
double damping_of(const RollingBody& body, const StepScope& scope);

class RankExchange;

/// Internal forces of both bodies at their displacements; drift: rotation of the body relative to its frame [rad].
/// Nodes that wait for nothing are updated on the way (FuseUpdate), unless the energies are wanted, which are those of
/// one moment. With several ranks each evaluates its own tiles and all get the forces
/// (fem/rank_exchange.hpp).
void evaluate_elements(RollingBodies& bodies, BodyStates& states, const std::array<double, 2>& drift,
                       const StepScope& scope, RankExchange* exchange = nullptr);

/// The nodes that waited for the contact, and the ends of open blocks.
void update_waiting_nodes(RollingBodies& bodies, BodyStates& states, const StepScope& scope);

/// Sums of this step's updates, of all ranks' tiles; zero if none were wanted.
std::array<UpdateSums, 2> update_sums(RollingBodies& bodies, const StepScope& scope, RankExchange* exchange);

}  // namespace railstrata
