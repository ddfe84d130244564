#include "result/patch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "contact/patch_extent.hpp"

using namespace railstrata;

namespace {

constexpr double kA = 6.5e-3, kB = 5.0e-3, kPeak = 1.1e9;

// Hertz's pressure on points of spacing h, the patch's centre at (x0, y0) between them.
ContactField hertz_field(double h, double x0, double y0) {
  const int n = static_cast<int>(std::ceil(9e-3 / h));
  ContactField f;
  f.resize(2 * n + 1, 2 * n + 1);
  for (int s = 0; s < f.stations; ++s)
    for (int c = 0; c < f.columns; ++c) {
      const int i = s * f.columns + c;
      f.x[i] = (s - n) * h;
      f.y[i] = (c - n) * h;
      f.area[i] = h * h;
      const double r2 = std::pow((f.x[i] - x0) / kA, 2) + std::pow((f.y[i] - y0) / kB, 2);
      f.p[i] = r2 < 1 ? kPeak * std::sqrt(1 - r2) : 0;
      f.state[i] = f.p[i] > 0 ? (f.x[i] < x0 ? ContactState::slip : ContactState::stick) : ContactState::separated;
      f.q_x[i] = -0.2 * f.p[i];
    }
  f.p_noise = 0.025 * kPeak;
  return f;
}

}  // namespace

TEST(Patch, AxesAreaAndPeakOfAnEllipseOnMillimetrePointsWhereverItLies) {  // closed form: Hertz, area pi a b
                                                                           // [Johnson1985 eq. 4.26]
  for (double shift : {0.0, 0.25e-3, 0.5e-3}) {
    const PatchMeasures m = measure_patch(hertz_field(1e-3, shift, 0.3 * shift));
    EXPECT_NEAR(m.length / (2 * kA), 1, 0.02) << shift;
    EXPECT_NEAR(m.width / (2 * kB), 1, 0.02) << shift;
    EXPECT_NEAR(m.area / (std::numbers::pi * kA * kB), 1, 0.02) << shift;
    EXPECT_NEAR(m.p_max / kPeak, 1, 2e-3) << shift;
    EXPECT_NEAR(m.p_max_x, shift, 0.05e-3);
  }
}

TEST(Patch, TwoPartsAreTwoRegionsWithTheGapBetweenThemInTheLength) {
  ContactField f = hertz_field(0.25e-3, 0, 0);
  EXPECT_EQ(contact_regions(f), 1);
  for (int i = 0; i < f.size(); ++i)
    if (std::abs(f.x[i]) < 1e-3) f.p[i] = 0;
  EXPECT_EQ(contact_regions(f), 2);
  EXPECT_NEAR(patch_extent(f).length, 2 * kA, 0.1e-3);
}

TEST(Patch, MeasuresConvergeWithTheSpacing) {
  const PatchMeasures coarse = measure_patch(hertz_field(1e-3, 0.2e-3, 0.1e-3)),
                      fine = measure_patch(hertz_field(0.25e-3, 0.2e-3, 0.1e-3));
  const double area = std::numbers::pi * kA * kB;
  EXPECT_LT(std::abs(fine.area / area - 1), 0.5 * std::abs(coarse.area / area - 1) + 1e-4);
  EXPECT_NEAR(fine.area / area, 1, 4e-3);
  EXPECT_NEAR(fine.length / (2 * kA), 1, 4e-3);
}

// What elements have: a node's pressure is its force over the length that it stands for.
TEST(Patch, EdgesOfNodesAreThoseOfTheForceThatTheyBear) {
  for (const double h : {1e-3, 1.5e-3, 2e-3})
    for (const double place : {0.0, 0.2, 0.4, 0.6, 0.8}) {
      ContactField f = hertz_field(h, 0, 0);
      f.at_points = true;
      for (int i = 0; i < f.size(); ++i) {
        f.x[i] += h * place;
        double force = 0;
        constexpr int kParts = 400;
        for (int k = 0; k < kParts; ++k) {
          const double t = 2 * (k + 0.5) / kParts - 1, x = f.x[i] + h * t,
                       p2 = 1 - std::pow(x / kA, 2) - std::pow(f.y[i] / kB, 2);
          force += p2 > 0 ? kPeak * std::sqrt(p2) * (1 - std::abs(t)) * 2 / kParts : 0.0;
        }
        f.p[i] = force;
      }
      const int column = f.columns / 2;
      const Chord chord = chord_along(f, column);
      EXPECT_NEAR(chord.begin, -kA, 0.05 * h) << h << ' ' << place;
      EXPECT_NEAR(chord.end, kA, 0.05 * h) << h << ' ' << place;
    }
}

// Carter's traction: f p in slip, f p less a Hertzian part over the stick in front of it. [Johnson1985 sec. 8.3]
TEST(Patch, ShearAtTheFrontOfSlipIsFoundBetweenThePointsWhateverTheirPlace) {
  const double f = 0.4, front = -1.3e-3, middle = 0.5 * (kA + front), half = 0.5 * (kA - front);
  const double exact = f * kPeak * std::sqrt(1 - std::pow(front / kA, 2));
  double worst_point = 0;
  for (const double place : {0.0, 0.1, 0.3, 0.5, 0.7, 0.9}) {
    ContactField field = hertz_field(0.5e-3, 0, 0);
    for (double& x : field.x) x += 0.5e-3 * place;
    for (int i = 0; i < field.size(); ++i) {
      const double x = field.x[i], y = field.y[i], p2 = 1 - std::pow(x / kA, 2),
                   s2 = 1 - std::pow((x - middle) / half, 2);
      const bool touches = p2 > 0 && std::abs(y) < 0.1e-3, sticks = touches && s2 > 0;
      field.p[i] = touches ? kPeak * std::sqrt(p2) : 0;
      field.q_x[i] = -f * (field.p[i] - (sticks ? kPeak * half / kA * std::sqrt(s2) : 0.0));
      field.state[i] = sticks ? ContactState::stick : touches ? ContactState::slip : ContactState::separated;
    }
    EXPECT_NEAR(shear_at_front_of_slip(field) / exact, 1, 5e-3) << place;
    worst_point = std::max(worst_point, std::abs(measure_patch(field).q_max_point / exact - 1));
  }
  EXPECT_GT(worst_point, 0.01);
}

// A film that yields bounds the shear whatever the pressure: where the pressure is larger at the front than behind it,
// q/p of the point behind says more than the film carries.
TEST(Patch, ShearAtTheFrontOfSlipIsNoMoreThanWhatAPointMayCarry) {
  const double yield = 0.3 * kPeak;
  ContactField field = hertz_field(0.5e-3, 0, 0);
  for (int i = 0; i < field.size(); ++i) {
    if (!(field.p[i] > 0)) continue;
    const bool sticks = field.x[i] > -2e-3;
    field.state[i] = sticks ? ContactState::stick : ContactState::slip;
    field.q_x[i] = -yield * (sticks ? 1 - 8 * std::sqrt(field.x[i] + 2e-3) : 1.0);
    field.q_y[i] = 0;
  }
  EXPECT_GT(shear_at_front_of_slip(field), 1.001 * yield) << "in proportion to p";
  field.bound.assign(field.p.size(), yield);
  EXPECT_DOUBLE_EQ(shear_at_front_of_slip(field), yield);
}

TEST(Patch, WithoutAFrontOfSlipTheLargestShearIsThatOfAPoint) {
  ContactField field = hertz_field(0.5e-3, 0, 0);
  for (ContactState& s : field.state)
    if (s == ContactState::stick) s = ContactState::slip;
  EXPECT_EQ(shear_at_front_of_slip(field), measure_patch(field).q_max_point);
}

TEST(Patch, ForcesAreSumsOverTheFieldAndTheWheelGetsTheReaction) {
  const PatchMeasures m = measure_patch(hertz_field(0.5e-3, 0, 0));
  EXPECT_NEAR(m.force_z / (2.0 / 3.0 * std::numbers::pi * kA * kB * kPeak), 1, 5e-3);
  EXPECT_NEAR(m.force_x / m.force_z, 0.2, 1e-12);
}

TEST(Patch, SlipFractionIsByArea) {
  const ContactField f = hertz_field(0.25e-3, 0.125e-3, 0);  // no point on the line that divides stick from slip
  EXPECT_NEAR(measure_patch(f).slip_area_fraction, 0.5, 0.01);
}

TEST(Patch, AnEmptyFieldHasNoPatch) {
  ContactField f;
  f.resize(4, 4);
  const PatchMeasures m = measure_patch(f);
  EXPECT_EQ(m.length, 0);
  EXPECT_EQ(m.area, 0);
  EXPECT_EQ(m.slip_area_fraction, 0);
}

TEST(CentreLine, RunsThroughTheLargestPressure) {
  const CentreLine line = centre_line(hertz_field(1e-3, 0, 2e-3));
  EXPECT_NEAR(line.y, 2e-3, 1e-12);
  EXPECT_EQ(line.x.size(), line.p.size());
  EXPECT_NEAR(*std::max_element(line.p.begin(), line.p.end()), kPeak, 1e-3);
}
