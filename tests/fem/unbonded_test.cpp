// A wheel rolls over a layer that has come off its base in a stretch: no tension, Coulomb's friction.
#include <gtest/gtest.h>

#include <cstring>

#include "body/traversal.hpp"
#include "core/faults.hpp"
#include "core/parallel.hpp"
#include "fem/interface_step.hpp"
#include "mesh/split_interface.hpp"
#include "small_rolling.hpp"
#include "tests/mesh/brick_mesh.hpp"
#include "thread_ranks.hpp"

namespace railstrata {
namespace {

using namespace fem_checks;

constexpr double kFrom = 0.04, kTo = 0.056;  // m, of the stretch

CaseSpec unbonded_case(double friction, double to = kTo) {
  CaseSpec spec = small_case();
  spec.run.window = 0;
  spec.run.positions = {0.05};
  spec.layers.emplace_back();
  LayerSpec& layer = spec.layers.back();
  layer.thickness = 4e-3;
  layer.width = 0.04;
  layer.elements = 1;
  layer.material.young = 420e9;
  layer.unbonded = {{kFrom, to}};
  layer.unbonded_friction = friction;
  return spec;
}

/// visit(above, below, normal is z): indices of x of all pairs between the ends of the stretch; the block is flat.
template <class Visit>
void each_open(const Body& rail, Visit&& visit) {
  const ContactBand& band = rail.mesh.contact;
  const BlockLayout& lay = rail.layout.blocks[band.block];
  const std::vector<double>& at = rail.mesh.blocks[band.block].stations.at;
  for (const SplitInterface& interface : rail.mesh.interfaces)
    each_pair(interface, band, [&](int above, int below) {
      for (int j = 0; j < lay.stations; ++j)
        if (at[j] > interface.open[0].from + 1e-6 && at[j] < interface.open[0].to - 1e-6)
          visit(lay.line(above, 0) + j, lay.line(below, 0) + j, lay.stride);
    });
}

double least_opening(const Stepper& st) {
  const Field& u = st.state().bodies[kRail].u;
  double least = 0;
  each_open(st.system().rail(), [&](std::ptrdiff_t above, std::ptrdiff_t below, int stride) {
    least = std::min(least, u[above + 2L * stride] - u[below + 2L * stride]);
  });
  return least;
}

void roll_to(Stepper& st, double position) {
  while (st.position() < position) st.step();
}

bool same_bits(const Field& a, const Field& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

void expect_same(const Stepper& a, const Stepper& b) {
  for (const std::size_t k : {kRail, kWheel}) {
    EXPECT_TRUE(same_bits(a.state().bodies[k].u, b.state().bodies[k].u)) << k;
    EXPECT_TRUE(same_bits(a.state().bodies[k].v, b.state().bodies[k].v)) << k;
  }
  EXPECT_EQ(a.energy().total(), b.energy().total());
}

TEST(PairForce, ClosesAGapWithinAStepAndHoldsUpToFriction) {
  const NodePair pair{{0, 0, 1}, 2.0, 0.5};
  const double dt = 0.1;
  EXPECT_EQ(pair_force(pair, {0, 0, 0.2}, {0, 0, -1}, dt).pressure, 0) << "it stays open";
  const PairForce closing = pair_force(pair, {0, 0, 0.05}, {0, 0, -1}, dt);
  EXPECT_NEAR(closing.pressure, 2.0 / dt * 0.5, 1e-12) << "what is left of the approach at the gap's end";
  EXPECT_EQ(pair_force(pair, {0, 0, 0.05}, {3, 0, 1}, dt).pressure, 0);
  const PairForce stick = pair_force(pair, {}, {0.1, 0.2, -1}, dt);
  EXPECT_NEAR(stick.shear.x, -2.0 / dt * 0.1, 1e-12);
  EXPECT_NEAR(stick.shear.y, -2.0 / dt * 0.2, 1e-12);
  const PairForce slide = pair_force(pair, {}, {3, 4, -1}, dt);
  EXPECT_NEAR(norm(slide.shear), 0.5 * slide.pressure, 1e-12);
  EXPECT_NEAR(slide.shear.x / slide.shear.y, 0.75, 1e-12);
}

TEST(InterfaceStep, JoinsOutsideTheStretchAndPressesWithin) {
  const RollingSystem system = small_system(unbonded_case(0.3));
  const Body& rail = system.rail();
  InterfaceStep step(rail);
  ASSERT_FALSE(rail.mesh.interfaces.empty());
  const auto waves = [&](double scale) {
    Field out = rail.layout.field();
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = scale * std::sin(0.7 * static_cast<double>(i * i % 1009));
    return out;
  };
  const double dt = 1e-7;
  Field u = waves(1e-9), v = waves(0.01), joined = waves(50), f = joined;
  step.join(joined);
  f = joined;
  const InterfaceLosses losses = step.press(u, v, dt, 0, f);
  EXPECT_GE(losses.friction, 0);
  int pressed = 0, open = 0, slid = 0;
  each_open(rail, [&](std::ptrdiff_t above, std::ptrdiff_t below, int stride) {
    const Vec3 force = vector_at(joined, above, stride) - vector_at(f, above, stride),
               counter = vector_at(joined, below, stride) - vector_at(f, below, stride);
    EXPECT_NEAR(norm(force + counter), 0, 1e-9);
    const Vec3 after = vector_at(v, above, stride) - vector_at(v, below, stride) -
                       (dt / rail.mass[above]) * vector_at(f, above, stride) +
                       (dt / rail.mass[below]) * vector_at(f, below, stride);
    const double gap = u[above + 2L * stride] - u[below + 2L * stride], shear = std::hypot(force.x, force.y);
    EXPECT_GE(force.z, 0) << "no tension";
    EXPECT_GE(gap + dt * after.z, -1e-18) << "m";
    EXPECT_LE(shear, 0.3 * force.z * (1 + 1e-12) + 1e-12);
    (force.z > 0 ? pressed : open) += 1;
    const bool slides = force.z > 0 && std::hypot(after.x, after.y) > 1e-9;
    slid += slides;
    if (slides) {
      EXPECT_NEAR(shear, 0.3 * force.z, 1e-9 * force.z + 1e-12);
    }
    f[above] = f[below] = joined[above] = joined[below] = 0;
  });
  EXPECT_GT(pressed, 5);
  EXPECT_GT(open, 5);
  EXPECT_GT(slid, 5);
  each_pair(rail.mesh.interfaces[0], rail.mesh.contact, [&](int above, int below) {
    const BlockLayout& lay = rail.layout.blocks[rail.mesh.contact.block];
    for (int j = 0; j < lay.stations; ++j) {
      const std::ptrdiff_t a = lay.line(above, 0) + j, b = lay.line(below, 0) + j;
      EXPECT_NEAR(joined[a] * rail.mass[b], joined[b] * rail.mass[a], 1e-9);
    }
  });
}

// Two equal bars, one above the other, of which the upper one falls on the lower one: as long as a wave takes to run up
// and down a bar both press each other by rho c V/2; then the upper one rests, and the lower one has its speed.
TEST(InterfaceStep, TwoBarsExchangeTheirVelocities) {
  constexpr int kRows = 80;
  constexpr double kSize = 1e-3, kSpeed = 0.1;
  SweptBody mesh = mesh_brick(1, 2 * kRows, 1, kSize, kSize, kSize);
  mesh.prescribed.clear();
  Section& section = mesh.blocks[0].section;
  SplitInterface interface { kRows, 0, {}, {{-1, 1}}, 0 };
  for (const int node : {2 * kRows, 2 * kRows + 1}) {
    interface.below.push_back(static_cast<int>(section.nodes.size()));
    section.nodes.push_back(Vec2{section.nodes[node]});
  }
  for (int& node : section.quads[kRows])
    if (node / 2 == kRows) node = interface.below[node % 2];
  mesh.interfaces = {interface};
  const Elastic steel = elastic(210e9, 0.0, 7800);
  const Body body(mesh, {steel}, {});
  const double c = std::sqrt(210e9 / 7800), dt = 0.5 * kSize / c, contact = 2 * kRows * kSize / c;
  Field u = body.layout.field(), v = u, f = u;
  const auto each_node = [&](auto&& visit) {
    for (int n = 0; n < body.layout.blocks[0].nodes; ++n) visit(n, body.layout.blocks[0].line(n, 2));
  };
  const auto is_above = [&](int n) { return n < 2 * (kRows + 1); };
  each_node([&](int n, std::ptrdiff_t z) { v[z] = v[z + 1] = is_above(n) ? -kSpeed : 0; });
  const auto mean_velocity = [&](bool above) {
    double momentum = 0, mass = 0;
    each_node([&](int n, std::ptrdiff_t z) {
      if (is_above(n) != above) return;
      momentum += body.mass[z] * v[z];
      mass += body.mass[z];
    });
    return momentum / mass;
  };
  Traversal elements(body);
  InterfaceStep step(body);
  double lost = 0, pressed = 0;
  int looks = 0;
  for (double time = 0; time < 1.3 * contact; time += dt) {
    elements.internal_force(u, 0, f, {});
    const double before = f[body.layout.blocks[0].line(interface.below[0], 2)];
    lost += step.press(u, v, dt, 0, f).normal;
    if (time > 0.4 * contact && time < 0.6 * contact) {
      pressed += f[body.layout.blocks[0].line(interface.below[0], 2)] - before;
      ++looks;
    }
    for (const NodeLine& l : body.lines)
      for (int j = 0; j < l.count; ++j) {
        v[l.first + j] -= dt * body.inverse_mass[l.first + j] * f[l.first + j];
        u[l.first + j] += dt * v[l.first + j];
      }
  }
  const double area = 0.25 * kSize * kSize, energy = 0.5 * 7800 * kRows * kSize * kSize * kSize * kSpeed * kSpeed;
  EXPECT_NEAR(pressed / looks, 0.5 * 7800 * c * kSpeed * area, 0.01 * 0.5 * 7800 * c * kSpeed * area);
  EXPECT_NEAR(mean_velocity(true), 0, 0.02 * kSpeed);
  EXPECT_NEAR(mean_velocity(false), -kSpeed, 0.02 * kSpeed);
  EXPECT_NEAR(lost, energy / (4 * kRows), 0.5 * energy / kRows) << "of the two nodes that meet";
}

// Two stations one element apart have none between them: the nodes stand twice and hold everywhere. They bear a smaller
// step than single ones, the bonded layer is given the same.
TEST(SlowUnbonded, AStretchWithoutNodesIsTheBondedLayer) {
  const Model model = build_model(unbonded_case(0, kFrom + 4e-3), ".");
  const RollingSystem split(model);
  Model whole = model;
  whole.rail = bonded(whole.rail);
  whole.spec.run.step_safety =
      StepPlan(split).limits.chosen * (1 + 1e-7) / StepPlan(RollingSystem(whole)).limits.lanczos;
  const RollingSystem one(whole);
  const PreloadResult preload = solve_preload(one, 1e-6);
  Stepper a(split, preload), b(one, preload);
  ASSERT_EQ(a.dt(), b.dt());
  for (int k = 0; k < 1000; ++k) {
    a.step();
    b.step();
  }
  const Field &u = a.state().bodies[kRail].u, &w = b.state().bodies[kRail].u;
  double most = 0, apart = 0;
  for (std::size_t i = 0; i < u.size(); ++i) {
    most = std::max(most, std::abs(w[i]));
    apart = std::max(apart, std::abs(u[i] - w[i]));
  }
  EXPECT_LT(apart, 1e-9 * most) << most;
  EXPECT_NEAR(a.forces().z, b.forces().z, 1e-9 * std::abs(b.forces().z));
}

TEST(Unbonded, TheLayerLiftsAndSlidesWithoutPenetrationAndFrictionHoldsItBack) {
  const CaseSpec smooth = unbonded_case(0);
  const RollingSystem system = small_system(smooth);
  Stepper st(system, solve_preload(system, 1e-6));
  double least = 0, opening = 0;
  while (st.position() < smooth.run.positions.back()) {
    for (int k = 0; k < 20; ++k) st.step();
    least = std::min(least, least_opening(st));
    opening = std::max(opening, st.interface_gap().opening);
  }
  const double slip = st.interface_gap().slip;
  EXPECT_GT(least, -1e-9);
  EXPECT_GT(opening, 0.1e-6) << "the layer lifts beside the wheel";
  EXPECT_GT(slip, 1e-6);
  const RunResult rough = run_rolling(small_system(unbonded_case(0.3)), {});
  const HistoryRow& last = rough.history.back();
  EXPECT_LT(rough.closure, 1e-4);
  EXPECT_GT(last.way.patches, 0);
  EXPECT_GT(last.interface.slip, 0);
  EXPECT_LT(last.interface.slip, 0.9 * slip);
}

TEST(SlowUnbonded, OnATrackAndWithElementsThatYieldEnergyClosesToo) {
  CaseSpec yields = unbonded_case(0.3);
  yields.run.plasticity = true;
  yields.rail_material.strength.yield_strength = 500e6;
  yields.rail_material.strength.kinematic_hardening = {{20e9, 100}};
  const RunResult on_sleepers = run_rolling(small_system(on_track(unbonded_case(0.3))), {}),
                  yielded = run_rolling(small_system(yields), {});
  EXPECT_LT(on_sleepers.closure, 1e-4);
  EXPECT_LT(yielded.closure, 1e-4);
  EXPECT_GT(yielded.plastic.accumulated, 1e-4);
  for (const RunResult* run : {&on_sleepers, &yielded}) EXPECT_GT(run->history.back().interface.slip, 1e-6);
}

TEST(Unbonded, RanksAreRefusedWithARemedy) {
  const RollingSystem system = small_system(unbonded_case(0.3));
  const PreloadResult preload = solve_preload(system, 1e-2);
  try {
    ThreadRanks(2).run(1, [&](const Ranks& ranks) { Stepper(system, preload, ranks); });
    FAIL() << "taken";
  } catch (const CaseError& e) {
    for (const char* word : {"layer.0.unbonded", "ranks", "run the case in one process"})
      EXPECT_NE(std::string(e.what()).find(word), std::string::npos) << e.what();
  }
}

TEST(SlowUnbonded, ThreadsAndACheckpointInTheStretchKeepTheBits) {
  const RollingSystem system = small_system(unbonded_case(0.3));
  const PreloadResult preload = solve_preload(system, 1e-4);
  const int threads = max_threads();
  set_threads(1);
  Stepper one(system, preload);
  roll_to(one, 0.045);
  while (!one.is_restart_point()) one.step();
  const RestartState kept = one.restart_state();
  for (int k = 0; k < 50; ++k) {
    if (k % 7 == 0) one.want_energy();
    one.step();
  }
  set_threads(2);
  Stepper two(system, preload), resumed(system, kept);
  while (two.state().step < kept.state.step) two.step();
  for (Stepper* st : {&two, &resumed})
    for (int k = 0; k < 50; ++k) {
      if (k % 7 == 0) st->want_energy();
      st->step();
    }
  set_threads(threads);
  expect_same(one, two);
  expect_same(one, resumed);
}

}  // namespace
}  // namespace railstrata
