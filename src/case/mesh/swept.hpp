#pragma once
// Swept hexahedral meshes: a plane section of quadrilaterals carried along a list of stations. A rail is extruded along
// x, a wheel revolved about its axle. Everything the solver knows of a mesh is here; how wheel and rail sections are
// made is in rail_mesh and wheel_mesh.
//
// Section coordinates are (y, z), y lateral, z up. A body has an origin in the model frame; a node of section point (y,
// z) at station t stands at
//   extrude (t = x [m])      origin + (t, y, z)
//   revolve (t = theta [rad]) origin + (-z sin t, y, z cos t),  z < 0: minus the distance to the axle; t = 0 is the
//   lowest point, t > 0 in front of it (x > 0).
// Elements between stations j and j+1 are congruent for equal station spacing: the solver keeps one set of reference
// data per quadrilateral, and a further one for every set of materials where they change along the sweep.
#include <algorithm>
#include <array>
#include <numbers>
#include <string>
#include <vector>

#include "core/sweep_kind.hpp"
#include "core/vec.hpp"

namespace railstrata {

/// A plane mesh of quadrilaterals, corners anticlockwise seen from +x (y to the right, z up).
struct Section {
  std::vector<Vec2> nodes;
  std::vector<std::array<int, 4>> quads;
  std::vector<int> quad_material;  ///< index into SweptBody::materials
};

/// Mean of the corners of a quadrilateral.
inline Vec2 centre_of(const Section& section, int quad) {
  Vec2 sum{};
  for (int n : section.quads[quad]) sum = sum + 0.25 * section.nodes[n];
  return sum;
}

/// Area of a quadrilateral by its diagonals, also of one that is not convex; positive for corners anticlockwise.
inline double quad_area(const Section& s, const std::array<int, 4>& quad) {
  return 0.5 * cross(s.nodes[quad[2]] - s.nodes[quad[0]], s.nodes[quad[3]] - s.nodes[quad[1]]);
}

/// Sweep coordinates of the node planes, increasing. closed: the last element joins the last station to the first (a
/// full ring, period 2 pi).
struct Stations {
  std::vector<double> at;
  bool closed = false;
  /// Of an element: it begins at at[element].
  double end(int element) const { return element + 1 == nodes() ? at.front() + 2 * std::numbers::pi : at[element + 1]; }
  double centre(int element) const { return 0.5 * (at[element] + end(element)); }
  /// The element around a place along the sweep, the nearest one beyond the ends.
  int element_at(double x) const {
    const auto above = std::upper_bound(at.begin(), at.end(), x);
    return std::clamp(static_cast<int>(above - at.begin()) - 1, 0, elements() - 1);
  }
  int nodes() const { return static_cast<int>(at.size()); }
  int elements() const { return closed ? nodes() : nodes() - 1; }
};

/// Materials of a section that change along the sweep. Empty: Section::quad_material all along.
struct MaterialSets {
  std::vector<std::vector<int>> sets;  ///< by set and quadrilateral; the first one is Section::quad_material
  std::vector<int> of_element;         ///< per element along the sweep, into sets
  bool empty() const { return sets.empty(); }
};

/// A section with its own stations.
struct Block {
  std::string name;  ///< "cap", "head", "rim", …: what reports call it
  Section section;
  Stations stations;
  MaterialSets along = {};

  int sets() const { return along.empty() ? 1 : static_cast<int>(along.sets.size()); }
  int set_of(int element) const { return along.empty() ? 0 : along.of_element[static_cast<std::size_t>(element)]; }
  int material_of_set(int set, int quad) const {
    return along.empty() ? section.quad_material[quad] : along.sets[static_cast<std::size_t>(set)][quad];
  }
  int material(int quad, int element) const { return material_of_set(set_of(element), quad); }
};

/// Hanging nodes: all nodes of one section node of a finer block are carried by a line of a coarser one,
/// u_slave(t) = (1 - w) u(master_node0, t) + w u(master_node1, t), with linear interpolation between the master block's
/// stations around t.
struct Tie {
  int slave_block = 0, slave_node = 0;
  int master_block = 0, master_node0 = 0, master_node1 = 0;
  double weight1 = 0;
};

/// The block that carries the running surface is a structured grid: node (column c, row r) has index r * (columns + 1)
/// + c, quadrilateral (c, r) index r * columns + c; row 0 of nodes lies on the surface, columns run with increasing y.
struct ContactBand {
  int block = 0;
  int columns = 0, rows = 0;            ///< elements
  std::vector<double> s;                ///< profile arc length of the columns + 1 surface nodes
  std::vector<double> depth;            ///< of the rows + 1 node rows below the surface, along the surface normal
  double fine_begin = 0, fine_end = 0;  ///< sweep coordinates between which the stations have the fine spacing
};

struct SectionNode {
  int block = 0, node = 0;
};

/// From and to of a stretch along the sweep.
struct SweepRange {
  double from = 0, to = 0;
};

/// The interface below a layer that has come off its base in some stretches. The nodes of the band's block there stand
/// twice in its section, at one place: those of the band's grid belong to what lies above, the others to what lies
/// below. Nothing in the mesh holds them together, in the stretches or elsewhere.
struct SplitInterface {
  int row = 0;             ///< of nodes of the band
  int first_column = 0;    ///< of `below`
  std::vector<int> below;  ///< nodes of the section, by column
  std::vector<SweepRange> open;
  double friction = 0;  ///< Coulomb's coefficient where it is open
};

struct SweptBody {
  std::string name;  ///< "rail", "wheel"
  SweepKind kind = SweepKind::extrude;
  Vec3 origin;
  double contact_at = 0;      ///< sweep coordinate under the wheel before the rolling: pi of a rail that is a ring
  std::vector<Block> blocks;  ///< masters and slaves in any order; a tie's slave is never master of a cycle
  std::vector<Tie> ties;
  ContactBand contact;
  std::vector<SplitInterface> interfaces;
  /// Rail: nodes of the foot's base (fixed); wheel: nodes of the bore (they move with the rigid axle).
  std::vector<SectionNode> prescribed;
  /// Nodes of the base of a rail on a track: free, pads press on them.
  std::vector<SectionNode> on_pads;
  std::vector<std::string> materials;  ///< names; 0 is the matrix, then the layers from the surface down, then those
                                       ///< of stretches
  std::vector<int> material_layer;     ///< of each material: 0 the matrix, k the k-th layer; the rows of a graded layer
                                       ///< share theirs. Empty: every material is a layer

  std::vector<double> strength;  ///< of each material, over that of its layer; empty: 1

  double strength_of(int material) const { return strength.empty() ? 1 : strength[static_cast<std::size_t>(material)]; }
  /// A rail that is a ring: its axle lies below the contact, where its sections stand on their heads.
  bool rises() const { return kind == SweepKind::revolve && contact_at != 0; }

  int layer_of(int material) const {
    return material_layer.empty() ? material : material_layer[static_cast<std::size_t>(material)];
  }

  long elements() const {
    long n = 0;
    for (const Block& b : blocks) n += static_cast<long>(b.section.quads.size()) * b.stations.elements();
    return n;
  }
  long nodes() const {
    long n = 0;
    for (const Block& b : blocks) n += static_cast<long>(b.section.nodes.size()) * b.stations.nodes();
    return n;
  }
};

/// Position in the model frame of a section point at sweep coordinate t.
inline Vec3 swept_point(SweepKind kind, Vec3 origin, Vec2 p, double t) {
  if (kind == SweepKind::extrude) return {origin.x + t, origin.y + p.y, origin.z + p.z};
  return {origin.x - p.z * std::sin(t), origin.y + p.y, origin.z + p.z * std::cos(t)};
}

}  // namespace railstrata
