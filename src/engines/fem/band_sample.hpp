#pragma once
// A sample of one body at the moving contact: plain numbers, without the solver that they come from.
#include <vector>

#include "body/element_plasticity.hpp"

namespace railstrata {

/// Stresses and displacements of a body's contact band around the wheel, on stations counted from the wheel's position
/// (relative station 0 is nearest to it). On a wheel they run on over the place where its ring closes.
struct BandSample {
  int columns = 0, rows = 0, stations = 0;  ///< elements
  std::vector<double> along;  ///< stations + 1: distance of the node planes from the axle in the rolling direction, m
                              ///< (arc length on the wheel)
  std::vector<int> element;   ///< per station, of the body along its sweep; empty where its materials are the same
  std::vector<Sym3> stress;   ///< Cauchy stress at the element centres, model frame, Pa; index (station * rows + row) *
                              ///< columns + column
  std::vector<ElementPlasticity> plastic;  ///< of the elements, as stress; empty where nothing may yield
  std::vector<Vec3> displacement;  ///< of the nodes, m, model frame, without the wheel's rigid motion; index (station *
                                   ///< (rows + 1) + row) * (columns + 1) + column
  std::vector<Vec3> below;         ///< the same of the nodes below split interfaces; station by station, in the order
                                   ///< of nodes_below (mesh/split_interface.hpp)
};

}  // namespace railstrata
