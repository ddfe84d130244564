#pragma once
// Derivatives of a rolling contact by the inputs of its problem, sets of cells as they are: pressure and tractions
// together. [Kalker1990 ch. 4]
//
// Of pressures p and tractions q a few sums c·(p, q) are wanted, by many inputs. At sets that stand the equations of
// both problems are linear, A (p, q, creepages) = b with b the change of gap, approach, rigid slip, bound and forces by
// an input. With the adjoint system A^T z = c the sum changes by z·b: one system for a sum, none for an input. Unlike
// bodies couple the two problems; influence functions are symmetric (Betti), so A^T takes the products of A.
#include <memory>
#include <vector>

#include "bem/rolling_contact.hpp"

namespace railstrata {

/// A sum over the cells of pressure and traction, by its weights on the whole grid; empty: none.
struct TractionSum {
  Plane p, q_x, q_y;
};

/// Per unit of an input; creepages are those of given forces too.
struct RollingSlopes {
  std::vector<double> sums;
  double creepage_x = 0, creepage_y = 0, approach = 0;
};

class RollingDerivatives {
 public:
  /// Of steady rolling under an approach, without heat and bounds that vary with slip; a film whose modulus rises with
  /// the pressure has none. All but the sums are kept by reference.
  RollingDerivatives(const InfluenceOperator& influence, const PatchGrid& grid, const RollingContact& contact,
                     const RollingSolution& solution, const std::vector<TractionSum>& sums);
  ~RollingDerivatives();
  /// more, less: the problem with the input larger and smaller by `step`.
  RollingSlopes by(const RollingContact& more, const RollingContact& less, double step) const;

 private:
  struct Weights;
  struct System;
  const RollingContact& contact_;
  const Plane& whole_pressure_;
  std::unique_ptr<System> system_;
};

}  // namespace railstrata
