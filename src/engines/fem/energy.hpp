#pragma once
// The energy book of a rolling.
#include <array>

namespace railstrata {

/// Work and energy since the start of the rolling [J]. Closure: kinetic + strain + hourglass + weight + spring +
/// dissipated = their start + torque_work + guide_work.
struct EnergyBalance {
  double kinetic = 0, strain = 0, hourglass = 0;
  double weight = 0;  ///< potential of gravity, and of what holds the rail's ends
  double spring = 0;  ///< suspension springs, with their static force
  double torque_work = 0;
  double guide_work = 0;      ///< of what keeps or pushes the axle sideways, keeps its speed, or turns a ring
  double friction = 0;        ///< dissipated by sliding
  double contact_normal = 0;  ///< lost in the normal direction of the contact
  double damping = 0;         ///< run-up damping
  double absorbed = 0;        ///< end absorbers
  double dashpot = 0;         ///< suspension dashpots
  double plastic = 0;         ///< work on plastic strains: dissipated, and stored by hardening
  double total() const;
};

/// state: of a moment; supplied, lost: summed over whole steps.
enum class EnergyKind { state, supplied, lost };

struct EnergyEntry {
  const char* name;
  double EnergyBalance::*value;
  EnergyKind kind;
};

/// The entries in the order of history.csv and of restart files.
inline constexpr std::array kEnergyEntries{
    EnergyEntry{"kinetic", &EnergyBalance::kinetic, EnergyKind::state},
    EnergyEntry{"strain", &EnergyBalance::strain, EnergyKind::state},
    EnergyEntry{"hourglass", &EnergyBalance::hourglass, EnergyKind::state},
    EnergyEntry{"weight", &EnergyBalance::weight, EnergyKind::state},
    EnergyEntry{"spring", &EnergyBalance::spring, EnergyKind::state},
    EnergyEntry{"torque_work", &EnergyBalance::torque_work, EnergyKind::supplied},
    EnergyEntry{"guide_work", &EnergyBalance::guide_work, EnergyKind::supplied},
    EnergyEntry{"friction", &EnergyBalance::friction, EnergyKind::lost},
    EnergyEntry{"contact_normal", &EnergyBalance::contact_normal, EnergyKind::lost},
    EnergyEntry{"run_up_damping", &EnergyBalance::damping, EnergyKind::lost},
    EnergyEntry{"absorbed", &EnergyBalance::absorbed, EnergyKind::lost},
    EnergyEntry{"dashpot", &EnergyBalance::dashpot, EnergyKind::lost},
    EnergyEntry{"plastic", &EnergyBalance::plastic, EnergyKind::state}};

inline double EnergyBalance::total() const {
  double out = 0;
  for (const EnergyEntry& e : kEnergyEntries)
    if (e.kind != EnergyKind::supplied) out += this->*e.value;
  for (const EnergyEntry& e : kEnergyEntries)
    if (e.kind == EnergyKind::supplied) out -= this->*e.value;
  return out;
}

/// Sums of whole steps have half of the step that follows at the moment between two steps.
inline EnergyBalance halfway(const EnergyBalance& before, EnergyBalance now) {
  for (const EnergyEntry& e : kEnergyEntries)
    if (e.kind != EnergyKind::state) now.*e.value = 0.5 * (before.*e.value + now.*e.value);
  return now;
}

}  // namespace railstrata
