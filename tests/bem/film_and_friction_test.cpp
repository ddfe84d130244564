// A third-body film under friction that falls with slip and remembers, in series with half-spaces; films that soften.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/faults.hpp"
#include "half_space_pair.hpp"

namespace railstrata {
namespace {

constexpr double kMPa = 1e6, kPerMm = 1e9;
const FallingFriction kFall{FrictionForm::falling_exponential, 0.4, 1.25, 30e-6, 1e-3};
constexpr double kSpeed = 10;

/// A particle's way through the patch under a film alone, between rigid bodies, by explicit steps of its own:
///   h/G dq/dt + slip = creepage V,   |q| <= min(tau_c(u_pl), f p m)
struct Particle {
  ThirdBody film;
  FallingFriction law;
  double q = 0, sheared = 0, share = 1;

  void move(double friction, double creepage, double step) {
    const double trial = q + creepage * step / film.flexibility(), strength = film.strength(sheared),
                 carried = friction * share, yield = film.yield_shear > 0 ? strength : HUGE_VAL;
    q = std::min({trial, carried, yield});
    const double slid = (trial - q) * film.flexibility();
    if (slid <= 0) return;
    if (yield < carried)
      sheared += slid;
    else if (law.falls())
      share += (friction_share(law, slid / step * kSpeed).value - share) * slid / law.memory_distance;
  }
};

/// Force [N] of rows of such particles under the pressure of Hertz.
double force_of_particles(const ReferenceContact& c, const ThirdBody& film, const FallingFriction& law,
                          double creepage) {
  constexpr int kSteps = 50'000, kRows = 40;
  double force = 0;
  for (int r = 0; r < kRows; ++r) {
    const double y = (r + 0.5) / kRows, half = c.hertz.a * std::sqrt(1 - y * y), step = 2 * half / kSteps;
    Particle particle{film, law};
    for (int i = 0; i < kSteps; ++i) {
      const double x = half - (i + 0.5) * step, left = 1 - y * y - x * x / (c.hertz.a * c.hertz.a);
      particle.move(c.kFriction * c.hertz.p0 * std::sqrt(std::max(0.0, left)), creepage, step);
      force += particle.q * step * 2 * c.hertz.b / kRows;
    }
  }
  return force;
}

/// Bodies so stiff that the film alone gives way; the pressure of steel.
TangentialSolution between_stiff_bodies(const ReferenceContact& c, const ThirdBody& film, const FallingFriction& law,
                                        double creepage) {
  const HalfSpaceMaterial stiff{210e13, 0.3};
  const InfluenceOperator influence(pair_of(stiff, stiff), c.grid.nx, c.grid.ny, c.grid.dx, c.grid.dy,
                                    film.flexibility());
  TangentialProblem p = c.rolling();
  p.third_body = film;
  p.falling = law;
  p.speed = kSpeed;
  p.x.creepage = creepage;
  return solve_tangential(influence, c.grid, p);
}

TEST(FilmAndFriction, ForceIsThatOfParticlesFollowedOnTheirWay) {
  const ReferenceContact c(1.2, 1.2, 0.1e-3);
  const ThirdBody elastic{20e-6, 1062.5 * kMPa, 0, 0}, plastic{20e-6, 1062.5 * kMPa, 250 * kMPa, 300 * kPerMm};
  for (const double creepage : {0.002, 0.01, 0.05, 0.1})
    for (const ThirdBody& film : {elastic, plastic}) {
      const double ours = between_stiff_bodies(c, film, kFall, creepage).force_x;
      EXPECT_NEAR(ours / force_of_particles(c, film, kFall, creepage), 1, 0.01) << creepage << ' ' << film.yield_shear;
    }
}

TEST(FilmAndFriction, SofteningFilmCarriesWhatItsParticlesDo) {
  const ReferenceContact c(1.2, 1.2, 0.1e-3);
  const ThirdBody film{20e-6, 106.25 * kMPa, 300 * kMPa, -400 * kPerMm, 30 * kMPa};
  for (const double creepage : {0.01, 0.05, 0.2}) {
    const TangentialSolution s = between_stiff_bodies(c, film, {}, creepage);
    EXPECT_NEAR(s.force_x / force_of_particles(c, film, {}, creepage), 1, 0.01) << creepage;
  }
}

// The power of force and creepage is what friction and film dissipate, their elastic shear given back or lost with it.
TEST(FilmAndFriction, PowerIsDissipated) {
  const ReferenceContact c(1.2, 1.2, 0.25e-3);
  const ThirdBody film{20e-6, 1062.5 * kMPa, 0, 0};
  const InfluenceOperator influence(pair_of(kSteel, kSteel), c.grid.nx, c.grid.ny, 0.25e-3, 0.25e-3,
                                    film.flexibility());
  TangentialProblem p = c.rolling();
  p.third_body = film;
  p.falling = kFall;
  p.speed = kSpeed;
  for (const double creepage : {0.005, 0.02, 0.1}) {
    p.x.creepage = creepage;
    const TangentialSolution s = solve_tangential(influence, c.grid, p);
    EXPECT_NEAR(s.dissipation / (s.force_x * creepage), 1, 0.01) << creepage;
    for (std::size_t k = 0; k < c.grid.size(); ++k)
      EXPECT_LE(std::abs(s.q_x[k]), p.traction_bound[k] * (1 - s.lost_friction[k]) * (1 + 3e-5));
  }
}

TEST(FilmAndFriction, RollingFromRestEndsInTheSteadyState) {
  const ReferenceContact c(1.2, 1.2, 0.5e-3);
  const ThirdBody film{20e-6, 1062.5 * kMPa, 300 * kMPa, 0};
  const InfluenceOperator influence(pair_of(kSteel, kSteel), c.grid.nx, c.grid.ny, 0.5e-3, 0.5e-3, film.flexibility());
  TangentialProblem p = c.rolling();
  p.third_body = film;
  p.falling = kFall;
  p.speed = kSpeed;
  p.x.creepage = 0.02;
  const TangentialSolution steady = solve_tangential(influence, c.grid, p);
  const TangentialSolution s = rolled_from_rest(influence, c.grid, p, 80);
  EXPECT_NEAR(s.force_x / steady.force_x, 1, 2e-4);
  EXPECT_NEAR(peak(s.lost_friction) / peak(steady.lost_friction), 1, 2e-3);
  EXPECT_NEAR(peak(s.plastic) / peak(steady.plastic), 1, 2e-3);
}

// hGP(m_s(0) - m_s)/d < 1: the memory that the message names does, and one a tenth shorter does not.
TEST(FilmAndFriction, TooShortAMemoryIsRefusedWithOneThatDoes) {
  const ReferenceContact c(1.2, 1.2, 0.1e-3);
  const ThirdBody film{20e-6, 106.25 * kMPa, 0, 0};
  FallingFriction law = kFall;
  law.memory_distance = 1e-6;
  double named = 0;
  try {
    between_stiff_bodies(c, film, law, 0.05);
    FAIL();
  } catch (const CaseError& e) {
    const std::string text = e.what(), begin = "below a memory distance of ";
    named = 1e-6 * std::stod(text.substr(text.find(begin) + begin.size()));
    EXPECT_NE(text.find("the film springs back"), std::string::npos) << text;
  }
  const double estimate = c.kFriction * c.hertz.p0 * 0.6 * film.flexibility();
  EXPECT_GT(named, 0.5 * estimate);
  EXPECT_LT(named, 1.1 * estimate);
  law.memory_distance = named;
  EXPECT_GT(between_stiff_bodies(c, film, law, 0.05).force_x, 0);
}

TEST(FilmAndFriction, AFilmThatSoftensTooFastIsRefused) {
  const ReferenceContact c(1.2, 1.2, 0.25e-3);
  const ThirdBody film{20e-6, 106.25 * kMPa, 300 * kMPa, -5300 * kPerMm, 30 * kMPa};
  const InfluenceOperator influence(pair_of(kSteel, kSteel), c.grid.nx, c.grid.ny, 0.25e-3, 0.25e-3,
                                    film.flexibility());
  TangentialProblem p = c.rolling();
  p.third_body = film;
  p.x.creepage = 0.01;
  try {
    solve_tangential(influence, c.grid, p);
    FAIL();
  } catch (const CaseError& e) {
    EXPECT_NE(std::string(e.what()).find("softens too fast: beyond -"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace railstrata
