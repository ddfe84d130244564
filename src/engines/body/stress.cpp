#include "body/stress.hpp"

#include <cassert>

namespace railstrata {
namespace {

// Corner displacements of one element, as element_kinematics wants them.
auto corners_of(const BlockLayout& l, const std::array<int, 4>& quad, const Field& u, int station) {
  const int next = l.closed && station + 1 == l.stations ? 0 : station + 1;
  return [&l, &quad, &u, station, next](int c, int i, double& sum, double& difference) {
    const double left = u[l.line(quad[c], i) + station], right = u[l.line(quad[c], i) + next];
    sum = right + left;
    difference = right - left;
  };
}

double scalar(const double* x) { return *x; }

}  // namespace

Sym3 element_stress(const Body& body, const Field& u, const PlasticHistory& history, int block, int quad, int station) {
  assert(u.size() >= static_cast<std::size_t>(body.layout.size));
  assert(block >= 0 && block < static_cast<int>(body.elements.size()) && station >= 0 &&
         station < body.layout.blocks[block].elements);
  assert(quad >= 0 && quad < static_cast<int>(body.mesh.blocks[block].section.quads.size()));
  const BlockElements& d = body.elements[block];
  const QuadReference& ref = d.table.quads[d.reference(d.set_at(station), quad)];
  const StationScale<double> st = d.table.scale<double>(station, scalar);
  const Rotation<double> q{d.cos_q[station], d.sin_q[station]};
  const auto corner = corners_of(body.layout.blocks[block], body.mesh.blocks[block].section.quads[quad], u, station);
  const auto in_element = [&](int k, int i, double& sum, double& difference) {
    if (i == 1) return corner(k, 1, sum, difference);
    double sx, dx, sz, dz;
    corner(k, 0, sx, dx);
    corner(k, 2, sz, dz);
    const PlaneVector<double> both = q.forward(sx, sz), apart = q.forward(dx, dz);
    sum = i == 0 ? both.x : both.z;
    difference = i == 0 ? apart.x : apart.z;
  };
  const auto kin = element_kinematics<SweepKind::revolve, double>(ref.shape, st, in_element);
  const auto relieve = [&](double(&s)[6]) {
    const int tile = body.tiling.first_tile[block] + station / kTile;
    const double* rows = body.plastic.eigenstress(history, tile, quad);
    if (!rows) rows = body.initial_stress.rows(block, quad);  // what is hot has it among its own
    if (!rows) return;
    for (int i = 0; i < 6; ++i) s[i] -= rows[(PlasticEntries::kEigenstress + i) * kTile + station % kTile];
  };
  const auto p = hex_stress<SweepKind::revolve, double>(ref, Rotation<double>{}, kin, relieve);
  // sigma = P F^T / det F, P and F with the element's frame as their right index
  const Vec3 f1 = rotate_back(q, {1 + kin.h1[0], kin.h1[1], kin.h1[2]});
  const Vec3 f2 = rotate_back(q, {kin.h2[0], 1 + kin.h2[1], kin.h2[2]});
  const Vec3 f3 = rotate_back(q, {kin.h3[0], kin.h3[1], 1 + kin.h3[2]});
  const Vec3 a = rotate_back(q, {p.p1[0], p.p1[1], p.p1[2]});
  const Vec3 b = rotate_back(q, {p.p2[0], p.p2[1], p.p2[2]});
  const Vec3 e = rotate_back(q, {p.p3[0], p.p3[1], p.p3[2]});
  return (1 / dot(f1, cross(f2, f3))) *
         Sym3{a.x * f1.x + b.x * f2.x + e.x * f3.x, a.y * f1.y + b.y * f2.y + e.y * f3.y,
              a.z * f1.z + b.z * f2.z + e.z * f3.z, a.x * f1.y + b.x * f2.y + e.x * f3.y,
              a.y * f1.z + b.y * f2.z + e.y * f3.z, a.x * f1.z + b.x * f2.z + e.x * f3.z};
}

std::array<Vec3, 3> displacement_gradient(const Body& body, const Field& u, int block, int quad, int station) {
  const ElementTable<double>& d = body.elements[block].table;
  const StationScale<double> st = d.scale<double>(station, scalar);
  const auto corner = corners_of(body.layout.blocks[block], body.mesh.blocks[block].section.quads[quad], u, station);
  const auto k = element_kinematics<SweepKind::revolve, double>(d.quads[quad].shape, st, corner);
  return {Vec3{k.h1[0], k.h1[1], k.h1[2]}, Vec3{k.h2[0], k.h2[1], k.h2[2]}, Vec3{k.h3[0], k.h3[1], k.h3[2]}};
}

}  // namespace railstrata
