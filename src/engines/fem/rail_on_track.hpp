#pragma once
// The rail on pads and rigid sleepers, and what a blow of a hammer on its head does to it.
//
// Displacements count from the equilibrium under the weights. Central differences as in fem/stepper.hpp; the dashpots
// at the ends take the mean of the velocities before and after a step.
#include <functional>
#include <vector>

#include "fem/rail_pads.hpp"

namespace railstrata {

struct HammerBlow {
  double x = 0;         ///< m, on the running surface
  double duration = 0;  ///< s, of a force (1 - cos(2 pi t/duration))/2 of 1 N at most
  double time = 0;      ///< s, followed
  double safety = 0.9;  ///< of the stable step
};

/// Sums over the blow, J.
struct BlowEnergy {
  double supplied = 0;                     ///< by the hammer
  double pads = 0, ballast = 0, ends = 0;  ///< dissipated
  double kept = 0;                         ///< kinetic and elastic, at the end
  double closure() const { return kept + pads + ballast + ends - supplied; }
};

struct BlowResponse {
  double dt = 0;                             ///< s
  std::vector<double> force, section, head;  ///< by step: N; m, mean of the section by mass, and where the force acts
  BlowEnergy energy;
};

/// progress: share done; may be empty. Throws CaseError where the pads ask for a shorter step.
BlowResponse strike(const Body& rail, const RailPads& pads, const HammerBlow& blow,
                    const std::function<void(double)>& progress = {});

}  // namespace railstrata
