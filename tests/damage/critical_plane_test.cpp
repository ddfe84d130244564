#include "damage/critical_plane.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "core/parallel.hpp"
#include "damage/enclosing_ball.hpp"
#include "tests/damage/hertz_stress.hpp"

namespace railstrata {
namespace {

constexpr double kYoung = 210e9, kPoisson = 0.3, kShear = kYoung / 2.6, kJ = 0.2, kK = 0.5, kYield = 500e6;
const CriticalPlaneMaterial kSteel{kYoung, kPoisson, FatemiSocieConstants{kK, kYield}, kJ};

/// One point with these samples.
StressHistory point(const std::vector<Sym3>& cycle) {
  StressHistory h{.x = {}, .y = {0}, .depth = {0}, .zone = {0}, .stress = cycle};
  for (std::size_t i = 0; i < cycle.size(); ++i) h.x.push_back(static_cast<double>(i));
  return h;
}
CriticalPlaneRow search(const std::vector<Sym3>& cycle, const Sym3& residual = {},
                        const CriticalPlaneMaterial& m = kSteel) {
  const std::vector<Sym3> rest{residual};
  return critical_planes(point(cycle), rest, std::vector<CriticalPlaneMaterial>{m})[0];
}

struct Frame {
  Vec3 a, b, c;
};
/// Turned about z, then about the new x.
Frame turned(double first, double second) {
  const double c1 = std::cos(first), s1 = std::sin(first), c2 = std::cos(second), s2 = std::sin(second);
  return {{c1, s1, 0}, {-s1 * c2, c1 * c2, s2}, {s1 * s2, -c1 * s2, c2}};
}
Sym3 dyad(Vec3 a, Vec3 b) {
  return {a.x * b.x,
          a.y * b.y,
          a.z * b.z,
          0.5 * (a.x * b.y + a.y * b.x),
          0.5 * (a.y * b.z + a.z * b.y),
          0.5 * (a.x * b.z + a.z * b.x)};
}
const std::vector<Frame> kFrames{turned(0, 0), turned(0.31, 0.77), turned(-1.1, 0.4), turned(2.3, 1.21)};

// Alternating tension s: SWT and Jiang-Sehitoglu with J = 0 are s De/2 on the plane across it, De = 2 s/E.
TEST(CriticalPlanes, OfAlternatingTension) {
  const double s = 300e6, range = 2 * s / kYoung;
  for (const Frame& f : kFrames) {
    const Sym3 tension = s * dyad(f.a, f.a);
    CriticalPlaneMaterial normal_only = kSteel;
    normal_only.jiang_sehitoglu = 0;
    const CriticalPlaneRow r = search({tension, -1 * tension}, {}, normal_only);
    EXPECT_NEAR(r.smith_watson_topper.value / (s * range / 2), 1, 2e-4);
    EXPECT_NEAR(r.jiang_sehitoglu->value / (s * range / 2), 1, 2e-4);
    EXPECT_GT(std::abs(dot(r.smith_watson_topper.normal, f.a)), std::cos(0.75 * std::numbers::pi / 180));
    // Fatemi-Socie: angle t from the axis, t_a = s sin(2t)/2, s_n = s cos²t: largest of sin(2t)(1 + k s cos²t/Y) s/2G
    double most = 0;
    for (double t = 0; t < std::numbers::pi / 2; t += 1e-4)
      most = std::max(most, s * std::sin(2 * t) / 2 / kShear * (1 + kK * s * std::pow(std::cos(t), 2) / kYield));
    EXPECT_NEAR(r.fatemi_socie->value / most, 1, 3e-4);
  }
}

// Alternating shear t: J Dg Dt with Dt = 2 t on the planes at 0 and 90 degrees, where the normal part is zero; SWT is
// that of the principal stress, t De/2 with De = 2 t (1 + nu)/E.
TEST(CriticalPlanes, OfAlternatingShear) {
  const double t = 200e6;
  for (const Frame& f : kFrames) {
    const Sym3 shear = 2 * t * dyad(f.a, f.b);
    CriticalPlaneMaterial strong = kSteel;
    strong.jiang_sehitoglu = 0.3;  // J 8 (1 + nu) = 3.12 shear against (1 + nu) normal: the shear plane governs
    const CriticalPlaneRow r = search({shear, -1 * shear}, {}, strong);
    EXPECT_NEAR(r.jiang_sehitoglu->value / (0.3 * 2 * t * 2 * t / kShear), 1, 4e-4);
    EXPECT_GT(std::max(std::abs(dot(r.jiang_sehitoglu->normal, f.a)), std::abs(dot(r.jiang_sehitoglu->normal, f.b))),
              std::cos(1.5 * std::numbers::pi / 180));
    EXPECT_NEAR(r.smith_watson_topper.value / (t * t * (1 + kPoisson) / kYoung), 1, 4e-4);
  }
}

TEST(CriticalPlanes, ResidualStressActsOnTheNormalStressOnly) {
  const double s = 300e6;
  const Sym3 tension{.xx = s};
  const PlaneCycle with = plane_cycle(std::vector<Sym3>{tension, -1 * tension}, {.xx = -100e6}, kSteel, {1, 0, 0});
  EXPECT_NEAR(with.normal_max, 200e6, 1);
  EXPECT_NEAR(with.normal_strain_range, 2 * s / kYoung, 1e-12);
  const CriticalPlaneRow r = search({tension, -1 * tension}, {.xx = -400e6});
  EXPECT_LT(r.smith_watson_topper.value, 1e-9) << "the crack is never opened";
  EXPECT_LT(r.fatemi_socie->value, search({tension, -1 * tension}).fatemi_socie->value);
}

// The shear vector on the plane z turns in a circle of radius t: range 2 t, as the chord. On a triangle's corners the
// circle is 2/sqrt(3) of the longest chord.
TEST(CriticalPlanes, ShearRangeIsTheDiameterOfTheSmallestCircle) {
  std::vector<Sym3> circle, corners;
  for (int i = 0; i < 60; ++i) {
    const double a = 2 * std::numbers::pi * i / 60;
    circle.push_back({.yz = 1e8 * std::sin(a), .xz = 1e8 * std::cos(a) + 7e7});
    if (i % 20 == 0) corners.push_back(circle.back());
  }
  EXPECT_NEAR(plane_cycle(circle, {}, kSteel, {0, 0, 1}).shear_range, 2e8, 1);
  EXPECT_NEAR(plane_cycle(corners, {}, kSteel, {0, 0, 1}).shear_range, 2e8, 1);
  EXPECT_NEAR(plane_cycle({{Sym3{.xz = -3e7}, Sym3{.xz = 5e7}, Sym3{.xz = 1e7}}}, {}, kSteel, {0, 0, 2}).shear_range,
              8e7, 1);
}

// Points that cannot lie on the circle are left out: the circle is that of all points.
TEST(CriticalPlanes, ShearRangeIsThatOfAllPoints) {
  for (int seed = 0; seed < 200; ++seed) {
    std::vector<Sym3> cycle;
    std::vector<Vec5> all;
    const double flat = seed % 4 == 0 ? 1 : 0.02 * (seed % 7);  // from circles to lines
    for (int i = 0; i < 40; ++i) {
      const double a = std::sin(seed + i * i * 1.3), b = flat * std::sin(2.0 * seed + i * i * 0.7 + i);
      cycle.push_back({.yz = 1e8 * (a + b), .xz = 1e8 * (a - b)});
      all.push_back({cycle.back().xz, cycle.back().yz, 0, 0, 0});
    }
    const double radius = enclosing_ball(all, free_directions(0, 1)).radius;
    EXPECT_NEAR(plane_cycle(cycle, {}, kSteel, {0, 0, 1}).shear_range / (2 * radius), 1, 1e-9) << seed;
  }
}

// Orthogonal shear of a frictionless line contact: range p0/2 at 0.5 a on the plane of the surface, and no plane and
// depth has more.
TEST(CriticalPlanes, RollingLineContactShearsHalfOfThePressureOnPlanesAlongTheSurface) {
  CriticalPlaneMaterial m = kSteel;
  m.fatemi_socie->k = 0;
  const auto h = testing::history_of(testing::LineLoad{}, testing::rolling_samples(0.02), {0}, {0.3, 0.5, 0.8});
  const auto rows = critical_planes(h, {}, std::vector<CriticalPlaneMaterial>(3, m));
  EXPECT_NEAR(rows[1].fatemi_socie->value * kShear, 0.25, 0.25 * 1e-3);
  EXPECT_GT(std::max(std::abs(rows[1].fatemi_socie->normal.z), std::abs(rows[1].fatemi_socie->normal.x)),
            std::cos(1.5 * std::numbers::pi / 180));
  EXPECT_LT(rows[0].fatemi_socie->value, rows[1].fatemi_socie->value);
  EXPECT_LT(rows[2].fatemi_socie->value, rows[1].fatemi_socie->value);
}

/// Every plane of a grid of 1.5 degrees of every column.
CriticalPlaneRow exhaustive(const StressHistory& h, int row, const CriticalPlaneMaterial& m) {
  CriticalPlaneRow out{{}, CriticalPlane{}, CriticalPlane{}};
  const double step = 1.5 * std::numbers::pi / 180;
  for (int column = 0; column < h.columns(); ++column)
    for (int i = 0; i <= 60; ++i)
      for (int j = 0; j < 240; ++j) {
        const Vec3 n{std::sin(i * step) * std::cos(j * step), std::sin(i * step) * std::sin(j * step),
                     std::cos(i * step)};
        const PlaneCycle c = plane_cycle({h.cycle(row, column), h.x.size()}, {}, m, n);
        const double swt = std::max(c.normal_max, 0.0) * c.normal_strain_range / 2;
        const double js = swt + *m.jiang_sehitoglu * c.shear_range * c.shear_range / kShear;
        const double fs = c.shear_range / kShear / 2 * (1 + m.fatemi_socie->k * c.normal_max / m.fatemi_socie->yield);
        out.smith_watson_topper.value = std::max(out.smith_watson_topper.value, swt);
        out.fatemi_socie->value = std::max(out.fatemi_socie->value, fs);
        out.jiang_sehitoglu->value = std::max(out.jiang_sehitoglu->value, js);
      }
  return out;
}

// Columns and planes that are left out cannot hold the largest: the search finds what a full grid finds.
TEST(CriticalPlanes, FindWhatAllPlanesOfAllColumnsHold) {
  const auto h = testing::history_of(testing::HertzLoad{.friction = 0.3}, testing::rolling_samples(0.25),
                                     {-0.6, 0, 0.4}, {0.002, 0.2, 0.6});
  CriticalPlaneMaterial m = kSteel;
  m.fatemi_socie->yield = 0.5;  // stresses in units of p0
  const auto rows = critical_planes(h, {}, std::vector<CriticalPlaneMaterial>(3, m));
  for (int row = 0; row < 3; ++row) {
    const CriticalPlaneRow all = exhaustive(h, row, m);
    const auto agrees = [&](double found, double grid) {
      EXPECT_GE(found, grid * (1 - 2e-4)) << row;
      EXPECT_LE(found, grid * (1 + 2e-3)) << row;
    };
    agrees(rows[row].smith_watson_topper.value, all.smith_watson_topper.value);
    agrees(rows[row].fatemi_socie->value, all.fatemi_socie->value);
    agrees(rows[row].jiang_sehitoglu->value, all.jiang_sehitoglu->value);
  }
}

// Cycles of no symmetry: sums of three harmonics with phases of their own in all six components.
TEST(CriticalPlanes, OfArbitraryCyclesAreThoseOfAllPlanes) {
  for (int seed = 1; seed <= 12; ++seed) {
    std::vector<Sym3> cycle(24);
    int k = 0;
    for (double Sym3::*c : {&Sym3::xx, &Sym3::yy, &Sym3::zz, &Sym3::xy, &Sym3::yz, &Sym3::xz})
      for (int harmonic = 0; harmonic < 3; ++harmonic, ++k)
        for (int i = 0; i < 24; ++i)
          cycle[i].*c += 1e8 * std::sin(harmonic * 2 * std::numbers::pi * i / 24 + seed * 1.7 + k * k * 0.61);
    const StressHistory h = point(cycle);
    const CriticalPlaneRow all = exhaustive(h, 0, kSteel), found = search(cycle);
    EXPECT_GE(found.smith_watson_topper.value, all.smith_watson_topper.value * (1 - 1e-4)) << seed;
    EXPECT_GE(found.fatemi_socie->value, all.fatemi_socie->value * (1 - 1e-4)) << seed;
    EXPECT_GE(found.jiang_sehitoglu->value, all.jiang_sehitoglu->value * (1 - 1e-4)) << seed;
    EXPECT_LE(found.fatemi_socie->value, all.fatemi_socie->value * 1.01) << seed;
  }
}

TEST(CriticalPlanes, HaveTheSameBitsForAnyThreads) {
  const auto h = testing::history_of(testing::HertzLoad{.friction = 0.3}, testing::rolling_samples(0.25),
                                     testing::steps(-1, 1, 0.25), testing::steps(0.1, 0.8, 0.1));
  const std::vector<CriticalPlaneMaterial> m(h.depth.size(), kSteel);
  const int threads = max_threads();
  set_threads(1);
  const auto one = critical_planes(h, {}, m);
  set_threads(3);
  const auto three = critical_planes(h, {}, m);
  set_threads(threads);
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].smith_watson_topper.value, three[i].smith_watson_topper.value);
    EXPECT_EQ(one[i].fatemi_socie->value, three[i].fatemi_socie->value);
    EXPECT_EQ(one[i].jiang_sehitoglu->value, three[i].jiang_sehitoglu->value);
    EXPECT_EQ(one[i].jiang_sehitoglu->normal.x, three[i].jiang_sehitoglu->normal.x);
  }
}

TEST(CriticalPlanes, LeaveOutWhatHasNoConstants) {
  const CriticalPlaneRow r = search({{.xx = 1e8}, {}}, {}, {kYoung, kPoisson, {}, {}});
  EXPECT_GT(r.smith_watson_topper.value, 0);
  EXPECT_FALSE(r.fatemi_socie);
  EXPECT_FALSE(r.jiang_sehitoglu);
  EXPECT_THROW(search({{.xx = 1e8}, {}}, {}, {0, kPoisson, {}, {}}), std::invalid_argument);
  EXPECT_THROW(search({{.xx = 1e8}, {}}, {}, {kYoung, kPoisson, FatemiSocieConstants{0.5, 0}, {}}),
               std::invalid_argument);
}

}  // namespace
}  // namespace railstrata
