#pragma once
// Kalker's table of creep forces of an elliptic contact of equal bodies, in the form that programs with a USETAB reader
// take ("tabcon"): forces over the ratio of the semi-axes and three scaled creepages. No layers: a half-space of steel.
#include <functional>
#include <string>
#include <vector>

#include "core/control.hpp"
#include "halfspace/creep_theories.hpp"

namespace railstrata {

inline constexpr double kUsetabPoisson = 0.28;

/// The values of the four axes, in the table's order.
struct UsetabAxes {
  std::vector<double> aspect;  ///< a/b, a along the rolling direction
  std::vector<double> xi, eta, psi;
};
UsetabAxes usetab_axes();

/// C11, C22, C23 that scale the creepages: of table E.3 in its range, interpolated in a/b or b/a and by a parabola of
/// 1/C in nu, beyond it the asymptotes for slender ellipses. [Kalker1990 table E.3]
CreepCoefficients usetab_coefficients(double a_over_b, double poisson);

/// Forces on the wheel of a unit load and friction, in units of the load and of load times sqrt(a b).
struct UsetabForce {
  double x = 0, y = 0, moment = 0;
};

struct UsetabOptions {
  int cells = 20;                               ///< along either axis of the ellipse
  const Control* control = nullptr;             ///< asked to stop, the answer is not complete
  std::function<void(double fraction)> solved;  ///< of an ellipse; from any thread, one at a time
};

/// Forces of one ellipse: index (ixi * eta.size() + ieta) * psi.size() + ipsi. The creepages are
///   -3 xi f N/(G c² C11), -3 eta f N/(G c² C22), -psi f N/(G c³ C23), c² = a b.
/// Throws as solve_rolling.
std::vector<UsetabForce> usetab_forces(double a_over_b, const UsetabAxes& axes, const UsetabOptions& options);

/// The file's text of an ellipse, and what stands before the first and after the last.
std::string usetab_head(const UsetabAxes& axes, int cells, const std::string& program);
std::string usetab_rows(double a_over_b, const UsetabAxes& axes, const std::vector<UsetabForce>& forces);
std::string usetab_end();

}  // namespace railstrata
