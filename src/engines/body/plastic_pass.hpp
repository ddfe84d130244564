#pragma once
// The pass over the elements that may yield (body/plastic_elements.hpp): strains at their Gauss points, the law, the
// eigenstress. The incompatible modes follow the plastic strains of the pass before (alpha_p): in explicit steps these
// differ by one step's increment, of order 1e-6, and a repeated pass at rest converges to the element's own
// equilibrium.
#include "body/body.hpp"
#include "body/tile_cut.hpp"

namespace railstrata {

/// Groups of eight elements sleep while no point has more than this share of its yield stress.
inline constexpr double kSleepBelow = 0.6;

/// all: every group is evaluated, and goes to sleep or wakes; awake: those that sleep are left alone, their plastic
/// strains stay. In the explicit steps all are looked at every kLookInterval steps: the wheel moves by some tenth of an
/// element meanwhile, and what was below 0.6 of its yield stress cannot pass it.
enum class PlasticLook { all, awake };
inline constexpr int kLookInterval = 16;

/// Carries the plastic strains on to displacements u (model frame, or one that is turned by psi, as in the traversal)
/// and writes the eigenstress; `history` is the body's. Ghosts of u must be right. Same bits for any number of threads.
/// cut: the tiles that are looked at; null: all.
void advance_plastic_elements(const Body& body, const Field& u, double psi, PlasticHistory& history,
                              PlasticLook look = PlasticLook::all, const TileCut* cut = nullptr);

/// Steps between two calls of extend_plastic_elements: the wheel moves by some fifth of an element.
inline constexpr int kExtendInterval = 32;

/// Cold elements whose mean stress has more than kSleepBelow of their yield stress at displacements u become hot, with
/// their whole place. One that is beyond its yield stress already yields by the whole excess in the next step: the law
/// is implicit. Returns how many places did.
int extend_plastic_elements(const Body& body, const Field& u, double psi, PlasticHistory& history);

/// Puts the histories of the points back to those of `from`; the eigenstress of the last pass and the bubbles, which
/// the next pass starts from, stay; places that were cold in `from` are virgin. For trials from one state.
void restore_points(const Body& body, const PlasticHistory& from, PlasticHistory& history);

/// The eigenstress's part of the stored energy, added to what Traversal::energy finds for elastic elements [J],
/// without that of the backstresses, which counts as plastic work.
double plastic_strain_energy(const Body& body, const Field& u, double psi, const PlasticHistory& history);

/// The initial stress's part of it in cold elements, the integral of S0:E [J]: stored energies count from the body
/// before it has come to its equilibrium, and may be negative.
double initial_stress_energy(const Body& body, const Field& u, double psi, const PlasticHistory& history);

/// Work done on the plastic strains so far: dissipated and stored by hardening [J].
double plastic_work(const Body& body, const PlasticHistory& history);

}  // namespace railstrata
