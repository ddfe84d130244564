#pragma once
// Wear fed back to the rail's profile: a load collective is solved, its wear taken off, and so on with the worn rail.
//
// A step takes as many passages as wear the deepest place by a chosen depth. The wear of a cell is moved inwards along
// the profile's normal. Before that neighbouring cells that wheels have rolled over exchange a quarter of their
// difference, again and again until a peak of one cell has a standard deviation of 1 mm: the area stays, and
// where nothing rolled nothing wears. The uppermost layer of the rail thins: every load is solved with the thickness
// that is left where it touches, and a step takes no more than what is left where the layer wears through first. The
// rail stays in its place in the track: what wears off its gauge face widens
// the gauge.
#include <cstdint>
#include <filesystem>
#include <vector>

#include "collective/collective.hpp"

namespace railstrata {

/// A rail on its way.
struct WornRail {
  int step = 0;                ///< steps taken
  double passages = 0;         ///< of the whole collective, since the beginning
  double area = 0;             ///< m², worn off since the beginning
  std::vector<Vec2> points;    ///< m, frame of the unworn profile
  std::filesystem::path file;  ///< where they stand; empty: the case's own profile
};

WornRail unworn(const Placement& placement, double cell);

/// m, how far a point of the worn rail lies below the unworn one, in its frame; of the unworn one's pieces those from
/// the point `from` - 1 up to `to` count.
double depth_below(const std::vector<Vec2>& unworn, Vec2 point, std::size_t from = 1, std::size_t to = SIZE_MAX);

/// The case on the worn rail; `original` is its placement on the unworn one.
CaseSpec on_worn_rail(const CaseSpec& spec, const Placement& original, const WornRail& rail);

struct WearStepOptions {
  CollectiveOptions collective;
  double max_wear = 0.005e-3;  ///< m, at the deepest place in one step
  double passages_left = 0;    ///< at most so many; 0: as many as max_wear allows
};

/// Result of a step.
struct WearStep {
  std::vector<CollectiveRow> rows;     ///< on the rail as it was before the step
  RailDamage damage;                   ///< of one collective
  double passages = 0;                 ///< of this step
  double deepest = 0;                  ///< m
  double wanted_area = 0;              ///< m², of the streamlines
  double gauge = 0;                    ///< m, of the track on the rail as it was
  WornRail rail;                       ///< afterwards; its area is that between the profiles, its file empty
  double layer_left = kNotApplicable;  ///< m, of the rail's uppermost layer where least is left after the step; 0: worn
                                       ///< through; NaN without a layer
  double layer_y = kNotApplicable;     ///< m, of that place in the rail's frame
  double tonnes = 0;                   ///< gross, of this step's wheels
  bool stopped = false;                ///< on request: nothing of this is complete
};

/// Throws CaseError where a load cannot be solved or fails a check, where nothing wears, and where the wear law lacks
/// its data.
WearStep wear_step(const CaseSpec& spec, const std::filesystem::path& folder, const Placement& original,
                   const WornRail& rail, const WearStepOptions& options);

}  // namespace railstrata
