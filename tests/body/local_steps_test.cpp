// Local time steps: against dense matrix functions, the spectrum's bounds and a run with one short step.
#include "body/local_steps.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "body/stable_step.hpp"
#include "contact/enforcement.hpp"
#include "tests/body/same_bits.hpp"
#include "tests/body/thin_layer.hpp"

namespace railstrata {
namespace {

using namespace fem_checks;

class LocalStepsTest : public ::testing::Test {
 protected:
  LocalStepsTest() { set_threads(1); }  // bodies of a few hundred nodes
  ~LocalStepsTest() override { set_threads(threads_); }
  int threads_ = max_threads();
};

std::vector<double> with_rows(int more) {
  std::vector<double> heights = kHeights;
  heights.insert(heights.end(), more, 1e-3);
  return heights;
}

Body block_under_layer() { return {layered_brick(1, 3, 1e-3, 1e-3, with_rows(4), 2), kStiffOnSteel, {}}; }

// Column by column: K, and M B K of local steps.
Eigen::MatrixXd dense(const Body& body, LocalSteps& local) {
  return free_matrix(body, [&](const Field& u, Field& f) { local.refine_linear(u, f); });
}
Eigen::MatrixXd dense(const Body& body, LocalSteps&& local) { return dense(body, local); }

Eigen::VectorXd masses(const Body& body) {
  const std::vector<std::ptrdiff_t> index = free_indices(body);
  Eigen::VectorXd m(static_cast<Eigen::Index>(index.size()));
  for (Eigen::Index i = 0; i < m.size(); ++i) m[i] = body.mass[index[i]];
  return m;
}

}  // namespace

TEST_F(LocalStepsTest, StagesAreChebyshevPolynomials) {
  for (int p : {1, 2, 7, 20}) {
    const Stages s(p, 0.01);
    // T_p(cosh x) = cosh p x, T_p' = p sinh(p x) / sinh x
    const double x = std::acosh(s.delta);
    EXPECT_NEAR(s.omega, 2 * p * std::tanh(p * x) / std::sinh(x), 1e-9 * s.omega) << p;
    for (int k = 1; k < p; ++k) {
      EXPECT_NEAR(s.b[k], std::cosh((k - 1) * x) / std::cosh((k + 1) * x), 1e-10);
      EXPECT_NEAR(s.c[k], std::cosh(k * x) / std::cosh((k + 1) * x), 1e-10);
    }
    EXPECT_LT(s.reach(), 4.0 * p * p);
    EXPECT_GT(s.reach(), 0.98 * 4.0 * p * p);
  }
}

// All nodes fine: D^2 B K = 2 (1 - T_p(delta - D^2 K/omega)/T_p(delta)) by the eigenvectors of M^-1/2 K M^-1/2.
TEST_F(LocalStepsTest, OfAWhollyFineBodyAreTheChebyshevPolynomialOfItsStiffness) {
  const Body body = thin_layer();
  LocalSteps local(body, {}, 2 * kWanted);
  local.set_step(0.9 * kWanted, lanczos_stable_step(body));
  ASSERT_GT(local.stages(), 10);
  const Eigen::VectorXd root = masses(body).cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd k = root.asDiagonal() * dense(body, LocalSteps()) * root.asDiagonal();
  const Eigen::MatrixXd effective = root.asDiagonal() * dense(body, local) * root.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(k);
  const Stages s(local.stages());
  const double d2 = local.step() * local.step();
  const Eigen::VectorXd polynomial = modes.eigenvalues().unaryExpr([&](double lambda) {
    const double y = s.delta - d2 * lambda / s.omega, p = s.count;
    const double t = std::abs(y) <= 1 ? std::cos(p * std::acos(y)) : std::cosh(p * std::acosh(y));
    return 2 / d2 * (1 - t / std::cosh(p * std::acosh(s.delta)));
  });
  const Eigen::MatrixXd wanted = modes.eigenvectors() * polynomial.asDiagonal() * modes.eigenvectors().transpose();
  EXPECT_LT((effective - wanted).norm(), 1e-9 * wanted.norm());
}

TEST_F(LocalStepsTest, GiveASymmetricOperatorThatIsTheStiffnessAwayFromTheFineNodes) {
  const Body body = block_under_layer();
  LocalSteps local(body, {}, kWanted);
  local.set_step(0.8 * kWanted, lanczos_stable_step(body));
  EXPECT_EQ(local.fine_elements(), 6 * 3);  // five thin rows and the one that touches them
  const Eigen::MatrixXd k = dense(body, LocalSteps()), effective = dense(body, local);
  EXPECT_LT((effective - effective.transpose()).norm(), 1e-10 * effective.norm());
  const std::vector<std::ptrdiff_t> index = free_indices(body);
  const BlockLayout& l = body.layout.blocks[0];
  int far = 0;
  for (std::size_t c = 0; c < index.size(); ++c) {
    const int row = static_cast<int>(index[c] / (3 * l.stride)) / 2;
    if (row < 7) continue;  // rows of nodes 0 to 5 are fine, 6 touches them
    ++far;
    EXPECT_LT((effective.col(c) - k.col(c)).norm(), 1e-12 * k.col(c).norm());
  }
  EXPECT_GT(far, 0);
}

// The upper block is fine, its hanging nodes are carried by a line of the lower one: x.(M B K y) = y.(M B K x), and
// stable.
TEST_F(LocalStepsTest, StaySymmetricAndStableAcrossTies) {
  for (SweepKind kind : {SweepKind::extrude, SweepKind::revolve}) {
    const Body body(tied_body(kind), {kSteel}, {});
    const double size = kind == SweepKind::extrude ? 4e-3 : 6e-3,
                 wave = std::sqrt(kSteel.p_wave_modulus() / kSteel.density);
    LocalSteps local(body, {}, 1.4 * size / wave);
    ASSERT_GT(local.fine_elements(), 0);
    ASSERT_LT(local.fine_elements(), body.mesh.elements());
    const double own = lanczos_stable_step(body), coarse = lanczos_coarse_step(body, local);
    local.set_step(0.9 * coarse, own);
    EXPECT_GT(local.stages(), 1);
    Traversal elements(body);
    auto product = [&](Field x) {
      Field f = x;
      body.ties.apply_homogeneous(x);
      elements.linear_force(x, f);
      body.ties.apply_transpose(f);
      local.refine_linear(x, f);
      return f;
    };
    auto dot = [&](const Field& a, const Field& b) {
      double sum = 0;
      for (std::ptrdiff_t i : free_indices(body)) sum += a[i] * b[i];
      return sum;
    };
    const Field x = scattered_forces(body, 1.0);
    Field y = x;
    std::reverse(y.begin(), y.end());
    for (std::size_t i = 0; i < y.size(); ++i)
      if (body.inverse_mass[i] == 0) y[i] = 0;
    const Field bx = product(x), by = product(y);
    EXPECT_NEAR(dot(y, bx), dot(x, by), 1e-10 * std::sqrt(dot(bx, bx) * dot(y, y)));
    const StepSpectrum spectrum = lanczos_spectrum(body, local);
    EXPECT_GT(spectrum.least, 0);
    EXPECT_LT(spectrum.largest, 3.8);
  }
}

// Stable at the step of the coarse nodes alone. Damping keeps the fast modes within 2 (1 -+ 1/cosh sqrt(2 nu)); without
// it they come to the edges of stability.
TEST_F(LocalStepsTest, AreStableUpToTheCoarseStepAndKeepTheFastModesFromTheEdges) {
  const Body body = block_under_layer();
  LocalSteps local(body, {}, kWanted);
  const double own = lanczos_stable_step(body), coarse = lanczos_coarse_step(body, local);
  ASSERT_GT(coarse, 10 * own);
  const Eigen::VectorXd root = masses(body).cwiseSqrt().cwiseInverse();
  auto largest = [&](double share, double damping, double& least) {
    local.set_step(share * coarse, own, damping);
    const Eigen::MatrixXd effective = root.asDiagonal() * dense(body, local) * root.asDiagonal();
    const Eigen::VectorXd values =
        local.step() * local.step() *
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(0.5 * (effective + effective.transpose())).eigenvalues();
    least = values.minCoeff();
    return values.maxCoeff();
  };
  const double edge = 2 * (1 + 1 / std::cosh(std::sqrt(2 * kStageDamping)));
  double undamped = 0;
  for (double share = 0.2; share < 0.96; share += 0.15) {
    double least = 0, least_undamped = 0;
    const double high = largest(share, kStageDamping, least);
    EXPECT_LT(high, std::max(1.01 * edge, 4 * share * share + 0.05))
        << share;  // the coarse nodes' own modes: 4 (D / coarse step)^2
    EXPECT_GT(least, 0.0) << share;
    undamped = std::max(undamped, largest(share, 0.0, least_undamped));
    const StepSpectrum by_lanczos = [&] {
      local.set_step(share * coarse, own);
      return lanczos_spectrum(body, local, 120);
    }();
    EXPECT_NEAR(by_lanczos.largest, high, 0.01 * high);
    EXPECT_GT(by_lanczos.least, 0.0);
  }
  EXPECT_GT(undamped, 3.999);
}

// A disc's or a rail's running surface over a thin layer, all stations of one spacing.
struct LayeredSurface {
  Body body;
  ContactSurface surface;
  LocalSteps local;
  static SweptBody mesh(SweepKind kind) {
    SweptBody mesh = layered_brick(4, 40, 1e-3, 1e-3, with_rows(1), 2);
    mesh.kind = kind;
    mesh.contact = {0, 4, 7, {}, {}, 0, 40e-3};
    Block& block = mesh.blocks[0];
    if (kind == SweepKind::revolve) {
      for (Vec2& p : block.section.nodes) p.z = -0.05 - p.z;  // the layer outside
      for (auto& q : block.section.quads) std::swap(q[1], q[3]);
      for (double& t : block.stations.at) t = t / 0.05 - 0.3;
      mesh.contact.fine_begin = -0.3;
      mesh.contact.fine_end = 0.5;
    }
    return mesh;
  }
  explicit LayeredSurface(SweepKind kind) : body(mesh(kind), kStiffOnSteel, {}), local(body, {}, kWanted) {
    const BlockLayout& l = body.layout.blocks[0];
    surface.kind = kind;
    surface.columns = 5;
    surface.stations = body.mesh.blocks[0].stations;
    surface.first_line = l.line(0, 0);
    surface.stride = l.stride;
    local.set_step(0.7 * kWanted, lanczos_stable_step(body));
  }
};

TEST_F(LocalStepsTest, AnswerFurtherForcesAsTheyAnswerThoseOfTheElements) {
  for (SweepKind kind : {SweepKind::extrude, SweepKind::revolve}) {
    LayeredSurface s(kind);
    ASSERT_GT(s.local.stages(), 5);
    const Field rest = s.body.layout.field();
    Field wanted = rest, f = rest;
    std::vector<NodalForce> forces;
    std::size_t k = 0;
    for (std::ptrdiff_t i : free_indices(s.body)) {
      wanted[i] = -scatter(++k);
      forces.push_back({i, scatter(k)});
    }
    s.local.refine_linear(rest, wanted);
    s.local.add_forces(forces, f);
    double largest = 0;
    for (std::ptrdiff_t i : free_indices(s.body)) largest = std::max(largest, std::abs(wanted[i]));
    for (std::ptrdiff_t i : free_indices(s.body)) ASSERT_NEAR(f[i], wanted[i], 1e-11 * largest);
  }
}

// Velocities of the surface by the response against all stages with all forces at once.
TEST_F(LocalStepsTest, SurfaceResponseIsWhatTheStagesGive) {
  for (SweepKind kind : {SweepKind::extrude, SweepKind::revolve}) {
    LayeredSurface s(kind);
    const SurfaceResponse response = surface_response(s.body, s.surface, s.local);
    EXPECT_EQ(response.reach(), std::min(s.local.stages() - 1, 20));
    ContactSide side;
    std::vector<std::ptrdiff_t> index;
    std::vector<Vec3> impulse;
    for (int column = 0; column < 5; ++column)
      for (int station = 18; station < 23; ++station) {
        index.push_back(s.surface.index(column, station));
        impulse.push_back({scatter(3 * index.size()), scatter(3 * index.size() + 1), scatter(3 * index.size() + 2)});
      }
    std::vector<NodalForce> forces;
    for (std::size_t n = 0; n < index.size(); ++n)
      for (const auto& [i, value] :
           {std::pair{0, impulse[n].x}, std::pair{1, impulse[n].y}, std::pair{2, impulse[n].z}})
        forces.push_back({index[n] + i * s.surface.stride, value});
    Field f = s.body.layout.field();
    s.local.add_forces(forces, f);
    for (std::size_t to = 0; to < index.size(); ++to) {
      Vec3 sum;
      for (std::size_t from = 0; from < index.size(); ++from) {
        const auto place = [&](std::size_t n) {
          return std::pair{static_cast<int>(n / 5), 18 + static_cast<int>(n % 5)};
        };
        const double angle = kind == SweepKind::revolve ? s.surface.stations.at[place(from).second] : 0,
                     c = std::cos(angle), q = std::sin(angle);
        const Vec3 a = impulse[from],
                   v = response.velocity(place(from).first, place(to).first, place(to).second - place(from).second,
                                         {c * a.x + q * a.z, a.y, c * a.z - q * a.x});
        sum += {c * v.x - q * v.z, v.y, q * v.x + c * v.z};
      }
      const std::ptrdiff_t i = index[to];
      const Vec3 wanted = -s.body.inverse_mass[i] * Vec3{f[i], f[i + s.surface.stride], f[i + 2 * s.surface.stride]};
      EXPECT_LT(norm(sum - wanted), 1e-8 * response.own(2)) << static_cast<int>(kind) << ' ' << to;
    }
  }
}

// v(n-1/2).M v(n+1/2)/2 + u.M B K u/2, to round-off.
TEST_F(LocalStepsTest, ConserveTheirEnergy) {
  const Body body = block_under_layer();
  LocalSteps local(body, {}, kWanted);
  local.set_step(0.9 * lanczos_coarse_step(body, local), lanczos_stable_step(body));
  const double dt = local.step();
  Field u = body.layout.field(), v = scattered_forces(body, 1.0), f = u;
  Traversal elements(body);
  auto step = [&] {
    elements.linear_force(u, f);
    local.refine_linear(u, f);
    double energy = 0.5 * nodal_dot(body.layout, u, f);
    for (std::ptrdiff_t i : free_indices(body)) {
      const double before = v[i];
      v[i] -= dt * body.inverse_mass[i] * f[i];
      energy += 0.5 * body.mass[i] * before * v[i];
      u[i] += dt * v[i];
    }
    return energy;
  };
  const double start = step();
  for (int s = 0; s < 2000; ++s) ASSERT_NEAR(step(), start, 1e-9 * start) << s;
}

// Against one short step for the whole body: what leaves the layer has the second order error of central differences
// and no more.
TEST_F(LocalStepsTest, APulsePassesThroughTheLayerAsWithOneShortStep) {
  const std::vector<double> heights = with_rows(60);
  const Elastic soft = elastic(kYoung, 0.0, 7800), stiff = elastic(4 * kYoung, 0.0, 7800);
  const Body body(layered_brick(1, 1, 1e-3, 1e-3, heights, 2), {soft, stiff}, {});
  LocalSteps local(body, {}, 1e-3 / std::sqrt(soft.p_wave_modulus() / soft.density));
  const BlockLayout& l = body.layout.blocks[0];
  constexpr double kPulse = 8e-6, kEnd = 9.6e-6, kPressure = 1e9, kSide = 1e-3;
  constexpr int kSamples = 20;
  const double own = lanczos_stable_step(body), coarse = lanczos_coarse_step(body, local);
  ASSERT_GT(coarse, 10 * own);
  auto run = [&](double step, bool locally) {
    const int steps = static_cast<int>(std::ceil(kEnd / step / kSamples)) * kSamples;
    const double dt = kEnd / steps;
    if (locally) local.set_step(dt, own);
    Field u = body.layout.field(), v = u, f = u;
    Traversal elements(body);
    std::vector<double> strain;
    for (int s = 0; s < steps; ++s) {
      elements.linear_force(u, f);
      const double t = s * dt,
                   pressure = t < kPulse ? 0.5 * kPressure * (1 - std::cos(2 * std::numbers::pi * t / kPulse)) : 0;
      for (int node : {0, 1})
        for (int j : {0, 1}) f[l.line(node, 2) + j] += 0.25 * pressure * kSide * kSide;
      if (locally) local.refine_linear(u, f);
      for (const NodeLine& line : body.lines)
        if (line.component == 2)
          for (int j = 0; j < line.count; ++j) {
            v[line.first + j] -= dt * body.inverse_mass[line.first + j] * f[line.first + j];
            u[line.first + j] += dt * v[line.first + j];
          }
      if ((s + 1) % (steps / kSamples)) continue;
      for (int row : {0, 1, 3, 20})
        strain.push_back((u[l.line(2 * row, 2)] - u[l.line(2 * row + 2, 2)]) / heights[row]);
    }
    return strain;
  };
  const std::vector<double> exact = run(0.2 * own, false), one = run(0.9 * coarse, true),
                            half = run(0.45 * coarse, true);
  double error_one[2] = {}, error_half[2] = {}, largest = 0;  // in the fine rows; far below
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const int below = i % 4 == 3;
    largest = std::max(largest, std::abs(exact[i]));
    error_one[below] = std::max(error_one[below], std::abs(one[i] - exact[i]));
    error_half[below] = std::max(error_half[below], std::abs(half[i] - exact[i]));
  }
  EXPECT_NEAR(largest, kPressure / kYoung, 0.02 * largest);
  EXPECT_LT(error_one[0], 0.003 * largest);
  EXPECT_LT(error_half[0], 0.0015 * largest);
  EXPECT_LT(error_one[1], 0.003 * largest);
  EXPECT_NEAR(error_one[1] / error_half[1], 4, 0.4);
}

// The nonlinear forces of a turned body: rigid rotation feels nothing, and nothing depends on the threads.
TEST_F(LocalStepsTest, SameBitsOnOneTwoAndFourThreadsAndNoForceFromRigidRotation) {
  SweptBody mesh = layered_brick(1, 20, 1e-3, 1e-3, with_rows(3), 2);
  mesh.kind = SweepKind::revolve;
  for (Vec2& p : mesh.blocks[0].section.nodes) p.z -= 0.05;
  for (double& t : mesh.blocks[0].stations.at) t /= 0.05;
  const Body body(mesh, kStiffOnSteel, {});
  LocalSteps local(body, {}, kWanted);
  local.set_step(0.8 * kWanted, lanczos_stable_step(body));
  ASSERT_GT(local.fine_elements(), 0);
  const double psi = 0.7;
  Field u = nodal_field(body, [&](Vec3 x) { return rigid_displacement(x, body.mesh.origin, psi, {}); });
  Field f = body.layout.field();
  internal_force(body, u, psi, f);
  Field refined = f;
  local.refine(u, psi, {}, refined);
  double largest = 0;
  for (std::ptrdiff_t i : free_indices(body)) largest = std::max(largest, std::abs(refined[i]));
  EXPECT_LT(largest, 1e-9 * kYoung * 1e-6);  // stress 1e-9 E on a square millimetre
  const Field shaken = scattered_forces(body, 1e-6);
  for (std::size_t i = 0; i < u.size(); ++i) u[i] += shaken[i];
  expect_same_bits_on_one_two_and_four_threads([&] {
    internal_force(body, u, psi, f);
    local.refine(u, psi, {{0, 0, -9.81}, 3000}, f);
    std::vector<double> bits;
    for (std::ptrdiff_t i : free_indices(body)) bits.push_back(f[i]);
    return bits;
  });
}

}  // namespace railstrata
