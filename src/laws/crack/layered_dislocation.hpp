#pragma once
// What layers add to the stresses of a dislocation in a half-plane.
//
// A dislocation at depth z0 is a jump of displacement there, b H(x - x0); per wave number k that is a jump of the state
// (U, W) of the layers' waves (halfspace/layer_waves.hpp), for which the free surface and the interfaces give the waves
// of all layers. From the stress the same half-plane of one metal, that of the place where the stress is asked, is
// taken away: what remains has no singularity at the dislocation and decays with k times the way over the interface.
#include <Eigen/Core>
#include <vector>

#include "crack/plane_of_rolling.hpp"
#include "halfspace/layered.hpp"

namespace railstrata {

struct CrackPoint {
  double x = 0, z = 0;  ///< m
};

/// Tractions on lines at an angle [rad]: of the points `at`, by dislocations at `from`. Rows: normal tractions of all
/// points, then the shear; columns: jumps b across the line of all, then along it. Pa/m. finest: m, over which
/// densities vary; empty where all layers are of one material.
Eigen::MatrixXd layers_traction(const LayeredHalfSpace& body, double angle, const std::vector<CrackPoint>& at,
                                const std::vector<CrackPoint>& from, double finest);

}  // namespace railstrata
