#pragma once
// Derivatives of what solve_bem gives by the inputs of its case, at a solution of one patch: the equations of the cells
// in contact, sticking and slipping, linearised at sets that stand. [Kalker1990 ch. 4]
#include <array>
#include <optional>

#include "bem/case_patch.hpp"
#include "bem/one_patch.hpp"
#include "bem/solve_bem.hpp"

namespace railstrata {

/// Per unit of an input; of the rail's forces as in RailForces.
struct ContactDerivative {
  RailForces force;
  double creepage_x = 0, creepage_y = 0, spin = 0;
  double approach = 0, angle = 0;
};

/// A case and the wheel's place in it.
struct PlacedCase {
  const CaseSpec& spec;
  const Placement& placement;
};

/// Pressures and tractions in the cells of a plane, their places and areas.
struct PlaneTractions {
  RigidContact plane;
  ContactField field;
};

/// All derivatives are taken at a descent d of the wheel, which the plane follows too. Under a weight G it follows each
/// input u by V(u, d) = N cos(delta) - T sin(delta) = G (solve_bem.hpp):
///   dV/du + dV/dd d' = dG/du,   dV = dN cos(delta) - dT sin(delta) - (N sin(delta) + T cos(delta)) d delta.
/// Geometry changes by differences, all else by one solution of the linear equations.
class ContactDerivatives {
 public:
  /// solved: the patch of the case under a descent [m] of the wheel, kept by reference; whole: as of its BemNeighbour.
  ContactDerivatives(const CaseSpec& spec, const Placement& placement, const BemOptions& options,
                     const BemStart& solved, double descent, bool whole);
  /// Whether the case has these equations: steady rolling, friction that neither slip nor heat changes, no force over a
  /// load that is a result, one place or several that hang together.
  bool linear() const;
  /// more, less: the case with the input larger and smaller by `step`.
  ContactDerivative by(const PlacedCase& more, const PlacedCase& less, double step);
  /// The tractions of more and of less, whose wheels are lowered by `descents` [m]: those of the solution, and `step`
  /// times their derivatives.
  std::array<PlaneTractions, 2> tractions(const PlacedCase& more, const PlacedCase& less,
                                          const std::array<double, 2>& descents, double step);

 private:
  /// The patch of a case that differs a little, at a descent.
  struct Beside {
    CasePatch patch;
    RigidContact plane;
  };
  Beside beside(const PlacedCase& there, double descent) const;
  OnePatch lowered(const CaseSpec& spec, const Placement& placement, double descent) const;
  RollingDerivatives& rolling();
  PlaneTractions moved(const Beside& there, const RollingDerivative& slope, double step) const;
  ContactDerivative between(const Beside& more, const Beside& less, double step);
  const ContactDerivative& by_descent();

  const CaseSpec& spec_;
  const Placement& placement_;
  const BemOptions& options_;
  const BemStart& solved_;
  bool whole_;
  OnePatch one_;
  CasePatch patch_;
  std::optional<RollingDerivatives> rolling_;
  std::optional<ContactDerivative> by_descent_;
};

}  // namespace railstrata
