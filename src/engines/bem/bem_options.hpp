#pragma once
// How the half-space engine solves a case.
#include <functional>
#include <vector>

#include "bem/rolling_contact.hpp"

namespace railstrata {

/// Where the rail's surface stands by what these tractions do not cause (plastic strain), in the cells of a grid.
struct RailSurface {
  Plane sinking;      ///< m, opens the gap
  PlanePair stretch;  ///< its displacement over a step ahead (one cell) less that of the cell, along x and y, per m:
                      ///< slip of the rail's surface
};

struct BemStart {
  PatchGrid grid;
  RollingSolution solution;
  double rail_s = 0;  ///< m, of its place on the rail
};

/// The force of a point contact grows with this power of the approach.
inline constexpr double kPowerOfHertz = 1.5;

/// A creepage that is sought, and its change with the force, 1/N, of the last search.
struct SoughtCreepage {
  double creepage = 0, compliance = 0;
};

/// The patches of a solution of a similar case, to start the next one from: wheels of a vehicle move little from one
/// time step to the next.
struct BemNeighbour {
  std::vector<BemStart> patches{};
  double descent = 0;                           ///< m, of the wheel below the place where it touches first
  double power = kPowerOfHertz;                 ///< of the descent in the vertical force, of one patch
  SoughtCreepage along{}, across{};             ///< of the wheel's reference, of several patches
  bool whole = false;                           ///< of one patch: all places of the wheel are in its plane
  std::vector<std::vector<BemStart>> smooth{};  ///< without friction: of each trial which patches merge
  std::vector<BemNeighbour> others{};           ///< where the answer is a mean of several: those after the first
  bool empty() const { return patches.empty(); }
  /// The one patch that bears all, of the first answer; null: there are several, or none.
  const BemStart* alone() const { return patches.size() == 1 ? &patches.front() : nullptr; }
};

struct BemOptions {
  double cell = kDefaultCell;    ///< m
  double across = 0;             ///< m, the cells across rolling; 0: as long as wide
  double largest_patch = 60e-3;  ///< m, of the potential contact area, per direction
  RollingOptions rolling;
  double balance = 1e-5;              ///< of the weight: how well normal and lateral force together bear it
  InfluenceCache* cache = nullptr;    ///< for sweeps; may be null
  BemNeighbour* neighbour = nullptr;  ///< may be null. Becomes this solution; numbers then depend on what it was,
                                      ///< within the tolerances of the solver
  double descent = 0;  ///< m, of the wheel, where the approach was made of it; 0: that of the approach (descent_of)
  bool keep_cells = false;  ///< patches keep the cells of the neighbour's where their sizes are within the double: for
                            ///< the trials of one search, whose forces then have no steps
  bool apart = true;  ///< parts of a patch of several contacts that are not connected become patches of the result;
                      ///< false: one patch, as its plane was solved
  std::function<RailSurface(const PatchGrid&)> rail_surface = {};  ///< empty: the surface of its profile
};

}  // namespace railstrata
