#pragma once
// Mesh data of elements that yield (element/plastic_hex.hpp), computed once before the run.
#include <array>

#include "element/plastic_hex.hpp"
#include "element/reference.hpp"

namespace railstrata {

GaussShape<double> gauss_shape(SweepKind kind, const std::array<Vec2, 4>& quad);

/// For one station spacing, as the hourglass stiffness.
IncompatibleModes<double> incompatible_modes(SweepKind kind, const std::array<Vec2, 4>& quad, SweepScale scale,
                                             const Elastic& material);

}  // namespace railstrata
