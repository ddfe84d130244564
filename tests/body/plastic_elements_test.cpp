// Elements that may yield: bits of those that do not, threads, energy, what a body's state carries.
#include <gtest/gtest.h>

#include "body/plastic_field.hpp"
#include "body/stress.hpp"
#include "core/faults.hpp"
#include "tests/body/relaxation.hpp"
#include "tests/body/same_bits.hpp"
#include "tests/mesh/brick_mesh.hpp"

namespace railstrata {
namespace {

using namespace fem_checks;

YieldingMaterial hardening(double yield) {
  YieldingMaterial m{perfectly_plastic(kSteel, yield), {}};
  m.law.saturation = 0.2 * yield;
  m.law.rate = 20;
  m.law.modulus[0] = 20e9;
  m.law.recall[0] = 100;
  m.law.modulus[1] = 5e9;
  return m;
}

Body yielding(SweepKind kind, double yield, Precision precision = Precision::double_precision) {
  Body body(distorted_body(kind), {kSteel}, {ElementKind::full, precision});
  body.plastic = PlasticElements(
      body, [&](int, int quad, int) { return quad == 2 ? std::nullopt : std::optional(hardening(yield)); },
      [](int, int quad, const Tile& tile) { return quad % 3 != 1 || tile.first > 0; });
  return body;
}

constexpr double kNever = 1e30;
constexpr double kMove = 3e-5;  // strains of some 1e-2

TEST(PlasticElements, WithoutYieldHaveTheForcesEnergyAndStressOfElasticOnesToTheLastBit) {
  for (SweepKind kind : {SweepKind::extrude, SweepKind::revolve})
    for (Precision precision : {Precision::double_precision, Precision::single_precision}) {
      const Body elastic(distorted_body(kind), {kSteel}, {ElementKind::full, precision});
      const Body body = yielding(kind, kNever, precision);
      ASSERT_FALSE(body.plastic.empty());
      BodyState a(elastic), b(body);
      a.u = b.u = scattered_field(body, kMove);
      Traversal plain(elastic), mine(body);
      for (auto [t, s] : {std::pair{&plain, &a}, std::pair{&mine, &b}}) {
        t->begin(s->u, 0.1);
        advance_plastic_elements(t->body(), s->u, 0.1, s->history);
        const std::vector<Chain> all = chains(t->body().tiling, 2);
        for (const Chain& c : all) t->chain_forces(c, s->u, s->f, s->history, StoreForces{});
        t->end(all, s->f);
      }
      for (const NodeLine& l : body.lines)
        for (int j = 0; j < l.count; ++j) ASSERT_EQ(a.f[l.first + j], b.f[l.first + j]);
      EXPECT_EQ(plain.energy(a.u, 0.1, a.history).strain, mine.energy(b.u, 0.1, b.history).strain);
      const Sym3 one = element_stress(elastic, a.u, a.history, 0, 3, 66),
                 two = element_stress(body, b.u, b.history, 0, 3, 66);
      EXPECT_EQ(one.xx, two.xx);
      EXPECT_EQ(one.yz, two.yz);
      EXPECT_EQ(plastic_extent(body, b.history).yielded, 0);
    }
}

TEST(PlasticElements, OfFloatPacksFeelTheSameEigenstress) {
  std::vector<double> forces[2];
  for (Precision precision : {Precision::double_precision, Precision::single_precision}) {
    const Body body = yielding(SweepKind::extrude, 200e6, precision);
    BodyState s(body);
    s.u = scattered_field(body, kMove);
    Traversal t(body);
    t.begin(s.u, 0);
    advance_plastic_elements(body, s.u, 0, s.history);
    const std::vector<Chain> all = chains(body.tiling, 2);
    for (const Chain& c : all) t.chain_forces(c, s.u, s.f, s.history, StoreForces{});
    t.end(all, s.f);
    for (const NodeLine& l : body.lines)
      for (int j = 0; j < l.count; ++j) forces[precision == Precision::single_precision].push_back(s.f[l.first + j]);
  }
  double size = 0;
  for (double f : forces[0]) size = std::max(size, std::abs(f));
  for (std::size_t k = 0; k < forces[0].size(); ++k) ASSERT_NEAR(forces[1][k], forces[0][k], 3e-5 * size);
}

TEST(PlasticElements, HaveTheSameBitsOnAnyNumberOfThreads) {
  const Body body = yielding(SweepKind::revolve, 300e6);
  expect_same_bits_on_one_two_and_four_threads([&] {
    BodyState s(body);
    Traversal t(body);
    for (double share : {0.5, 1.0, 0.3}) {
      s.u = scattered_field(body, share * kMove);
      t.begin(s.u, 0.2);
      advance_plastic_elements(body, s.u, 0.2, s.history);
      t.internal_force(s.u, 0.2, s.f, s.history);
    }
    std::vector<double> out(s.history.numbers.begin(), s.history.numbers.end());
    for (const NodeLine& l : body.lines) out.insert(out.end(), &s.f[l.first], &s.f[l.first] + l.count);
    out.push_back(t.energy(s.u, 0.2, s.history).strain);
    out.push_back(plastic_work(body, s.history));
    return out;
  });
}

// Work of the internal forces along a closed path of displacements, and what has become of it.
struct PathEnergies {
  double work, stored, plastic;
};
PathEnergies follow(SweepKind kind, int steps) {
  SweptBody mesh = distorted_body(kind);  // but with equal spacings: elements are those that their modes are made for
  std::vector<double>& at = mesh.blocks[0].stations.at;
  const double length = at.back();
  for (std::size_t j = 0; j < at.size(); ++j)
    at[j] = length * static_cast<double>(j) / static_cast<double>(at.size() - 1);
  Body body(mesh, {kSteel}, {});
  make_plastic(body, hardening(300e6));
  BodyState s(body);
  Traversal t(body);
  const Field first = scattered_field(body, kMove), second = scattered_field(body, kMove, 99999);
  Field before_f = body.layout.field(), before_u = body.layout.field(), change = before_u;
  double work = 0;
  for (int k = 1; k <= steps; ++k) {
    const double a = std::numbers::pi * k / steps, x = std::sin(a), y = 0.5 * (1 - std::cos(a));
    for (std::size_t i = 0; i < s.u.size(); ++i) s.u[i] = x * first[i] + y * second[i];
    t.begin(s.u, 0);
    advance_plastic_elements(body, s.u, 0, s.history);
    t.internal_force(s.u, 0, s.f, s.history);
    for (std::size_t i = 0; i < change.size(); ++i) change[i] = s.u[i] - before_u[i];
    work += 0.5 * (nodal_dot(body.layout, before_f, change) + nodal_dot(body.layout, s.f, change));
    before_f = s.f;
    before_u = s.u;
  }
  const StrainEnergy energy = t.energy(s.u, 0, s.history);
  return {work, energy.strain + energy.hourglass, plastic_work(body, s.history)};
}

TEST(PlasticElements, StoreAndSpendTheWorkOfTheirForcesInFirstOrderOfTheStep) {
  for (SweepKind kind : {SweepKind::extrude, SweepKind::revolve}) {
    double error[2];
    for (int level : {0, 1}) {
      const PathEnergies e = follow(kind, 200 << (2 * level));
      EXPECT_GT(e.plastic, 0.1 * e.work);
      error[level] = std::abs(e.work - e.stored - e.plastic) / e.work;
    }
    EXPECT_LT(error[1], 1e-3);
    EXPECT_LT(error[1], 0.3 * error[0]);
  }
}

TEST(PlasticElements, BubblesThatLagBehindConvergeToTheElementsOwnEquilibrium) {
  const Body body = yielding(SweepKind::revolve, 300e6);
  BodyState s(body);
  s.u = scattered_field(body, kMove);
  Traversal t(body);
  t.begin(s.u, 0);
  std::vector<double> change;
  Field before = s.f;
  for (int repeat = 0; repeat < 200; ++repeat) {
    advance_plastic_elements(body, s.u, 0, s.history);
    t.internal_force(s.u, 0, s.f, s.history);
    double sum = 0;
    for (const NodeLine& l : body.lines)
      for (std::ptrdiff_t i = l.first; i < l.first + l.count; ++i) sum += (s.f[i] - before[i]) * (s.f[i] - before[i]);
    change.push_back(std::sqrt(sum));
    before = s.f;
  }
  EXPECT_LT(change.back(), 1e-6 * change.front());
}

TEST(PlasticElements, OfAConstantInitialStressThatIsInEquilibriumFeelNothingButIt) {
  Body body(mesh_brick(3, 3, 5, 1e-2, 1e-2, 1e-2), {kSteel}, {});
  YieldingMaterial m = hardening(kNever);
  m.initial_stress = {100e6, -50e6, 0, 0, 0, 0};
  make_plastic(body, m);
  BodyState s(body);
  Traversal t(body);
  t.internal_force(s.u, 0, s.f, s.history);
  const Sym3 before = element_stress(body, s.u, s.history, 0, 4, 2);
  EXPECT_EQ(before.xx, 100e6);
  EXPECT_EQ(before.yy, -50e6);
  const Field first = s.f;
  advance_plastic_elements(body, s.u, 0, s.history);
  t.internal_force(s.u, 0, s.f, s.history);
  double end = 0;
  for (const NodeLine& l : body.lines)
    for (std::ptrdiff_t i = l.first; i < l.first + l.count; ++i) {
      EXPECT_NEAR(s.f[i], first[i], 1e-6);
      if (l.component == 0 && i == l.first) end += s.f[i];
    }
  EXPECT_LT(end, 0);  // the end planes are pulled in, as long as nobody holds them
}

TEST(PlasticElements, WithOnePointAreRefusedInWords) {
  Body body(mesh_brick(1, 1, 1, 1, 1, 1), {kSteel}, {ElementKind::one_point, Precision::double_precision});
  EXPECT_THROW(make_plastic(body, hardening(1e8)), CaseError);
}

TEST(PlasticElements, ThatSleepWakeAtTheNextLook) {
  Body body(mesh_brick(1, 1, 8, 1e-2, 1e-2, 1e-2), {kSteel}, {});
  make_plastic(body, {perfectly_plastic(kSteel, 100e6), {}});
  BodyState s(body);
  const auto sheared = [&](double stress) {
    return nodal_field(body, [&](Vec3 x) { return Vec3{stress / std::sqrt(3.0) / kSteel.mu * x.z, 0, 0}; });
  };
  s.u = sheared(50e6);
  advance_plastic_elements(body, s.u, 0, s.history, PlasticLook::all);
  s.u = sheared(120e6);
  advance_plastic_elements(body, s.u, 0, s.history, PlasticLook::awake);
  EXPECT_EQ(plastic_extent(body, s.history).yielded, 0) << "0.5 of the yield stress: asleep";
  s.u = sheared(80e6);
  advance_plastic_elements(body, s.u, 0, s.history, PlasticLook::all);
  s.u = sheared(120e6);
  advance_plastic_elements(body, s.u, 0, s.history, PlasticLook::awake);
  EXPECT_EQ(plastic_extent(body, s.history).yielded, 8) << "0.8: awake";
}

}  // namespace
}  // namespace railstrata
