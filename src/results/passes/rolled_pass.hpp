#pragma once
// Result of a pass by the finite elements: plastic strain of the section and residual stress, point by point and as a
// row of a table. A point is a quadrilateral of the elements that may yield, with the means over its Gauss points. The
// way of the points through the pass, as passes/pass_way.hpp has it of the stationary method: rolling is steady, so
// that what stands along the rail when the wheel arrives is what a point has seen as the wheel came and went.
#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "body/plastic_section.hpp"
#include "fem/preload.hpp"
#include "fem/rolling_run.hpp"
#include "passes/rail_passes.hpp"
#include "record/unit.hpp"

namespace railstrata {

/// Quadrilaterals of a section, in the axes of PassPoint.
struct SectionMesh {
  std::vector<Vec2> nodes;                ///< m, (y, depth)
  std::vector<std::array<int, 4>> quads;  ///< nodes
};

struct RolledPass {
  PassRow row;                    ///< iterations: time steps; error: `uneven`
  double uneven = 0;              ///< largest difference of the pass's plastic strain between the two halves of the
                                  ///< steady stations, over the largest of its increments: 0: steady
  std::vector<PassPoint> points;  ///< in the order of PlasticSection::quads, without their class
  SectionMesh mesh;               ///< of the points
};
/// From the rail at rest (fem/rail_at_rest.hpp) with `after` at all stations. base: the model whose contact point gives
/// the axes; before: the same quadrilaterals before the pass; middle: m, of the steady stations.
RolledPass rolled_pass(const RollingSystem& system, const Model& base, const PlasticSection& before,
                       const PlasticSection& after, const RailBefore& at_rest, double middle);

/// State of the rail at the end of a rolling.
struct RolledRail {
  Field u;
  PlasticHistory history;
  double wheel = 0;              ///< m, where the axle is
  double behind = 0, ahead = 0;  ///< m, stations of the loops: between wheel - behind and wheel + ahead
};

/// Loops from well ahead of the wheel to well behind it, at the elements' centres; p: mean of the points. The governing
/// point: where the net strain of the pass is largest; where nothing flowed, where plastic strain is largest. Then in
/// its column of the fine zone the first row, and the rows above and below the border of each layer. None where nothing
/// has ever yielded. pass: of `section`'s quadrilaterals.
std::vector<PassLoop> rolled_loops(const RollingSystem& system, const Model& base, const PlasticSection& section,
                                   const RolledPass& pass, const RolledRail& rail);

/// Limit of RolledPass::uneven up to which the stations count as steady.
inline constexpr double kLargestUnevenness = 0.1;
/// What is wrong beyond it, and what to do; empty below.
std::string unevenness_text(double uneven);
/// RolledPass::uneven, from the sections of both halves, all of the same quadrilaterals.
double unevenness(const PlasticSection& before, const PlasticSection& first, const PlasticSection& second);

// ---- after a run with run.plasticity: plastic strain of the section and residual stress of the rail at rest, without
// the wheel
struct RunResidual {
  double from = 0, to = 0;  ///< m from where the wheel was put on: the stations whose mean is the section's
  RolledPass pass;          ///< of the whole run; of its row extremes, displacements and balance
  std::string none;         ///< why there is none; empty: there is
};

/// The steady stations of a run, in half-lengths a of Hertz's ellipse: from 6 to 4 behind the wheel at its end, if the
/// first of them lies beyond 6 a and beyond the run-up. Nearer to the start the rail has the marks of the wheel that
/// was put on; nearer to the wheel its strain still changes (runs/rolled_passes.hpp has the measurements).
/// One more increment of the rail's equilibrium is solved, with that state at all stations of an endless rail; nothing
/// yields in it. None, in words: the run is too short, nothing has yielded, no equilibrium.
RunResidual run_residual(const RollingSystem& system, const RollingState& end);

/// A number of residual.json, SI.
struct ResidualNumber {
  std::string_view name;  ///< its key, less the unit's ending
  Unit unit;
  std::string_view doc;
  double (*value)(const RunResidual&);

  std::string key() const { return std::string(name) + std::string(unit.key_ending); }
};
/// All numbers, in the order of the file; its writer and its documentation use them.
std::span<const ResidualNumber> residual_numbers();

/// One line for the screen: the most compressive stresses, or the reason why there are none.
std::string describe(const RunResidual& residual);
/// A warning where the stations are not steady; else empty.
std::string doubt_of(const RunResidual& residual);

}  // namespace railstrata
