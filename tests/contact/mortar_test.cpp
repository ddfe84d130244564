#include "contact/mortar.hpp"

#include <gtest/gtest.h>

#include <map>
#include <numbers>

#include "sample_surfaces.hpp"

namespace railstrata {
namespace {

using namespace contact_checks;

const MortarRows& settled_rows(MortarContact& contact, const Field& u_rail, const Field& u_wheel,
                               const AxlePose& pose) {
  contact.search(u_rail, u_wheel, pose, 20e-3, 1e-3);
  for (int pass = 0; pass < 4; ++pass) contact.rows(u_rail, u_wheel, pose);  // the tangential corrections settle
  return contact.rows(u_rail, u_wheel, pose);
}

// (1/h) int psi_A gap dx for a rail node at x: dual shape function 2 - 3 |t| on both sides, composite Simpson.
template <class Gap>
double weighted(double x, double h, Gap&& gap) {
  constexpr int kIntervals = 64;
  double sum = 0;
  for (int side : {-1, 1})
    for (int i = 0; i <= kIntervals; ++i) {
      const double t = static_cast<double>(i) / kIntervals, simpson = (i == 0 || i == kIntervals ? 1
                                                                       : i % 2                   ? 4
                                                                                                 : 2) /
                                                                      (3.0 * kIntervals);
      sum += 0.5 * simpson * (2 - 3 * t) * gap(x + side * h * t);
    }
  return 2 * sum;  // a_A = h
}

}  // namespace

TEST(Mortar, WeightedGapOfACylinderOverAFlatRailIsTheIntegralOfTheExactGapAtEveryAngleOfTheWheel) {
  const Surfaces s;
  for (double psi : {0.0, 0.0013, -0.02, 3.0})
    for (double x : {0.0, 0.37e-3}) {
      MortarContact contact(s.rail, s.wheel);
      const AxlePose pose{x, 0, -5e-6, psi};
      const MortarRows& rows = settled_rows(contact, s.rail_field(), s.rolled(pose), pose);
      ASSERT_GT(rows.rows.size(), 50u);
      for (const ContactRow& row : rows.rows) {
        const double exact = weighted(s.rail.stations.at[row.station], s.h, [&](double at) {
          return s.radius - std::sqrt(s.radius * s.radius - (at - x) * (at - x)) - 5e-6;
        });
        ASSERT_NEAR(row.gap, exact, 2e-12) << "psi " << psi << " station " << row.station;
        ASSERT_NEAR(row.area, s.h * s.width, 1e-15);
      }
    }
}

// Many turns on, and with the place where the ring closes in the middle of the patch.
TEST(Mortar, RowsAreTheSameWhereTheWheelsRingCloses) {
  Surfaces s(1.37, 0.05);
  const int ring = s.close_ring();
  const auto rows_at = [&](int station) {
    MortarContact contact(s.rail, s.wheel);
    const AxlePose pose{0, 0, -0.5e-6, 2 * std::numbers::pi * station / ring};
    return settled_rows(contact, s.rail_field(), s.rolled(pose), pose);
  };
  const MortarRows away = rows_at(ring / 3);
  for (int station : {-1, 0, 1, ring, 5 * ring}) {
    const MortarRows closing = rows_at(station);
    ASSERT_EQ(closing.rows.size(), away.rows.size());
    ASSERT_EQ(closing.weights.size(), away.weights.size());
    for (std::size_t r = 0; r < away.rows.size(); ++r) ASSERT_NEAR(closing.rows[r].gap, away.rows[r].gap, 1e-13);
    for (std::size_t k = 0; k < away.weights.size(); ++k) {
      const std::ptrdiff_t column = 3 * s.wheel.stride,
                           ahead = away.weights[k].wheel % column - closing.weights[k].wheel % column;
      ASSERT_EQ(closing.weights[k].wheel / column, away.weights[k].wheel / column);
      ASSERT_EQ((ahead - ring / 3 + station + 6 * ring) % ring, 0) << "station " << station;
      ASSERT_NEAR(closing.weights[k].m, away.weights[k].m, 1e-9);
    }
  }
}

// Two cylinders, one below the other, however far both have turned: the gap of a row is the closed form of its facets'
// mean, normals are the ring's radii, and areas its arcs.
TEST(Mortar, ARingBelowTheWheelHasTheGapsOfTwoCircles) {
  const double radius = 0.07;
  Surfaces s;
  s.bend_rail(radius);
  for (const double psi : {0.0, -0.013}) {
    MortarContact contact(s.rail, s.wheel);
    const AxlePose pose{0, 0, 1e-6, 0.021, psi};
    int compared = 0;
    for (const ContactRow& row : settled_rows(contact, s.turned_rail(psi), s.rolled(pose), pose).rows) {
      const double angle = std::numbers::pi + psi - s.rail.stations.at[row.station], x = radius * std::sin(angle);
      if (std::abs(x) > 4e-3) continue;
      const double sum = 1 / radius + 1 / s.radius;
      EXPECT_NEAR(row.normal.x, std::sin(angle), 1e-12);
      EXPECT_NEAR(row.normal.z, std::cos(angle), 1e-12);
      EXPECT_NEAR(row.area, s.h * s.width, 1e-9 * s.h * s.width);
      EXPECT_NEAR(row.gap, 1e-6 + 0.5 * sum * (x * x - s.h * s.h / 6), 0.01 * 0.5 * sum * (x * x + s.h * s.h));
      ++compared;
    }
    EXPECT_GT(compared, 50);
  }
}

// For a parabola x^2 / 2R the integral is (x^2 - h^2 / 6) / 2R.
TEST(Mortar, WeightedGapOfAParabolaFollowsTheClosedForm) {
  const Surfaces s;
  MortarContact contact(s.rail, s.wheel);
  for (const ContactRow& row : settled_rows(contact, s.rail_field(), s.wheel_field(), {}).rows) {
    const double x = s.rail.stations.at[row.station],
                 quartic = std::pow(std::abs(x) + s.h, 4) / (8 * std::pow(s.radius, 3));
    ASSERT_NEAR(row.gap, (x * x - s.h * s.h / 6) / (2 * s.radius), 2 * quartic + 1e-13);
  }
}

TEST(Mortar, GapFollowsALinearDisplacementOfTheRailExactly) {
  const Surfaces s;
  MortarContact before(s.rail, s.wheel), after(s.rail, s.wheel);
  auto rise = [](Vec3 x) { return Vec3{0, 0, -3e-6 + 2e-5 * x.x + 1e-5 * x.y}; };
  const MortarRows still = settled_rows(before, s.rail_field(), s.wheel_field(), {});
  const MortarRows& moved = settled_rows(after, s.rail_field(rise), s.wheel_field(), {});
  std::map<std::pair<int, int>, double> gap;
  for (const ContactRow& row : still.rows) gap[{row.column, row.station}] = row.gap;
  int compared = 0;
  for (const ContactRow& row : moved.rows)
    if (const auto known = gap.find({row.column, row.station}); known != gap.end()) {
      const Vec3 x{s.rail.stations.at[row.station], s.rail.node[row.column].y, 0};
      ASSERT_NEAR(row.gap, known->second - rise(x).z, 1e-10);  // the nearest point moves by the slope times the gap
      ++compared;
    }
  EXPECT_GT(compared, 50);
}

TEST(Mortar, WeightsOfARowSumToOneAndReproduceLinearFieldsOnNonMatchingMeshes) {
  for (double ratio : {0.6, 1.0, 1.37, 2.3}) {
    const Surfaces s(ratio);
    MortarContact contact(s.rail, s.wheel);
    const AxlePose pose{0.2e-3, 0, 0, 0.0004};
    for (const MortarRows& rows = settled_rows(contact, s.rail_field(), s.rolled(pose), pose);
         const ContactRow& row : rows.rows) {
      double one = 0, y = 0;
      for (int k = row.first; k < row.first + row.count; ++k) {
        const WheelWeight& w = rows.weights[k];
        one += w.m;
        y += w.m * s.wheel.node[(w.wheel - s.wheel.first_line) / (3 * s.wheel.stride)].y;
      }
      ASSERT_NEAR(one, 1.0, 1e-13);
      ASSERT_NEAR(y, s.rail.node[row.column].y, 1e-12);
    }
  }
}

// Contact patch test [TaylorPapadopoulos1991] for the forces: a uniform pressure on the rail's nodes arrives on the
// wheel's with its resultant and moments, and each node gets the pressure times its own area but for the quadrature of
// kinks inside a facet.
TEST(Mortar, UniformPressurePassesThroughNonMatchingMeshes) {
  struct Case {
    double ratio, scatter;  // wheel's mesh over the rail's; largest deviation of a nodal force in the middle
  };
  for (const Case& c : {Case{1.0, 1e-6}, Case{2.0, 1e-6}, Case{1.37, 0.04}, Case{2.3, 0.011}, Case{0.77, 0.17}}) {
    const Surfaces s(c.ratio, 1e4);  // nearly flat
    MortarContact contact(s.rail, s.wheel);
    contact.search(s.rail_field(), s.wheel_field(), {}, 8.2e-3, 1e-3);
    const MortarRows& rows = contact.rows(s.rail_field(), s.wheel_field(), {});
    std::map<std::ptrdiff_t, double> force;
    double area = 0, moment_x = 0, moment_y = 0, wheel_x = 0, wheel_y = 0, total = 0;
    for (const ContactRow& row : rows.rows) {
      area += row.area;
      moment_x += row.area * s.rail.stations.at[row.station];
      moment_y += row.area * s.rail.node[row.column].y;
      for (int k = row.first; k < row.first + row.count; ++k)
        force[rows.weights[k].wheel] += row.area * rows.weights[k].m;
    }
    double worst = 0;
    for (const auto& [index, f] : force) {
      const std::ptrdiff_t k = index - s.wheel.first_line;
      const double x = s.radius * std::sin(s.wheel.stations.at[k % (3 * s.wheel.stride)]),
                   y = s.wheel.node[k / (3 * s.wheel.stride)].y;
      total += f;
      wheel_x += f * x;
      wheel_y += f * y;
      if (std::abs(x) < 4e-3 && std::abs(y) < 2.5e-3)
        worst = std::max(worst, std::abs(f / (s.wheel_h * s.wheel_width) - 1));
    }
    EXPECT_NEAR(total / area, 1.0, 1e-12);
    EXPECT_NEAR(wheel_x, moment_x, 1e-9 * area);
    EXPECT_NEAR(wheel_y, moment_y, 1e-12 * area);
    EXPECT_LT(worst, c.scatter) << c.ratio;
    RecordProperty("ratio_" + std::to_string(c.ratio), std::to_string(worst));
  }
}

TEST(Mortar, SearchChoosesTheNodesWhoseGapIsBelowTheLimit) {
  const Surfaces s;
  MortarContact contact(s.rail, s.wheel);
  const double limit = 20e-6, half = std::sqrt(2 * s.radius * limit);
  contact.search(s.rail_field(), s.wheel_field(), {}, 20e-3, limit);
  const MortarRows& rows = contact.rows(s.rail_field(), s.wheel_field(), {});
  int expected = 0;
  for (double x : s.rail.stations.at) expected += std::abs(x) < half;
  EXPECT_EQ(static_cast<int>(rows.rows.size()), expected * (s.rail.columns - 2));
  for (const ContactRow& row : rows.rows) EXPECT_LT(std::abs(s.rail.stations.at[row.station]), half);
}

TEST(Mortar, ContactAtTheBorderOfTheFineZoneIsReported) {
  const Surfaces s;
  MortarContact contact(s.rail, s.wheel);
  for (const AxlePose& pose :
       {AxlePose{0, 0, 1e-6, 0}, AxlePose{0, 0, -1e-6, 0}}) {  // a cylinder that touches does so across the whole width
    contact.search(s.rail_field(), s.rolled(pose), pose, 20e-3, 20e-6);
    EXPECT_EQ(contact.rows(s.rail_field(), s.rolled(pose), pose).reached_edge, pose.z < 0);
  }
}

}  // namespace railstrata
