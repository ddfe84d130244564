#pragma once
// The way of a rail's points through the last pass: loops of stress against strain at a few of them, and the equivalent
// stress of a longitudinal section as the rail yields beside that of elastic bodies.
#include <string>
#include <vector>

#include "passes/rail_passes.hpp"

namespace railstrata {

/// A point of the section whose history over the passes is recorded.
struct WayPoint {
  std::string name;       ///< "governing", "surface", "above the border", "below the border"
  std::size_t point = 0;  ///< SteadyGrid::point
};

/// The governing point: where the net strain of the last pass is largest; where nothing flowed, where plastic strain is
/// largest; where there is none, below the middle of the patch where the elastic stress comes nearest to yield. Then in
/// its column the first row, and the rows above and below the lower border of each layer.
std::vector<WayPoint> way_points(const RailPasses& rail, const PassResult& last, const PassState& state);

struct PassWay {
  std::vector<WayPoint> points;
  std::vector<std::vector<StationState>> loops;  ///< per point, at the active stations in their order
  int column = 0;                                ///< of the longitudinal section: the governing point's
  std::vector<double> elastic, yielding;         ///< Pa, von Mises per row and active station, [row * stations + i];
                                                 ///< stress of the process is in both
};

/// contact: the strain of the last pass.
PassWay pass_way(const RailPasses& rail, const SteadyBody& body, const Field& contact, const PassResult& last,
                 const PassState& state);

}  // namespace railstrata
