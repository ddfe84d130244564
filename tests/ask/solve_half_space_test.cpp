#include "ask/solve_half_space.hpp"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

#include "reader/case_file.hpp"

namespace railstrata {
namespace {

HalfSpaceSolution solve(const std::vector<std::string>& overrides) {
  const LoadedCase loaded = parse_case("[case]\ntitle = \"from a text\"\n", "none.toml", overrides);
  BemOptions options;
  options.cell = 0.5e-3;
  return solve_half_space(loaded.spec, place(loaded.spec, "."), options);
}

void expect_same_bits(const HalfSpaceSolution& a, const HalfSpaceSolution& b) {
  EXPECT_EQ(a.result.field.p, b.result.field.p);
  EXPECT_EQ(a.result.field.q_x, b.result.field.q_x);
  EXPECT_EQ(a.result.field.q_y, b.result.field.q_y);
  EXPECT_EQ(a.result.rigid_slip.x, b.result.rigid_slip.x);
  ASSERT_TRUE(a.summary.rail.subsurface && b.summary.rail.subsurface);
  EXPECT_EQ(a.summary.rail.subsurface->von_mises.value, b.summary.rail.subsurface->von_mises.value);
}

}  // namespace

TEST(SolveHalfSpace, TwoThreadsAtATimeGetTheBitsOfOneAfterTheOther) {
  const std::vector<std::vector<std::string>> cases{{"drive.traction_coefficient=0.1"},
                                                    {"drive.traction_coefficient=0.3", "geometry.lateral_shift=2 mm"}};
  const HalfSpaceSolution first = solve(cases[0]), second = solve(cases[1]);
  EXPECT_NE(first.result.rigid_slip.x, second.result.rigid_slip.x);
  for (int round = 0; round < 3; ++round) {
    HalfSpaceSolution a, b;
    std::thread one([&] { a = solve(cases[0]); }), other([&] { b = solve(cases[1]); });
    one.join();
    other.join();
    expect_same_bits(a, first);
    expect_same_bits(b, second);
  }
}

TEST(SolveHalfSpace, GivesPatchForcesStressesAndSummary) {
  const HalfSpaceSolution s = solve({});
  EXPECT_EQ(s.summary.title, "from a text");
  EXPECT_EQ(s.summary.run.engine, Engine::bem);
  EXPECT_GT(s.summary.run.threads, 0);
  EXPECT_NEAR(s.result.force.z, -(660 + 8000) * 9.81, 1e-4 * 8660 * 9.81);
  const double deepest = s.summary.rail.subsurface->von_mises.value;
  EXPECT_GT(deepest, 0.3 * s.result.patch.largest_pressure);
  EXPECT_LT(deepest, s.result.patch.largest_pressure);
  const InteriorPoint below = rail_interior(s.result).at({{0, 0, 1e-3}}).front();
  EXPECT_LT(below.stress.zz, -0.5 * s.result.patch.largest_pressure);  // a millimetre below the middle of the patch
}

TEST(SolveHalfSpace, AStaticCaseIsWithoutFriction) {
  const HalfSpaceSolution s = solve({"run.rolling=false"});
  EXPECT_EQ(s.result.force.x, 0);
  EXPECT_EQ(s.result.patch.largest_traction, 0);
}

}  // namespace railstrata
