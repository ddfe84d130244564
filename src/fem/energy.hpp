#pragma once
// The energy book of a rolling.

namespace railstrata {

/// Work and energy since the start of the rolling [J]. Closure: kinetic + strain + hourglass + weight + spring +
/// dissipated = their start + torque_work + guide_work.
struct EnergyBalance {
  double kinetic = 0, strain = 0, hourglass = 0;
  double weight = 0;  ///< potential of gravity, and of what holds the rail's ends
  double spring = 0;  ///< suspension springs, with their static force
  double torque_work = 0;
  double guide_work = 0;      ///< of the forces on the axle that keep or push it sideways, or keep its speed
  double friction = 0;        ///< dissipated by sliding
  double contact_normal = 0;  ///< lost in the normal direction of the contact
  double damping = 0;         ///< run-up damping
  double absorbed = 0;        ///< end absorbers
  double dashpot = 0;         ///< suspension dashpots
  double plastic = 0;         ///< work on plastic strains: dissipated, and stored by hardening
  double total() const {
    return kinetic + strain + hourglass + weight + spring + friction + contact_normal + damping + absorbed + dashpot +
           plastic - torque_work - guide_work;
  }
};

/// Work and losses are summed over whole steps; the moment between two steps has half of the one that follows.
inline EnergyBalance halfway(const EnergyBalance& before, EnergyBalance now) {
  using E = EnergyBalance;
  for (double E::*sum :
       {&E::torque_work, &E::guide_work, &E::friction, &E::contact_normal, &E::damping, &E::absorbed, &E::dashpot})
    now.*sum = 0.5 * (before.*sum + now.*sum);
  return now;
}

}  // namespace railstrata
