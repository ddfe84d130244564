// Selective mass scaling of thin rows: against dense algebra, closed forms and the unscaled body.
#include "body/mass_scaling.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "body/stable_step.hpp"
#include "fem/stepper.hpp"
#include "small_rolling.hpp"
#include "tests/body/same_bits.hpp"
#include "tests/body/thin_layer.hpp"

namespace railstrata {
namespace {

using namespace fem_checks;

struct Dense {
  std::vector<std::ptrdiff_t> index;
  Eigen::MatrixXd stiffness, mass, added;
};
Dense dense(const Body& body, MassScaling& scaling) {
  Dense d{free_indices(body), {}, {}, {}};
  const auto n = static_cast<Eigen::Index>(d.index.size());
  d.stiffness = stiffness_matrix(body);
  d.mass = d.added = Eigen::MatrixXd::Zero(n, n);
  Field unit = body.layout.field(), other = unit;
  for (Eigen::Index c = 0; c < n; ++c) {
    std::fill(unit.begin(), unit.end(), 0.0);
    unit[d.index[c]] = 1;
    const Field stretch = scaling.differences(unit);
    for (Eigen::Index r = 0; r < n; ++r) {
      other[d.index[r]] = 1;
      d.added(r, c) = 2 * scaling.kinetic(stretch, other);
      other[d.index[r]] = 0;
    }
    d.mass(c, c) = body.mass[d.index[c]];
  }
  return d;
}

class MassScalingTest : public ::testing::Test {
 protected:
  MassScalingTest() { set_threads(1); }  // bodies of a hundred nodes
  ~MassScalingTest() override { set_threads(threads_); }
  int threads_ = max_threads();
};

Eigen::VectorXd eigenvalues(const Eigen::MatrixXd& k, const Eigen::MatrixXd& m) {
  return Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(k, m, Eigen::EigenvaluesOnly).eigenvalues();
}

}  // namespace

TEST_F(MassScalingTest, TwoSweepsSolveWithTheDenseScaledMassToRoundOff) {
  const Body body = thin_layer();
  MassScaling scaling(body, kWanted);
  const Dense d = dense(body, scaling);
  ASSERT_GT(d.added.norm(), d.mass.norm());
  const Field f = scattered_forces(body, 1.0);
  Field scaled = f;
  scaling.scale(scaled);
  Eigen::VectorXd force(d.mass.rows());
  for (Eigen::Index i = 0; i < force.size(); ++i) force[i] = f[d.index[i]];
  const Eigen::VectorXd wanted = d.mass * (d.mass + d.added).ldlt().solve(force);
  for (Eigen::Index i = 0; i < force.size(); ++i) EXPECT_NEAR(scaled[d.index[i]], wanted[i], 1e-12) << i;
}

TEST_F(MassScalingTest, AForceOnTheSurfaceAddedAfterwardsIsScaledAllTheSame) {
  const Body body = thin_layer();
  MassScaling scaling(body, kWanted);
  const std::ptrdiff_t at = body.layout.blocks[0].line(1, 2) + 2;
  const Field f = scattered_forces(body, 1.0);
  Field before = f, after = f;
  before[at] += 3;
  scaling.scale(before);
  scaling.scale(after);
  scaling.add_force(after, at, 3);
  for (std::ptrdiff_t i : free_indices(body)) EXPECT_NEAR(before[i], after[i], 1e-13);
  Field unit = body.layout.field();
  unit[at] = 1;
  scaling.scale(unit);
  EXPECT_NEAR(unit[at], scaling.share(at), 1e-15);
  EXPECT_LT(scaling.share(at), 0.5);
}

TEST_F(MassScalingTest, KeepsTheMassOfTranslationAndEveryMomentum) {
  const Body body = thin_layer();
  MassScaling scaling(body, kWanted);
  const Field same = nodal_field(body, [](Vec3) { return Vec3{1, -2, 3}; });
  EXPECT_EQ(scaling.kinetic(scaling.differences(same), same), 0.0);
  const Field f = scattered_forces(body, 1.0);
  Field scaled = f;
  scaling.scale(scaled);
  for (int component = 0; component < 3; ++component) {
    double sum = 0, sum_scaled = 0;
    for (const NodeLine& l : body.lines)
      if (l.component == component)
        for (int j = 0; j < l.count; ++j) {
          sum += f[l.first + j];
          sum_scaled += scaled[l.first + j];
        }
    EXPECT_NEAR(sum_scaled, sum, 1e-12);
  }
}

// One row, nu = 0: u_z = +-1 on its two faces is a mode of the free row with omega^2 = 4 k/(m + 4 a) = 4/D^2.
TEST_F(MassScalingTest, PutsTheThicknessModeOfARowAtTheWantedStep) {
  const Elastic bar = elastic(4 * kYoung, 0.0, 7800);
  SweptBody mesh = layered_brick(3, 3, 1e-3, 1e-3, {1e-4}, 1);
  mesh.prescribed.clear();
  const Body body(mesh, {bar, bar}, {});
  MassScaling scaling(body, kWanted);
  Field mode = nodal_field(body, [](Vec3 x) { return Vec3{0, 0, x.z > -5e-5 ? 1.0 : -1.0}; }), force = mode;
  linear_force(body, mode, force);
  Field inertia = mode;
  for (std::size_t i = 0; i < mode.size(); ++i) inertia[i] *= body.mass[i];
  const double twice_kinetic =
      nodal_dot(body.layout, inertia, mode) + 2 * scaling.kinetic(scaling.differences(mode), mode);
  const double omega = std::sqrt(nodal_dot(body.layout, force, mode) / twice_kinetic);
  EXPECT_NEAR(2 / omega / kWanted, 1.0, 1e-12);
}

TEST_F(MassScalingTest, LanczosFindsTheStepOfTheScaledBodyTenTimesTheUnscaledOne) {
  const Body body = thin_layer();
  MassScaling scaling(body, kWanted);
  const Dense d = dense(body, scaling);
  const double step = 2 / std::sqrt(eigenvalues(d.stiffness, d.mass + d.added).maxCoeff()),
               unscaled = 2 / std::sqrt(eigenvalues(d.stiffness, d.mass).maxCoeff());
  EXPECT_NEAR(lanczos_stable_step(body, scaling) / step, 1.0, 0.01);
  EXPECT_GE(lanczos_stable_step(body, scaling), step * (1 - 1e-9));
  EXPECT_GT(step, 10 * unscaled);
  EXPECT_LE(step, kWanted);
}

// A rod of plane waves along z (nu = 0): A <= D^2/4 K, so omega^2 / (1 + omega^2 D^2/4) <= omega_scaled^2 <= omega^2
// for every mode, by the minimum-maximum principle.
TEST_F(MassScalingTest, SlowsAModeOfPeriodTByNoMoreThanHalfOfPiDOverTSquared) {
  const Elastic soft = elastic(kYoung, 0.0, 7800), stiff = elastic(4 * kYoung, 0.0, 7800);
  std::vector<double> heights = kHeights;
  heights.insert(heights.end(), 30, 1e-3);
  const Body body(layered_brick(1, 1, 1e-3, 1e-3, heights, 2), {soft, stiff}, {});
  MassScaling scaling(body, kWanted);
  const BlockLayout& l = body.layout.blocks[0];
  const auto n = static_cast<Eigen::Index>(heights.size());
  Eigen::MatrixXd k(n, n), m(n, n);
  auto row = [&](Eigen::Index r) {
    return nodal_field(body, [&](Vec3 x) {
      return Vec3{0, 0, std::abs(x.z - body.mesh.blocks[0].section.nodes[2 * r].z) < 1e-9 ? 1.0 : 0.0};
    });
  };
  Field f = body.layout.field();
  for (Eigen::Index c = 0; c < n; ++c) {
    Field u = row(c), inertia = u;
    linear_force(body, u, f);
    for (std::size_t i = 0; i < u.size(); ++i) inertia[i] *= body.mass[i];
    for (Eigen::Index r = 0; r < n; ++r) {
      const Field other = row(r);
      k(r, c) = nodal_dot(body.layout, f, other);
      m(r, c) = nodal_dot(body.layout, inertia, other);
    }
  }
  ASSERT_EQ(l.nodes, 2 * (n + 1));
  Eigen::MatrixXd scaled = m;
  for (Eigen::Index c = 0; c < n; ++c) {
    const Field stretch = scaling.differences(row(c));
    for (Eigen::Index r = 0; r < n; ++r) scaled(r, c) += 2 * scaling.kinetic(stretch, row(r));
  }
  const Eigen::VectorXd before = eigenvalues(k, m), after = eigenvalues(k, scaled);
  for (Eigen::Index i = 0; i < n; ++i) {
    EXPECT_LE(after[i], before[i] * (1 + 1e-12)) << i;
    EXPECT_GE(after[i], before[i] / (1 + 0.25 * before[i] * kWanted * kWanted) * (1 - 1e-12)) << i;
  }
  EXPECT_LT(after[0], before[0]);
  EXPECT_NEAR(std::sqrt(after[0] / before[0]), 1.0, 1e-5);
}

// A pressure pulse of 20 us on the layer, run with the short step of the real masses and with the long one of the
// scaled ones: the wave that leaves the layer is the same, and so is what the layer itself feels.
TEST_F(MassScalingTest, APulsePassesThroughTheLayerUnchanged) {
  std::vector<double> heights = kHeights;
  heights.insert(heights.end(), 120, 1e-3);
  const Elastic soft = elastic(kYoung, 0.0, 7800), stiff = elastic(4 * kYoung, 0.0, 7800);
  const Body body(layered_brick(1, 1, 1e-3, 1e-3, heights, 2), {soft, stiff}, {});
  MassScaling none, scaling(body, kWanted);
  const BlockLayout& l = body.layout.blocks[0];
  constexpr double kPulse = 20e-6, kEnd = 24e-6, kPressure = 1e9, kSide = 1e-3;
  struct Trace {
    std::vector<double> layer, below;  // strains at kSamples instants
  };
  constexpr int kSamples = 60;
  auto run = [&](MassScaling& masses, double step) {
    const int steps = static_cast<int>(std::ceil(kEnd / step / kSamples)) * kSamples;
    const double dt = kEnd / steps;
    Field u = body.layout.field(), v = u, f = u;
    Traversal elements(body);
    Trace out;
    for (int s = 0; s < steps; ++s) {
      elements.linear_force(u, f);
      const double t = s * dt,
                   pressure = t < kPulse ? 0.5 * kPressure * (1 - std::cos(2 * std::numbers::pi * t / kPulse)) : 0;
      for (int node : {0, 1})
        for (int j : {0, 1}) f[l.line(node, 2) + j] += 0.25 * pressure * kSide * kSide;
      masses.scale(f);
      for (const NodeLine& line : body.lines)
        if (line.component == 2)
          for (int j = 0; j < line.count; ++j) {
            v[line.first + j] -= dt * body.inverse_mass[line.first + j] * f[line.first + j];
            u[line.first + j] += dt * v[line.first + j];
          }
      if ((s + 1) % (steps / kSamples)) continue;
      auto strain = [&](int row) { return (u[l.line(2 * row, 2)] - u[l.line(2 * row + 2, 2)]) / heights[row]; };
      out.layer.push_back(strain(0));
      out.below.push_back(strain(20));
    }
    return out;
  };
  const double unscaled = lanczos_stable_step(body), scaled = lanczos_stable_step(body, scaling);
  ASSERT_GT(scaled, 10 * unscaled);
  const Trace a = run(none, 0.5 * unscaled), b = run(scaling, 0.9 * scaled);
  const double static_strain = kPressure / (4 * kYoung);
  for (int i = 0; i < kSamples; ++i) {
    EXPECT_NEAR(b.layer[i], a.layer[i], 0.01 * static_strain) << i;
    EXPECT_NEAR(b.below[i], a.below[i], 0.01 * 4 * static_strain) << i;
  }
  // d'Alembert: a wave into a half space carries the pressure itself, c dt later; 20 mm below, past the layer
  const double peak = *std::min_element(a.below.begin(), a.below.end());
  EXPECT_NEAR(peak, -kPressure / kYoung, 0.01 * kPressure / kYoung);
}

// v(n-1/2).(M + A) v(n+1/2)/2 + u(n).K u(n)/2 is a constant of central differences, to round-off.
TEST_F(MassScalingTest, TheEnergyOfCentralDifferencesWithTheAddedMassStandsStill) {
  const Body body = thin_layer();
  MassScaling scaling(body, kWanted);
  const double dt = 0.9 * lanczos_stable_step(body, scaling);
  Field u = body.layout.field(), v = scattered_forces(body, 1.0), f = u;
  auto step = [&] {
    linear_force(body, u, f);
    double energy = 0.5 * nodal_dot(body.layout, u, f);
    scaling.scale(f);
    const Field stretch = scaling.differences(v);
    for (std::ptrdiff_t i : free_indices(body)) {
      const double before = v[i];
      v[i] -= dt * body.inverse_mass[i] * f[i];
      energy += 0.5 * body.mass[i] * before * v[i];
      u[i] += dt * v[i];
    }
    return energy + scaling.kinetic(stretch, v);
  };
  const double start = step();
  for (int s = 0; s < 1000; ++s) ASSERT_NEAR(step(), start, 1e-10 * start) << s;
}

TEST_F(MassScalingTest, SameBitsOnOneTwoAndFourThreads) {
  const Body body = thin_layer();
  MassScaling scaling(body, kWanted);
  const Field f = scattered_forces(body, 1.0), w = scattered_forces(body, 0.3);
  expect_same_bits_on_one_two_and_four_threads([&] {
    Field bits = f;
    scaling.scale(bits);
    bits.push_back(scaling.kinetic(scaling.differences(f), w));
    return bits;
  });
}

TEST_F(MassScalingTest, AMeshWithoutThinRowsHasNone) {
  const Body body(layered_brick(3, 5, 1e-3, 1e-3, std::vector<double>(4, 0.9e-3), 0), kStiffOnSteel, {});
  EXPECT_TRUE(MassScaling(body, kWanted).empty());
  const Body thick(layered_brick(3, 5, 1e-3, 1e-3, std::vector<double>(4, 1e-3), 4), kStiffOnSteel, {});
  EXPECT_TRUE(MassScaling(thick, kWanted).empty());  // as fast along the row as across it: nothing to gain
}

// 0.8 mm at 4 E0 on 4 mm elements, rolled with the step of the real masses and with scaled masses.
class ThinLayerRolling : public ::testing::Test {
 protected:
  struct Outcome {
    StepLimits limits;
    double closure = 0, p_max = 0, von_mises_rail = 0, von_mises_wheel = 0, penetration = 0;
  };
  static constexpr double kFrom = 0.15e-3, kTo = 0.3e-3;

  static CaseSpec thin_case() {
    CaseSpec spec = small_case();
    LayerSpec layer;
    layer.thickness = 0.8e-3;
    layer.material.young = 4 * kYoung;
    spec.layers = {layer};
    return spec;
  }
  static const PreloadResult& preload() {  // statics know nothing of masses and steps
    static const PreloadResult result = solve_preload(small_system(thin_case()), 1e-6);
    return result;
  }
  static Outcome roll(double mass_scaling_step) {
    CaseSpec spec = thin_case();
    spec.run.mass_scaling_step = mass_scaling_step;
    const RollingSystem system = small_system(spec);
    Stepper st(system, preload());
    auto energy = [&] {
      st.want_energy();
      st.step();
      return st.energy();
    };
    Outcome out;
    out.limits = st.plan().limits;
    const EnergyBalance start = energy();
    long count = 0;
    while (st.position() < kTo) {
      st.step();
      if (st.position() < kFrom) continue;
      double p_max = 0;
      for (const NodeTraction& t : st.state().tractions.all()) p_max = std::max(p_max, t.p);
      out.p_max += p_max;
      out.penetration = std::max(out.penetration, st.forces().penetration);
      ++count;
    }
    out.p_max /= static_cast<double>(count);
    const EnergyBalance end = energy();
    out.closure = std::abs(end.total() - start.total()) / end.strain;
    const BodyState &rail = st.state().bodies[0], &wheel = st.state().bodies[1];
    const RollingSample sample =
        take_sample(system, {rail.u, rail.history}, {wheel.u, wheel.history}, st.state().tractions,
                    {st.state().axle.x, st.state().axle.z, st.state().axle.psi});
    for (const Sym3& s : sample.rail.stress) out.von_mises_rail = std::max(out.von_mises_rail, von_mises(s));
    for (const Sym3& s : sample.wheel.stress) out.von_mises_wheel = std::max(out.von_mises_wheel, von_mises(s));
    return out;
  }
};

TEST_F(ThinLayerRolling, ScaledMassesGiveTheSamePressuresStressesAndEnergiesWithATenTimesLongerStep) {
  const Outcome real = roll(0), scaled = roll(1);
  EXPECT_GT(scaled.limits.chosen, 10 * real.limits.chosen);
  EXPECT_NEAR(scaled.p_max / real.p_max, 1.0, 0.003);
  EXPECT_NEAR(scaled.von_mises_rail / real.von_mises_rail, 1.0, 0.01);
  EXPECT_NEAR(scaled.von_mises_wheel / real.von_mises_wheel, 1.0, 0.01);
  EXPECT_LT(scaled.penetration, 1e-9) << "the contact is solved for the motion that follows";
  EXPECT_LT(scaled.closure, 1e-4) << "of the strain energy; the same case without a layer: 5e-5";
}

}  // namespace railstrata
