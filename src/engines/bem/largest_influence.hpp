#pragma once
#include "bem/influence_operator.hpp"
#include "bem/plane_algebra.hpp"

namespace railstrata {

/// Largest eigenvalue [m/Pa] of the displacement by tangential traction, rail minus wheel, where `inside` > 0: that of
/// a traction of one sign over the whole patch. By powers of the operator, from below; the tenth has it to a
/// thousandth.
double largest_tangential_influence(const InfluenceOperator& influence, const Plane& inside);

}  // namespace railstrata
