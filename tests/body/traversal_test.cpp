#include "body/traversal.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>

#include "body/stress.hpp"
#include "body/ties.hpp"
#include "geometry/profile_names.hpp"
#include "tests/body/same_bits.hpp"
#include "tests/body/sample_bodies.hpp"

namespace railstrata {
namespace {

using namespace fem_checks;

Vec3 apply(const Eigen::Matrix3d& g, Vec3 x) {
  const Eigen::Vector3d v = g * Eigen::Vector3d(x.x, x.y, x.z);
  return {v(0), v(1), v(2)};
}

// Strains of 1 % on top of a rotation by 0.3 rad about a skew axis.
Eigen::Matrix3d finite_gradient() {
  Eigen::Matrix3d stretch;
  stretch << 1.01, 0.004, -0.003, 0.004, 0.992, 0.006, -0.003, 0.006, 1.005;
  return Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, -0.5).normalized()) * stretch - Eigen::Matrix3d::Identity();
}

Eigen::Matrix3d cauchy_of(const Eigen::Matrix3d& gradient) {
  const Eigen::Matrix3d f = gradient + Eigen::Matrix3d::Identity(),
                        e = 0.5 * (f.transpose() * f - Eigen::Matrix3d::Identity());
  const Eigen::Matrix3d s = kSteel.lambda * e.trace() * Eigen::Matrix3d::Identity() + 2 * kSteel.mu * e;
  return f * s * f.transpose() / f.determinant();
}

double difference(const Sym3& s, const Eigen::Matrix3d& m) {
  return std::sqrt(std::pow(s.xx - m(0, 0), 2) + std::pow(s.yy - m(1, 1), 2) + std::pow(s.zz - m(2, 2), 2) +
                   std::pow(s.xy - m(0, 1), 2) + std::pow(s.yz - m(1, 2), 2) + std::pow(s.xz - m(0, 2), 2));
}

// Section nodes on the section's boundary: those of an edge that only one quadrilateral has.
std::vector<char> boundary_nodes(const Section& section) {
  std::vector<char> boundary(section.nodes.size(), 0);
  for (const auto& q : section.quads)
    for (int k = 0; k < 4; ++k) {
      const int a = q[k], b = q[(k + 1) % 4];
      const auto has_reverse = [&](const std::array<int, 4>& other) {
        for (int m = 0; m < 4; ++m)
          if (other[m] == b && other[(m + 1) % 4] == a) return true;
        return false;
      };
      if (std::none_of(section.quads.begin(), section.quads.end(), has_reverse)) boundary[a] = boundary[b] = 1;
    }
  return boundary;
}

// Largest force on the nodes that `interior` picks, over that of the whole field.
template <class Interior>
double unbalance(const Body& solid, const Field& f, Interior&& interior) {
  double inside = 0, all = 0;
  const auto& blocks = solid.layout.blocks;
  for (int b = 0; b < static_cast<int>(blocks.size()); ++b)
    for (int n = 0; n < blocks[b].nodes; ++n)
      for (int j = 0; j < blocks[b].stations; ++j) {
        const double size = norm(value(f, blocks[b], n, j));
        all = std::max(all, size);
        const bool end = !blocks[b].closed && (j == 0 || j == blocks[b].stations - 1);
        if (!end && interior(b, n)) inside = std::max(inside, size);
      }
  return inside / all;
}

struct Kind {
  SweepKind sweep;
  ElementKind element;
};
std::vector<Kind> kinds() {
  return {{SweepKind::extrude, ElementKind::full},
          {SweepKind::extrude, ElementKind::one_point},
          {SweepKind::revolve, ElementKind::full},
          {SweepKind::revolve, ElementKind::one_point}};
}

}  // namespace

TEST(SolidPatchTest, LinearDisplacementsOnASkewedSectionGiveTheExactStressAndNoForceInside) {
  const Eigen::Matrix3d gradient = finite_gradient(), truth = cauchy_of(gradient);
  for (const Kind& kind : kinds()) {
    const Body solid(distorted_body(kind.sweep), {kSteel}, {kind.element});
    Field u = nodal_field(solid, [&](Vec3 x) { return apply(gradient, x); }), f = solid.layout.field();
    internal_force(solid, u, 0.0, f);
    const std::vector<char> boundary = boundary_nodes(solid.mesh.blocks[0].section);
    ASSERT_EQ(std::count(boundary.begin(), boundary.end(), 0), 4 * 3);
    EXPECT_LT(unbalance(solid, f, [&](int, int n) { return !boundary[n]; }), 1e-11);
    for (int q = 0; q < 20; ++q)
      for (int e = 0; e < 70; ++e)
        ASSERT_LT(difference(element_stress(solid, u, initial_history(solid), 0, q, e), truth), 1e-11 * truth.norm());
    EXPECT_LT(strain_energy(solid, u, 0.0).hourglass, 1e-20 * strain_energy(solid, u, 0.0).strain);
  }
}

TEST(SolidPatchTest, LinearForcesVanishInsideUnderLinearDisplacements) {
  const Eigen::Matrix3d gradient = 1e-3 * finite_gradient();
  for (const Kind& kind : kinds()) {
    const Body solid(distorted_body(kind.sweep), {kSteel}, {kind.element});
    Field u = nodal_field(solid, [&](Vec3 x) { return apply(gradient, x); }), f = solid.layout.field();
    linear_force(solid, u, f);
    const std::vector<char> boundary = boundary_nodes(solid.mesh.blocks[0].section);
    EXPECT_LT(unbalance(solid, f, [&](int, int n) { return !boundary[n]; }), 1e-11);
  }
}

TEST(SolidPatchTest, PassesThroughHangingNodesOfAPlaneInterface) {
  const Eigen::Matrix3d gradient = finite_gradient(), truth = cauchy_of(gradient);
  for (const Kind& kind : kinds()) {
    const SweptBody body = tied_body(kind.sweep);
    const Body solid(body, {kSteel}, {kind.element});
    const Ties ties(body, solid.layout);
    Field u = nodal_field(solid, [&](Vec3 x) { return apply(gradient, x); }), exact = u, f = solid.layout.field();
    ties.apply(u, 0.0);
    const auto& blocks = solid.layout.blocks;
    for (const Tie& t : body.ties)
      for (int j = 0; j < blocks[0].stations; ++j)
        ASSERT_LT(norm(value(u, blocks[0], t.slave_node, j) - value(exact, blocks[0], t.slave_node, j)), 1e-14);
    internal_force(solid, u, 0.0, f);
    ties.apply_transpose(f);
    std::vector<std::vector<char>> boundary{boundary_nodes(body.blocks[0].section),
                                            boundary_nodes(body.blocks[1].section)};
    for (int c = 1; c < 4; ++c) boundary[1][c] = 0;  // the interface's inner nodes are inside the body
    EXPECT_LT(unbalance(solid, f, [&](int b, int n) { return !boundary[b][n]; }), 1e-11);
    for (int b = 0; b < 2; ++b)
      for (int q = 0; q < static_cast<int>(body.blocks[b].section.quads.size()); ++q)
        for (int e = 0; e < blocks[b].elements; ++e)
          ASSERT_LT(difference(element_stress(solid, u, initial_history(solid), b, q, e), truth), 1e-11 * truth.norm());
  }
}

TEST(Solid, RigidRotationOfTheLmaWheelBy90DegreesInOneDegreeStepsStressesItLessThan1e9OfYoungsModulus) {
  const SweptBody body = coarse_lma_wheel();
  ASSERT_FALSE(body.ties.empty());
  const Body solid(body, {kSteel}, {});
  const Ties ties(body, solid.layout);
  Field f = solid.layout.field();
  const double face = 1e-4;  // m², of the order of an element's
  for (int degree = 0; degree <= 90; ++degree) {
    const double psi = degree * std::numbers::pi / 180;
    Field u = nodal_field(solid, [&](Vec3 x) {
      return rigid_displacement(x, body.origin, psi, {0.43 * psi, 0, -1e-4});
    });
    ties.apply(u, psi);
    double worst = 0;
    for (int b = 0; b < static_cast<int>(body.blocks.size()); ++b)
      for (int q = 0; q < static_cast<int>(body.blocks[b].section.quads.size()); ++q)
        for (int e = 0; e < body.blocks[b].stations.elements(); ++e) {
          const Sym3 s = element_stress(solid, u, initial_history(solid), b, q, e);
          for (double c : {s.xx, s.yy, s.zz, s.xy, s.yz, s.xz}) worst = std::max(worst, std::abs(c));
        }
    ASSERT_LT(worst, 1e-9 * kYoung) << degree;
    if (degree % 10 != 0) continue;
    internal_force(solid, u, psi, f);
    double force = 0;
    for (const BlockLayout& l : solid.layout.blocks)
      for (int n = 0; n < l.nodes; ++n)
        for (int j = 0; j < l.stations; ++j) force = std::max(force, norm(value(f, l, n, j)));
    EXPECT_LT(force, 1e-9 * kYoung * face) << degree;
    const StrainEnergy energy = strain_energy(solid, u, psi);
    EXPECT_LT(energy.strain + energy.hourglass, 1e-18 * kYoung);
  }
}

TEST(Solid, InternalForceIsTheGradientOfTheEnergyAtFiniteStrainAndRotation) {
  const double psi = 0.7;
  for (const Kind& kind : kinds()) {
    const bool ring = kind.sweep == SweepKind::revolve;
    const Body solid(distorted_body(kind.sweep, ring), {kSteel}, {kind.element});
    const Field noise = scattered_field(solid, 1e-4), direction = scattered_field(solid, 1.0, 999);
    Field u = nodal_field(solid,
                          [&](Vec3 x) { return rigid_displacement(x, solid.mesh.origin, ring ? psi : 0.0, {}); }),
          f = solid.layout.field();
    for (std::size_t i = 0; i < u.size(); ++i) u[i] += noise[i];
    const double turned = ring ? psi : 0.0, step = 1e-7;
    internal_force(solid, u, turned, f);
    auto energy_at = [&](double t) {
      Field moved = u;
      for (std::size_t i = 0; i < u.size(); ++i) moved[i] += t * direction[i];
      const StrainEnergy e = strain_energy(solid, moved, turned);
      return e.strain + e.hourglass;
    };
    // fourth-order central difference: the energy is a quartic, so this is its derivative up to round-off
    const double slope =
        (8 * (energy_at(step) - energy_at(-step)) - (energy_at(2 * step) - energy_at(-2 * step))) / (12 * step);
    const double work = nodal_dot(solid.layout, f, direction);
    EXPECT_NEAR(slope / work, 1.0, 1e-8);
  }
}

TEST(Solid, LinearForceIsTheTangentOfTheInternalForceAtRest) {
  for (const Kind& kind : kinds()) {
    const Body solid(distorted_body(kind.sweep, kind.sweep == SweepKind::revolve), {kSteel}, {kind.element});
    Field u = scattered_field(solid, 1e-7), minus = u, linear = solid.layout.field(), plus = linear, opposite = linear;
    for (double& v : minus) v = -v;
    linear_force(solid, u, linear);
    internal_force(solid, u, 0.0, plus);
    internal_force(solid, minus, 0.0, opposite);
    const double size = std::sqrt(nodal_dot(solid.layout, linear, linear));
    for (std::size_t i = 0; i < plus.size(); ++i) plus[i] = 0.5 * (plus[i] - opposite[i]) - linear[i];
    EXPECT_LT(std::sqrt(nodal_dot(solid.layout, plus, plus)), 1e-8 * size);
  }
}

TEST(Solid, DiagonalOfTheStiffnessIsThatOfLinearForce) {
  for (const Kind& kind : kinds()) {
    const Body solid(distorted_body(kind.sweep, kind.sweep == SweepKind::revolve), {kSteel}, {kind.element});
    Field diagonal = solid.layout.field(), f = diagonal;
    stiffness_diagonal(solid, diagonal);
    const BlockLayout& l = solid.layout.blocks[0];
    for (int n : {0, 8, 14, 29})
      for (int i = 0; i < 3; ++i)
        for (int j : {0, 1, 33, 64, l.stations - 1}) {
          Field unit = solid.layout.field();
          const std::ptrdiff_t k = l.line(n, i) + j;
          unit[k] = 1.0;
          linear_force(solid, unit, f);
          EXPECT_NEAR(diagonal[k] / f[k], 1.0, 1e-12) << n << " " << i << " " << j;
        }
  }
}

TEST(Solid, ForcesAndEnergyHaveTheSameBitsOnOneTwoAndFourThreads) {
  const Body solid(coarse_lma_wheel(), {kSteel}, {});
  const Field u = scattered_field(solid, 1e-5);
  expect_same_bits_on_one_two_and_four_threads([&] {
    Field moved = u, f = solid.layout.field();
    internal_force(solid, moved, 0.3, f);
    std::vector<double> bits;
    for (const BlockLayout& l : solid.layout.blocks)
      for (int line = 0; line < 3 * l.nodes; ++line)
        bits.insert(bits.end(), f.begin() + l.line(0, line), f.begin() + l.line(0, line) + l.stations);
    const StrainEnergy e = strain_energy(solid, moved, 0.3);
    bits.insert(bits.end(), {e.strain, e.hourglass});
    return bits;
  });
}

TEST(SolidMass, OfASkewedBarIsDensityTimesAreaTimesLength) {
  const Body solid(distorted_body(SweepKind::extrude), {kSteel}, {});
  const Section& s = solid.mesh.blocks[0].section;
  double area = 0;
  for (const auto& q : s.quads) area += 0.5 * cross(s.nodes[q[2]] - s.nodes[q[0]], s.nodes[q[3]] - s.nodes[q[1]]);
  EXPECT_NEAR(total_mass(solid) / (7800 * area * 0.7), 1.0, 1e-13);
}

// Pappus: area times the path of its centroid; a polygonal ring has the chord triangles' sin(D) in place of each
// station's angle D.
TEST(SolidMass, OfASkewedRingIsThatOfPappusForAPolygon) {
  const Body solid(distorted_body(SweepKind::revolve, true), {kSteel}, {});
  const Block& block = solid.mesh.blocks[0];
  double moment = 0;  // int r dA, exact for a quadrilateral as two triangles
  for (const auto& q : block.section.quads)
    for (int k : {1, 2}) {
      const Vec2 a = block.section.nodes[q[0]], b = block.section.nodes[q[k]], c = block.section.nodes[q[k + 1]];
      moment += 0.5 * cross(b - a, c - a) * -(a.z + b.z + c.z) / 3;
    }
  double turn = 0, whole = 0;
  const auto& at = block.stations.at;
  for (std::size_t j = 0; j < at.size(); ++j) {
    const double d = (j + 1 < at.size() ? at[j + 1] : at[0] + 2 * std::numbers::pi) - at[j];
    turn += std::sin(d);
    whole += d;
  }
  EXPECT_NEAR(total_mass(solid) / (7800 * moment * turn), 1.0, 1e-13);
  EXPECT_NEAR(whole, 2 * std::numbers::pi, 1e-12);
}

TEST(SolidMass, OfTheRailIsThatOfItsSectionInGB2585) {
  RailMeshSpec spec;
  spec.x_end = 0.02;
  const SweptBody body = mesh_rail(builtin_profile(ProfileKind::rail, "CN60"), {}, spec, {2e-3, 24e-3, 8e-3, 3, 8e-3});
  const Body solid(body, {kSteel}, {});
  const double length = body.blocks[0].stations.at.back() - body.blocks[0].stations.at.front();
  EXPECT_NEAR(total_mass(solid) / (7800 * 77.45e-4 * length), 1.0,
              5e-3);  // straight edges of up to 8 mm along its fillets
}

TEST(Body, IsConstantSoThatTwoTraversalsMayUseItAtATime) {
  const Body body(distorted_body(SweepKind::revolve, true), {kSteel}, {});
  const Field u = scattered_field(body, 1e-6);
  Field alone = body.layout.field(), moved = u;
  internal_force(body, moved, 0.2, alone);
  std::array<Field, 2> f{body.layout.field(), body.layout.field()};
  for_each(2, [&](std::ptrdiff_t k) {
    Field mine = u;
    for (int repeat = 0; repeat < 20; ++repeat) internal_force(body, mine, 0.2, f[static_cast<std::size_t>(k)]);
  });
  for (const Field& other : f)
    for (const NodeLine& l : body.lines)
      for (int j = 0; j < l.count; ++j) ASSERT_EQ(other[l.first + j], alone[l.first + j]);
}

TEST(BodyState, OfAnElasticBodyKeepsNoHistoryAndNamesItsArrays) {
  const Body body(distorted_body(SweepKind::extrude), {kSteel}, {});
  const BodyState state(body);
  EXPECT_TRUE(state.history.places.empty());
  EXPECT_TRUE(fits(body, state));
}

}  // namespace railstrata
