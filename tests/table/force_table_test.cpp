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

namespace {

constexpr double kPlaces[][4] = {{1e-3, -2e-3, 0.1, 70e3}, {-4e-3, 5e-4, 0, 55e3}, {3e-3, 6e-3, -0.3, 98e3}};

/// Similar at any load: |F| = f N tanh(rho)/sqrt(1 + psi²) against the creepage, whatever its direction, and a patch
/// area as N^(2/3).
double size_of_similar(double load, double rho, double psi) { return 0.3 * load * std::tanh(rho) / std::hypot(1, psi); }

ForceTable similar(int angles = 12) {
  ForceTable t{scaled_axes(angles, 17, 13),
               {{"patch_area", "m2", {}}, {"lateral_force", "N", {}}, {"force_x", "N", {}}}};
  t.axes.push_back({"load", "N", {50e3, 1e5}});
  t.scaling = {{{{"creepage_x", "", {-0.01, 0.01}}, {"creepage_y", "", {-0.01, 0.01}}, {"spin", "1/m", {-1, 1}}}},
               {{{"x", "", {4e3, 4e3}}, {"y", "", {5e3, 5e3}}, {"spin", "", {0.2, 0.2}}}},
               0.8,
               -0.7,
               0.7,
               0,
               0.3};
  for (std::size_t k = 0; k < t.points(); ++k) {
    const std::vector<double> place = grid_place(t, k);
    const ScaledPlace there{place[0], -0.7 + 1.4 * place[1], 0.8 * place[2]};
    const double psi = std::sinh(there.spin), r = creep_radius(there),
                 force = -size_of_similar(place[3], std::sqrt(r * r - psi * psi), psi);
    t.numbers[0].values.push_back(1e-7 * std::pow(place[3], 2.0 / 3));
    t.numbers[1].values.push_back(force * std::sin(place[0]));
    t.numbers[2].values.push_back(force * std::cos(place[0]));
  }
  return t;
}

}  // namespace

TEST(CreepScaling, UnitsAreThoseOfKalkerAndPlacesGoBothWays) {
  const CreepUnits units = creep_units({4e3, 5e3, 0.2}, 64e3, 0.3);
  EXPECT_DOUBLE_EQ(units.plane, std::sqrt(4e3 * 5e3) * std::pow(64e3, 2.0 / 3) / (3 * 0.3 * 64e3)) << "k / (3 f N)";
  EXPECT_DOUBLE_EQ(units.spin, 0.2 * 64e3 / (0.3 * 64e3)) << "k_s / (f N)";
  for (const auto& place : kPlaces) {
    const Creepages back = creepages_at(scaled_place({place[0], place[1], place[2]}, units), units);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(back[k], place[k], 1e-15);
  }
}

TEST(ScaledTable, HasItsPointsAtTheirPlaces) {
  const ForceTable t = similar();
  const TableInterpolation between(t);
  double out[3];
  for (std::size_t k = 0; k < t.points(); k += 7) {
    const std::vector<double> place = asked_place(t, k);
    if (between.at(place.data(), out) > 0) continue;  // beyond what may be asked for
    for (std::size_t n = 0; n < 3; ++n) EXPECT_NEAR(out[n], t.numbers[n].values[k], 1e-9 * 30e3) << "point " << k;
  }
}

TEST(ScaledTable, IsExactForAnyLoadWhereContactsAreSimilarAndForAnyDirectionOfTheForce) {
  const ForceTable t = similar(), fewer_angles = similar(5);
  for (const auto& place : kPlaces) {
    double out[3], fewer[3];
    EXPECT_EQ(TableInterpolation(t).at(place, out), 0);
    TableInterpolation(fewer_angles).at(place, fewer);
    const double rho = std::sqrt(4e3 * 5e3) / std::cbrt(place[3]) / 0.9 * std::hypot(place[0], place[1]);
    EXPECT_NEAR(out[0], 1e-7 * std::pow(place[3], 2.0 / 3), 1e-12);
    EXPECT_NEAR(out[1] * place[0], out[2] * place[1], 1e-13 * 30e3) << "against the creepage";
    EXPECT_NEAR(std::hypot(out[1], out[2]), size_of_similar(place[3], rho, 0.2 / 0.3 * place[2]), 1e-3 * 0.3 * place[3])
        << "cubics";
    EXPECT_NEAR(fewer[1], out[1], 1e-10 * 30e3);
    EXPECT_NEAR(fewer[2], out[2], 1e-10 * 30e3);
  }
}

// Three waves around are within what seven angles and more have.
TEST(ScaledTable, HasTheWavesOfTheAnglesOfCreepage) {
  for (const int angles : {7, 8}) {
    ForceTable t = similar(angles);
    const auto wave = [](double angle) { return 2 + std::sin(angle) - 0.3 * std::cos(3 * angle); };
    for (std::size_t k = 0; k < t.points(); ++k) t.numbers[0].values[k] = wave(grid_place(t, k)[0]);
    t.numbers[0].name = "slip";
    const TableInterpolation between(t);
    for (const auto& place : kPlaces) {
      double out[3];
      between.at(place, out);
      EXPECT_NEAR(out[0], wave(std::atan2(place[1], place[0])), 0.02 * 0.3) << "cubics between four points of each";
    }
  }
}

TEST(ScaledTable, HasTheBoundOfItsForces) {
  ForceTable t = similar();
  t.numbers.push_back({"normal_force", "N", std::vector<double>(t.points(), 60e3)});
  t.numbers.push_back({"bound", "", std::vector<double>(t.points(), 0.0)});
  const TableInterpolation between(t);
  for (const auto& place : kPlaces) {
    double out[5];
    between.at(place, out);
    EXPECT_NEAR(out[4], std::hypot(out[1], out[2]) / (0.3 * out[3]), 1e-14);
    EXPECT_GT(out[4], 0.1);
  }
}

TEST(ScaledTable, TakesWhatLiesBeyondAtTheEndsOfCreepages) {
  const ForceTable t = similar();
  const double beyond[] = {5, 0, -7, 1e6}, at_the_ends[] = {0.01, 0, -1, 1e5};
  double out[3], ends[3];
  EXPECT_EQ(TableInterpolation(t).at(beyond, out), 3);
  TableInterpolation(t).at(at_the_ends, ends);
  for (std::size_t n = 0; n < 3; ++n) EXPECT_EQ(out[n], ends[n]);
}

TEST(ScaledTable, WithoutItsOwnAxesStiffnessesOrFrictionIsRefused) {
  ForceTable t = similar();
  t.axes[1].at[3] += 0.01;
  EXPECT_THROW(check(t), CaseError);
  t = similar();
  t.axes[1].name = "spin_angle";  // of a table of before
  EXPECT_THROW(check(t), CaseError);
  t = similar();
  t.scaling->spin_high = t.scaling->spin_low;
  EXPECT_THROW(check(t), CaseError);
  t = similar();
  t.scaling->stiffness[2].values.pop_back();
  EXPECT_THROW(check(t), CaseError);
  t = similar();
  t.scaling->friction = 0;
  EXPECT_THROW(check(t), CaseError);
}

}  // namespace railstrata
