#pragma once
// Layers that begin and end along the sweep. The rows of a section serve all stacks that occur: a *slab* is what lies
// between two depths at which any of them has an interface. A slab belongs to one layer or to the matrix, by station.
#include <vector>

#include "mesh/bodies.hpp"

namespace railstrata {

/// Depths of the layers' bottoms: each lies below those before it that it meets.
std::vector<double> layer_bottoms(const std::vector<LayerMesh>& layers);

/// The slabs from the surface down, as layers of which none ends; the layers themselves where none does. Layers of
/// which any ends have one width.
std::vector<LayerMesh> slabs_of(const std::vector<LayerMesh>& layers);

/// In a body whose sections have slabs for materials: gives their quadrilaterals the layers' materials, and its blocks
/// a set for every stack that occurs in them. metres: per unit of the sweep coordinate. Nothing where no layer ends.
void set_stacks(SweptBody& body, const std::vector<LayerMesh>& layers, double metres);

}  // namespace railstrata
