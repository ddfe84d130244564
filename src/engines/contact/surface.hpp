#pragma once
// The running surface of a swept body as the contact sees it: the top nodes of the contact band, with the exact profile
// between them.
#include <cassert>
#include <cmath>
#include <functional>

#include "core/rotation.hpp"
#include "geometry/height_field.hpp"
#include "mesh/layout.hpp"
#include "mesh/swept.hpp"

namespace railstrata {

/// A point of the profile in section coordinates of the body and the unit normal out of the material.
struct SectionPoint {
  Vec2 position, outward;
};
using SectionCurve = std::function<SectionPoint(double s)>;

/// Where a node of the running surface stands.
struct SurfaceIndex {
  int column, station;
};

struct ContactSurface {
  Vec3 origin;
  double contact_at = 0;  ///< SweptBody::contact_at
  double radius = 1;      ///< m, of a revolved surface, the largest: metres per unit of the sweep coordinate
  bool rises = false;     ///< a rail that is a ring, axle below (SweptBody::rises)
  Rotation<double> yaw;   ///< of the body's axes about the vertical through its origin, from the model's
  int columns = 0;        ///< nodes across
  Stations stations;
  std::vector<Vec2> node;         ///< section coordinates of the surface nodes, y increasing
  std::vector<Vec2> outward;      ///< unit normals there
  std::vector<Vec2> sagitta;      ///< exact mid-facet point minus the chord's middle, columns - 1
  std::vector<double> s;          ///< profile arc length of the nodes
  std::vector<double> width;      ///< arc length of the facets, columns - 1
  std::ptrdiff_t first_line = 0;  ///< layout line of node 0, component 0
  int stride = 0;                 ///< between components; nodes are 3 strides apart
  HeightField heights;            ///< along the surface, out of the body; the mesh has none of it
  double first_contact_y = 0;     ///< m, model frame: from where on the heights count y
  /// Index of component x of a node in the body's fields; y and z follow one and two strides on.
  std::ptrdiff_t index(int column, int station) const {
    assert(column >= 0 && column < columns);
    assert(station >= 0 && station < stations.nodes());
    return first_line + static_cast<std::ptrdiff_t>(column) * 3 * stride + station;
  }
  /// y and z, model frame, of a column's node of the undeformed body where the contact is.
  Vec2 at_contact(int column) const {
    return {origin.y + node[column].y, origin.z + (rises ? -node[column].z : node[column].z)};
  }
  /// Normal of a rail at a column, model frame, out of the material, `ahead` [m] of where the contact is.
  Vec3 rail_normal(int column, double ahead) const {
    const Vec2 n = outward[column];
    if (!rises) return {0, n.y, n.z};
    return {-n.z * std::sin(ahead / radius), n.y, -n.z * std::cos(ahead / radius)};
  }
  /// The inverse of index().
  SurfaceIndex node_at(std::ptrdiff_t index) const {
    const std::ptrdiff_t k = index - first_line;
    return {static_cast<int>(k / (3 * stride)), static_cast<int>(k % (3 * stride))};
  }
};

ContactSurface contact_surface(const SweptBody& body, const BodyLayout& layout, const SectionCurve& curve);

}  // namespace railstrata
