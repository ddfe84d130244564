// Carter's line contact: the surface's stress in closed form against points that stand anywhere.
#include "post/surface_peaks.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/damage/hertz_stress.hpp"

namespace railstrata {
namespace {

/// Half-length and largest pressure 1; sticks from the front to the leading edge, x = 1. [Johnson1985 sec. 8.3]
struct Carter {
  double friction = 0.3, front = -0.2;
  double half() const { return 0.5 * (1 - front); }  ///< of the stick zone
  double in_stick(double x) const { return (x - 0.5 * (1 + front)) / half(); }
  double p(double x) const { return std::sqrt(std::max(0.0, 1 - x * x)); }
  double q(double x) const {
    if (half() == 0) return friction * p(x);
    const double t = in_stick(x);
    return friction * (p(x) - half() * std::sqrt(std::max(0.0, 1 - t * t)));
  }
  Sym3 stress(double x) const {
    const auto line = [](double f, double at) { return testing::LineLoad{.friction = f}.at(at, 0, 0); };
    if (half() == 0) return line(friction, x);
    const double t = in_stick(x);
    return line(friction, x) + (-friction * half()) * (line(1, t) + (-1.0) * line(0, t));
  }
};

struct Points {
  double spacing, offset;
  int count() const { return static_cast<int>(std::ceil(2.4 / spacing)); }
  double x(int i) const { return -1.2 + offset + spacing * i; }
};

/// The two points ahead of the front miss the exact stress by `error`, as cells do.
SurfacePeaks peaks_of(const Carter& c, const Points& at, double error = 0) {
  const auto stress = [&](int i) {
    Sym3 s = c.stress(at.x(i));
    if (at.x(i) > c.front && at.x(i - 2) < c.front) s.xx += error;
    return s;
  };
  SurfaceRow row{{}, {}, {}, stress, 0.3};
  for (int i = 0; i < at.count(); ++i) {
    const double x = at.x(i), p = c.p(x);
    row.p.push_back(p);
    row.q.push_back(c.q(x));
    row.state.push_back(p <= 0 ? ContactState::separated : x < c.front ? ContactState::slip : ContactState::stick);
  }
  return surface_peaks(row);
}

}  // namespace

TEST(SurfacePeaks, AtTheFrontOfSlipAreThoseOfTheClosedForm) {
  for (const double front : {-0.6, -0.2, 0.3}) {
    const Carter c{.front = front};
    const Sym3 exact = c.stress(front + 1e-9);
    for (const double spacing : {0.2, 0.1, 0.05})
      for (const double offset : {0.0, 0.3, 0.7}) {
        const Points at{spacing, offset * spacing};
        const SurfacePeaks found = peaks_of(c, at);
        ASSERT_EQ(found.fronts.size(), 1u);
        const Sym3& s = found.fronts[0].stress;
        EXPECT_GT(at.x(found.fronts[0].at), front);
        EXPECT_NEAR(std::abs(s.xz), std::abs(exact.xz), 0.015) << spacing << ' ' << offset;
        EXPECT_NEAR(s.zz, exact.zz, 0.05 * spacing / 0.2) << spacing << ' ' << offset;
        EXPECT_NEAR(s.xx, exact.xx, 0.05 * spacing / 0.2) << spacing << ' ' << offset;
      }
  }
}

TEST(SurfacePeaks, DoNotTakeTheStickingStrainNextToTheCusp) {
  const Carter c;
  for (const double offset : {0.0, 0.3, 0.7}) {
    const Points at{0.1, 0.1 * offset};
    EXPECT_EQ(peaks_of(c, at, 0.1).fronts.at(0).stress.xx, peaks_of(c, at).fronts.at(0).stress.xx);
  }
}

// sigma_xx is 2 f p0 and -2 f p0 at the edges of a patch in full slip; points miss the root behind them.
TEST(SurfacePeaks, AtTheEdgesAreThoseOfTheClosedForm) {
  const Carter c{.front = 1};
  for (const double spacing : {0.2, 0.1, 0.05})
    for (const double offset : {0.0, 0.3, 0.7}) {
      const SurfacePeaks found = peaks_of(c, {spacing, offset * spacing});
      ASSERT_TRUE(found.any());
      EXPECT_TRUE(found.fronts.empty());
      EXPECT_NEAR(found.behind.xx, 2 * c.friction, 0.5 * spacing * spacing) << spacing << ' ' << offset;
      EXPECT_NEAR(found.ahead.xx, -2 * c.friction, 0.5 * spacing * spacing) << spacing << ' ' << offset;
      EXPECT_EQ(found.behind.zz, 0);
    }
}

TEST(SurfacePeaks, OfAPatchOfThreePointsAreNotLookedFor) { EXPECT_FALSE(peaks_of(Carter{}, {0.7, 0}).any()); }

}  // namespace railstrata
