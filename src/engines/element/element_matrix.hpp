#pragma once
// Stiffness matrices of single elements, for set-up and checks; defined in reference.cpp beside the shape functions.
#include <Eigen/Core>

#include "element/reference.hpp"

namespace railstrata {

using Matrix24 = Eigen::Matrix<double, 24, 24>;
/// Linear stiffness of the element in its own frame (dof 3 a + i, corners as in local_corners), from the reference data
/// the solver uses.
Matrix24 linear_stiffness(const QuadReference& ref, SweepScale scale, const HourglassStiffness& hourglass);
/// Stiffness of the fully integrated incompatible-mode element, condensed: what `full` must reproduce.
Matrix24 incompatible_mode_stiffness(const std::array<Vec3, 8>& corners, const Elastic& material);

}  // namespace railstrata
