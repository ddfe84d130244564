#pragma once
// An elastic body with its hanging and fixed nodes.
#include <vector>

#include "body/solid.hpp"
#include "body/ties.hpp"

namespace railstrata {

/// A deformable body with its constraints and lumped inertia.
struct DeformableBody {
  Solid solid;
  Ties ties;
  Field mass;          ///< of the free nodes; slaves, fixed and rigid nodes have zero
  Field inverse_mass;  ///< zero likewise
  /// Lines of free nodes: one component of one section node at all stations.
  struct Line {
    std::ptrdiff_t first;
    int count, component, block, node;
  };
  std::vector<Line> lines;

  DeformableBody(const SweptBody& mesh, const std::vector<Elastic>& materials, const SolidOptions& options);
};

}  // namespace railstrata
