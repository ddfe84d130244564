// CONTACT's interface from C++: grids and gaps by formula, blocks, refusals, threads. The library itself is looked at
// by contact_test.py.
#include <gtest/gtest.h>

#include <cmath>
#include <thread>
#include <vector>

#include "cntc/discretise.hpp"
#include "cntc/flags.hpp"
#include "cntc/railstrata_cntc.h"
#include "cntc/settings.hpp"

namespace railstrata::cntc {
namespace {

void set_steel(Problem& p) { set_materials(p, 0, std::vector<double>{0.3, 0.3, 80000, 80000}); }

TEST(ContactGrids, TheFourWaysToSayARectangleAreTheSame) {
  const double mx = 20, my = 10;
  const std::vector<std::vector<double>> ways{{mx, my, -4, -3, 0.5, 0.25},
                                              {mx, my, -4, -3, 6, -0.5},
                                              {mx, my, -3.75, -2.875, 0.5, 0.25},
                                              {mx, my, -3.75, -2.875, 5.75, -0.625}};
  for (std::size_t k = 0; k < ways.size(); ++k) {
    Problem p;
    set_steel(p);
    set_potential_contact(p, static_cast<int>(k) + 1, ways[k]);
    set_gap(p, 1, std::vector<double>{0, 0, 0, 0, 0, 0});
    const PatchGrid g = discretise(p.settings).grid;
    EXPECT_EQ(g.nx, 20);
    EXPECT_EQ(g.ny, 10);
    EXPECT_NEAR(g.dx, 0.5e-3, 1e-15);
    EXPECT_NEAR(g.dy, 0.25e-3, 1e-15);
    EXPECT_NEAR(g.x0, -3.75e-3, 1e-15);
    EXPECT_NEAR(g.y0, -2.875e-3, 1e-15);
  }
}

TEST(ContactGrids, HertzByCurvaturesByTheirRatioAndBySemiAxesAreTheSame) {
  Problem p;
  set_steel(p);
  set_load(p, 50000);
  set_hertz(p, -1, std::vector<double>{40, 30, 0.001, 0.002, 1.2});
  const Discretisation first = discretise(p.settings);
  const Hertz h = first.hertz;
  EXPECT_NEAR(first.grid.x0, -1.2 * h.a * (1 - 1.0 / 40), 1e-12);
  EXPECT_NEAR(first.grid.dy, 2 * 1.2 * h.b / 30, 1e-12);
  set_hertz(p, -2, std::vector<double>{40, 30, 0.001, h.a / h.b, 1.2});
  EXPECT_NEAR(discretise(p.settings).hertz.B, h.B, 1e-9 * h.B);
  set_hertz(p, -3, std::vector<double>{40, 30, 1e3 * h.a, 1e3 * h.b, 1.2});
  EXPECT_NEAR(discretise(p.settings).hertz.A, h.A, 1e-9 * h.A);
  const double modulus = contact_modulus(p.settings.materials.body[0], p.settings.materials.body[1]);
  const double approach = 1e3 * hertz_contact(h.A, h.B, modulus, 50000).approach;
  for (const int way : {-1, -3}) {
    set_approach(p, approach);
    set_hertz(p, way,
              way == -1 ? std::vector<double>{40, 30, 0.001, 0.002, 1.2}
                        : std::vector<double>{40, 30, 1e3 * h.a, 1e3 * h.b, 1.2});
    EXPECT_NEAR(discretise(p.settings).hertz.a, h.a, 1e-9 * h.a) << way;
    EXPECT_NEAR(discretise(p.settings).hertz.B, h.B, 1e-8 * h.B) << way;
  }
}

TEST(ContactGaps, FollowTheirFormulasInMillimetresAndInMetres) {
  for (const double mm : {1.0, 1e-3}) {
    Problem p;
    set_flag(p, kUnits, mm == 1 ? 1934 : 1936);
    set_materials(p, 0, std::vector<double>{0.3, 0.3, 80000 / mm / mm, 80000 / mm / mm});
    set_potential_contact(p, 3, std::vector<double>{2, 2, 1 * mm, 2 * mm, 1 * mm, 1 * mm});
    const auto gap = [&](int number, const std::vector<double>& values) {
      set_gap(p, number, values);
      return discretise(p.settings).gap[3] * 1e3;  // mm, at (2, 3) mm
    };
    EXPECT_NEAR(gap(1, {0.1 / mm, 0.2 / mm, 0.3 / mm, 0.4, 0.5, 0.6 * mm}), 0.4 + 1.2 + 2.7 + 0.8 + 1.5 + 0.6, 1e-12);
    EXPECT_NEAR(gap(2, {3, 1 * mm, 10 * mm, 0, 2 * mm, 0, 0.2 * mm, 0.6 * mm}), 0.4 + 1.0 / 20, 1e-12);
    EXPECT_NEAR(gap(3, {0.5 * mm, 2 / mm, 1 * mm, 0.25 * mm, 3 / mm, 1.5 * mm, 100 * mm, 50 * mm}),
                0.5 * std::sin(2.0) - 0.25 * std::sin(1.5) + 0.04 + 9.0 / 50, 1e-12);
    // x fastest: the third of four is (1, 3).
    set_gap(p, 9, std::vector<double>{1 * mm, 2 * mm, 3 * mm, 4 * mm});
    EXPECT_NEAR(discretise(p.settings).gap[1], 3e-3, 1e-15);
  }
}

TEST(ContactFlags, HaveContactsDefaultsAndRefuseWhatIsNotOffered) {
  Problem p;
  EXPECT_EQ(get_flag(p, kTang), 3);
  EXPECT_EQ(get_flag(p, kTime), 2);
  EXPECT_EQ(get_flag(p, kNorm), 1);
  EXPECT_EQ(get_flag(p, kUnits), 1934);
  for (const auto& [flag, value] : {std::pair{kTime, 1}, {kBound, 4}, {kTang, 4}, {kForce, 3}, {kInfluence, 3}})
    EXPECT_THROW(set_flag(p, flag, value), Refused) << flag;
  EXPECT_NE(set_flag(p, kMatFile, 1), "");
  EXPECT_EQ(set_flag(p, kMatFile, 0), "");
  EXPECT_NE(set_flag(p, 1234, 1), "");
}

/// A problem that rolls, its tractions.
std::vector<double> solved(int ire, int icp) {
  const auto set = [&](auto* call, int number, std::vector<double> values) {
    const int n = static_cast<int>(values.size());
    call(&ire, &icp, &number, &n, values.data());
  };
  set(cntc_setmaterialparameters, 0, {0.3, 0.25, 80000, 60000});
  set(cntc_setfrictionmethod, 0, {0.3, 0.3});
  set(cntc_setpotcontact, 3, {25, 25, -6, -6, 0.5, 0.5});
  set(cntc_setundeformeddistc, 1, {0.001, 0, 0.0012, 0, 0, 0});
  const double force = 20000 + 1000 * icp, creepage = -0.0004, spin = 1e-4;
  cntc_setnormalforce(&ire, &icp, &force);
  cntc_setcreepages(&ire, &icp, &creepage, &creepage, &spin);
  int error = 77;
  cntc_calculate(&ire, &icp, &error);
  EXPECT_EQ(error, 0);
  std::vector<double> out(625);
  const int field = kTractionX, n = 625;
  cntc_getfielddata(&ire, &icp, &field, &n, out.data());
  return out;
}

TEST(ContactThreads, EightProblemsOnFourThreadsHaveTheBitsOfOne) {
  int version = 0, error = 77;
  const int nowhere = -1, one = 1;
  cntc_initializefirst(&version, &error, &nowhere, " ", " ", " ", &one, &one, &one);
  ASSERT_EQ(error, 0);
  std::vector<std::vector<double>> alone(8), together(8);
  for (int k = 0; k < 8; ++k) alone[static_cast<std::size_t>(k)] = solved(1, k + 1);
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&together, t] {
      for (int k = t; k < 8; k += 4) together[static_cast<std::size_t>(k)] = solved(2, k + 1);
    });
  for (std::thread& thread : threads) thread.join();
  for (std::size_t k = 0; k < 8; ++k) EXPECT_EQ(alone[k], together[k]) << k;
  cntc_finalizelast();
}

TEST(ContactErrors, AreKeptUntilTheyAreAskedFor) {
  int version = 0, error = 77;
  const int nowhere = -1, one = 1, ire = 4, icp = 2, length = 12;
  cntc_initializefirst(&version, &error, &nowhere, " ", " ", " ", &one, &one, &one);
  cntc_calculate(&ire, &icp, &error);
  EXPECT_EQ(error, kOther);
  char text[12];
  int code = 0;
  rscntc_lasterror(&ire, &icp, &code, text, &length);
  EXPECT_EQ(code, kOther);
  EXPECT_STREQ(text, "no material");
  double force = 0, other = 0;
  cntc_getcontactforces(&ire, &icp, &force, &other, &other, &other);
  EXPECT_TRUE(std::isnan(force));
  EXPECT_EQ(version, kInterfaceVersion);
  cntc_finalizelast();
}

}  // namespace
}  // namespace railstrata::cntc
