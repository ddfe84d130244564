#include "single_track/history_stress.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "damage/shakedown.hpp"
#include "tests/damage/hertz_stress.hpp"

namespace railstrata {
namespace {

using testing::history_of;
using testing::LineLoad;
using testing::rolling_samples;
using testing::steps;

/// Cubic in each direction.
struct CubicStress {
  static Sym3 at(double x, double y, double z) {
    return {.xx = 1 + x * x * x - 2 * y * y + z,
            .yy = x * y * z,
            .zz = z * z * z,
            .xy = y * y * y * x,
            .yz = -2 + x,
            .xz = x * x * z * z * y};
  }
  std::vector<Sym3> stresses(const std::vector<Vec3>& points) const {
    std::vector<Sym3> out;
    for (const Vec3& p : points) out.push_back(at(p.x, p.y, p.z));
    return out;
  }
};

TEST(HistoryStress, IsExactForCubics) {
  const StressHistory h =
      history_of(CubicStress{}, {-2, -1, -0.2, 0.1, 1, 1.5, 2}, {-1, -0.3, 0, 0.8, 1}, {0, 0.1, 0.4, 0.5, 1});
  const HistoryStress stress(h, 0, 0);
  for (const Vec3 p : {Vec3{0.05, 0.4, 0.2}, Vec3{-1.9, -0.9, 0}, Vec3{2, 1, 1}, Vec3{0.1, -0.3, 0.45}}) {
    const Sym3 s = stress.at(p, false), truth = CubicStress::at(p.x, p.y, p.z);
    EXPECT_NEAR(s.xx, truth.xx, 1e-12);
    EXPECT_NEAR(s.yy, truth.yy, 1e-12);
    EXPECT_NEAR(s.zz, truth.zz, 1e-12);
    EXPECT_NEAR(s.xy, truth.xy, 1e-12);
    EXPECT_NEAR(s.yz, truth.yz, 1e-12);
    EXPECT_NEAR(s.xz, truth.xz, 1e-12);
  }
}

// Boussinesq: s_zz = -3 z^3/(2 pi r^5) for a unit force.
TEST(HistoryStress, FallsOutsideAsBelowAPointForce) {
  struct Force {
    static double zz(double x, double y, double z) {
      return -3 * z * z * z / (2 * M_PI * std::pow(std::hypot(x, y, z), 5));
    }
    std::vector<Sym3> stresses(const std::vector<Vec3>& points) const {
      std::vector<Sym3> out;
      for (const Vec3& p : points) out.push_back({.zz = p.z == 0 ? 0 : zz(p.x - 0.3, p.y + 0.2, p.z)});
      return out;
    }
  };
  const StressHistory h = history_of(Force{}, steps(-2, 2, 0.1), steps(-2, 2, 0.1), steps(0, 2, 0.1));
  const HistoryStress stress(h, 0.3, -0.2);
  for (const Vec3 p : {Vec3{5, 1, 3}, Vec3{-4, -3, 1}, Vec3{0.3, -0.2, 7}, Vec3{1, 6, 4}})
    EXPECT_NEAR(stress.at(p, false).zz, Force::zz(p.x - 0.3, p.y + 0.2, p.z),
                1e-3 * std::abs(Force::zz(p.x - 0.3, p.y + 0.2, p.z)));
}

TEST(HistoryStress, JumpsAtAnInterface) {
  StressHistory h{.x = {0}, .y = {0}, .depth = {0, 0.5, 0.5, 1}, .zone = {1, 1, 0, 0}, .stress = std::vector<Sym3>(4)};
  for (std::size_t row = 0; row < 4; ++row) h.stress[row].xx = std::array<double, 4>{1, 2, 10, 20}[row];
  const HistoryStress stress(h, 0, 0);
  EXPECT_EQ(stress.interfaces(), std::vector<double>{0.5});
  EXPECT_NEAR(stress.at({0, 0, 0.5}, false).xx, 2, 1e-15);
  EXPECT_NEAR(stress.at({0, 0, 0.5}, true).xx, 10, 1e-15);
  EXPECT_NEAR(stress.at({0, 0, 0.25}, false).xx, 1.5, 1e-15);
  EXPECT_NEAR(stress.at({0, 0, 0.75}, true).xx, 15, 1e-14);
  EXPECT_NEAR(stress.of_rows({4, 6, 1, 2}, 0.25, false), 5, 1e-15);
  EXPECT_NEAR(stress.of_rows({4, 6, 1, 2}, 0.5, false), 6, 1e-15);
  EXPECT_NEAR(stress.of_rows({4, 6, 1, 2}, 0.5, true), 1, 1e-15);
  EXPECT_NEAR(stress.of_rows({4, 6, 1, 2}, 3, false), 2, 1e-15);
}

TEST(HistoryStress, ASingleTrackOnAHistoryHasTheLimitOfTheLine) {
  const StressHistory h = history_of(LineLoad{0.2}, rolling_samples(0.05), {0}, steps(0, 3, 0.05));
  SingleTrackInput in = single_track_input(h, std::vector<double>(h.depth.size(), 2.), 1, 1);
  in.sides = TrackSides::endless;
  EXPECT_NEAR(single_track(in).factor, 2 * 3.202, 0.005 * 2 * 3.202);
}

// In metres (depth over half-length times half-length is not the depth to the last bit): a soft layer on a hard body.
TEST(HistoryStress, ASingleTrackKeepsTheSidesOfAnInterface) {
  const double depth = 0.0018, a = 0.00515;
  ASSERT_GT(depth / a * a, depth);
  std::vector<double> z = steps(0, depth, depth / 20), k(21, 0.5e9);
  z.back() = depth;
  for (const double below : steps(depth, 0.02, 0.0182 / 60)) {
    z.push_back(z.size() == 21 ? depth : below);
    k.push_back(2e9);
  }
  StressHistory h = history_of(LineLoad{}, rolling_samples(0.05), {0}, z);
  for (int row = 0; row < h.rows(); ++row)
    for (int i = 0; i < h.samples(); ++i) h.cycle(row, 0)[i] = 1e9 * LineLoad{}.at(h.x[i], 0, z[row] / a);
  for (double& x : h.x) x *= a;
  SingleTrackInput in = single_track_input(h, k, a, a);
  in.sides = TrackSides::endless;
  const double limit = shakedown({h, k, {}, {}}).wandering.value;
  EXPECT_NEAR(single_track(in).factor, limit, 0.005 * limit);
}

TEST(HistoryStress, RejectsWhatItCannotUse) {
  const StressHistory h = history_of(CubicStress{}, {-1, 1}, {-1, 1}, {0.1, 1}),
                      good = history_of(CubicStress{}, {-1, 1}, {-1, 1}, {0, 1});
  EXPECT_THROW(HistoryStress(h, 0, 0), std::invalid_argument);
  EXPECT_THROW(HistoryStress(StressHistory{}, 0, 0), std::invalid_argument);
  EXPECT_THROW(HistoryStress(good, 2, 0), std::invalid_argument);
  EXPECT_THROW(single_track_input(good, {1}, 1, 1), std::invalid_argument);
}

}  // namespace
}  // namespace railstrata
