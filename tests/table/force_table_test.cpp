#include "table/force_table.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/faults.hpp"

namespace railstrata {
namespace {

ForceTable filled(double (*f)(double, double, double)) {
  ForceTable t;
  t.axes = {{"a", "", {-1, 0, 2}}, {"b", "N", {1, 3}}, {"c", "", {0, 0.1, 0.4, 1}}};
  t.numbers = {{"f", "N", {}}, {"g", "", {}}};
  for (const double a : t.axes[0].at)
    for (const double b : t.axes[1].at)
      for (const double c : t.axes[2].at) {
        t.numbers[0].values.push_back(f(a, b, c));
        t.numbers[1].values.push_back(a);
      }
  return t;
}

double multilinear(double a, double b, double c) { return 2 + a - 3 * b * c + 0.5 * a * b * c; }

}  // namespace

TEST(ForceTable, IsExactForWhatIsLinearAlongEveryAxis) {
  const ForceTable t = filled(multilinear);
  const TableInterpolation between(t);
  for (const double a : {-1.0, -0.3, 0.0, 1.7, 2.0})
    for (const double b : {1.0, 1.4, 3.0})
      for (const double c : {0.0, 0.05, 0.3, 1.0}) {
        const double point[] = {a, b, c};
        double out[2];
        EXPECT_EQ(between.at(point, out), 0);
        EXPECT_NEAR(out[0], multilinear(a, b, c), 1e-13);
        EXPECT_NEAR(out[1], a, 1e-14);
      }
}

TEST(ForceTable, TakesWhatLiesBeyondAtTheEndAndSaysSo) {
  const ForceTable t = filled(multilinear);
  const double point[] = {-5, 2, 7};
  double out[2];
  EXPECT_EQ(TableInterpolation(t).at(point, out), 2);
  EXPECT_NEAR(out[0], multilinear(-1, 2, 1), 1e-13);
}

TEST(ForceTable, HasNoAnswerBesideAPointWithoutOne) {
  ForceTable t = filled(multilinear);
  t.numbers[0].values.back() = NAN;  // at a = 2, b = 3, c = 1
  const TableInterpolation between(t);
  double out[2];
  const double beside[] = {1.9, 2, 0.9}, on_a_whole_plane[] = {0, 2, 0.9};
  between.at(beside, out);
  EXPECT_TRUE(std::isnan(out[0]));
  EXPECT_FALSE(std::isnan(out[1]));
  between.at(on_a_whole_plane, out);
  EXPECT_NEAR(out[0], multilinear(0, 2, 0.9), 1e-13);
}

TEST(ForceTable, RefusesAxesThatDoNotAscendAndValuesThatAreMissing) {
  ForceTable t = filled(multilinear);
  t.axes[1].at = {3, 1};
  EXPECT_THROW(check(t), CaseError);
  t.axes[1].at = {1, 1};
  EXPECT_THROW(check(t), CaseError);
  t = filled(multilinear);
  t.numbers[1].values.pop_back();
  EXPECT_THROW(check(t), CaseError);
  EXPECT_THROW(check(ForceTable{}), CaseError);
}

}  // namespace railstrata
