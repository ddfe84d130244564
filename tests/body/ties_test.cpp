#include "body/ties.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "geometry/profile_names.hpp"
#include "tests/body/same_bits.hpp"
#include "tests/body/sample_bodies.hpp"
#include "tests/mesh/brick_mesh.hpp"

namespace railstrata {
namespace {

using namespace fem_checks;

SweptBody layered_rail() {
  RailMeshSpec spec;
  spec.x_end = 0.02;
  spec.layers = {{"layer", 2e-3, 0.06, 0}};
  return mesh_rail(builtin_profile(ProfileKind::rail, "CN60"), {}, spec, {4e-3, 24e-3, 8e-3, 3, 16e-3});
}

// Three blocks that meet in the plane z = -10 mm, 4, 2 and 1 elements to 2 cm: the first one's bottom hangs on the
// second one's, which hangs on the third's top.
SweptBody chain() {
  SweptBody body;
  body.materials = {"matrix"};
  for (int b = 0; b < 3; ++b) {
    const int n = 4 >> b;
    SweptBody part = mesh_brick(n, 2, 5 * n, 20e-3 / n, 20e-3 / n, 5e-3);
    if (b == 2)
      for (Vec2& p : part.blocks[0].section.nodes) p.z -= 10e-3;
    body.blocks.push_back(std::move(part.blocks[0]));
  }
  for (int b = 0; b < 2; ++b) {
    const int n = 4 >> b, masters = n / 2, row = b == 0 ? 2 * (masters + 1) : 0;
    for (int c = 0; c <= n; ++c) {
      const int left = std::min(c / 2, masters - 1);
      body.ties.push_back({b, 2 * (n + 1) + c, b + 1, row + left, row + left + 1, 0.5 * (c - 2 * left)});
    }
  }
  return body;
}

std::vector<SweptBody> tied_bodies() {
  return {coarse_lma_wheel(), layered_rail(), tied_body(SweepKind::extrude), tied_body(SweepKind::revolve), chain()};
}

// Sets the slaves to nonsense, so that whatever stands there afterwards came from the masters.
void spoil_slaves(const SweptBody& body, const BodyLayout& layout, Field& u) {
  for (const Tie& t : body.ties)
    for (int i = 0; i < 3; ++i)
      std::fill_n(u.begin() + layout.blocks[t.slave_block].line(t.slave_node, i), layout.blocks[t.slave_block].stations,
                  1e3);
}

double slave_error(const SweptBody& body, const BodyLayout& layout, const Field& u, const Field& truth) {
  double worst = 0;
  for (const Tie& t : body.ties)
    for (int j = 0; j < layout.blocks[t.slave_block].stations; ++j)
      worst = std::max(worst, norm(value(u, layout.blocks[t.slave_block], t.slave_node, j) -
                                   value(truth, layout.blocks[t.slave_block], t.slave_node, j)));
  return worst;
}

}  // namespace

TEST(Ties, ARigidTurnOfAnySizeIsSpreadExactlyOnRevolvedBodies) {
  for (const SweptBody& body : {coarse_lma_wheel(), tied_body(SweepKind::revolve)}) {
    const Body solid(body, {kSteel}, {});
    const Ties ties(body, solid.layout);
    for (double psi : {0.0, 1e-3, 0.7, 2.5, 40.0}) {
      const Field truth = nodal_field(solid, [&](Vec3 x) {
        return rigid_displacement(x, body.origin, psi, {17.0, 0.2, -0.3});
      });
      Field u = truth;
      spoil_slaves(body, solid.layout, u);
      ties.apply(u, psi);
      EXPECT_LT(slave_error(body, solid.layout, u, truth), 2e-14) << body.name << " " << psi;  // round-off of 17 m
    }
  }
}

TEST(Ties, ATranslationIsSpreadExactlyOnEveryBody) {
  for (const SweptBody& body : tied_bodies()) {
    const Body solid(body, {kSteel, kSteel}, {});
    const Ties ties(body, solid.layout);
    const Field truth = nodal_field(solid, [](Vec3) { return Vec3{0.3, -0.2, 0.1}; });
    Field u = truth;
    spoil_slaves(body, solid.layout, u);
    ties.apply(u, 0.0);
    EXPECT_LT(slave_error(body, solid.layout, u, truth), 1e-15) << body.name;
  }
}

TEST(Ties, AChainOfTiesCarriesALinearFieldThroughWhateverTheOrderOfItsLines) {
  SweptBody body = chain();
  const Body solid(body, {kSteel}, {});
  const Field truth = nodal_field(solid, [](Vec3 x) { return Vec3{x.x + 2 * x.y, 3 * x.z - x.x, x.y}; });
  for (int pass = 0; pass < 2; ++pass, std::reverse(body.ties.begin(), body.ties.end())) {
    Field u = truth;
    spoil_slaves(body, solid.layout, u);
    Ties(body, solid.layout).apply(u, 0.0);
    EXPECT_LT(slave_error(body, solid.layout, u, truth), 1e-15);
  }
}

TEST(Ties, CollectIsTheTransposeOfSpread) {
  for (const SweptBody& body : tied_bodies()) {
    const Body solid(body, {kSteel, kSteel}, {});
    const Ties ties(body, solid.layout);
    Field u = scattered_field(solid, 1.0), f = scattered_field(solid, 1.0, 12345), masters = u;
    for (const Tie& t : body.ties)
      for (int i = 0; i < 3; ++i)
        std::fill_n(masters.begin() + solid.layout.blocks[t.slave_block].line(t.slave_node, i),
                    solid.layout.blocks[t.slave_block].stations, 0.0);
    ties.apply_homogeneous(u);
    const double work = nodal_dot(solid.layout, f, u),
                 size = std::sqrt(nodal_dot(solid.layout, f, f) * nodal_dot(solid.layout, u, u));
    ties.apply_transpose(f);
    EXPECT_NEAR(nodal_dot(solid.layout, f, masters), work, 1e-13 * size) << body.name;
    for (const Tie& t : body.ties) EXPECT_EQ(norm(value(f, solid.layout.blocks[t.slave_block], t.slave_node, 0)), 0.0);
  }
}

// The slaves follow masters and rotation: f . du_s/dpsi is what collect_turning hands to the rotation, and the masters
// get the same as from collect.
TEST(Ties, MomentOfTheOffsetsIsTheWorkOfTheSlavesForcesOnARotation) {
  for (const SweptBody& body : {coarse_lma_wheel(), tied_body(SweepKind::revolve)}) {
    const Body solid(body, {kSteel}, {});
    const Ties ties(body, solid.layout);
    const double psi = 0.8, step = 1e-4;
    Field ahead = scattered_field(solid, 1.0), behind = ahead, f = scattered_field(solid, 1.0, 12345), plain = f;
    ties.apply(ahead, psi + step);
    ties.apply(behind, psi - step);
    for (std::size_t k = 0; k < ahead.size(); ++k) ahead[k] = (ahead[k] - behind[k]) / (2 * step);
    const double work = nodal_dot(solid.layout, f, ahead),
                 size = std::sqrt(nodal_dot(solid.layout, f, f) * nodal_dot(solid.layout, ahead, ahead));
    EXPECT_NEAR(ties.apply_transpose(f, psi), work, 1e-8 * size) << body.name;
    ties.apply_transpose(plain);
    EXPECT_EQ(f, plain);
  }
}

// Two bodies of different depth and length in one loop: each gets what it gets alone, on any number of threads.
TEST(Ties, SeveralBodiesInOneLoopHaveTheBitsOfEachAlone) {
  const SweptBody wheel = coarse_lma_wheel(), chained = chain();
  const Body first(wheel, {kSteel}, {}), second(chained, {kSteel}, {});
  const double psi = 0.8;
  const auto forces = [](const Body& body) { return scattered_field(body, 1.0, 12345); };
  Field u_alone[] = {forces(first), forces(second)}, f_alone[] = {u_alone[0], u_alone[1]};
  first.ties.apply(u_alone[0], psi);
  second.ties.apply(u_alone[1], 0);
  const double moment = first.ties.apply_transpose(f_alone[0], psi);
  second.ties.apply_transpose(f_alone[1]);
  expect_same_bits_on_one_two_and_four_threads([&] {
    Field u[] = {forces(first), forces(second)}, f[] = {u[0], u[1]};
    const TiedField spread[] = {{first.ties, u[0], rotation_by(psi)}, {second.ties, u[1]}};
    const TiedField collected[] = {{first.ties, f[0], rotation_by(psi)}, {second.ties, f[1]}};
    spread_ties(spread);
    EXPECT_EQ(collect_ties(collected), moment);
    for (int k = 0; k < 2; ++k) {
      EXPECT_EQ(u[k], u_alone[k]) << k;
      EXPECT_EQ(f[k], f_alone[k]) << k;
    }
    u[0].insert(u[0].end(), f[0].begin(), f[0].end());
    return u[0];
  });
}

// A tie of ties gives its forces on from level to level.
TEST(Ties, ALevelHoldsNoLineThatCarriesAnotherOfIt) {
  const SweptBody body = chain();
  const Ties ties(body, layout_of(body));
  ASSERT_EQ(ties.levels().size(), 2U);
  std::size_t lines = 0;
  for (const Ties::Level& level : ties.levels()) {
    lines += level.lines.size();
    for (const Ties::Master& master : level.masters)
      for (int k : level.lines) {
        const Ties::Line& line = ties.lines()[k];
        EXPECT_FALSE(line.slave_block == master.block && line.slave_node == master.node) << k;
      }
  }
  EXPECT_EQ(lines, ties.lines().size());
}

TEST(Ties, CollectedMassIsTheWholeMass) {
  for (const SweptBody& body : tied_bodies()) {
    const Body solid(body, {kSteel, kSteel}, {});
    Field mass = solid.element_mass;
    Ties(body, solid.layout).apply_transpose(mass);
    const Field unit = nodal_field(solid, [](Vec3) { return Vec3{1, 0, 0}; });
    EXPECT_NEAR(nodal_dot(solid.layout, mass, unit) / total_mass(solid), 1.0, 1e-13) << body.name;
  }
}

TEST(Ties, CyclesAndNodesTiedTwiceAreRefused) {
  SweptBody cycle = chain();
  cycle.ties.push_back({2, 0, 0, 2 * 5, 2 * 5 + 1, 0.0});
  EXPECT_THROW(Ties(cycle, layout_of(cycle)), std::logic_error);
  SweptBody twice = chain();
  twice.ties.push_back(twice.ties.front());
  EXPECT_THROW(Ties(twice, layout_of(twice)), std::logic_error);
}

}  // namespace railstrata
