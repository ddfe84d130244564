#pragma once
// How the half-space engine solves a case.
#include <functional>

#include "bem/rolling_contact.hpp"

namespace railstrata {

/// Where the rail's surface stands by what these tractions do not cause (plastic strain), in the cells of a grid.
struct RailSurface {
  Plane sinking;      ///< m, opens the gap
  PlanePair stretch;  ///< its displacement over a step ahead (one cell) less that of the cell, along x and y, per m:
                      ///< slip of the rail's surface
};

/// A solution of a similar case and its grid, to start the next one from: wheels of a vehicle move little from one time
/// step to the next. Of one patch with one load.
struct BemNeighbour {
  PatchGrid grid;
  RollingSolution solution;
  double descent = 0;  ///< m, of the wheel below the place where it touches first
  bool empty() const { return solution.normal.pressure.empty(); }
};

struct BemOptions {
  double cell = kDefaultCell;    ///< m
  double across = 0;             ///< m, the cells across rolling; 0: as long as wide
  double largest_patch = 60e-3;  ///< m, of the potential contact area, per direction
  RollingOptions rolling;
  double balance = 1e-5;              ///< of the weight: how well normal and lateral force together bear it
  InfluenceCache* cache = nullptr;    ///< for sweeps; may be null
  BemNeighbour* neighbour = nullptr;  ///< may be null. Becomes this solution where one patch bears the load, else
                                      ///< empty. Numbers then depend on it, within the tolerances of the solver
  bool apart = true;  ///< parts of a patch of several contacts that are not connected become patches of the result;
                      ///< false: one patch, as its plane was solved
  std::function<RailSurface(const PatchGrid&)> rail_surface = {};  ///< empty: the surface of its profile
};

}  // namespace railstrata
