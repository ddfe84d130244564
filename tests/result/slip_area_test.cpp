// The slip area of a rolling contact from what the law said of the nodes that passed through it, and from their shear.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "result/rolling_mean.hpp"
#include "tests/fem/small_rolling.hpp"

namespace railstrata {
namespace {

constexpr double kA = 6.5e-3, kB = 5.0e-3, kSpeed = 25, kPeak = 1e9, kFriction = 0.4;

/// Strips of Carter's line contact over Hertz's ellipse: each slips over the same length 2 d behind its stick, or all
/// of it where it is shorter. [Kalker1990]
struct Strips {
  double d = 0;
  static double half(double y) { return kA * std::sqrt(std::max(0.0, 1 - y * y / (kB * kB))); }
  double front(double y) const { return std::min(2 * d - half(y), half(y)); }
  /// Carter's: f p, less in stick a Hertzian part. [Johnson1985 sec. 8.3]
  double shear(double x, double y) const {
    const double p2 = 1 - x * x / (kA * kA) - y * y / (kB * kB), middle = 0.5 * (half(y) + front(y)),
                 stick = 0.5 * (half(y) - front(y)), s2 = stick * stick - (x - middle) * (x - middle);
    return p2 > 0 ? -kFriction * kPeak * (std::sqrt(p2) - std::sqrt(std::max(0.0, s2)) / kA) : 0.0;
  }
  double slip_share() const {
    constexpr int kSteps = 20000;
    double area = 0;
    for (int k = 0; k < kSteps; ++k) area += 2 * std::min(d, half(kB * (2 * (k + 0.5) / kSteps - 1)));
    return area * 2 * kB / kSteps / (std::numbers::pi * kA * kB);
  }
};

/// Samples at consecutive stations, the axle `offset` beyond each.
PositionSamples passing(const RollingSystem& system, const Strips& strips, double offset) {
  const ContactSurface& rail = system.rail_surface();
  const int reach = static_cast<int>(std::ceil(10e-3 / system.model.spec.mesh.element_size)),
            middle = static_cast<int>(rail.stations.at.size()) / 2;
  PositionSamples out;
  for (int k = -2; k <= 2; ++k) {
    RollingSample s;
    s.position = rail.stations.at[middle + k] + offset;
    s.time = s.position / kSpeed;
    s.first_station = middle + k - reach;
    s.rail.stations = 2 * reach;
    for (int j = 0; j <= 2 * reach; ++j) {
      const double x = rail.stations.at[s.first_station + j] - s.position;
      s.rail.along.push_back(x);
      for (int c = 0; c < rail.columns; ++c) {
        const double y = rail.node[c].y, half = Strips::half(y), front = strips.front(y),
                     p2 = 1 - x * x / (kA * kA) - y * y / (kB * kB);
        s.tractions.push_back({.p = p2 > 0 ? kPeak * std::sqrt(p2) : 0,
                               .q1 = strips.shear(x, y),
                               .contact_time = std::clamp(half - x, 0.0, 2 * half) / kSpeed,
                               .slip_time = std::clamp(front - x, 0.0, front + half) / kSpeed});
      }
    }
    out.samples.push_back(s);
  }
  return out;
}

}  // namespace

TEST(SlipArea, OfAPassingPatchIsThatOfTheStripTheoryBelowTheElementSize) {
  CaseSpec spec = fem_checks::small_case();
  spec.mesh.element_size = 1.25e-3;
  spec.mesh.fine_width = 15e-3;
  spec.mesh.fine_depth = 2.5e-3;
  const RollingSystem system = fem_checks::small_system(spec);
  for (const double d : {0.8e-3, 2e-3, 4.4e-3})
    for (const double offset : {0.0, 0.4e-3, 0.9e-3}) {
      const Strips strips{d};
      const MeanContact mean = mean_contact(system, passing(system, strips, offset));
      EXPECT_NEAR(mean.patch.slip_area_fraction, strips.slip_share(), 0.02) << d << ' ' << offset;
    }
}

// A point in the middle of slip slips, one in the middle of stick sticks, whatever its last step was.
TEST(SlipArea, StatesAreThoseOfMostOfTheWayAroundAPoint) {
  const CaseSpec spec = fem_checks::small_case();
  const RollingSystem system = fem_checks::small_system(spec);
  PositionSamples samples = passing(system, Strips{3e-3}, 0);
  for (NodeTraction& t : samples.samples[2].tractions) t.stuck = 0;
  const ContactField field = mean_contact(system, samples).field;
  for (int i = 0; i < field.size(); ++i) {
    if (field.p[i] <= 0 || std::abs(field.y[i]) > 0.5e-3) continue;
    EXPECT_EQ(field.state[i], field.x[i] < -0.5e-3 ? ContactState::slip : ContactState::stick) << field.x[i];
  }
}

}  // namespace railstrata
