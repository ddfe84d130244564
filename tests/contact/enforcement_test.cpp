#include "contact/enforcement.hpp"

#include <gtest/gtest.h>

#include "sample_surfaces.hpp"

namespace railstrata {
namespace {

using namespace contact_checks;

constexpr double kStep = 2e-7, kFriction = 0.3;

double scatter(std::size_t i) {
  return 2 * std::fmod(0.6180339887498949 * static_cast<double>(i * i + 7 * i + 1), 1.0) - 1;
}

// A wheel pressed into the rail while it approaches and slides; velocities without pattern, unequal masses.
struct Impact {
  Surfaces surfaces{1.37};
  MortarContact contact{surfaces.rail, surfaces.wheel};
  MortarRows rows;
  ContactSystem before, after;
  SurfaceTractions memory{surfaces.rail.columns, surfaces.rail.stations.nodes()};

  explicit Impact(const EnforcementOptions& options, double lift = -0.5e-6) {
    const AxlePose pose{0, 0, lift, 0};
    contact.search(surfaces.rail_field(), surfaces.rolled(pose), pose, 20e-3, 30e-6);
    rows = contact.rows(surfaces.rail_field(), surfaces.rolled(pose), pose);
    number_wheel_nodes(rows, surfaces.wheel, before);
    for (std::size_t r = 0; r < rows.rows.size(); ++r) {
      before.rail.velocity.push_back({0.3 * scatter(3 * r), 0.3 * scatter(3 * r + 1), scatter(3 * r + 2)});
      before.rail.inverse_mass.push_back(2e5 * (1 + 0.3 * scatter(r)));
    }
    for (std::size_t n = 0; n < before.wheel_nodes.size(); ++n) {
      before.wheel.velocity.push_back({1 + 2 * scatter(4 * n), scatter(4 * n + 1), -2 + scatter(4 * n + 2)});
      before.wheel.inverse_mass.push_back(1.2e5 * (1 + 0.3 * scatter(n + 77)));
    }
    before.rail.before = before.rail.velocity;
    before.wheel.before = before.wheel.velocity;
    after = before;
    enforce_contact(rows, kStep, options, after, memory);
  }
  Vec3 slip(const ContactSystem& s, std::size_t r) const {
    Vec3 w = -s.rail.velocity[r];
    for (int k = rows.rows[r].first; k < rows.rows[r].first + rows.rows[r].count; ++k)
      w += rows.weights[k].m * s.wheel.velocity[s.weight_node[k]];
    return w;
  }
  const NodeTraction& traction(std::size_t r) const { return memory.at(rows.rows[r].column, rows.rows[r].station); }
  // Free velocities with which the tractions in memory bring every node to rest.
  void stop_with_tractions(ContactSystem& s) const {
    for (Vec3& v : s.rail.velocity) v = {};
    for (Vec3& v : s.wheel.velocity) v = {};
    for (std::size_t r = 0; r < rows.rows.size(); ++r) {
      const ContactRow& row = rows.rows[r];
      const Vec3 impulse = (kStep * row.area) * traction_vector(traction(r), row.normal);
      s.rail.velocity[r] -= s.rail.inverse_mass[r] * impulse;
      for (int k = row.first; k < row.first + row.count; ++k)
        s.wheel.velocity[s.weight_node[k]] += (rows.weights[k].m * s.wheel.inverse_mass[s.weight_node[k]]) * impulse;
    }
  }
};

EnforcementOptions exact(double friction = kFriction) { return {{friction, {}}, 0, 1e-19, 20000}; }

}  // namespace

TEST(Multipliers, SatisfySignoriniAndCoulombAtTheEndOfTheStep) {
  constexpr double kLow = 0.15;
  const Impact c(exact(kLow), -2e-6);
  int open = 0, stick = 0, sliding = 0;
  for (std::size_t r = 0; r < c.rows.rows.size(); ++r) {
    const ContactRow& row = c.rows.rows[r];
    const NodeTraction& t = c.traction(r);
    const Vec3 w = c.slip(c.after, r);
    const double gap = row.gap + kStep * dot(w, row.normal), q = std::hypot(t.q1, t.q2);
    constexpr double kPressure = 1e6, kLength = 1e-15,
                     kSpeed = 1e-8;  // of pressures of GPa, gaps of um and speeds of m/s
    EXPECT_GE(t.p, 0.0);
    EXPECT_GE(gap, -kLength);
    EXPECT_LT(t.p > 0 ? std::abs(gap) : 0.0, kLength);
    EXPECT_LE(q, kLow * t.p * (1 + 1e-12));
    EXPECT_NEAR(t.slip1, dot(w, tangent_frame(row.normal).t1), 1e-12);
    if (t.p < kPressure) {
      ++open;
      continue;
    }
    if (q < kLow * t.p * (1 - 1e-9)) {
      ++stick;
      EXPECT_LT(std::hypot(t.slip1, t.slip2), kSpeed);
    } else {
      ++sliding;  // the traction on the rail points the way the wheel slips
      EXPECT_NEAR((t.q1 * t.slip1 + t.q2 * t.slip2), q * std::hypot(t.slip1, t.slip2),
                  1e-6 * q * std::hypot(t.slip1, t.slip2) + q * kSpeed);
    }
  }
  EXPECT_GT(open, 10);
  EXPECT_GT(stick, 4);
  EXPECT_GT(sliding, 4);
}

// Where the law lets a node slip, its traction is on the disc and the surfaces slide; where it does not, they do not.
TEST(Multipliers, AnswerWhichNodesSlip) {
  constexpr double kLow = 0.15, kPressure = 1e6, kSpeed = 1e-8;
  const Impact c(exact(kLow), -2e-6);
  int slipping = 0, sticking = 0;
  for (std::size_t r = 0; r < c.rows.rows.size(); ++r) {
    const NodeTraction& t = c.traction(r);
    EXPECT_EQ(t.contact_time, t.p > 0 ? kStep : 0);
    EXPECT_EQ(t.slip_time, t.slips() ? kStep : 0);
    if (t.p < kPressure) continue;
    EXPECT_EQ(t.slips(), std::hypot(t.slip1, t.slip2) > kSpeed);
    EXPECT_EQ(t.slips(), std::hypot(t.q1, t.q2) > kLow * t.p * (1 - 1e-9));
    ++(t.slips() ? slipping : sticking);
  }
  EXPECT_GT(slipping, 4);
  EXPECT_GT(sticking, 4);
}

// A node that slid counts as sliding through a pause shorter than the mesh's fastest vibration, and no longer.
TEST(Multipliers, TakeAShortPauseForSlip) {
  constexpr double kPressure = 1e6;  // Pa; below, round-off of the velocities above decides
  Impact c(exact());
  const auto after_steps = [&](long steps, bool slides) {
    for (NodeTraction& t : c.memory.all())
      if (t.p > 0) {
        t.stuck = slides ? 0 : NodeTraction::kPause;
        t.slip_time = 0;
      }
    for (long k = 0; k < steps; ++k) {  // what was reached is kept: nothing slips in these steps
      ContactSystem again = c.after;
      c.stop_with_tractions(again);
      MortarRows touching = c.rows;
      for (ContactRow& row : touching.rows) row.gap = 0;
      enforce_contact(touching, kStep, exact(10), again, c.memory);
    }
    int slipping = 0;
    for (const NodeTraction& t : c.memory.all()) slipping += t.p > kPressure && t.slips();
    return slipping;
  };
  EXPECT_EQ(after_steps(2, false), 0);
  EXPECT_GT(after_steps(NodeTraction::kPause - 1, true), 4);
  EXPECT_EQ(after_steps(NodeTraction::kPause, true), 0);
}

// An elastic film shears by (h/G) q; with friction that never slips that is all of the motion.
TEST(Multipliers, LeaveAnElasticFilmItsShear) {
  EnforcementOptions options = exact(1e6);
  options.friction.film = {2e-6, 1e8, 0, 0};
  const Impact c(options, -2e-6);
  int pressed = 0;
  for (std::size_t r = 0; r < c.rows.rows.size(); ++r) {
    const NodeTraction& t = c.traction(r);
    if (t.p < 1e6) continue;
    ++pressed;
    const TangentFrame f = tangent_frame(c.rows.rows[r].normal);
    const Vec3 w = c.slip(c.after, r);
    EXPECT_NEAR(dot(w, f.t1) * kStep, 2e-14 * t.q1, 1e-6 * kStep);
    EXPECT_NEAR(dot(w, f.t2) * kStep, 2e-14 * t.q2, 1e-6 * kStep);
    EXPECT_NEAR(std::hypot(t.slip1, t.slip2), 0, 1e-6);
    EXPECT_FALSE(t.slips());
  }
  EXPECT_GT(pressed, 10);
}

// Friction that falls with slip: the disc of a step is what earlier slip has left, the slip of the step takes more of
// it, and a node that opens loses its history.
TEST(Multipliers, TakeWhatSlipHasLeftOfFriction) {
  constexpr double kLow = 0.15;
  EnforcementOptions options = exact(kLow);
  options.friction.falling = {FrictionForm::falling_rational, 0.3, 0.5, 0.5e-6, 1e-3};
  Impact c(options, -2e-6);
  std::vector<double> lost;
  int sliding = 0;
  for (std::size_t r = 0; r < c.rows.rows.size(); ++r) {
    const NodeTraction& t = c.traction(r);
    EXPECT_NEAR(t.lost_friction,
                t.p > 0 ? lost_after(options.friction.falling, 0, std::hypot(t.slip1, t.slip2), kStep) : 0, 1e-15);
    lost.push_back(t.lost_friction);
  }
  ContactSystem next = c.before;
  enforce_contact(c.rows, kStep, options, next, c.memory);
  for (std::size_t r = 0; r < c.rows.rows.size(); ++r) {
    const NodeTraction& t = c.traction(r);
    const double bound = kLow * (1 - lost[r]) * t.p;
    EXPECT_LE(std::hypot(t.q1, t.q2), bound * (1 + 1e-12));
    if (t.p < 1e6 || std::hypot(t.slip1, t.slip2) < 0.2) continue;
    EXPECT_NEAR(std::hypot(t.q1, t.q2) / bound, 1, 1e-9);
    EXPECT_GT(lost[r], 0.01);
    ++sliding;
  }
  EXPECT_GT(sliding, 4);
  for (ContactRow& row : c.rows.rows) row.gap = 1e-3;
  ContactSystem lifted = c.before;
  enforce_contact(c.rows, kStep, options, lifted, c.memory);
  for (const NodeTraction& t : c.memory.all()) EXPECT_EQ(t.lost_friction, 0);
}

// A film that yields carries tau_c0 + k u_pl, u_pl being the path that is not elastic.
TEST(Multipliers, LeaveAPlasticFilmItsPath) {
  EnforcementOptions options = exact(1e6);
  const ThirdBody film = options.friction.film = {2e-6, 1e8, 2e6, 4e12};
  Impact c(options, -2e-6);
  int yielding = 0;
  for (std::size_t r = 0; r < c.rows.rows.size(); ++r) {
    const NodeTraction& t = c.traction(r);
    if (t.p < 1e6) continue;
    const double q = std::hypot(t.q1, t.q2), path = kStep * std::hypot(t.slip1, t.slip2);
    EXPECT_NEAR(t.plastic, path, 1e-6 * path + 1e-13);
    EXPECT_LE(q, (film.yield_shear + film.hardening * t.plastic) * (1 + 1e-9));
    EXPECT_NEAR(t.slips() ? q : 0, t.slips() ? film.yield_shear + film.hardening * t.plastic : 0, 1e-6 * q);
    yielding += t.slips();
  }
  EXPECT_GT(yielding, 10);
  for (ContactRow& row : c.rows.rows) row.gap = 1e-3;
  ContactSystem lifted = c.before;
  enforce_contact(c.rows, kStep, options, lifted, c.memory);
  for (const NodeTraction& t : c.memory.all()) EXPECT_EQ(t.plastic, 0) << "opened, the node meets a fresh film";
}

TEST(Multipliers, KeepLinearMomentum) {
  for (double friction : {0.0, kFriction}) {
    const Impact c(exact(friction));
    Vec3 change, exchanged;
    for (std::size_t r = 0; r < c.rows.rows.size(); ++r) {
      const Vec3 dp = (1 / c.before.rail.inverse_mass[r]) * (c.after.rail.velocity[r] - c.before.rail.velocity[r]);
      change += dp;
      exchanged += Vec3{std::abs(dp.x), std::abs(dp.y), std::abs(dp.z)};
    }
    for (std::size_t n = 0; n < c.before.wheel_nodes.size(); ++n)
      change += (1 / c.before.wheel.inverse_mass[n]) * (c.after.wheel.velocity[n] - c.before.wheel.velocity[n]);
    EXPECT_LT(norm(change), 1e-12 * norm(exchanged));
  }
}

TEST(Multipliers, ImpulseIsAreaTimesTractionTimesTheStepOnBothSides) {
  const Impact c(exact());
  std::vector<Vec3> wheel(c.before.wheel_nodes.size());
  for (std::size_t r = 0; r < c.rows.rows.size(); ++r) {
    const ContactRow& row = c.rows.rows[r];
    const Vec3 impulse = (kStep * row.area) * traction_vector(c.traction(r), row.normal);
    const Vec3 rail = (1 / c.before.rail.inverse_mass[r]) * (c.after.rail.velocity[r] - c.before.rail.velocity[r]);
    EXPECT_LT(norm(rail - impulse), 1e-9 * norm(impulse) + 1e-15);
    for (int k = row.first; k < row.first + row.count; ++k)
      wheel[c.before.weight_node[k]] -= c.rows.weights[k].m * impulse;
  }
  for (std::size_t n = 0; n < wheel.size(); ++n) {
    const Vec3 dp = (1 / c.before.wheel.inverse_mass[n]) * (c.after.wheel.velocity[n] - c.before.wheel.velocity[n]);
    EXPECT_LT(norm(dp - wheel[n]), 1e-9 * norm(dp) + 1e-15);
  }
}

TEST(Multipliers, TakeKineticEnergyOutOfSurfacesThatDoNotOverlap) {
  const Impact c(exact(), 0.3e-6);
  for (const ContactRow& row : c.rows.rows) ASSERT_GE(row.gap, 0.0);
  double loss = 0;
  auto energy = [](Vec3 v, double inverse_mass) { return 0.5 * dot(v, v) / inverse_mass; };
  for (std::size_t r = 0; r < c.rows.rows.size(); ++r)
    loss += energy(c.before.rail.velocity[r], c.before.rail.inverse_mass[r]) -
            energy(c.after.rail.velocity[r], c.before.rail.inverse_mass[r]);
  for (std::size_t n = 0; n < c.before.wheel_nodes.size(); ++n)
    loss += energy(c.before.wheel.velocity[n], c.before.wheel.inverse_mass[n]) -
            energy(c.after.wheel.velocity[n], c.before.wheel.inverse_mass[n]);
  EXPECT_GT(loss, 0.0);
}

TEST(Multipliers, OfALooseToleranceLeaveAPenetrationOfItsOrder) {
  for (double tolerance : {1e-11, 1e-13}) {
    EnforcementOptions options = exact();
    options.tolerance = tolerance;
    const Impact c(options);
    double worst = 0;
    for (std::size_t r = 0; r < c.rows.rows.size(); ++r)
      worst = std::max(worst, -(c.rows.rows[r].gap + kStep * dot(c.slip(c.after, r), c.rows.rows[r].normal)));
    EXPECT_LT(worst, 20 * tolerance);
  }
}

TEST(Multipliers, AreTheSameWhenTheyStartFromTheSolution) {
  Impact c(exact());
  const std::vector<NodeTraction> first = c.memory.all();
  c.after = c.before;
  enforce_contact(c.rows, kStep, exact(), c.after, c.memory);
  for (std::size_t k = 0; k < first.size(); ++k) EXPECT_NEAR(c.memory.all()[k].p, first[k].p, 1e-7 * 1e9);
}

}  // namespace railstrata
