#pragma once
// Where the front of slip is between two points of a row.
//
// Next to the front, on its sticking side, the margin f p - |q| is c sqrt(t), t being the distance to the front: its
// square is linear. [Johnson1985 sec. 8.3] Cells have one traction each, the mean over the cell, so that the cell next
// to the front, or with the front in it, has the mean of that root.
#include <optional>

namespace railstrata {

/// The margins f p - |q| [Pa] of the sticking points next to the front, nearest first.
struct StickMargins {
  double near = 0, next = 0;
  std::optional<double> after;
};

/// Distance from the nearest sticking point to the front, of points: 0 to 1.
double front_behind_point(const StickMargins& margins);

/// Distance from the middle of the nearest sticking cell to the front, of cells: -0.5 (the cell's far side) to 1 (the
/// middle of the slipping cell). Without the third margin as of points.
double front_behind_cell(const StickMargins& margins);

}  // namespace railstrata
