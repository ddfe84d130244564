// Carter's line contact: the surface's stress in closed form against points that stand anywhere.
#include "result/surface_peaks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

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

double mean(const std::function<double(double)>& f, double middle, double width) {
  constexpr int kParts = 400;
  double sum = 0;
  for (int k = 0; k < kParts; ++k) sum += f(middle + ((k + 0.5) / kParts - 0.5) * width);
  return sum / kParts;
}

/// Cells as half-spaces have them: tractions are means, stresses those of them; a cell slips where its middle does.
SurfacePeaks peaks_of_cells(const Carter& c, const Points& at) {
  std::vector<double> excess;  // of the pressure in the middle over the mean
  const auto stress = [&](int i) {
    Sym3 s = c.stress(at.x(i));
    s.xx += excess[i];
    s.yy += 0.6 * excess[i];
    return s;
  };
  SurfaceRow row{{}, {}, {}, stress, 0.3, true};
  for (int i = 0; i < at.count(); ++i) {
    const double x = at.x(i), p = mean([&](double u) { return c.p(u); }, x, at.spacing);
    const bool touches = std::abs(x) < 1, slips = touches && x < c.front;
    excess.push_back(touches ? c.p(x) - p : 0);
    row.p.push_back(touches ? p : 0);
    row.q.push_back(slips ? c.friction * p : mean([&](double u) { return c.q(u); }, x, at.spacing));
    row.state.push_back(slips ? ContactState::slip : touches ? ContactState::stick : ContactState::separated);
  }
  return surface_peaks(row);
}

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

TEST(SurfacePeaks, OfCellsAtTheFrontOfSlipAreThoseOfTheClosedForm) {
  for (const double front : {-0.6, -0.2, 0.3}) {
    const Carter c{.front = front};
    const Sym3 exact = c.stress(front + 1e-9);
    for (const double spacing : {0.1, 0.05, 0.025})
      for (const double offset : {0.0, 0.2, 0.4, 0.6, 0.8}) {
        const SurfacePeaks found = peaks_of_cells(c, {spacing, offset * spacing});
        ASSERT_EQ(found.fronts.size(), 1u);
        const Sym3& s = found.fronts[0].stress;
        EXPECT_NEAR(std::abs(s.xz) / std::abs(exact.xz), 1, 2.5 * spacing * spacing) << spacing << ' ' << offset;
        EXPECT_NEAR(s.zz / exact.zz, 1, 2.5 * spacing * spacing) << spacing << ' ' << offset;
        EXPECT_NEAR(s.xx / exact.xx, 1, 2.5 * spacing * spacing) << spacing << ' ' << offset;
      }
  }
}

// Behind a sticking zone the smooth part bends; the outermost cell may be in contact in part.
TEST(SurfacePeaks, OfCellsAtTheEdgesAreThoseOfTheClosedForm) {
  for (const double front : {-0.3, 0.2, 1.0}) {
    const Carter c{.front = front};
    const double exact = c.stress(-1 + 1e-12).xx;
    for (const double spacing : {0.1, 0.05, 0.025})
      for (const double offset : {0.0, 0.2, 0.4, 0.6, 0.8}) {
        const SurfacePeaks found = peaks_of_cells(c, {spacing, offset * spacing});
        EXPECT_NEAR(found.behind.xx / exact, 1, 2 * spacing * spacing) << front << ' ' << spacing << ' ' << offset;
      }
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
