#pragma once
// Small bodies and nodal fields of the finite element tests.
#include <cmath>
#include <numbers>

#include "body/traversal.hpp"
#include "geometry/profile_names.hpp"
#include "mesh/bodies.hpp"
#include "tests/mesh/brick_mesh.hpp"

namespace railstrata::fem_checks {

inline const Elastic kSteel = elastic(210e9, 0.3, 7800);
inline constexpr double kYoung = 210e9;

/// A fixed sequence of numbers in [-1, 1) without pattern.
inline double scatter(std::size_t i) {
  return 2 * std::fmod(0.6180339887498949 * static_cast<double>(i * i + 7 * i + 1), 1.0) - 1;
}

/// Moves every node of a section by up to `size`.
inline void distort(Section& section, double size) {
  for (std::size_t n = 0; n < section.nodes.size(); ++n)
    section.nodes[n] = section.nodes[n] + size * Vec2{scatter(2 * n), scatter(2 * n + 1)};
}

/// 5 x 4 quadrilaterals of about 1 cm, all skewed, along 70 elements of unequal spacing: more than a tile, spacings
/// mixed within a pack. Revolved: radii from 5 to 9 cm, over half a turn or the whole ring.
inline SweptBody distorted_body(SweepKind kind, bool ring = false) {
  constexpr int kElements = 70;
  SweptBody body = mesh_brick(5, 4, kElements, 1e-2, 1e-2, 1e-2);
  body.kind = kind;
  body.origin = {0.2, -0.1, 0.5};
  Block& block = body.blocks[0];
  distort(block.section, 2e-3);
  std::vector<double> at{0.0};
  for (int e = 0; e < kElements; ++e) at.push_back(at.back() + 1 + 0.25 * (e / 3 % 3));
  const double whole = kind == SweepKind::extrude ? 0.7
                       : ring                     ? 2 * std::numbers::pi
                                                  : std::numbers::pi,
               scale = whole / at.back();
  for (double& t : at) t *= scale;
  if (ring) at.pop_back();
  block.stations = {at, ring};
  if (kind == SweepKind::revolve)
    for (Vec2& p : block.section.nodes) p.z -= 0.05;
  return body;
}

/// A fine block tied onto a coarse one along a plane; section nodes off the plane are skewed. Extruded: three times
/// finer across and along. Revolved: twice finer across, same stations (otherwise the two polygons of a ring would not
/// meet in a plane).
inline SweptBody tied_body(SweepKind kind) {
  const int ratio = kind == SweepKind::extrude ? 3 : 2, along = kind == SweepKind::extrude ? 3 : 1, columns = 4,
            rows = 3, stations = 12;
  const double size = 12e-3, fine = size / ratio, spacing = kind == SweepKind::extrude ? size : 0.1;
  SweptBody body = mesh_brick(columns * ratio, rows, stations * along, spacing / along, fine, fine);
  SweptBody lower = mesh_brick(columns, rows, stations, spacing, size, size);
  body.kind = kind;
  body.origin = {-0.1, 0.3, 0.2};
  Section& upper_section = body.blocks[0].section;
  Section& lower_section = lower.blocks[0].section;
  for (Vec2& p : lower_section.nodes) p.z -= rows * fine;
  const int hanging = rows * (columns * ratio + 1);
  for (int n = 0; n < hanging; ++n)
    upper_section.nodes[n] = upper_section.nodes[n] + 0.2 * fine * Vec2{scatter(2 * n), scatter(2 * n + 1)};
  for (std::size_t n = columns + 1; n < lower_section.nodes.size(); ++n)
    lower_section.nodes[n] = lower_section.nodes[n] + 0.2 * size * Vec2{scatter(2 * n), scatter(2 * n + 1)};
  if (kind == SweepKind::revolve)
    for (Section* s : {&upper_section, &lower_section})
      for (Vec2& p : s->nodes) p.z -= 0.1;
  for (int c = 0; c <= columns * ratio; ++c) {
    const int left = std::min(c / ratio, columns - 1);
    body.ties.push_back({0, hanging + c, 1, left, left + 1, static_cast<double>(c - left * ratio) / ratio});
  }
  body.prescribed.clear();
  for (SectionNode n : lower.prescribed) body.prescribed.push_back({1, n.node});
  body.blocks.push_back(std::move(lower.blocks[0]));
  return body;
}

/// The wheel of the paper at 4 mm: rings of unequal stations, tied to one another.
inline SweptBody coarse_lma_wheel() {
  WheelMeshSpec spec;
  spec.theta_begin = -0.05;
  spec.theta_end = 0.05;
  return mesh_wheel(builtin_profile(ProfileKind::wheel, "LMA"), 0.430, {0, 0, 0.430}, spec,
                    {4e-3, 24e-3, 8e-3, 3, 16e-3});
}

/// u = f(X) at all nodes.
template <class F>
Field nodal_field(const Body& solid, F&& f) {
  Field u = solid.layout.field();
  const auto& blocks = solid.layout.blocks;
  for (int b = 0; b < static_cast<int>(blocks.size()); ++b)
    for (int n = 0; n < blocks[b].nodes; ++n)
      for (int j = 0; j < blocks[b].stations; ++j) {
        const Vec3 v = f(reference_position(solid, b, n, j));
        u[blocks[b].line(n, 0) + j] = v.x;
        u[blocks[b].line(n, 1) + j] = v.y;
        u[blocks[b].line(n, 2) + j] = v.z;
      }
  return u;
}

/// Numbers without pattern in [-size, size) at all nodes.
inline Field scattered_field(const Body& solid, double size, std::size_t seed = 0) {
  std::size_t i = seed;
  return nodal_field(solid, [&](Vec3) { return size * Vec3{scatter(i++), scatter(i++), scatter(i++)}; });
}

inline Vec3 value(const Field& u, const BlockLayout& l, int node, int station) {
  return {u[l.line(node, 0) + station], u[l.line(node, 1) + station], u[l.line(node, 2) + station]};
}

/// a . b over the nodes, padding and ghosts left out.
inline double nodal_dot(const BodyLayout& layout, const Field& a, const Field& b) {
  double sum = 0;
  for (const BlockLayout& l : layout.blocks)
    for (int n = 0; n < l.nodes; ++n)
      for (int j = 0; j < l.stations; ++j) sum += dot(value(a, l, n, j), value(b, l, n, j));
  return sum;
}

/// Displacement of a rigid rotation by psi (rolling forward: z turns towards x) about the axle at `centre`, and a
/// translation.
inline Vec3 rigid_displacement(Vec3 x, Vec3 centre, double psi, Vec3 translation) {
  const Vec3 r = x - centre;
  const double c = std::cos(psi) - 1, s = std::sin(psi);
  return translation + Vec3{c * r.x + s * r.z, 0, c * r.z - s * r.x};
}

/// A single evaluation of elements to which nothing has happened, with a workspace of its own.
inline void internal_force(const Body& body, Field& u, double psi, Field& f) {
  Traversal(body).internal_force(u, psi, f, initial_history(body));
}
inline void linear_force(const Body& body, Field& u, Field& f) { Traversal(body).linear_force(u, f); }
inline StrainEnergy strain_energy(const Body& body, Field& u, double psi) {
  return Traversal(body).energy(u, psi, initial_history(body));
}

}  // namespace railstrata::fem_checks
