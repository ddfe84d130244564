#pragma once
// Quasi-static computations of small bodies that yield: damped explicit steps along a slow path.
#include <functional>

#include "body/plastic_pass.hpp"
#include "tests/body/sample_bodies.hpp"
#include "tests/mesh/brick_mesh.hpp"

namespace railstrata::fem_checks {

inline PlasticParameters<double> perfectly_plastic(const Elastic& m, double yield) {
  PlasticParameters<double> p{};
  p.mu = m.mu;
  p.yield = yield;
  return p;
}

/// All elements may yield.
inline void make_plastic(Body& body, const YieldingMaterial& material) {
  body.plastic = PlasticElements(
      body, [&](int, int, int) { return material; }, [](int, int, const Tile&) { return true; });
}

/// A structured section: node (column c, row r) at place(c, r), with rows from the top down; nothing is prescribed.
template <class Place>
SweptBody structured_body(SweepKind kind, int columns, int rows, const std::vector<double>& stations, Place&& place) {
  SweptBody body = mesh_brick(columns, rows, static_cast<int>(stations.size()) - 1, 1, 1, 1);
  body.kind = kind;
  Block& block = body.blocks[0];
  block.stations.at = stations;
  for (int r = 0; r <= rows; ++r)
    for (int c = 0; c <= columns; ++c)
      block.section.nodes[static_cast<std::size_t>(r * (columns + 1) + c)] = place(c, r);
  body.prescribed.clear();
  return body;
}

/// How a node of block 0 moves: freely along `free` (any directions normal to each other), at a given displacement
/// otherwise.
struct NodeMotion {
  std::vector<Vec3> free;
  Vec3 given;  ///< at the end of the path; grows with the load parameter
};

class Relaxation {
 public:
  using Motion = std::function<NodeMotion(int node, int station, Vec3 position)>;
  Relaxation(Body& body, const Motion& motion, double damping)
      : body_(body), elements_(body), state_(body), damping_(damping) {
    dt_ = 0.8 * element_step_bound(body).step;
    const BlockLayout& lay = body.layout.blocks[0];
    for (int n = 0; n < lay.nodes; ++n)
      for (int j = 0; j < lay.stations; ++j)
        nodes_.push_back({lay.line(n, 0) + j, lay.stride, motion(n, j, reference_position(body, 0, n, j)), n, j});
  }

  /// Steps to the load parameter `to` in a time of so many steps, then holds it for `rest` steps.
  void run(double to, int steps, int rest) {
    const double from = parameter_;
    for (int s = 1; s <= steps + rest; ++s) {
      evaluate();
      parameter_ = s >= steps ? to : from + (to - from) * s / steps;
      for (const Node& n : nodes_) move(n);
    }
    evaluate();
  }
  void evaluate() {
    advance_plastic_elements(body_, state_.u, 0, state_.history);
    elements_.internal_force(state_.u, 0, state_.f, state_.history);
  }
  BodyState& state() { return state_; }
  Traversal& elements() { return elements_; }
  /// Sum over the nodes of a measure of the internal force: of(node, station, position, force).
  template <class Of>
  double sum(Of&& of) const {
    double out = 0;
    for (const Node& n : nodes_)
      out += of(n.node, n.station, reference_position(body_, 0, n.node, n.station),
                vector_at(state_.f, n.index, n.stride));
    return out;
  }
  Vec3 displacement(int node, int station) const {
    const BlockLayout& lay = body_.layout.blocks[0];
    return vector_at(state_.u, lay.line(node, 0) + station, lay.stride);
  }

 private:
  struct Node {
    std::ptrdiff_t index;
    int stride;
    NodeMotion motion;
    int node, station;
  };
  void move(const Node& n) {
    const Vec3 f = vector_at(state_.f, n.index, n.stride), v = vector_at(state_.v, n.index, n.stride);
    const Vec3 u = vector_at(state_.u, n.index, n.stride);
    const double c = 0.5 * damping_ * dt_;
    Vec3 free{}, along{};
    for (const Vec3& e : n.motion.free) {
      const double next = ((1 - c) * dot(v, e) - dt_ * dot(f, e) / body_.mass[n.index]) / (1 + c);
      free += next * e;
      along += dot(u, e) * e;
    }
    set(state_.v, n, free);
    set(state_.u, n, along + dt_ * free + parameter_ * n.motion.given);
  }
  static void set(Field& field, const Node& n, Vec3 v) {
    field[n.index] = v.x;
    field[n.index + n.stride] = v.y;
    field[n.index + 2 * n.stride] = v.z;
  }
  Body& body_;
  Traversal elements_;
  BodyState state_;
  double damping_, dt_, parameter_ = 0;
  std::vector<Node> nodes_;
};

}  // namespace railstrata::fem_checks
