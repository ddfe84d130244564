#include "single_track/single_track.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/faults.hpp"
#include "damage/shakedown.hpp"
#include "tests/damage/hertz_stress.hpp"

namespace railstrata {
namespace {

using testing::HertzLoad;
using testing::history_of;
using testing::LineLoad;
using testing::rolling_samples;
using testing::steps;

template <class Load>
SingleTrackInput input_of(const Load& load, TrackSides sides) {
  SingleTrackInput in;
  in.stress = [load](const std::vector<Vec3>& points, bool) { return load.stresses(points); };
  in.shear_strength = [](double, bool) { return 1.; };
  in.half_length = in.half_width = 1;
  in.sides = sides;
  return in;
}

/// A line load that fades to the sides: no elastic solution, but the program does not ask for one.
struct FadingLoad {
  LineLoad line{0.3};
  double scale = 1, stress = 1;  ///< m, Pa
  Vec3 centre;
  std::vector<Sym3> stresses(const std::vector<Vec3>& points) const {
    std::vector<Sym3> out;
    for (const Vec3& p : points) {
      const double y = (p.y - centre.y) / scale;
      out.push_back(stress * std::exp(-y * y) * line.at((p.x - centre.x) / scale, 0, p.z / scale));
    }
    return out;
  }
};

constexpr SingleTrackOptions kCoarse{.cell = 0.35, .box = 4};

// 4 exactly without friction [Johnson1985 sec. 9.2], 3.202 at 0.2.
TEST(SingleTrack, LineLoadHasItsLimit) {
  for (const auto& [friction, limit] : {std::pair{0., 4.}, std::pair{0.2, 3.202}}) {
    const SingleTrack track = single_track(input_of(LineLoad{friction}, TrackSides::endless));
    EXPECT_NEAR(track.factor, limit, 0.002 * limit);
    EXPECT_NEAR(track.depth, friction > 0 ? 0.42 : 0.50, 0.04);
    double work = 0, most = 0;
    for (const TrackPoint& p : track.points) {
      work += p.work;
      most = std::max(most, p.utilisation);
    }
    EXPECT_NEAR(work, 1, 1e-3);
    EXPECT_NEAR(most, 1, 5e-3);
  }
}

// The line's limit is the least of k(z) over the required strength, whatever k(z) is.
TEST(SingleTrack, StrengthMayJumpWithDepth) {
  StressHistory h = history_of(LineLoad{0.4}, rolling_samples(0.02), {0}, steps(0, 2, 0.02));
  for (const double below : {0.8, 1.25, 0.5}) {
    std::vector<double> k(h.depth.size(), 1.);
    for (std::size_t row = 0; row < k.size(); ++row)
      if (h.depth[row] > 0.3 + 1e-9) k[row] = below;
    const double limit = shakedown({h, k, {}, {}}).wandering.value;
    SingleTrackInput in = input_of(LineLoad{0.4}, TrackSides::endless);
    in.interfaces = {0.3};
    in.shear_strength = [&](double z, bool below_interface) {
      return z > 0.3 || (z == 0.3 && below_interface) ? below : 1.;
    };
    const SingleTrack track = single_track(in);
    EXPECT_NEAR(track.factor, limit, 0.005 * limit) << below;
    EXPECT_EQ(track.depth > 0.29, below < 1);
  }
}

TEST(SingleTrack, InterfaceOfEqualStrengthsChangesNothing) {
  SingleTrackInput in = input_of(LineLoad{0.2}, TrackSides::endless);
  const double without = single_track(in).factor;
  in.interfaces = {0.27, 0.5};
  EXPECT_NEAR(single_track(in).factor, without, 0.001 * without);
}

// The surface governs at 0.4; taken for elastic, the limit is that of what lies below.
TEST(SingleTrack, LayerThatStaysElasticDoesNotCount) {
  SingleTrackInput in = input_of(LineLoad{0.4}, TrackSides::endless);
  in.interfaces = {0.2};
  in.shear_strength = [](double z, bool below) {
    return z > 0.2 || (z == 0.2 && below) ? 1. : std::numeric_limits<double>::quiet_NaN();
  };
  EXPECT_NEAR(single_track(in).factor, 1 / 0.377, 0.005 / 0.377);
}

TEST(SingleTrack, OneSideOfASymmetricLoadIsEnough) {
  const double half = single_track(input_of(FadingLoad{}, TrackSides::symmetric), kCoarse).factor,
               both = single_track(input_of(FadingLoad{}, TrackSides::both), kCoarse).factor;
  EXPECT_NEAR(half, both, 0.003 * both);
}

TEST(SingleTrack, UnitsAndPlaceDoNotMatter) {
  SingleTrackInput in = input_of(FadingLoad{}, TrackSides::both);
  const SingleTrack track = single_track(in, kCoarse);
  const FadingLoad real{.line = {0.3}, .scale = 0.006, .stress = 1e9, .centre = {0.1, -0.02, 0}};
  in.stress = [real](const std::vector<Vec3>& points, bool) { return real.stresses(points); };
  in.shear_strength = [](double, bool) { return 3e8; };
  in.half_length = in.half_width = 0.006;
  in.centre_x = 0.1;
  in.centre_y = -0.02;
  in.ends = [](double y) {
    const double t = std::min(1., std::abs(y + 0.02) / 0.006), e = 0.006 * std::sqrt(1 - t * t);
    return std::array<double, 2>{0.1 - e, 0.1 + e};
  };
  const SingleTrack in_metres = single_track(in, kCoarse);
  EXPECT_NEAR(in_metres.factor, 0.3 * track.factor, 0.003 * track.factor);
  EXPECT_NEAR(in_metres.depth, 0.006 * track.depth, 0.006 * 0.1);
}

TEST(SingleTrack, HasTheSameBitsForAnyNumberOfThreads) {
  const SingleTrackInput in = input_of(FadingLoad{}, TrackSides::symmetric);
  const int threads = max_threads();
  set_threads(1);
  const double one = single_track(in, kCoarse).factor;
  set_threads(3);
  const double three = single_track(in, kCoarse).factor;
  set_threads(threads);
  EXPECT_EQ(one, three);
}

TEST(SingleTrack, RejectsWhatItCannotUse) {
  const SingleTrackInput good = input_of(LineLoad{}, TrackSides::endless);
  SingleTrackInput in = good;
  in.half_width = 0;
  EXPECT_THROW(single_track(in), std::invalid_argument);
  in = good;
  in.interfaces = {0.5, 0.2};
  EXPECT_THROW(single_track(in), std::invalid_argument);
  in = good;
  in.shear_strength = [](double, bool) { return std::numeric_limits<double>::infinity(); };
  EXPECT_THROW(single_track(in), std::invalid_argument);
  in.shear_strength = [](double, bool) { return -1.; };
  EXPECT_THROW(single_track(in), std::invalid_argument);
  in = good;
  in.stress = [](const std::vector<Vec3>& points, bool) {
    return std::vector<Sym3>(points.size(), {.xx = std::numeric_limits<double>::quiet_NaN()});
  };
  EXPECT_THROW(single_track(in), NumericalError);
}

// Circular patch, nu 0.3. Without friction the classical limit 4.68 [PonterHearleJohnson1985] is reached; with full
// slip at 0.2 independent bounds are 4.27 and 4.40, and traffic that wanders bears 3.68.
TEST(LongSingleTrack, CircularContactLiesBetweenItsBounds) {
  for (const double friction : {0., 0.2}) {
    const HertzLoad load{.friction = friction};
    const Shakedown bounds = [&] {
      const StressHistory h = history_of(load, rolling_samples(0.05), steps(0, 1, 0.1), steps(0, 0.6, 0.04));
      return shakedown({h, std::vector<double>(h.depth.size(), 1.), {}, {}});
    }();
    const SingleTrack track = single_track(input_of(load, TrackSides::symmetric));
    EXPECT_LE(bounds.wandering.value, track.factor);
    EXPECT_LE(track.factor, bounds.upper.value);
    if (friction == 0) {
      EXPECT_NEAR(track.factor, 4.675, 0.002 * 4.675);
      EXPECT_NEAR(track.depth, 0.35, 0.02);
      EXPECT_EQ(track.y, 0);
    } else {
      EXPECT_GT(track.factor, 4.27);
      EXPECT_LT(track.factor, 4.40);
    }
  }
}

}  // namespace
}  // namespace railstrata
