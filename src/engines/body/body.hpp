#pragma once
// A meshed elastic body with its hanging and prescribed nodes, ready for computing. Constant once it is made: any
// number of threads may use one body, each with a traversal of its own (body/traversal.hpp). What changes is the
// BodyState.
#include <vector>

#include "body/element_tables.hpp"
#include "body/initial_stress.hpp"
#include "body/plastic_elements.hpp"
#include "body/ties.hpp"
#include "body/tiling.hpp"

namespace railstrata {

/// One component of one free section node at all stations.
struct NodeLine {
  std::ptrdiff_t first;
  int count, component, block, node;
};

struct Body {
  Body(const SweptBody& mesh, const std::vector<Elastic>& materials, const ElementOptions& options);

  SweptBody mesh;
  BodyLayout layout;
  std::vector<Elastic> materials;
  ElementOptions options;
  std::vector<BlockElements> elements;  ///< per block
  Tiling tiling;
  Ties ties;
  Field element_mass;  ///< kg, lumped from the elements, the same for the three components of a node; padding zero
  Field mass;          ///< kg, of the free nodes with what they carry; slaves and prescribed nodes have zero
  Field inverse_mass;  ///< 1/kg, zero likewise
  std::vector<NodeLine> lines;   ///< of free nodes
  PlasticElements plastic;       ///< that may yield; none unless they are put here before the body is used
  InitialStress initial_stress;  ///< likewise; elements which may yield have theirs with their material too

  bool is_free(int block, int node) const { return inverse_mass[layout.blocks[block].line(node, 0)] > 0; }
};

/// kg, of all elements.
double total_mass(const Body& body);

/// Position of a node in the undeformed body, model frame.
Vec3 reference_position(const Body& body, int block, int node, int station);

/// Distance of a section node from the axle, negative below it: z of the section; the arm of station angle t is
/// (-z sin t, 0, z cos t) for a revolved body.
inline double line_radius(const Body& body, int block, int node) {
  return body.mesh.blocks[block].section.nodes[node].z;
}

/// d = the diagonal of the stiffness K of the undeformed body.
void stiffness_diagonal(const Body& body, Field& d);

/// The smallest stable step of the free elements [s] and the block that has it.
struct StepBound {
  double step = 0;
  int block = 0;
};
StepBound element_step_bound(const Body& body);

}  // namespace railstrata
