#pragma once
// Plastic state of one element, as plain numbers.
#include "core/vec.hpp"

namespace railstrata {

/// Means over an element's points by their shares of the volume, in the model frame: the element's own frame turned as
/// its body is (the rotation that strains bring along is left out).
struct ElementPlasticity {
  Sym3 strain;             ///< Ep, tensor shears
  Sym3 backstress;         ///< Pa, sum of all
  double accumulated = 0;  ///< p
};

}  // namespace railstrata
