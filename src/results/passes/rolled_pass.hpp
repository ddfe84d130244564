#pragma once
// Result of a pass by the finite elements: plastic strain of the section and residual stress, point by point and as a
// row of a table. A point is a quadrilateral of the elements that may yield, with the means over its Gauss points.
#include <array>
#include <string>
#include <vector>

#include "body/plastic_section.hpp"
#include "fem/preload.hpp"
#include "passes/pass_point.hpp"
#include "passes/rail_passes.hpp"

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

/// Limit of RolledPass::uneven up to which the stations count as steady.
inline constexpr double kLargestUnevenness = 0.1;
/// What is wrong beyond it, and what to do; empty below.
std::string unevenness_text(double uneven);
/// RolledPass::uneven, from the sections of both halves, all of the same quadrilaterals.
double unevenness(const PlasticSection& before, const PlasticSection& first, const PlasticSection& second);

}  // namespace railstrata
