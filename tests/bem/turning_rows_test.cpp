// Conformal contact by the normals of each row of cells.
#include <gtest/gtest.h>

#include <cmath>

#include "bem/case_patch.hpp"
#include "bem/rolling_contact.hpp"
#include "geometry/profile_names.hpp"
#include "half_space_pair.hpp"

namespace railstrata {
namespace {

constexpr HalfSpaceMaterial kGrooveSteel{204.8e9, 0.28};

/// A ball of 10 mm lateral radius and 420 mm along rolling in a groove under 10 kN [Li2002].
struct Groove {
  Profile wheel = circular_profile(ProfileKind::wheel, 10e-3, 9.9e-3), rail;
  TrackGeometry track;
  RigidContact contact;
  PatchGrid grid;
  ProfileGap gap;
  Plane turn;
  RollingContact problem;
  std::shared_ptr<const InfluenceOperator> influence;

  Groove(double radius, double cell)
      : rail(circular_profile(ProfileKind::rail, -radius, 9.9e-3)),
        grid(centred_grid(static_cast<int>(5e-3 / cell), static_cast<int>(7.5e-3 / cell), cell, cell)) {
    track.cant = 0;
    track.wheel_radius = 0.42;
    contact = place_wheel(wheel, rail, track);
    gap = local_gap(wheel, rail, track, contact, grid);
    for (const RowPlane& row : gap.rows) turn.push_back(row.angle);
    influence = std::make_shared<InfluenceOperator>(
        InfluenceOperator(pair_of(kGrooveSteel, kGrooveSteel), grid.nx, grid.ny, cell, cell), turn);
    problem.gap = gap.gap;
    problem.turn = turn;
    problem.target.load = 10e3;
  }
  double smooth_peak() const {
    return peak(solve_normal(*influence, grid, gap.gap, problem.target, {}, {}, turn).pressure);
  }
};

/// MPa by an independent program of elements without friction, within 0.07 % of Persson's plane solution.
TEST(TurningRows, PressTheGroovesAsSectionsOfElements) {
  struct Row {
    double radius, p_max;
  };
  for (const Row& row : {Row{10.25e-3, 530.0}, {10.10e-3, 409.4}, {10.05e-3, 348.7}, {10.02e-3, 295.3}})
    EXPECT_NEAR(Groove(row.radius, 0.3e-3).smooth_peak() / (row.p_max * 1e6), 1, 5e-3) << row.radius;
}

/// MPa by the same program with friction 0.3, free rolling; CONTACT has 520.6, 397.6, 336.1.
TEST(TurningRows, LetFrictionBearAPartOfTheLoadInTheGrooves) {
  struct Row {
    double radius, p_max;
  };
  for (const Row& row : {Row{10.25e-3, 524.4}, {10.10e-3, 402.2}, {10.05e-3, 340.8}, {10.02e-3, 287.8}}) {
    Groove groove(row.radius, 0.4e-3);
    RollingContact& c = groove.problem;
    c.friction = 0.3;
    c.x.force = 0;
    c.extra_slip.x.resize(groove.grid.size());
    for (std::size_t k = 0; k < groove.grid.size(); ++k) {
      const std::size_t under_axle = groove.grid.index(groove.grid.nx / 2, static_cast<int>(k) % groove.grid.ny);
      c.extra_slip.x[k] = 1 - groove.gap.radius[under_axle] / groove.contact.rolling_radius;
    }
    for (const double turn : groove.turn) c.local_spin.push_back(-std::sin(turn) / groove.contact.rolling_radius);
    const RollingSolution s = solve_rolling(*groove.influence, groove.grid, c);
    EXPECT_NEAR(peak(s.normal.pressure) / (row.p_max * 1e6), 1, 1e-2) << row.radius;
    EXPECT_NEAR(s.normal.load, 10e3, 1) << row.radius;
  }
}

TEST(TurningRows, WorkIsTheSameWhicheverLoadComesFirst) {
  const Groove groove(10.1e-3, 0.8e-3);
  const InfluenceOperator& op = *groove.influence;
  const std::size_t n = groove.grid.size();
  Plane p(n), q(n), none(n, 0.0), x(n);
  for (std::size_t k = 0; k < n; ++k) {
    p[k] = std::cos(1.0 * static_cast<double>(k * k % 17));
    q[k] = std::sin(2.0 * static_cast<double>(k * k % 13));
    x[k] = std::cos(3.0 * static_cast<double>(k * k % 11));
  }
  const double there = dot(q, op.tangential_from_pressure(p, groove.grid.nx).y),
               back = dot(p, op.normal_from_traction(none, q));
  EXPECT_NEAR(there, back, 1e-10 * std::abs(there));
  const PlanePair one = op.tangential(x, q, groove.grid.nx), other = op.tangential(q, p, groove.grid.nx);
  EXPECT_NEAR((dot(q, one.x) + dot(p, one.y)) / (dot(x, other.x) + dot(q, other.y)), 1, 1e-10);
}

}  // namespace
}  // namespace railstrata
