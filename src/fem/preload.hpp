#pragma once
// Equilibrium before the rolling: gravity, the centrifugal forces of the wheel's starting spin (they widen the rim by some 10 um, a tenth of the approach: a wheel set
// spinning without them rings), frictionless contact.
//
// Unknown: the displacements of both bodies and the axle's height. Newton steps on the exact residual with the stiffness of the undeformed bodies, augmented
// multipliers for the contact (p <- max(0, p - eps g)), each step solved by conjugate gradients that use the explicit solver's element kernel as the operator and the
// point-block diagonal as the preconditioner. Nothing is assembled.
#include <atomic>
#include <functional>

#include "fem/rolling_system.hpp"

namespace railstrata {

struct PreloadResult {
  Field u_rail, u_wheel;
  double axle_z = 0;                  ///< m, displacement of the axle from the rigid contact position, negative: down
  TractionMemory tractions{0, 0};
  double residual = 0;                ///< |r| / |load vector|
  double penetration = 0;             ///< m, largest of the nodes in contact
  double contact_force_z = 0;         ///< N, on the wheel
  int newton_steps = 0, cg_iterations = 0;
  double wall_seconds = 0;
};

/// Called after every Newton step with (relative residual, wanted residual, CG iterations so far).
using PreloadProgress = std::function<void(double, double, int)>;

/// Throws NumericalError when it does not converge, or `stop` was set.
PreloadResult solve_preload(const RollingSystem& system, double tolerance, const PreloadProgress& progress = {}, const std::atomic<bool>* stop = nullptr);

}  // namespace railstrata
