#pragma once
// What a section's surface gives under waves of line loads: influence of the real body, wave by wave.
#include <Eigen/Core>
#include <vector>

#include "halfspace/layered.hpp"
#include "section/section_stiffness.hpp"

namespace railstrata {

/// Loads and displacements at stations across the running surface, at equal arc lengths: a load is spread over the arc
/// as a hat with its foot points at the neighbours, and displacements are weighed by the same hats. Index 3 m +
/// direction at station m, directions x, y, z of the section; along x amplitudes of i e^{ikx}, else of e^{ikx}, of
/// forces per length along x and across [N/m].
struct SectionCompliance {
  double spacing = 0;               ///< m
  std::vector<Vec2> stations;       ///< m, in the section's plane
  std::vector<double> k;            ///< 1/m, increasing
  std::vector<Eigen::MatrixXd> at;  ///< 1/Pa, of each k
  std::vector<double> by_rotation;  ///< m s², displacement along z by a squared angular velocity; empty: not revolved
};

/// Forces of the hats at `count` stations, each of one newton per metre along the sweep, on free nodes.
Eigen::MatrixXd hat_loads(const QuadraticSection& mesh, int columns, int count);
/// Stations whose hats stand whole on the band's surface.
int station_count(const QuadraticSection& mesh, int columns);

/// columns: of the band's surface from one station to the next. Wave numbers are solved in parallel.
SectionCompliance section_compliance(const QuadraticSection& mesh, const SectionStiffness& stiffness, int columns,
                                     const std::vector<double>& k);

/// The same of a half-space below a plane with the directions x, along the stations, and into the body, at `count`
/// stations. above: the body lies above the plane, and the third direction points out of it.
std::vector<Eigen::MatrixXd> half_space_compliance(const LayeredHalfSpace& body, bool above, double spacing, int count,
                                                   const std::vector<double>& k);

}  // namespace railstrata
