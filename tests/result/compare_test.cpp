#include "result/compare.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <stdexcept>

namespace railstrata {
namespace {

ContactField field_of(int columns, int stations, double half_width, const std::function<double(double, double)>& p) {
  ContactField f;
  f.resize(columns, stations);
  for (int s = 0; s < stations; ++s)
    for (int c = 0; c < columns; ++c) {
      const int k = c + columns * s;
      f.x[k] = half_width * (2.0 * s / (stations - 1) - 1);
      f.y[k] = half_width * (2.0 * c / (columns - 1) - 1);
      f.p[k] = p(f.x[k], f.y[k]);
      f.q_x[k] = -0.3 * f.p[k];
      f.q_y[k] = 0.4 * f.p[k];
    }
  return f;
}

TEST(CompareFields, ABilinearPressureIsTheSameOnAnyGrid) {
  const auto p = [](double x, double y) { return 5e8 + 2e10 * x - 1e10 * y + 3e12 * x * y; };
  const FieldComparison g = compare_fields(field_of(7, 9, 8e-3, p), field_of(31, 23, 8e-3, p));
  EXPECT_LT(g.p.largest, 1e-12);
  EXPECT_LT(g.q.largest, 1e-12);
}

TEST(CompareFields, APressureTwoPercentHigherDiffersByTwoPercentOfTheReference) {
  const auto a = field_of(21, 21, 8e-3, [](double, double) { return 1.02e9; }),
             b = field_of(11, 11, 8e-3, [](double, double) { return 1e9; });
  const FieldComparison g = compare_fields(a, b);
  EXPECT_NEAR(g.p.largest, 0.02, 1e-12);
  EXPECT_NEAR(g.p.rms, 0.02, 1e-12);
  EXPECT_NEAR(g.q.rms, 0.02, 1e-12) << "|q| = 0.5 p in both";
  EXPECT_NEAR(compare_fields(b, a).p.rms, 0.02 / 1.02, 1e-12) << "relative to the second field";
}

TEST(CompareFields, TheLargestDifferenceIsFoundWhereOneFieldHasASpike) {
  const auto flat = [](double, double) { return 1e9; };
  ContactField a = field_of(17, 17, 8e-3, flat);
  a.p[12 + 17 * 3] = 1.5e9;  // x = -5 mm, y = 4 mm
  const FieldComparison g = compare_fields(a, field_of(17, 17, 8e-3, flat));
  EXPECT_NEAR(g.p.x, -5e-3, 1e-9);
  EXPECT_NEAR(g.p.y, 4e-3, 1e-9);
  EXPECT_NEAR(g.p.largest, 0.5, 1e-9);
}

// Two Hertzian pressures on circles of 5 mm, 1 mm apart, against their closed form on the line between the centres.
TEST(CompareFields, AShiftOfTheWheelShowsAsTheShiftOfItsPressure) {
  const auto hertz = [](double at) {
    return
        [at](double x, double y) { return 1e9 * std::sqrt(std::max(0.0, 1 - (std::pow(x - at, 2) + y * y) / 25e-6)); };
  };
  const double d = 1e-3;
  const FieldComparison g = compare_fields(field_of(161, 161, 8e-3, hertz(d)), field_of(161, 161, 8e-3, hertz(0)));
  std::size_t i = 0;
  while (g.x[i] < 0) ++i;
  const std::size_t k = i * g.y.size() + g.y.size() / 2;
  EXPECT_NEAR((g.p_a[k] - g.p_b[k]) / 1e9,
              std::sqrt(1 - std::pow((g.x[i] - d) / 5e-3, 2)) - std::sqrt(1 - std::pow(g.x[i] / 5e-3, 2)), 1e-3);
  EXPECT_NEAR(g.x.front(), -5e-3, 0.15e-3);
  EXPECT_NEAR(g.x.back(), 6e-3, 0.15e-3) << "the grid covers both patches";
}

TEST(CompareFields, FieldsThatCannotBeComparedAreRefused) {
  const auto flat = [](double, double) { return 1e9; };
  const ContactField a = field_of(5, 5, 8e-3, flat), none = field_of(5, 5, 8e-3, [](double, double) { return 0.0; });
  EXPECT_THROW(compare_fields(none, none), std::invalid_argument);
  ContactField backwards = a;
  for (double& x : backwards.x) x = -x;
  EXPECT_THROW(compare_fields(a, backwards), std::invalid_argument);
  const FieldComparison g = compare_fields(a, none);
  EXPECT_TRUE(std::isnan(g.p.rms)) << "nothing to be relative to";
}

}  // namespace
}  // namespace railstrata
