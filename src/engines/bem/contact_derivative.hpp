#pragma once
// Derivatives of what solve_bem gives by the inputs of its case, at a solution of one patch: the equations of the cells
// in contact, sticking and slipping, linearised at sets that stand. [Kalker1990 ch. 4]
#include <array>
#include <optional>

#include "bem/case_patch.hpp"
#include "bem/one_patch.hpp"
#include "bem/rolling_derivatives.hpp"
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

/// What changes with an input: places of the cells, under the tractions of the solution; sums of these per unit.
struct CarriedChange {
  PlaneTractions more, less;
  std::vector<double> sums;
};

/// All derivatives are taken at a descent d of the wheel, which the plane follows too. Under a weight G it follows each
/// input u by V(u, d) = N cos(delta) - T sin(delta) = G (solve_bem.hpp):
///   dV/du + dV/dd d' = dG/du,   dV = dN cos(delta) - dT sin(delta) - (N sin(delta) + T cos(delta)) d delta.
/// Geometry changes by differences, all else by the adjoint systems of rolling_derivatives.hpp.
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
  PlaneTractions here() const;
  /// Sums over the cells of here() instead of a contact's own, for change_of.
  void weigh(std::vector<TractionSum> sums);
  /// descents: of the wheels of more and of less, m.
  CarriedChange change_of(const PlacedCase& more, const PlacedCase& less, const std::array<double, 2>& descents,
                          double step);

 private:
  /// The patch of a case that differs a little, at a descent.
  struct Beside {
    CasePatch patch;
    RigidContact plane;
  };
  Beside beside(const PlacedCase& there, double descent) const;
  void carry_influence(CasePatch& there) const;
  OnePatch lowered(const CaseSpec& spec, const Placement& placement, double descent) const;
  RollingDerivatives& rolling();
  PlaneTractions tractions_in(const CasePatch& patch, const RigidContact& plane) const;
  ContactDerivative between(const Beside& more, const Beside& less, double step);
  const ContactDerivative& by_descent();

  const CaseSpec& spec_;
  const Placement& placement_;
  const BemOptions& options_;
  const BemStart& solved_;
  bool whole_;
  OnePatch one_;
  CasePatch patch_;
  std::vector<TractionSum> sums_;
  std::optional<RollingDerivatives> rolling_;
  std::optional<ContactDerivative> by_descent_;
};

}  // namespace railstrata
