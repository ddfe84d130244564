#include "export/solid_model.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/rotation.hpp"
#include "mesh/station_weights.hpp"
#include "mesh/unstructured.hpp"
#include "rules/support.hpp"

namespace railstrata {
namespace {

/// Numbers of the nodes of a body as unstructured() has them, and which hang on which.
class NodeCarriers {
 public:
  explicit NodeCarriers(const SweptBody& body) : body_(body) {
    for (const Block& block : body.blocks) {
      first_.push_back(count_);
      count_ += static_cast<long>(block.section.nodes.size()) * block.stations.nodes();
    }
    for (const Tie& tie : body.ties) ties_.emplace(std::pair{tie.slave_block, tie.slave_node}, &tie);
  }

  long number(int block, int node, int station) const {
    return first_[block] + static_cast<long>(station) * static_cast<long>(body_.blocks[block].section.nodes.size()) +
           node;
  }
  bool hangs(int block, int node) const { return ties_.contains({block, node}); }

  std::vector<HangingNode> hanging() const {
    std::vector<HangingNode> out;
    for (const auto& [at, tie] : ties_)
      for (int j = 0; j < body_.blocks[at.first].stations.nodes(); ++j) {
        std::map<long, double> weights;
        add_carriers(at.first, at.second, j, 1, weights);
        HangingNode node{number(at.first, at.second, j), {}};
        for (const auto& [carrier, weight] : weights) node.carriers.push_back({carrier, weight});
        out.push_back(std::move(node));
      }
    return out;
  }

 private:
  /// A carrier that hangs hands on to its own.
  void add_carriers(int block, int node, int station, double share, std::map<long, double>& weights) const {
    if (share == 0) return;
    const auto known = ties_.find({block, node});
    if (known == ties_.end()) {
      weights[number(block, node, station)] += share;
      return;
    }
    const Tie& tie = *known->second;
    const StationWeights at =
        station_weights(body_.blocks[tie.master_block].stations, body_.blocks[block].stations.at[station]);
    for (const auto& [master, across] :
         {std::pair{tie.master_node0, 1 - tie.weight1}, std::pair{tie.master_node1, tie.weight1}}) {
      add_carriers(tie.master_block, master, at.left, share * across * (1 - at.weight), weights);
      add_carriers(tie.master_block, master, at.right, share * across * at.weight, weights);
    }
  }

  const SweptBody& body_;
  std::vector<long> first_;
  long count_ = 0;
  std::map<std::pair<int, int>, const Tie*> ties_;  // by (block, node)
};

long first_cell(const SweptBody& body, int block) {
  long first = 0;
  for (int b = 0; b < block; ++b)
    first += static_cast<long>(body.blocks[b].section.quads.size()) * body.blocks[b].stations.elements();
  return first;
}

/// The edge of a quadrilateral whose both corners lie on the running surface.
int surface_edge(const std::array<int, 4>& quad, int columns) {
  for (int k = 0; k < 4; ++k)
    if (quad[k] <= columns && quad[(k + 1) % 4] <= columns) return k;
  return -1;
}

/// Faces of the top row whose middle is at most `reach` [m] along the path from the first point of contact and whose
/// nodes are free: the outermost columns hang on a coarser block.
std::vector<SurfaceFace> surface_faces(const SweptBody& swept, const NodeCarriers& nodes, double contact_x,
                                       double reach) {
  const ContactBand& band = swept.contact;
  const Block& block = swept.blocks[band.block];
  const long quads = static_cast<long>(block.section.quads.size()), first = first_cell(swept, band.block);
  std::vector<SurfaceFace> out;
  for (int j = 0; j < block.stations.elements(); ++j) {
    const int next = (j + 1) % block.stations.nodes();
    for (int c = 0; c < band.columns; ++c) {
      const int edge = surface_edge(block.section.quads[c], band.columns);
      const std::array<int, 4>& quad = block.section.quads[c];
      const int a = quad[edge], b = quad[(edge + 1) % 4];
      if (nodes.hangs(band.block, a) || nodes.hangs(band.block, b)) continue;
      const Vec3 here = swept_point(swept.kind, swept.origin, block.section.nodes[a], block.stations.at[j]),
                 there = swept_point(swept.kind, swept.origin, block.section.nodes[a], block.stations.at[next]);
      const Vec3 middle = 0.5 * (here + there);
      const bool below_axle = swept.kind == SweepKind::extrude || middle.z < swept.origin.z;
      if (!below_axle || std::abs(middle.x - contact_x) > reach) continue;
      out.push_back({first + j * quads + c,
                     edge,
                     {nodes.number(band.block, a, j), nodes.number(band.block, b, j), nodes.number(band.block, b, next),
                      nodes.number(band.block, a, next)}});
    }
  }
  return out;
}

SolidBody solid_body(BodyId id, const SweptBody& swept, const std::vector<Elastic>& materials, double contact_x,
                     double reach) {
  HexMesh mesh = unstructured(swept);
  const NodeCarriers nodes(swept);
  SolidBody out;
  out.id = id;
  out.points = std::move(mesh.points);
  for (const std::array<long long, 8>& c : mesh.cells) {
    std::array<long, 8> cell{};
    std::copy(c.begin(), c.end(), cell.begin());
    out.cells.push_back(cell);
  }
  out.material = std::move(mesh.material);
  out.materials = materials;
  out.material_names = swept.materials;
  out.hanging = nodes.hanging();
  for (const SectionNode& n : swept.prescribed)
    if (!nodes.hangs(n.block, n.node))
      for (int j = 0; j < swept.blocks[n.block].stations.nodes(); ++j)
        out.prescribed.push_back(nodes.number(n.block, n.node, j));
  out.face = surface_faces(swept, nodes, contact_x, reach);
  return out;
}

double cell_volume(const SolidBody& body, const std::array<long, 8>& cell) {
  // six tetrahedra around the diagonal from corner 0 to corner 6
  constexpr int ring[6] = {1, 2, 3, 7, 4, 5};
  const Vec3 from = body.points[cell[0]], diagonal = body.points[cell[6]] - from;
  double six = 0;
  for (int k = 0; k < 6; ++k)
    six +=
        std::abs(dot(diagonal, cross(body.points[cell[ring[k]]] - from, body.points[cell[ring[(k + 1) % 6]]] - from)));
  return six / 6;
}

double meshed_mass(const SolidBody& body) {
  double mass = 0;
  for (std::size_t e = 0; e < body.cells.size(); ++e)
    mass += body.materials[body.material[e]].density * cell_volume(body, body.cells[e]);
  return mass;
}

/// 1/Pa, of a half-space under pressure.
double compliance(const Elastic& m) { return (1 - poisson(m) * poisson(m)) / young(m); }

double least_compliance(const SolidBody& body) {
  double least = compliance(body.materials.front());
  for (const Elastic& m : body.materials) least = std::min(least, compliance(m));
  return least;
}

/// The wheel's axes are turned about the vertical through the axle's centre.
void turn_about_axle(SolidBody& wheel, Vec3 axle, double angle) {
  const Rotation<double> turn = rotation_by(angle);
  for (Vec3& p : wheel.points) p = axle + yaw(turn, p - axle);
}

}  // namespace

double missed_by_nodes(const SolidModel& model) {
  const auto pressure = [](double x, double y) { return std::sqrt(std::max(0.0, 1 - x * x - y * y)); };
  const double smaller = std::cbrt((least_compliance(model.rail) + least_compliance(model.wheel)) /
                                   (compliance(model.rail.materials[0]) + compliance(model.wheel.materials[0])));
  const double u = 0.5 * model.element_size / (smaller * model.a), v = 0.5 * model.element_size / (smaller * model.b);
  const double node = pressure(u, v);
  const double above = (node - pressure(3 * u, v)) / 8 + (node - pressure(u, 3 * v)) / 8;
  return node > 0 ? above / (node + above) : 1;
}

SolidModel solid_model(const Model& m) {
  require_support(uses::kDeck, m.spec);
  const RigidContact& contact = m.placement.contact;
  const double h = m.spec.mesh.element_size, reach = 1.5 * m.hertz.a + 3 * h;
  SolidModel out;
  out.title = m.spec.title;
  out.rail = solid_body(BodyId::rail, m.rail, m.rail_materials, contact.x, reach);
  out.wheel = solid_body(BodyId::wheel, m.wheel, m.wheel_materials, contact.x, reach);
  out.axle = m.wheel.origin;
  if (contact.yaw != 0) turn_about_axle(out.wheel, out.axle, contact.yaw);
  out.axle_load = m.load - meshed_mass(out.wheel) * kGravity;
  out.static_load = m.load;
  out.approach = m.hertz.approach;
  out.p_max = m.hertz.p0;
  out.a = m.hertz.a;
  out.b = m.hertz.b;
  out.element_size = h;
  out.friction = m.spec.drive.friction_coefficient;
  out.one_point = m.spec.mesh.element == ElementFormulation::one_point;
  return out;
}

}  // namespace railstrata
