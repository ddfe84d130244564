#include "damage/shakedown.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/faults.hpp"
#include "damage/deviator.hpp"
#include "tests/damage/hertz_stress.hpp"

namespace railstrata {
namespace {

using testing::HertzLoad;
using testing::history_of;
using testing::LineLoad;
using testing::rolling_samples;
using testing::steps;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

Shakedown of(const StressHistory& h, std::vector<double> strength = {}) {
  if (strength.empty()) strength.assign(h.depth.size(), 1.);
  return shakedown({h, std::move(strength), {}, {}});
}

/// One point at a depth with the given stresses.
StressHistory one_point(std::vector<Sym3> stresses, double depth = 1) {
  StressHistory h{.x = {}, .y = {0}, .depth = {depth}, .zone = {0}, .stress = std::move(stresses)};
  for (std::size_t i = 0; i < h.stress.size(); ++i) h.x.push_back(static_cast<double>(i));
  return h;
}

// Hertz's axis: s_z = -1/(1 + z^2), s_x = -(1 + nu)(1 - z acot z) + 1/2(1 + z^2) [Johnson1985 eq. 3.45].
TEST(HertzStress, IsTheClosedFormOnTheAxisAndTheTractionsOnTheSurface) {
  for (const double z : {0.1, 0.3, 0.5, 1., 2.}) {
    const Sym3 s = HertzLoad{}.at(0, 0, z);
    EXPECT_NEAR(s.zz, -1 / (1 + z * z), 1e-6);
    EXPECT_NEAR(s.xx, -1.3 * (1 - z * std::atan2(1, z)) + 0.5 / (1 + z * z), 1e-6);
    EXPECT_NEAR(s.yy, s.xx, 1e-12);
  }
  const HertzLoad sliding{.a = 1, .b = 1.5, .friction = 0.3};
  for (const double x : {-0.6, 0., 0.4}) {
    const double p = std::sqrt(1 - x * x - 0.5 * 0.5 / (1.5 * 1.5));
    const Sym3 s = sliding.at(x, 0.5, 0);
    EXPECT_NEAR(s.zz, -p, 2e-3);
    EXPECT_NEAR(s.xz, -0.3 * p, 2e-3);  // the outward normal is -z
    EXPECT_NEAR(s.yz, 0, 2e-3);
  }
  // A long ellipse is a line, but for a/b (1 - 2 nu).
  const Sym3 line = LineLoad{0.3}.at(0.4, 0, 0.5),
             ellipse = HertzLoad{.a = 1, .b = 300, .friction = 0.3}.at(0.4, 0, 0.5);
  EXPECT_NEAR(ellipse.xx, line.xx, 2e-3);
  EXPECT_NEAR(ellipse.zz, line.zz, 2e-3);
  EXPECT_NEAR(ellipse.xz, line.xz, 2e-3);
}

struct LineTruth {
  double friction, first_yield, wandering, kinematic;
};

// p0/k of a line contact in full slip, nu 0.3; without friction 4 exactly [Johnson1985 sec. 9.2], the others from an
// independent search at steps of 0.02 a.
TEST(Shakedown, LineContactHasItsPublishedLimits) {
  for (const LineTruth& truth : {LineTruth{0, 3.107, 4.000, 4.000}, LineTruth{0.1, 3.063, 3.564, 3.987},
                                 LineTruth{0.2, 2.936, 3.202, 3.944}, LineTruth{0.3, 2.598, 2.900, 3.154},
                                 LineTruth{0.4, 2.123, 2.319, 2.407}, LineTruth{0.5, 1.777, 1.884, 1.938}}) {
    const Shakedown s = of(history_of(LineLoad{truth.friction}, rolling_samples(0.01), {0}, steps(0, 1.4, 0.02)));
    const double tolerance = truth.friction == 0 ? 0.001 : 0.005;
    EXPECT_NEAR(s.first_yield.value, truth.first_yield, tolerance * truth.first_yield);
    EXPECT_NEAR(s.wandering.value, truth.wandering, tolerance * truth.wandering);
    EXPECT_NEAR(s.kinematic.value, truth.kinematic, tolerance * truth.kinematic);
    EXPECT_LE(s.wandering.value, s.upper.value * (1 + 1e-12));
    EXPECT_LE(s.upper.value, s.kinematic.value * (1 + 1e-12));
    if (truth.friction == 0) {
      EXPECT_NEAR(s.wandering.value, 4, 4e-4);
      EXPECT_NEAR(s.wandering.depth, 0.5, 1e-9);
      EXPECT_NEAR(s.first_yield.depth, 0.7, 1e-9);
    }
  }
}

struct NeedTruth {
  double friction;
  std::vector<double> wandering, kinematic;
};

// k/p0 at z/a = 0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.8, 1.0, 1.2, to three digits.
TEST(Shakedown, LineContactAsksForStrengthAtEachDepth) {
  const std::vector<NeedTruth> truths = {{0, {.115, .166, .212, .236, .247, .250, .248, .235, .218, .200}, {}},
                                         {0.2,
                                          {.239, .243, .284, .306, .312, .310, .302, .280, .256, .232},
                                          {.225, .213, .233, .246, .253, .253, .250, .236, .219, .201}},
                                         {0.4,
                                          {.431, .361, .361, .376, .377, .370, .357, .326, .294, .265},
                                          {.415, .307, .283, .273, .268, .263, .256, .240, .222, .204}}};
  const std::vector<double> depths = {0, .1, .2, .3, .4, .5, .6, .8, 1., 1.2};
  for (const NeedTruth& truth : truths) {
    const Shakedown s = of(history_of(LineLoad{truth.friction}, rolling_samples(0.01), {0}, depths));
    for (std::size_t row = 0; row < depths.size(); ++row) {
      EXPECT_NEAR(s.required.wandering[row], truth.wandering[row], 0.01 * truth.wandering[row]);
      const double kinematic = truth.kinematic.empty() ? truth.wandering[row] : truth.kinematic[row];
      EXPECT_NEAR(s.required.kinematic[row], kinematic, 0.01 * kinematic);
    }
  }
}

// Circular patch, nu 0.3: first yield from the axis in closed form; 4.68 is the classical limit without friction
// [PonterHearleJohnson1985].
TEST(Shakedown, CircularContactHasItsLimitsAtEveryLevel) {
  const auto limits = [](double friction) {
    return of(
        history_of(HertzLoad{.friction = friction}, rolling_samples(0.05), steps(0, 1, 0.2), steps(0.2, 0.6, 0.02)));
  };
  const Shakedown smooth = limits(0), sliding = limits(0.2);
  EXPECT_NEAR(smooth.first_yield.value, 2.795, 0.005 * 2.795);
  EXPECT_NEAR(smooth.first_yield.depth, 0.48, 0.021);
  EXPECT_NEAR(smooth.wandering.value, 4.632, 0.005 * 4.632);
  EXPECT_NEAR(smooth.wandering.depth, 0.36, 0.021);
  EXPECT_NEAR(smooth.upper.value, 4.677, 0.003 * 4.677);
  EXPECT_NEAR(smooth.upper.y, 0, 1e-9);
  EXPECT_NEAR(sliding.first_yield.value, 2.717, 0.005 * 2.717);
  EXPECT_NEAR(sliding.wandering.value, 3.683, 0.005 * 3.683);
  EXPECT_NEAR(sliding.wandering.depth, 0.30, 0.021);
  EXPECT_NEAR(sliding.upper.value, 4.584, 0.003 * 4.584);
  EXPECT_NEAR(sliding.upper.depth, 0.32, 0.021);
}

// The surface ball of a circular patch at 0.2: p0/k = 4.814, below 1/friction.
TEST(Shakedown, SurfaceHasTheConditionOfNoTractions) {
  const Shakedown hertz = of(history_of(HertzLoad{.friction = 0.2}, rolling_samples(0.05), {0, 0.25, 0.5}, {0.}));
  EXPECT_NEAR(hertz.upper.value, 4.814, 0.003 * 4.814);
  EXPECT_LT(hertz.upper.value, 5);
  // Shear between 0 and 1: a residual shear would halve it, at the surface there is none.
  for (const double Sym3::*shear : {&Sym3::xz, &Sym3::yz, &Sym3::xy}) {
    std::vector<Sym3> path(2);
    path[1].*const_cast<double Sym3::*>(shear) = 1;
    const Shakedown surface = of(one_point(path, 0)), inside = of(one_point(path, 1));
    EXPECT_NEAR(surface.upper.value, shear == &Sym3::xy ? 2 : 1, 1e-12);
    EXPECT_NEAR(inside.upper.value, 2, 1e-12);
    EXPECT_NEAR(surface.kinematic.value, 2, 1e-12);
    EXPECT_NEAR(surface.wandering.value, 1, 1e-12);
  }
}

TEST(Shakedown, ProcessStressMovesFirstYieldAlone) {
  // Tension along x to 2 with 1 there before, yield in tension sqrt 3 k = 4: (4 - 1)/2; compression to -2: (4 + 1)/2.
  const double k = 4 / std::sqrt(3.);
  for (const double sign : {1., -1.}) {
    const StressHistory h = one_point({Sym3{}, Sym3{.xx = 2 * sign}});
    const Shakedown with = shakedown({h, {k}, {1}, {0}}), without = of(h, {k});
    EXPECT_NEAR(with.first_yield.value, sign > 0 ? 1.5 : 2.5, 1e-14);
    EXPECT_NEAR(with.required.first_yield[0], sign > 0 ? std::sqrt(3.) : 1 / std::sqrt(3.), 1e-14);
    EXPECT_NEAR(without.first_yield.value, 2, 1e-14);
    EXPECT_EQ(with.wandering.value, without.wandering.value);
    EXPECT_EQ(with.upper.value, without.upper.value);
    EXPECT_NEAR(with.wandering.value, 4, 1e-12);
  }
  // Equal in x and y: the von Mises stress of the process is 5 and yields by itself.
  EXPECT_EQ(shakedown({one_point({Sym3{.xx = 1}}), {k}, {5}, {5}}).first_yield.value, 0);
}

// A layer twice as strong: exact for the line, the least of k(z)/k_required(z).
TEST(Shakedown, StrongLayerMovesTheLimitBelowIt) {
  StressHistory h = history_of(LineLoad{0.4}, rolling_samples(0.01), {0}, steps(0, 1.4, 0.02));
  std::vector<double> k(h.depth.size(), 1.);
  for (std::size_t row = 0; row < k.size(); ++row)
    if (h.depth[row] < 0.3 - 1e-9) {
      k[row] = 2;
      h.zone[row] = 1;
    }
  const Shakedown s = of(h, k);
  ASSERT_EQ(s.zones.size(), 2U);
  EXPECT_EQ(s.zones[0].zone, 1);
  EXPECT_EQ(s.zones[1].zone, 0);
  EXPECT_NEAR(s.zones[0].wandering.value, 2 / .431, 0.01 * 2 / .431);
  EXPECT_NEAR(s.zones[1].wandering.value, 1 / .377, 0.005 / .377);
  EXPECT_EQ(s.wandering.value, s.zones[1].wandering.value);
  EXPECT_EQ(s.wandering.zone, 0);
  // A layer that stays elastic does not count, but reports what it would need.
  for (std::size_t row = 0; row < k.size(); ++row)
    if (h.zone[row] == 1) k[row] = row % 2 == 0 ? kNone : std::numeric_limits<double>::infinity();
  const Shakedown elastic = of(h, k);
  EXPECT_EQ(elastic.wandering.value, s.wandering.value);
  EXPECT_FALSE(std::isfinite(elastic.zones[0].wandering.value));
  EXPECT_FALSE(std::isfinite(elastic.zones[0].first_yield.value));
  EXPECT_EQ(elastic.required.wandering, s.required.wandering);
}

TEST(Shakedown, SaysWherePointsAre) {
  const StressHistory h = history_of(HertzLoad{.friction = 0.2}, rolling_samples(0.1), {-0.5, 0, 0.5}, {0.3, 0.46});
  const Shakedown s = of(h);
  EXPECT_EQ(s.first_yield.y, 0);
  EXPECT_EQ(s.first_yield.depth, 0.46);
  EXPECT_EQ(s.pointwise.size(), 6U);
  EXPECT_EQ(*std::max_element(s.pointwise.begin(), s.pointwise.begin() + 3), s.required.upper[0]);
}

TEST(Shakedown, HasTheSameBitsForAnyNumberOfThreads) {
  const StressHistory h =
      history_of(HertzLoad{.friction = 0.3}, rolling_samples(0.2), steps(-1, 1, 0.2), {0.2, 0.4, 0.5});
  const int threads = max_threads();
  set_threads(1);
  const Shakedown one = of(h);
  set_threads(3);
  const Shakedown three = of(h);
  set_threads(threads);
  EXPECT_EQ(one.pointwise, three.pointwise);
  EXPECT_EQ(one.required.wandering, three.required.wandering);
  EXPECT_EQ(one.first_yield.value, three.first_yield.value);
}

TEST(Shakedown, RejectsWhatDoesNotFit) {
  StressHistory h = one_point({Sym3{.xx = 1}});
  EXPECT_THROW(shakedown({h, {}, {}, {}}), std::invalid_argument);
  EXPECT_THROW(shakedown({h, {0}, {}, {}}), std::invalid_argument);
  EXPECT_THROW(shakedown({h, {1}, {1, 2}, {}}), std::invalid_argument);
  EXPECT_THROW(shakedown({StressHistory{}, {}, {}, {}}), std::invalid_argument);
  h.stress[0].xy = kNone;
  EXPECT_THROW(shakedown({h, {1}, {}, {}}), NumericalError);
}

}  // namespace
}  // namespace railstrata
