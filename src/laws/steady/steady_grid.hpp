#pragma once
// Grid of a stationary solution: stations along the travel, columns across it, rows of depth.
//
// The load stands still at x = 0 and travels to +x, so that the material comes from ahead: station 0 is the foremost,
// a streamline runs through the stations in their order. The grid is periodic along x and y. What that needs:
//
//   x = front         .. -active        plastic flow is followed
//   x = -active       .. -active - hold  plastic strain stays what it has become
//   x = -active-hold  .. front - length  it returns smoothly to what it was ahead, for the period's sake alone
//
// The return is no physics: plastic strain that goes back leaves stress around it, so it must be far from where flow is
// followed and slow. What it does to the load's surroundings is of the order of the pass's increment alone and dies
// away as 1/distance in plane strain, 1/distance² under a patch.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <vector>

namespace railstrata {

struct SteadyGrid {
  int nx = 0;                          ///< stations
  int ny = 1;                          ///< columns; 1: plane strain
  double dx = 0, dy = 0;               ///< m
  double front = 0;                    ///< m, x of the foremost border
  double y0 = 0;                       ///< m, y of column 0
  double active = 0, hold = 0;         ///< m, see above
  int steps = 1;                       ///< of the law from station to station, see path()
  std::vector<double> thickness = {};  ///< m, of the rows where plastic strain may be, from the surface down
  double x(int i) const { return front - (i + 0.5) * dx; }
  double y(int j) const { return y0 + j * dy; }
  int rows() const { return static_cast<int>(thickness.size()); }
  /// Stations where plastic flow is followed.
  int active_stations() const { return std::clamp(static_cast<int>(std::lround((front + active) / dx)), 1, nx); }
  /// The places along a streamline where the law is taken, `steps` for each station, as stations of their own: the
  /// strain of the contact is that at these. What the body answers is smoother, and belongs to stations.
  SteadyGrid path() const {
    SteadyGrid out = *this;
    out.nx *= steps;
    out.dx /= steps;
    out.active = active_stations() * dx - front;
    out.steps = 1;
    return out;
  }
  /// Mid-depth of a row, m.
  double depth(int row) const {
    const auto at = thickness.begin() + row;
    return std::accumulate(thickness.begin(), at, 0.0) + 0.5 * *at;
  }
  /// Share of the pass's increment at a station behind the active ones: 1, then cos² to 0.
  double share(int i) const {
    const double end = front - nx * dx, begin = -active - hold;
    return 0.5 - 0.5 * std::cos(std::numbers::pi * std::clamp((x(i) - end) / (begin - end), 0.0, 1.0));
  }

  std::size_t plane() const { return static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny); }
  /// Layout of a field of six components: xx, yy, zz, xy, yz, xz, each a plane per row, columns fastest.
  std::size_t size() const { return 6 * thickness.size() * plane(); }
  std::size_t index(int component, int row, int i, int j) const {
    return ((static_cast<std::size_t>(component) * thickness.size() + static_cast<std::size_t>(row)) *
                static_cast<std::size_t>(nx) +
            static_cast<std::size_t>(i)) *
               static_cast<std::size_t>(ny) +
           static_cast<std::size_t>(j);
  }
  /// Layout of a field at active stations alone, likewise.
  std::size_t active_size() const { return active_index(6, 0, 0, 0); }
  std::size_t active_index(int component, int row, int i, int j) const {
    const int line = (component * rows() + row) * active_stations() + i;
    return static_cast<std::size_t>(line) * static_cast<std::size_t>(ny) + static_cast<std::size_t>(j);
  }
  /// A point of the section.
  std::size_t point(int row, int j) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(ny) + static_cast<std::size_t>(j);
  }
  std::size_t points() const { return thickness.size() * static_cast<std::size_t>(ny); }
};

}  // namespace railstrata
