// A third-body layer in series with the half-spaces.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bem/rolling_contact.hpp"
#include "half_space_pair.hpp"

namespace railstrata {
namespace {

constexpr double kMPa = 1e6, kPerMm = 1e9;
// Films of Hou's tests, 20 µm. [HouKalousekMagel1997]
const ThirdBody kMagnetite{20e-6, 176.63 * kMPa, 560 * kMPa, 0}, kClay{20e-6, 106.25 * kMPa, 200 * kMPa, 435 * kPerMm},
    kMoS2{20e-6, 20.238 * kMPa, 20 * kMPa, 20.4 * kPerMm},
    kSand{20e-6, 176.63 * kMPa, 400 * kMPa, -195 * kPerMm, 1 * kMPa};

/// Shifts of one cell of 1 mm², in mm, and the force over friction after each, as CONTACT prints it (its example
/// plastic_3bl: G = 82 GPa, nu = 0.28, 900 N, f = 0.7).
struct Sheared {
  ThirdBody film;
  std::vector<double> shift, force;
};

TEST(ThirdBody, OneCellShearedBackAndForthMeetsContact) {
  const Sheared tests[] = {
      {{}, {-0.001}, {0.1349}},
      {kMagnetite, {-0.035, -0.035, -0.030, -0.050, -0.050}, {0.4444, 0.8889, 0.8889, 0.8889, 0.8889}},
      {kClay,
       {-0.040, -0.040, -0.040, -0.040, -0.036, 0.0, 0.036, 0.0, -0.046, -0.044, -0.050, -0.050},
       {0.3175, 0.3429, 0.3683, 0.3937, 0.4166, 0.4166, 0.1308, 0.1308, 0.4229, 0.4509, 0.4826, 0.5144}},
      {kSand,
       {-0.025, -0.025, -0.050, -0.050, -0.050, -0.050, -0.050, -0.050, -0.050, -0.050, -0.050, -0.050, -0.050},
       {0.3175, 0.6349, 0.6190, 0.6032, 0.5873, 0.5714, 0.5556, 0.5397, 0.5238, 0.5081, 0.4922, 0.4763, 0.4605}},
      {kMoS2,
       {-0.020, -0.040, -0.040, -0.050, -0.050, -0.050},
       {0.03175, 0.03302, 0.03428, 0.03587, 0.03746, 0.03904}}};
  const HalfSpaceMaterial body{2 * 82e9 * 1.28, 0.28};
  const PatchGrid grid{1, 1, 1e-3, 1e-3, 0, 0};
  for (const Sheared& test : tests) {
    const InfluenceOperator influence(pair_of(body, body), 1, 1, grid.dx, grid.dy, test.film.flexibility());
    TangentialProblem p;
    p.kind = RollingKind::shift;
    p.traction_bound = {0.7 * 900 * kMPa};
    p.third_body = test.film;
    TangentialSolution s;
    for (std::size_t i = 0; i < test.shift.size(); ++i) {
      p.x.creepage = 1e-3 * test.shift[i];
      if (i > 0) shift_on(influence, grid, s, p);
      s = solve_tangential(influence, grid, p);
      EXPECT_NEAR(-s.force_x / 630, test.force[i], 1.5e-4) << i;
    }
  }
}

/// The middle of a patch thirty times as wide as long is plane strain: cells along x end at the patch's edges.
struct LongPatch {
  static constexpr double kA = 2e-3, kB = 60e-3, kLoad = 2e5;
  static constexpr int kHalf = 30;
  PatchGrid grid = centred_grid(kHalf + 3, 32, kA / (kHalf + 0.5), kB / 30);
  HertzGap gap = hertz_gap(kA, kB, contact_modulus(kSteel, kSteel), kLoad);
  /// Force of the middle strip over width and creepage without slip, N/m.
  double slope(double film) const {
    const InfluenceOperator influence(pair_of(kSteel, kSteel), grid.nx, grid.ny, grid.dx, grid.dy, film);
    RollingContact p;
    p.gap = quadratic_gap(grid, gap.A, gap.B);
    p.target.load = kLoad;
    p.friction = 100;
    p.x.creepage = 1e-7;
    const TangentialSolution s = solve_rolling(influence, grid, p).tangential;
    double sum = 0;
    for (int i = 0; i < grid.nx; ++i) sum += s.q_x[grid.index(i, grid.ny / 2)] * grid.dx;
    return sum / p.x.creepage;
  }
};

// A film alone has q = xi (a - x) G/h, in all 2 a² G/h; Carter's half-spaces alone have pi a G/(2 (1 - nu)). Expanded
// in the softness of the film, the force of both in series is that of the added compliances to the second order: of the
// film's traction the half-spaces make the slip -(4/pi) as in the sum, since (x + 1)(1 - t) - (t + 1)(1 - x) is 2 (x -
// t). The third order, and the two dimensions of the middle strip, are within the half per cent.
TEST(ThirdBody, SlopeOfTheCreepCurveIsThatOfTheCompliancesAdded) {
  const LongPatch patch;
  const double a = patch.kA, G = kSteel.young / (2 * (1 + kSteel.poisson)),
               bare = std::numbers::pi * a * G / (2 * (1 - kSteel.poisson));
  for (const double times : {1.0, 2.0, 10.0}) {
    const double film = times * kClay.flexibility(), alone = 2 * a * a / film;
    EXPECT_LT(alone, bare) << "soft";
    EXPECT_NEAR(patch.slope(film) * (1 / bare + 1 / alone), 1, 5e-3) << times;
  }
}

// What a film leaves of the slope is the bodies' and the film's, not the cells'.
TEST(ThirdBody, FilmLowersTheSlopeOnEveryCellAlike) {
  double last = 0;
  for (const double cell : {1e-3, 0.5e-3, 0.25e-3}) {
    const ReferenceContact c(1.2, 1.2, cell);
    const auto slope = [&](double film) {
      const InfluenceOperator influence(pair_of(kSteel, kSteel), c.grid.nx, c.grid.ny, cell, cell, film);
      RollingContact p;
      p.gap = quadratic_gap(c.grid, 1.2, 1.2);
      p.target.load = c.kLoad;
      p.friction = c.kFriction;
      p.x.creepage = 1e-5;
      return solve_rolling(influence, c.grid, p).tangential.force_x / p.x.creepage;
    };
    const double ratio = slope(kClay.flexibility()) / slope(0);
    EXPECT_GT(ratio, 0.1);
    EXPECT_LT(ratio, 0.3);
    if (last > 0) {
      EXPECT_NEAR(ratio / last, 1, 0.03) << cell;
    }
    last = ratio;
  }
}

/// Rolling with a film; 84954.6 N on a circle, f = 0.5.
RollingSolution rolling(const ReferenceContact& c, const ThirdBody& film, double creepage) {
  const InfluenceOperator influence(pair_of(kSteel, kSteel), c.grid.nx, c.grid.ny, c.grid.dx, c.grid.dy,
                                    film.flexibility());
  RollingContact p;
  p.gap = quadratic_gap(c.grid, 1.2, 1.2);
  p.target.load = c.kLoad;
  p.friction = c.kFriction;
  p.third_body = film;
  p.x.creepage = creepage;
  return solve_rolling(influence, c.grid, p);
}

// Fully sheared, a film that does not harden carries the lower of f p and tau_c0 everywhere; p of Hertz: the integral.
TEST(ThirdBody, FullyYieldedItCarriesTheLowerOfFrictionAndYield) {
  const ReferenceContact c(1.2, 1.2, 0.25e-3);
  const double yield = 200 * kMPa;
  const RollingSolution s = rolling(c, {20e-6, 106.25 * kMPa, yield, 0}, 1);
  double lower = 0;
  for (std::size_t k = 0; k < c.grid.size(); ++k) {
    lower += std::min(c.kFriction * s.normal.pressure[k], yield) * c.grid.cell_area();
    if (s.normal.pressure[k] > 0) {
      EXPECT_NEAR(s.tangential.q_x[k], std::min(c.kFriction * s.normal.pressure[k], yield), 2e-5 * yield);
    }
  }
  EXPECT_NEAR(s.tangential.force_x / lower, 1, 2e-5);
  // f p0 sqrt(1 - r²) above tau: a plateau to the radius r_0 with sqrt(1 - r_0²) = tau/(f p0)
  const double t = yield / (c.kFriction * c.hertz.p0), share = 1.5 * t * (1 - t * t) + t * t * t;
  EXPECT_NEAR(s.tangential.force_x / (c.kFriction * c.kLoad * share), 1, 2e-3);
}

// Along its way through the patch the film hardens by what it has sheared: tau_c0 + k u_pl in every cell that yields,
// u_pl the sum of the slips over the steps before and its own.
TEST(ThirdBody, HardensAlongItsWayThroughThePatch) {
  const ReferenceContact c(1.2, 1.2, 0.5e-3);
  const ThirdBody film{20e-6, 106.25 * kMPa, 150 * kMPa, 4000 * kPerMm};
  const RollingSolution s = rolling(c, film, 0.01);
  const TangentialSolution& t = s.tangential;
  int yielding = 0;
  for (int i = c.grid.nx - 2; i >= 0; --i)
    for (int j = 0; j < c.grid.ny; ++j) {
      const std::size_t k = c.grid.index(i, j), ahead = c.grid.index(i + 1, j);
      const double bound = c.kFriction * s.normal.pressure[k], limit = film.yield_shear + film.hardening * t.plastic[k];
      EXPECT_LE(std::hypot(t.q_x[k], t.q_y[k]), std::min(bound, limit) * (1 + 2e-5));
      EXPECT_GE(t.plastic[k], t.plastic[ahead]);
      if (!(t.plastic[k] > t.plastic[ahead])) continue;
      EXPECT_NEAR(std::hypot(t.q_x[k], t.q_y[k]) / std::min(bound, limit), 1, 1e-4);
      ++yielding;
    }
  EXPECT_GT(yielding, 50);
  EXPECT_GT(*std::max_element(t.plastic.begin(), t.plastic.end()), 0.02e-3);
}

// A film's shear travels with its particles: steps of rolling at one creepage, from rest, end in the steady state.
TEST(ThirdBody, StepsOfRollingEndInTheSteadyStateWithItsPlasticShear) {
  const ReferenceContact c(1.2, 1.2, 1e-3);
  const ThirdBody film{20e-6, 106.25 * kMPa, 150 * kMPa, 435 * kPerMm};
  const InfluenceOperator influence(pair_of(kSteel, kSteel), c.grid.nx, c.grid.ny, 1e-3, 1e-3, film.flexibility());
  TangentialProblem p = c.rolling();
  p.third_body = film;
  p.x.creepage = 0.01;
  const TangentialSolution steady = solve_tangential(influence, c.grid, p);
  const TangentialSolution s = rolled_from_rest(influence, c.grid, p, 60);
  EXPECT_NEAR(s.force_x / steady.force_x, 1, 1e-4);
  EXPECT_NEAR(peak(s.plastic) / peak(steady.plastic), 1, 1e-3);
  EXPECT_GT(peak(s.plastic), 0.01e-3);
}

}  // namespace
}  // namespace railstrata
