// Motions of a wheelset through the C interface: standstill, rolling back, wheels that turn by themselves, yawed rails.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/capi/wheelset_handle.hpp"

namespace railstrata {
namespace {

struct MotionOf : OfBothPairs {
  const std::string text{case_of(GetParam())};
};
INSTANTIATE_TEST_SUITE_P(Pairs, MotionOf, testing::ValuesIn(kBothPairs), OfBothPairs::name);

double number_of(Set& set, const char* key) {
  double out = 0;
  EXPECT_EQ(rs_contact_number(rs_wheelset_contact(set.handle, RS_LEFT), key, &out, &set.error), RS_OK);
  return out;
}

double radius_of(Set& set) { return number_of(set, "geometry.wheel_radius"); }

rs_wheelset_state moving() {
  rs_wheelset_state out = loaded(2e-3, 2e-3);
  out.y_rate = 0.02;
  out.yaw_rate = 0.01;
  out.pitch_rate = 0.03;
  out.rail_y[RS_LEFT] = 0.5e-3;
  out.rail_y_rate[RS_RIGHT] = 5e-3;
  out.rail_yaw[RS_LEFT] = 1e-3;
  out.wheel_pitch_rate[RS_RIGHT] = 0.01;
  return out;
}

/// The same state from the other side of the track: axes turned by half a turn about z, left and right exchanged.
rs_wheelset_state half_turned(rs_wheelset_state s) {
  for (double* odd : {&s.y, &s.roll, &s.speed, &s.y_rate, &s.roll_rate, &s.pitch_rate, &s.roll_moment}) *odd = -*odd;
  for (double* pair : {s.rail_y, s.rail_y_rate, s.rail_roll, s.wheel_pitch_rate})
    for (int side : {RS_LEFT, RS_RIGHT}) pair[side] = -pair[side];
  for (double* pair : {s.rail_y, s.rail_z, s.rail_y_rate, s.rail_z_rate, s.rail_roll, s.rail_yaw, s.wheel_pitch_rate})
    std::swap(pair[RS_LEFT], pair[RS_RIGHT]);
  return s;
}

TEST_P(MotionOf, RollingBackIsRollingOnSeenFromBehind) {
  Set on(text), back(text);
  ASSERT_EQ(on.solve(moving()), RS_OK) << on.error.message;
  ASSERT_EQ(back.solve(half_turned(moving())), RS_OK) << back.error.message;
  const double sign[] = {-1, -1, 1};
  for (int side : {RS_LEFT, RS_RIGHT}) {
    const rs_wheel &a = on.forces.wheel[side], &b = back.forces.wheel[1 - side];
    for (int i : {0, 1, 2}) {
      EXPECT_NEAR(b.force[i], sign[i] * a.force[i], 1);
      EXPECT_NEAR(b.moment[i], sign[i] * a.moment[i], 1);
      EXPECT_NEAR(b.point[i], sign[i] * a.point[i], 1e-9);
    }
    EXPECT_NEAR(b.creepage_x, -a.creepage_x, 1e-9);
    EXPECT_NEAR(b.creepage_y, -a.creepage_y, 1e-9);
    EXPECT_NEAR(b.spin, a.spin, 1e-7);
    EXPECT_NEAR(b.contact_angle, -a.contact_angle, 1e-7);
    EXPECT_NEAR(b.spin_moment, a.spin_moment, 1e-3);
    EXPECT_NEAR(b.dissipation, a.dissipation, 1e-4 * a.dissipation);
    EXPECT_GT(a.dissipation, 0);
  }
}

TEST(WheelsetMotion, AWheelsetThatStandsHasAnAnswerBetweenThoseOfBothDirections) {
  for (const char* text : {kChineseCase, kEuropeanCase}) {
    Set set(text);
    rs_wheelset_state state = loaded(2e-3);
    state.y_rate = 2e-6;  // slip of 2e-4 over 0.01 m/s
    state.speed = 0;
    ASSERT_EQ(set.solve(state), RS_OK) << set.error.message;
    const rs_wheelset_forces still = set.forces;
    EXPECT_LT(still.wheel[RS_LEFT].lateral_force, -1000);
    EXPECT_NEAR(still.wheel[RS_LEFT].creepage_y, 2e-4, 1e-5);
    EXPECT_NEAR(still.force[0], 0, 1e-4 * 160e3);
    for (const double speed : {1e-9, -1e-9}) {
      state.speed = speed;
      ASSERT_EQ(set.solve(state), RS_OK) << set.error.message;
      for (int i : {0, 1, 2}) EXPECT_NEAR(set.forces.force[i], still.force[i], 2e-4 * 160e3) << speed;
    }
  }
}

TEST_P(MotionOf, WheelsThatSpinWhereTheAxleStandsSlideUnderAllFriction) {
  Set set(text);
  rs_wheelset_state state = loaded();
  for (const double speed : {0.0, 1.0, -1.0})
    for (const double spinning : {20.0, -20.0}) {
      state.speed = speed;
      state.pitch_rate = spinning;
      ASSERT_EQ(set.solve(state), RS_OK) << speed << " " << spinning << ": " << set.error.message;
      const rs_wheel& left = set.forces.wheel[RS_LEFT];
      EXPECT_GT(std::copysign(1, spinning) * left.force[0], 0.29 * left.normal_force) << speed << " " << spinning;
      EXPECT_NEAR(std::abs(left.creepage_x), 1, 0.01);
      EXPECT_NEAR(left.dissipation, std::abs(left.force[0]) * 20 * left.rolling_radius, 0.01 * left.dissipation);
    }
}

TEST_P(MotionOf, WheelsThatTurnByThemselvesHaveTheirOwnCreepage) {
  Set axle(text), wheels(text), free(text);
  rs_wheelset_state state = loaded(2e-3);
  state.pitch_rate = 0.05;
  ASSERT_EQ(axle.solve(state), RS_OK) << axle.error.message;
  state.pitch_rate = 0;
  state.wheel_pitch_rate[RS_LEFT] = state.wheel_pitch_rate[RS_RIGHT] = 0.05;
  ASSERT_EQ(wheels.solve(state), RS_OK) << wheels.error.message;
  for (int i : {0, 1, 2}) EXPECT_EQ(wheels.forces.moment[i], axle.forces.moment[i]);
  for (int side : {RS_LEFT, RS_RIGHT})
    state.wheel_pitch_rate[side] = state.speed / axle.forces.wheel[side].rolling_radius - state.speed / radius_of(axle);
  ASSERT_EQ(free.solve(state), RS_OK) << free.error.message;
  for (int side : {RS_LEFT, RS_RIGHT}) EXPECT_LT(std::abs(free.forces.wheel[side].creepage_x), 2e-5);
}

// The whole track is turned by psi: the rails then stand at e/cos(psi) from the middle where x is 0.
TEST_P(MotionOf, ATrackThatIsTurnedHasItsForcesTurned) {
  Set straight(text), turned(text);
  constexpr double kTurn = 0.01;
  const double c = std::cos(kTurn), s = std::sin(kTurn),
               e = 0.5 * number_of(straight, "geometry.back_to_back") +
                   number_of(straight, "geometry.flange_back_to_tape");
  rs_wheelset_state state = loaded(1e-3, 1e-3);
  ASSERT_EQ(straight.solve(state), RS_OK) << straight.error.message;
  rs_wheelset_state other = state;
  other.given = RS_WHEELSET_Z | RS_WHEELSET_ROLL;
  other.z = straight.forces.z;
  other.roll = straight.forces.roll;
  other.yaw += kTurn;
  other.y = state.y / c;
  other.speed = c * state.speed;
  other.y_rate = s * state.speed;
  other.pitch_rate = (state.speed - other.speed) / radius_of(straight);
  for (int side : {RS_LEFT, RS_RIGHT}) {
    other.rail_yaw[side] = kTurn;
    other.rail_y[side] = (side == RS_LEFT ? e : -e) * (1 / c - 1);
  }
  ASSERT_EQ(turned.solve(other), RS_OK) << turned.error.message;
  for (int side : {RS_LEFT, RS_RIGHT}) {
    const double *a = straight.forces.wheel[side].force, *b = turned.forces.wheel[side].force;
    EXPECT_NEAR(b[0], c * a[0] - s * a[1], 8);
    EXPECT_NEAR(b[1], s * a[0] + c * a[1], 8);
    EXPECT_NEAR(b[2], a[2], 8);
    const double *m = straight.forces.wheel[side].moment, *n = turned.forces.wheel[side].moment;
    EXPECT_NEAR(n[2], m[2], 8);
  }
}

rs_patch patch_of(const Set& set, int side, int patch, const double* about = nullptr) {
  rs_patch out{};
  out.size = sizeof(rs_patch);
  rs_error error{};
  EXPECT_EQ(rs_wheelset_patch(set.handle, side, patch, about, &out, &error), RS_OK) << error.message;
  return out;
}

TEST(WheelsetMotion, PatchesAddUpToTheirWheelInTheAxesOfTheTrack) {
  Set set(kEuropeanCase);
  rs_wheelset_state state = half_turned(moving());
  state.y = 5.2e-3;
  ASSERT_EQ(set.solve(state), RS_OK) << set.error.message;
  int most = 0;
  for (int side : {RS_LEFT, RS_RIGHT}) {
    const rs_wheel& wheel = set.forces.wheel[side];
    most = std::max(most, wheel.patches);
    for (int i : {0, 1, 2}) {
      double force = 0, moment = 0;
      for (int k = 0; k < wheel.patches; ++k) {
        const rs_patch patch = patch_of(set, side, k);
        force += patch.force[i];
        moment += patch.moment[i];
      }
      EXPECT_NEAR(force, wheel.force[i], 1e-6);
      EXPECT_NEAR(moment, wheel.moment[i], 1e-6);
    }
    const rs_patch first = patch_of(set, side, 0);
    EXPECT_EQ(std::signbit(first.contact_angle), std::signbit(wheel.contact_angle));
    EXPECT_NEAR(first.point[1], wheel.point[1], 0.04);
    const rs_patch about = patch_of(set, side, 0, first.point);
    EXPECT_LT(std::abs(about.moment[0]), 100);
    EXPECT_LT(std::abs(about.moment[1]), 100);
  }
  EXPECT_GE(most, 2);
  rs_patch out = patch_of(set, RS_LEFT, 0);
  EXPECT_EQ(rs_wheelset_patch(set.handle, 2, 0, nullptr, &out, &set.error), RS_CASE);
  EXPECT_EQ(rs_wheelset_patch(set.handle, RS_LEFT, 9, nullptr, &out, &set.error), RS_CASE);
  state.speed = std::nan("");
  ASSERT_EQ(set.solve(state), RS_CASE);
  EXPECT_EQ(rs_wheelset_patch(set.handle, RS_LEFT, 0, nullptr, &out, &set.error), RS_CASE);
}

TEST_P(MotionOf, RemarksNameTheirWheel) {
  Set set(text);
  EXPECT_STREQ(rs_wheelset_remarks(set.handle), "");
  EXPECT_STREQ(rs_wheelset_remarks(nullptr), "");
  ASSERT_EQ(set.solve(loaded(2e-3)), RS_OK) << set.error.message;
  std::string wanted;
  for (int side : {RS_LEFT, RS_RIGHT}) {
    std::istringstream lines(rs_remarks(rs_wheelset_contact(set.handle, side)));
    for (std::string line; std::getline(lines, line);)
      wanted += (wanted.empty() ? "" : "\n") + std::string(side == RS_LEFT ? "left" : "right") + " wheel: " + line;
  }
  EXPECT_EQ(rs_wheelset_remarks(set.handle), wanted);
}

TEST_P(MotionOf, ACopyGoesOnWithTheSameBitsAndOutlivesItsOriginal) {
  rs_wheelset_forces alone{};
  rs_wheelset* copy = nullptr;
  rs_contact* left = nullptr;
  rs_error error{};
  {
    Set set(text);
    ASSERT_EQ(set.solve(loaded(1e-3)), RS_OK) << set.error.message;
    rs_wheelset_keep(set.handle);
    copy = rs_wheelset_copy(set.handle, &error);
    ASSERT_NE(copy, nullptr) << error.message;
    left = rs_contact_copy(rs_wheelset_contact(set.handle, RS_LEFT), &error);
    ASSERT_NE(left, nullptr) << error.message;
    ASSERT_EQ(set.solve(loaded(1.1e-3)), RS_OK);
    alone = set.forces;
  }
  rs_wheelset_forces forces{};
  forces.size = sizeof(forces);
  const rs_wheelset_state state = loaded(1.1e-3);
  ASSERT_EQ(rs_wheelset_solve(copy, &state, &forces, &error), RS_OK) << error.message;
  EXPECT_EQ(forces.wheel[RS_LEFT].p_max, alone.wheel[RS_LEFT].p_max);
  for (int i : {0, 1, 2}) EXPECT_EQ(forces.force[i], alone.force[i]);
  rs_wheelset_free(copy);
  int nx = 0, ny = 0;
  EXPECT_EQ(rs_points(left, 0, &nx, &ny, &error), RS_OK) << "its solution has come along";
  EXPECT_EQ(rs_solve(left, nullptr, nullptr, &error), RS_CASE);
  rs_contact_free(left);
  EXPECT_EQ(rs_contact_copy(nullptr, &error), nullptr);
  EXPECT_EQ(rs_wheelset_copy(nullptr, &error), nullptr);
}

TEST_P(MotionOf, AStateOfAnOlderHeaderHasTheBitsOfOneWithoutTheMembersThatItLacks) {
  Set set(text), other(text);
  rs_wheelset_state state = loaded(1e-3);
  ASSERT_EQ(set.solve(state), RS_OK) << set.error.message;
  state.size = offsetof(rs_wheelset_state, wheel_pitch_rate);
  state.wheel_pitch_rate[RS_LEFT] = state.rail_yaw[RS_LEFT] = std::nan("");
  ASSERT_EQ(other.solve(state), RS_OK) << other.error.message;
  for (int i : {0, 1, 2}) EXPECT_EQ(other.forces.force[i], set.forces.force[i]);
  state.size -= 8;
  EXPECT_EQ(other.solve(state), RS_CASE);
}

TEST_P(MotionOf, AContactRollsAlongItsXWhateverTheSpeed) {
  Handle contact(GetParam());
  rs_state state = state_of(RS_SPEED | RS_CREEPAGE_X | RS_LOAD);
  state.load = 80e3;
  state.creepage_x = -1e-3;
  std::vector<double> forces, powers;
  for (const double speed : {20.0, -20.0, 0.01, 0.0, -1e-3}) {
    state.speed = speed;
    rs_forget(contact.handle);
    ASSERT_EQ(contact.solve(state), RS_OK) << speed << ": " << contact.error.message;
    forces.push_back(contact.forces.force_x);
    powers.push_back(contact.forces.dissipation);
  }
  for (const double force : forces) EXPECT_NEAR(force, forces[0], 1e-9 * forces[0]);
  EXPECT_EQ(powers[1], powers[0]);
  EXPECT_NEAR(powers[2], powers[0] / 2000, 1e-9 * powers[0]);
  EXPECT_EQ(powers[3], powers[2]);
  EXPECT_EQ(powers[4], powers[2]);
}

}  // namespace
}  // namespace railstrata
