// Wheelsets of the C interface: equilibrium, mirror images, trial steps, many states, Klingel's wavelength.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <random>
#include <string>
#include <utility>

#include "tests/capi/wheelset_handle.hpp"

namespace railstrata {
namespace {

/// LMA on CN60 under a layer, and the European pair.
struct WheelsetOf : OfBothPairs {
  const std::string text{case_of(GetParam())};
};
INSTANTIATE_TEST_SUITE_P(Pairs, WheelsetOf, testing::ValuesIn(kBothPairs), OfBothPairs::name);

TEST_P(WheelsetOf, BearsLoadAndRollMoment) {
  Set set(text);
  ASSERT_NE(set.handle, nullptr) << set.error.message;
  rs_wheelset_state state = loaded(2e-3, 1e-3);
  state.roll_moment = 20e3;
  ASSERT_EQ(set.solve(state), RS_OK) << set.error.message;
  EXPECT_NEAR(set.forces.force[2], 160e3, 16);
  EXPECT_NEAR(set.forces.moment[0], -20e3, 16);
  const double left = set.forces.wheel[RS_LEFT].force[2];
  state.given = RS_WHEELSET_Z | RS_WHEELSET_ROLL;
  state.z = set.forces.z;
  state.roll = set.forces.roll;
  ASSERT_EQ(set.solve(state), RS_OK) << set.error.message;
  EXPECT_NEAR(set.forces.wheel[RS_LEFT].force[2], left, 1e-4 * left);
  state.given = RS_WHEELSET_LOAD | RS_WHEELSET_ROLL;
  ASSERT_EQ(set.solve(state), RS_OK) << set.error.message;
  EXPECT_NEAR(set.forces.z, state.z, 1e-8);
}

TEST_P(WheelsetOf, TheMirrorImageOfAStateHasThoseOfItsForces) {
  Set set(text), other(text);
  rs_wheelset_state state = loaded(3e-3, 2e-3), image = loaded(-3e-3, -2e-3);
  state.y_rate = 0.01;
  state.rail_y[RS_LEFT] = 1e-3;
  image.y_rate = -0.01;
  image.rail_y[RS_RIGHT] = -1e-3;
  ASSERT_EQ(set.solve(state), RS_OK) << set.error.message;
  ASSERT_EQ(other.solve(image), RS_OK) << other.error.message;
  const rs_wheel &a = set.forces.wheel[RS_LEFT], &b = other.forces.wheel[RS_RIGHT];
  const double sign[] = {1, -1, 1};
  for (int i : {0, 1, 2}) {
    EXPECT_NEAR(a.force[i], sign[i] * b.force[i], 10);
    EXPECT_NEAR(a.moment[i], -sign[i] * b.moment[i], 10);
  }
  EXPECT_NEAR(a.contact_angle, -b.contact_angle, 1e-6);
  EXPECT_NEAR(set.forces.roll, -other.forces.roll, 1e-9);
}

TEST_P(WheelsetOf, RailsThatMoveAlongChangeNothing) {
  Set set(text), other(text);
  rs_wheelset_state state = loaded(1e-3), moved = loaded(3e-3);
  for (int side : {RS_LEFT, RS_RIGHT}) {
    moved.rail_y[side] = 2e-3;
    moved.rail_z[side] = 1e-3;
  }
  ASSERT_EQ(set.solve(state), RS_OK) << set.error.message;
  ASSERT_EQ(other.solve(moved), RS_OK) << other.error.message;
  EXPECT_NEAR(other.forces.z - set.forces.z, 1e-3, 1e-9);
  for (int i : {0, 1, 2}) EXPECT_NEAR(other.forces.force[i], set.forces.force[i], 5);
}

TEST_P(WheelsetOf, TrialStepsLeaveNoTraceAfterAReset) {
  Set set(text);
  ASSERT_EQ(set.solve(loaded(1e-3)), RS_OK) << set.error.message;
  rs_wheelset_keep(set.handle);
  ASSERT_EQ(set.solve(loaded(1.2e-3, 1e-4)), RS_OK) << set.error.message;
  const rs_wheelset_forces first = set.forces;
  ASSERT_EQ(set.solve(loaded(5e-3, -1e-3)), RS_OK) << set.error.message;
  rs_wheelset_reset(set.handle);
  ASSERT_EQ(set.solve(loaded(1.2e-3, 1e-4)), RS_OK) << set.error.message;
  for (int i : {0, 1, 2}) EXPECT_EQ(set.forces.force[i], first.force[i]);
}

TEST(Wheelset, UnderACladItSinksDeeperTheSofterItsInterface) {
  const auto sunk = [](const std::string& text) {
    Set set(text);
    EXPECT_EQ(set.solve(loaded(2e-3, 1e-3)), RS_OK) << set.error.message;
    EXPECT_NEAR(set.forces.force[2], 160e3, 16);
    return set.forces.z;
  };
  const double bonded = sunk(std::string(kChineseCase) + "[[layer]]\nthickness = \"3 mm\"\nyoung_ratio = 2\n");
  EXPECT_NEAR(sunk(clad_on_springs("1e10", "1e10")), bonded, 1e-10);
  double last = bonded;
  for (const char* stiffness : {"1e5", "2e4", "5e3"}) {
    const double here = sunk(clad_on_springs(stiffness, stiffness));
    EXPECT_LT(here, last - 1e-7);
    last = here;
  }
}

TEST_P(WheelsetOf, AWheelThatLiftsIsAnAnswer) {
  Set set(text);
  ASSERT_EQ(set.solve(loaded()), RS_OK) << set.error.message;
  rs_wheelset_state state = loaded();
  state.given = RS_WHEELSET_Z | RS_WHEELSET_ROLL;
  state.z = set.forces.z;
  state.roll = 1e-3;
  ASSERT_EQ(set.solve(state), RS_OK) << set.error.message;
  EXPECT_EQ(set.forces.wheel[RS_LEFT].patches, 0);
  EXPECT_LT(set.forces.wheel[RS_LEFT].approach, 0);
  EXPECT_GT(set.forces.wheel[RS_RIGHT].force[2], 80e3);
  rs_wheelset_state tipped = loaded();
  tipped.roll_moment = 200e3;
  EXPECT_EQ(set.solve(tipped), RS_NO_ANSWER);
}

TEST_P(WheelsetOf, WithoutALoadTheWheelsTouchWithoutForces) {
  Set set(text);
  rs_wheelset_state state = loaded(2e-3);
  ASSERT_EQ(set.solve(state), RS_OK) << set.error.message;
  const double z = set.forces.z, roll = set.forces.roll;
  state.load = 0;
  for (const unsigned given : {RS_WHEELSET_LOAD, RS_WHEELSET_LOAD | RS_WHEELSET_ROLL}) {
    state.given = given;
    state.roll = roll;
    ASSERT_EQ(set.solve(state), RS_OK) << set.error.message;
    EXPECT_EQ(set.forces.force[2], 0);
    EXPECT_EQ(set.forces.wheel[RS_LEFT].patches + set.forces.wheel[RS_RIGHT].patches, 0);
    EXPECT_NEAR(set.forces.z - z, 0.1e-3, 0.05e-3);
    EXPECT_NEAR(set.forces.roll, roll, 2e-5);
  }
  state.given = RS_WHEELSET_LOAD;
  state.roll_moment = 1;
  EXPECT_EQ(set.solve(state), RS_NO_ANSWER);
}

TEST_P(WheelsetOf, WhatIsNoNumberIsAMistakeWithItsName) {
  Set set(text);
  rs_wheelset_state rate = loaded(), rail = loaded();
  rate.y_rate = std::nan("");
  rail.rail_z[RS_RIGHT] = std::nan("");
  EXPECT_EQ(set.solve(rate), RS_CASE);
  EXPECT_NE(std::string(set.error.message).find("y_rate = nan"), std::string::npos);
  EXPECT_EQ(set.solve(rail), RS_CASE);
  EXPECT_NE(std::string(set.error.message).find("rail_z[1] = nan"), std::string::npos);
}

/// `largest`: shift, short of the flange's second patch.
void expect_answers(const std::string& text, double largest) {
  const char* many = std::getenv("RAILSTRATA_STATES");
  const int states = many ? std::atoi(many) : 40;
  Set set(text);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(-1, 1);
  int failed = 0, solutions = 0;
  for (int k = 0; k < states; ++k) {
    rs_wheelset_state state = loaded(largest * unit(random), 5e-3 * unit(random));
    state.load *= 1 + 0.3 * unit(random);
    const int code = set.solve(state);
    failed += code != RS_OK;
    if (code) ADD_FAILURE() << state.y << " " << state.yaw << " " << state.load << ": " << set.error.message;
    solutions += set.forces.solutions;
  }
  EXPECT_EQ(failed, 0);
  testing::Test::RecordProperty("solutions", solutions);
}

TEST(Wheelset, StatesOfARunAllHaveAnAnswer) {
  expect_answers({}, 6e-3);
  expect_answers(kEuropeanCase, 6e-3);
}

// What the states before leave must not lead a solution astray: from nothing each of these has an answer.
TEST(Wheelset, AStateBesideThoseBeforeItHasAnAnswer) {
  Set set(kEuropeanCase);
  ASSERT_NE(set.handle, nullptr) << set.error.message;
  rs_wheelset_state state = loaded();
  state.load = 60e3;
  state.speed = 22;
  state.y_rate = 0.0009599568862381572;
  state.yaw_rate = 0.005290820798761049;
  state.pitch_rate = -0.0036286935052856264;
  state.rail_y[0] = state.rail_y[1] = -0.0002177664896200208;
  const double y = -0.0005901007261253111, yaw = 1.5779507855573356e-05, step = 1e-5;
  for (const auto& [more_y, more_yaw] : {std::pair{0.0, 0.0}, {step, 0.0}, {0.0, step}}) {
    state.y = y + more_y;
    state.yaw = yaw + more_yaw;
    ASSERT_EQ(set.solve(state), RS_OK) << more_y << " " << more_yaw << ": " << set.error.message;
    EXPECT_NEAR(set.forces.force[2], 60e3, 6);
  }
}

// S1002 on UIC60 near the middle of the track: 0.8 urad of roll move the place of the first contact by 10 mm.
TEST(Wheelset, AWheelThatChangesItsPlaceBearsItsLoad) {
  Set set(kEuropeanCase);
  ASSERT_NE(set.handle, nullptr) << set.error.message;
  rs_wheelset_state state = loaded(2.2376e-4, 1.19695e-4);
  state.load = 220e3;
  state.speed = 22;
  state.y_rate = 2.62344e-3;
  state.yaw_rate = -4.318513e-3;
  state.pitch_rate = -4.940123e-3;
  ASSERT_EQ(set.solve(state), RS_OK) << set.error.message;
  EXPECT_NEAR(set.forces.force[2], 220e3, 22);
  EXPECT_NEAR(set.forces.moment[0], 0, 22);
}

/// A bogie's wheelset between tread and gauge corner.
struct BetweenPlanes {
  double y, yaw;                        ///< m, rad
  double y_rate, yaw_rate, pitch_rate;  ///< m/s, rad/s
  double roll_moment, rail_y;           ///< N m, m
  rs_wheelset_state state() const {
    rs_wheelset_state out = loaded(y, yaw);
    out.load = 109100;
    out.y_rate = y_rate;
    out.yaw_rate = yaw_rate;
    out.pitch_rate = pitch_rate;
    out.roll_moment = roll_moment;
    out.rail_y[RS_LEFT] = out.rail_y[RS_RIGHT] = rail_y;
    return out;
  }
};
/// Places whose angles become nearer than those of one plane; patches whose pressures reach the ridge between them.
constexpr BetweenPlanes kTurns{0.005222303846900928,  0.0012050263801346103, -0.0002341538428388014,
                               -0.013954913610259924, -0.067997667946069873, -669.8347047230717,
                               0.00016910843242349882},
    kMeets{0.0050584164147168221, 0.0013475929651244427, -0.002429306637423832,  -0.016972273766443433,
           -0.079160375849027478, -928.76240570846073,   -8.6867191200560179e-05};

constexpr const char* kBogie =
    "[geometry]\nwheel_profile = \"S1002\"\nrail_profile = \"UIC60\"\ncant = \"1:40\"\nwheel_radius = \"460 mm\"\n"
    "[drive]\nfriction_coefficient = 0.3\n";

TEST(Wheelset, ALoadBetweenTheForcesOfTwoPlanesAndOfOneHasAnAnswer) {
  for (const BetweenPlanes& between : {kTurns, kMeets}) {
    Set set(kBogie);
    ASSERT_EQ(set.solve(between.state()), RS_OK) << between.y << ": " << set.error.message;
    EXPECT_NEAR(set.forces.force[2], 109100, 11) << between.y;
    EXPECT_NEAR(set.forces.moment[0], -between.roll_moment, 11) << between.y;
  }
}

/// Cold solutions at 61 heights and rolls about those given.
struct Way {
  int mixed = 0;                      ///< solutions that are means of two
  double force = 0, roll_moment = 0;  ///< the largest changes from one to the next, N, N m

  Way(const BetweenPlanes& between, double z, double roll, double by_z, double by_roll) {
    Set set(kBogie);
    for (int side : {RS_LEFT, RS_RIGHT}) rs_set_tolerance(rs_wheelset_contact(set.handle, side), 1e-7, nullptr);
    rs_wheelset_state state = between.state();
    state.given = RS_WHEELSET_Z | RS_WHEELSET_ROLL;
    rs_wheelset_forces before{};
    for (int i = -30; i <= 30; ++i) {
      state.z = z + i * by_z;
      state.roll = roll + i * by_roll;
      rs_wheelset_forget(set.handle);
      EXPECT_EQ(set.solve(state), RS_OK) << set.error.message;
      mixed += std::string(rs_wheelset_remarks(set.handle)).find("on the way into one plane") != std::string::npos;
      if (i > -30) {
        force = std::max(force, std::abs(set.forces.force[2] - before.force[2]));
        roll_moment = std::max(roll_moment, std::abs(set.forces.moment[0] - before.moment[0]));
      }
      before = set.forces;
    }
  }
};

// By one of both planes at a time the vertical force has a step of 730 N over the height, where 50 nm are 130 N, and
// one of 960 N over the roll, where 0.4 urad are 40 N.
TEST(Wheelset, ForcesAreContinuousWhereTwoPlanesBecomeOne) {
  const Way over_height(kMeets, 5.6207e-5, 3.69866337298e-4, -5e-8, 0);
  EXPECT_GT(over_height.mixed, 5);
  EXPECT_LT(over_height.force, 250);
  EXPECT_LT(over_height.roll_moment, 100);
  const Way over_roll(kTurns, 4.63e-5, 3.6e-4, 0, 4e-7);
  EXPECT_GT(over_roll.mixed, 5);
  EXPECT_LT(over_roll.force, 80);
  EXPECT_LT(over_roll.roll_moment, 600);
}

/// Where the flange's patch, of 230 N beside 92 kN, comes to the ridge before the tread's.
rs_wheelset_state beside_the_ridge(double y) {
  rs_wheelset_state state = loaded(y);
  state.pitch_rate = -0.04;
  return state;
}

// The force of a wheel grows with up to the 16th power of its descent there, over 50 nm, and its arm of the moment with
// it.
TEST(Wheelset, OnTheWayOfTwoPlanesIntoOneHeightAndRollAreSoonFound) {
  Set set(kEuropeanCase);
  int solutions = 0;
  for (int k = 0; k < 60; ++k) {
    ASSERT_EQ(set.solve(loaded(5.52e-3 + 0.2e-6 * k)), RS_OK) << set.error.message;
    solutions += set.forces.solutions;
  }
  EXPECT_LE(solutions, 250);
}

// A patch of its own cells, and of an approach that the large one leaves it: known so well that no state is refused.
TEST(Wheelset, ALoadBesideTheRidgeHasAnAnswer) {
  Set set(kBogie);
  for (double y = 5.5294e-3; y < 5.5312e-3; y += 2e-7) {
    const rs_wheelset_state state = beside_the_ridge(y);
    ASSERT_EQ(set.solve(state), RS_OK) << y << ": " << set.error.message;
    EXPECT_NEAR(set.forces.force[2], state.load, 2e-5 * state.load) << y;  // the tolerance of each wheel
  }
}

// Over 70 nm of height the force grows by 500 N, the difference between both planes, by old and new solutions alike.
TEST(Wheelset, BesideTheRidgeWarmSolutionsAreTheColdOnes) {
  Set warm(kBogie), cold(kBogie);
  rs_wheelset_state state = beside_the_ridge(5.53e-3);
  state.given = RS_WHEELSET_Z | RS_WHEELSET_ROLL;
  state.roll = 4.32669e-4;
  double least = 1e9, most = 0;
  for (int i = 0; i <= 14; ++i) {
    state.z = 8.742e-5 - 5e-9 * i;
    rs_wheelset_forget(cold.handle);
    ASSERT_EQ(warm.solve(state), RS_OK) << warm.error.message;
    ASSERT_EQ(cold.solve(state), RS_OK) << cold.error.message;
    const double force = warm.forces.wheel[RS_LEFT].force[2];
    EXPECT_NEAR(force, cold.forces.wheel[RS_LEFT].force[2], 50) << state.z;
    least = std::min(least, force);
    most = std::max(most, force);
  }
  EXPECT_GT(most - least, 450);
}

// Towards the flange, and beyond where it bears the load alone.
TEST(Wheelset, OnTheFlangeIsInEquilibrium) {
  Set set(kEuropeanCase);
  ASSERT_NE(set.handle, nullptr) << set.error.message;
  for (const double y : {6.0, 6.2, 6.3, 6.4, 6.5, 6.6, 7.0, -6.4, -6.5}) {
    ASSERT_EQ(set.solve(loaded(1e-3 * y)), RS_OK) << y << ": " << set.error.message;
    EXPECT_NEAR(set.forces.force[2], 160e3, 16) << y;
    EXPECT_NEAR(set.forces.moment[0], 0, 160) << y;
  }
}

// Force and moment of the left flange, whose place follows the roll. Beyond 7.3 mm a second equilibrium has the axle
// 3 mm higher, on the tip of the flange; from the state before and from none the answer is the lower one.
TEST(Wheelset, OnOneFlangeAloneIsInEquilibriumWithTheOtherWheelLifted) {
  Set warm(kEuropeanCase);
  for (const double y : {6.436e-3, 6.8e-3, 7.4e-3, 7.7e-3, 8.2e-3}) {
    Set set(kEuropeanCase);
    ASSERT_EQ(set.solve(loaded(y, 2e-3)), RS_OK) << set.error.message;
    EXPECT_EQ(set.forces.wheel[RS_RIGHT].patches, 0);
    EXPECT_NEAR(set.forces.force[2], 160e3, 1e-5 * 160e3);
    EXPECT_NEAR(set.forces.moment[0], 0, 1e-5 * 160e3 * 0.75);
    ASSERT_EQ(warm.solve(loaded(y, 2e-3)), RS_OK) << warm.error.message;
    EXPECT_NEAR(warm.forces.roll, set.forces.roll, 1e-7);
    EXPECT_NEAR(warm.forces.force[1], set.forces.force[1], 1e-4 * 160e3);
  }
}

// Beside the flange force and moment follow height and roll together: three solutions a state.
TEST(Wheelset, OnTheWayToTheFlangeAStateTakesThreeSolutions) {
  Set set(kEuropeanCase);
  int solutions = 0;
  for (int i = 0; i < 60; ++i) {
    ASSERT_EQ(set.solve(loaded(6.3e-3 + 5e-6 * i, 4.6e-3)), RS_OK) << set.error.message;
    if (i > 0) solutions += set.forces.solutions;
  }
  EXPECT_LE(solutions, 4 * 59);
}

TEST_P(WheelsetOf, ARollMomentBeyondOneWheelIsRefusedWithWhatBothBear) {
  Set set(text);
  rs_wheelset_state state = loaded(1e-3);
  state.roll_moment = 130e3;
  EXPECT_EQ(set.solve(state), RS_NO_ANSWER);
  EXPECT_NE(std::string(set.error.message).find("on the left wheel alone to"), std::string::npos) << set.error.message;
}

// Of two patches in planes of their own, too, the creepages are those of the state and not of the one before.
TEST(Wheelset, OnTwoPlanesANewCreepageCounts) {
  Set warm(kBogie), cold(kBogie);
  BetweenPlanes near = kMeets;
  near.y = 5.008e-3;
  near.roll_moment = -970;
  rs_wheelset_state state = near.state();
  ASSERT_EQ(warm.solve(state), RS_OK) << warm.error.message;
  const double before = warm.forces.force[0];
  state.given = RS_WHEELSET_Z | RS_WHEELSET_ROLL;
  state.z = warm.forces.z;
  state.roll = warm.forces.roll;
  state.pitch_rate += 0.01;
  ASSERT_EQ(warm.solve(state), RS_OK) << warm.error.message;
  ASSERT_EQ(cold.solve(state), RS_OK) << cold.error.message;
  EXPECT_EQ(warm.forces.wheel[RS_LEFT].patches, 2);
  EXPECT_GT(std::abs(warm.forces.force[0] - before), 500);
  for (int i : {0, 1, 2}) {
    EXPECT_NEAR(warm.forces.force[i], cold.forces.force[i], 2);
    EXPECT_NEAR(warm.forces.moment[i], cold.forces.moment[i], 2);
  }
}

// Where the wheel overlaps the rail at the ridge a patch may bear there, beside cells that do not: a grid for its own
// size alone ends before.
TEST(Wheelset, APatchReachesToTheRidgeThatIsOverlapped) {
  Set warm(kBogie), cold(kBogie);
  const BetweenPlanes spills{5.5627162237635013e-3, 2.0973321426131153e-3, 1.4876734599024442e-3, -0.019491847990334724,
                             -0.095494847874202315, -1163.7674386680262,   3.1648320935597949e-4};
  rs_wheelset_state state = spills.state();
  state.y += 1e-6;
  ASSERT_EQ(warm.solve(state), RS_OK) << warm.error.message;
  state = spills.state();
  state.given = RS_WHEELSET_Z | RS_WHEELSET_ROLL;
  state.z = 6.81565e-5;
  state.roll = 3.86823756858e-4;
  ASSERT_EQ(warm.solve(state), RS_OK) << warm.error.message;
  ASSERT_EQ(cold.solve(state), RS_OK) << cold.error.message;
  for (int i : {0, 1, 2}) EXPECT_NEAR(warm.forces.force[i], cold.forces.force[i], 1) << i;
}

// As a vehicle code asks in its time steps: the sharing of tread and flange goes on as before, which saves a solution
// of three, and forces are those of new wheelsets.
TEST(Wheelset, OnTreadAndFlangeAStateTakesTwoSolutions) {
  constexpr int kStates = 60;
  Set set(kEuropeanCase);
  int solutions = 0;
  for (int k = 0; k < kStates; ++k) {
    const rs_wheelset_state state = loaded(5.2e-3 + 2e-6 * k, 1e-3);
    ASSERT_EQ(set.solve(state), RS_OK) << set.error.message;
    EXPECT_EQ(set.forces.wheel[RS_LEFT].patches, 2);
    if (k > 2) solutions += set.forces.solutions;
    if (k % 20 != 19) continue;
    Set anew(kEuropeanCase);
    ASSERT_EQ(anew.solve(state), RS_OK) << anew.error.message;
    for (int i : {0, 1, 2}) EXPECT_NEAR(set.forces.force[i], anew.forces.force[i], 2e-5 * state.load);
  }
  EXPECT_LT(solutions, 2.5 * (kStates - 3));
  RecordProperty("solutions", solutions);
}

/// Rates of force and moment, by y and yaw and by their rates, at rest in the middle of the track.
struct Linear {
  double force[4], moment[4];
};
Linear linear(Set& set, double speed, double pitch_rate) {
  constexpr double kStep = 2e-4;
  double rs_wheelset_state::*const members[] = {&rs_wheelset_state::y, &rs_wheelset_state::yaw,
                                                &rs_wheelset_state::y_rate, &rs_wheelset_state::yaw_rate};
  Linear out{};
  for (int j = 0; j < 4; ++j)
    for (const double sign : {1.0, -1.0}) {
      rs_wheelset_state state = loaded();
      state.speed = speed;
      state.pitch_rate = pitch_rate;
      state.*members[j] = sign * kStep;
      EXPECT_EQ(set.solve(state), RS_OK) << set.error.message;
      out.force[j] += sign * set.forces.force[1] / (2 * kStep);
      out.moment[j] += sign * set.forces.moment[2] / (2 * kStep);
    }
  return out;
}

// Without mass, forces by position and by rates balance: (lambda C + K) (y, yaw) = 0. [Klingel1883] has the wave 2 pi
// sqrt(r0 b/conicity); the rest of 1 % is what spin and the roll of the wheelset add to it.
TEST(Wheelset, ConesRollInTheWavesOfKlingel) {
  const std::string folder = source_dir() / "examples/vehicle";
  Set set;
  rs_wheelset_free(set.handle);
  set.handle = rs_wheelset_new((folder + "/case.toml").c_str(), nullptr, 0, nullptr, 0, &set.error);
  ASSERT_NE(set.handle, nullptr) << set.error.message;
  for (int side : {RS_LEFT, RS_RIGHT}) rs_set_cell(rs_wheelset_contact(set.handle, side), 1e-3, nullptr);
  constexpr double kSpeed = 1, kAside = 1e-3;
  rs_wheelset_state aside = loaded(kAside);
  aside.speed = kSpeed;
  ASSERT_EQ(set.solve(aside), RS_OK) << set.error.message;
  const rs_wheel *left = &set.forces.wheel[RS_LEFT], *right = &set.forces.wheel[RS_RIGHT];
  const double conicity = (left->rolling_radius - right->rolling_radius) / (2 * kAside),
               base = 0.5 * (left->point[1] - right->point[1]),
               klingel = 2 * std::numbers::pi * std::sqrt(0.46 * base / conicity);
  EXPECT_NEAR(conicity, 0.05, 0.005);
  const Linear l = linear(set, kSpeed, 2 * kSpeed / (left->rolling_radius + right->rolling_radius) - kSpeed / 0.46);
  const double a = l.force[2] * l.moment[3] - l.force[3] * l.moment[2],
               c = l.force[0] * l.moment[1] - l.force[1] * l.moment[0],
               b = l.force[2] * l.moment[1] + l.force[0] * l.moment[3] - l.force[3] * l.moment[0] -
                   l.force[1] * l.moment[2];
  ASSERT_LT(b * b, 4 * a * c);
  const double frequency = std::sqrt(c / a - 0.25 * b * b / (a * a));
  EXPECT_NEAR(2 * std::numbers::pi * kSpeed / frequency, klingel, 0.01 * klingel);
  RecordProperty("wave", std::to_string(2 * std::numbers::pi * kSpeed / frequency));
  RecordProperty("klingel", std::to_string(klingel));
}

TEST_P(WheelsetOf, FreeingAContactOfItLeavesItWhole) {
  Set set(text);
  rs_contact_free(rs_wheelset_contact(set.handle, RS_LEFT));
  EXPECT_EQ(set.solve(loaded(0)), RS_OK) << set.error.message;
}

}  // namespace
}  // namespace railstrata
