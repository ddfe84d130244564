// Derivatives of wheelsets against differences of new solutions.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "tests/capi/wheelset_handle.hpp"

namespace railstrata {
namespace {

struct Input {
  int number;
  std::size_t offset;  ///< in rs_wheelset_state
  double step;
};
#define RS_INPUT(number, member, step) \
  { number, offsetof(rs_wheelset_state, member), step }
constexpr Input kMotions[] = {RS_INPUT(RS_BY_Y, y, 1e-8),
                              RS_INPUT(RS_BY_YAW, yaw, 2e-7),
                              RS_INPUT(RS_BY_SPEED, speed, 1e-4),
                              RS_INPUT(RS_BY_Y_RATE, y_rate, 2e-6),
                              RS_INPUT(RS_BY_YAW_RATE, yaw_rate, 2e-6),
                              RS_INPUT(RS_BY_ROLL_RATE, roll_rate, 2e-6),
                              RS_INPUT(RS_BY_PITCH_RATE, pitch_rate, 2e-6),
                              RS_INPUT(RS_BY_RAIL_Y, rail_y, 1e-8),
                              RS_INPUT(RS_BY_RAIL_Z + RS_OF_RIGHT, rail_z[1], 2e-9),
                              RS_INPUT(RS_BY_WHEEL_PITCH_RATE + RS_OF_RIGHT, wheel_pitch_rate[1], 2e-6)};
constexpr Input kPressed[] = {RS_INPUT(RS_BY_Z, z, 2e-9), RS_INPUT(RS_BY_ROLL, roll, 4e-9)};
constexpr Input kLoaded[] = {RS_INPUT(RS_BY_LOAD, load, 1), RS_INPUT(RS_BY_ROLL_MOMENT, roll_moment, 1)};
#undef RS_INPUT

double& number_in(rs_wheelset_state& state, std::size_t offset) {
  return *reinterpret_cast<double*>(reinterpret_cast<char*>(&state) + offset);
}

void sharpen(Set& set, double tolerance) {
  for (int side : {RS_LEFT, RS_RIGHT}) rs_set_tolerance(rs_wheelset_contact(set.handle, side), tolerance, nullptr);
}

rs_wheelset_state running(double y, double yaw) {
  rs_wheelset_state out = loaded(y, yaw);
  out.y_rate = 4e-3;
  out.yaw_rate = -5e-3;
  out.pitch_rate = 0.02;
  out.rail_y[RS_LEFT] = 0.1e-3;
  out.rail_z[RS_RIGHT] = -0.1e-3;
  return out;
}

rs_wheelset_derivatives derivative(Set& set, int input) {
  rs_wheelset_derivatives out{};
  out.size = sizeof out;
  EXPECT_EQ(rs_wheelset_jacobian(set.handle, &input, 1, &out, &set.error), RS_OK) << set.error.message;
  return out;
}

/// Of cold solutions: z, roll, forces, moments.
std::array<double, 8> numbers_at(Set& cold, rs_wheelset_state state, const Input& input, double by) {
  number_in(state, input.offset) += by;
  rs_wheelset_forget(cold.handle);
  EXPECT_EQ(cold.solve(state), RS_OK) << cold.error.message;
  const rs_wheelset_forces& f = cold.forces;
  return {f.z, f.roll, f.force[0], f.force[1], f.force[2], f.moment[0], f.moment[1], f.moment[2]};
}

void expect_differences(Set& set, Set& cold, const rs_wheelset_state& state, const Input& input) {
  constexpr double kClose = 1e-4, kRoundOff = 2e-14;  // the latter of z and roll that are found: m, rad
  const rs_wheelset_derivatives d = derivative(set, input.number);
  const auto more = numbers_at(cold, state, input, input.step), less = numbers_at(cold, state, input, -input.step);
  const double found[] = {d.z, d.roll, d.force[0], d.force[1], d.force[2], d.moment[0], d.moment[1], d.moment[2]};
  const auto slope = [&](std::size_t k) { return (more[k] - less[k]) / (2 * input.step); };
  const std::array<std::size_t, 3> ends{2, 5, 8};
  std::size_t begin = 0;
  for (const std::size_t end : ends) {
    double scale = begin == 0 ? kRoundOff / (kClose * input.step) : 0;
    for (std::size_t k = begin; k < end; ++k) scale = std::max(scale, std::abs(slope(k)));
    for (std::size_t k = begin; k < end; ++k)
      EXPECT_NEAR(found[k], slope(k), kClose * scale) << "number " << k << " by input " << input.number;
    begin = end;
  }
  for (int i : {0, 1, 2}) {
    EXPECT_NEAR(d.left_force[i] + d.right_force[i], d.force[i], 1e-9 * std::abs(d.left_force[i]));
    EXPECT_NEAR(d.left_moment[i] + d.right_moment[i], d.moment[i], 1e-9 * std::abs(d.left_moment[i]));
  }
}

void expect_slopes(const std::string& text, double y, double yaw) {
  Set set(text), cold(text);
  sharpen(set, 1e-8);
  sharpen(cold, 1e-11);
  rs_wheelset_state state = running(y, yaw);
  ASSERT_EQ(set.solve(state), RS_OK) << set.error.message;
  for (const auto& inputs : {std::vector<Input>(std::begin(kMotions), std::end(kMotions)),
                             std::vector<Input>(std::begin(kLoaded), std::end(kLoaded))})
    for (const Input& input : inputs) expect_differences(set, cold, state, input);
  state.given = RS_WHEELSET_Z | RS_WHEELSET_ROLL;
  state.z = set.forces.z;
  state.roll = set.forces.roll;
  ASSERT_EQ(set.solve(state), RS_OK) << set.error.message;
  for (const auto& inputs : {std::vector<Input>(std::begin(kMotions), std::end(kMotions)),
                             std::vector<Input>(std::begin(kPressed), std::end(kPressed))})
    for (const Input& input : inputs) expect_differences(set, cold, state, input);
}

TEST(SlowWheelsetDerivatives, AreThoseOfColdSolutions) {
  expect_slopes(kEuropeanCase, 2e-3, 1e-3);
  expect_slopes(kEuropeanCase, -3.1e-3, -2e-3);
  expect_slopes(kChineseCase, 4e-3, 1e-3);
}

// Tread and gauge corner, tried apart and in one plane.
TEST(SlowWheelsetDerivatives, OfPlacesInOnePlaneAreThoseOfColdSolutions) { expect_slopes(kEuropeanCase, 5.3e-3, 1e-3); }

TEST(WheelsetDerivatives, OfPlacesInOnePlaneAreThoseOfColdSolutions) {
  Set set(kEuropeanCase), cold(kEuropeanCase);
  sharpen(set, 1e-8);
  sharpen(cold, 1e-11);
  rs_wheelset_state state = running(5.27e-3, 1e-3);
  ASSERT_EQ(set.solve(state), RS_OK) << set.error.message;
  EXPECT_EQ(set.forces.wheel[RS_LEFT].patches, 2);
  state.given = RS_WHEELSET_Z | RS_WHEELSET_ROLL;
  state.z = set.forces.z;
  state.roll = set.forces.roll;
  ASSERT_EQ(set.solve(state), RS_OK) << set.error.message;
  for (const Input& input : kPressed) expect_differences(set, cold, state, input);
}

TEST(WheelsetDerivatives, OfSectionsAreThoseOfColdSolutions) {
  const std::string text = std::string(kChineseCase) + "[bem]\nbodies = \"sections\"\n";
  Set set(text), cold(text);
  sharpen(set, 1e-8);
  sharpen(cold, 1e-11);
  const rs_wheelset_state state = running(2e-3, 1e-3);
  ASSERT_EQ(set.solve(state), RS_OK) << set.error.message;
  for (const Input& input : {kMotions[0], kMotions[1], kMotions[4], kMotions[9], kLoaded[0]})
    expect_differences(set, cold, state, input);
}

TEST(WheelsetDerivatives, UnderACladOnSpringsAreThoseOfColdSolutions) {
  const std::string text = clad_on_springs("20000", "5000");
  Set set(text), cold(text);
  sharpen(set, 1e-8);
  sharpen(cold, 1e-11);
  const rs_wheelset_state state = running(2e-3, 1e-3);
  ASSERT_EQ(set.solve(state), RS_OK) << set.error.message;
  for (const Input& input : {kMotions[0], kMotions[4], kMotions[9], kLoaded[0]})
    expect_differences(set, cold, state, input);
}

// The pressure of the cell is smaller than what the step of the derivative changes.
TEST(WheelsetDerivatives, WhereACellBeginsToTouchAreThoseOfTheSideWhereItTouches) {
  constexpr double kStep = 2e-9, kClose = 1e-4;  // m
  Set set(kEuropeanCase);
  sharpen(set, 1e-11);
  rs_wheelset_state state = running(2e-3, 1e-3);
  ASSERT_EQ(set.solve(state), RS_OK) << set.error.message;
  state.given = RS_WHEELSET_Z | RS_WHEELSET_ROLL;
  state.roll = set.forces.roll;
  const int cells = set.forces.wheel[RS_LEFT].cells;
  const auto forces_at = [&](double z) {
    state.z = z;
    rs_wheelset_forget(set.handle);
    EXPECT_EQ(set.solve(state), RS_OK) << set.error.message;
    return set.forces;
  };
  double without = set.forces.z, with = without - 5e-6;
  ASSERT_EQ(forces_at(without).wheel[RS_LEFT].cells, cells);
  ASSERT_GT(forces_at(with).wheel[RS_LEFT].cells, cells);
  while (without - with > 1e-13) {
    const double middle = 0.5 * (without + with);
    (forces_at(middle).wheel[RS_LEFT].cells == cells ? without : with) = middle;
  }
  const rs_wheelset_forces deeper = forces_at(with - kStep), here = forces_at(with);
  const rs_wheelset_derivatives d = derivative(set, RS_BY_Z);
  for (int i : {0, 1, 2})
    EXPECT_NEAR(d.left_force[i], (here.wheel[RS_LEFT].force[i] - deeper.wheel[RS_LEFT].force[i]) / kStep,
                kClose * std::abs(d.left_force[2]));
}

struct WheelsetDerivativesOf : OfBothPairs {
  const std::string text{case_of(GetParam())};
};
INSTANTIATE_TEST_SUITE_P(Pairs, WheelsetDerivativesOf, testing::ValuesIn(kBothPairs), OfBothPairs::name);

TEST_P(WheelsetDerivativesOf, UnderALoadKeepLoadAndMoment) {
  Set set(text);
  ASSERT_EQ(set.solve(running(2e-3, 1e-3)), RS_OK) << set.error.message;
  EXPECT_NEAR(derivative(set, RS_BY_LOAD).force[2], 1, 1e-9);
  EXPECT_NEAR(derivative(set, RS_BY_ROLL_MOMENT).moment[0], -1, 1e-9);
  const rs_wheelset_derivatives by_y = derivative(set, RS_BY_Y);
  EXPECT_NEAR(by_y.force[2] / by_y.force[1], 0, 1e-9);
  EXPECT_NEAR(by_y.moment[0] / by_y.force[1], 0, 1e-9);
}

TEST_P(WheelsetDerivativesOf, OfResultsAndOfNoSolutionAreRefused) {
  Set set(text);
  rs_wheelset_derivatives out{};
  out.size = sizeof out;
  const auto answer = [&](int input) { return rs_wheelset_jacobian(set.handle, &input, 1, &out, &set.error); };
  EXPECT_EQ(answer(RS_BY_Y), RS_CASE);
  ASSERT_EQ(set.solve(loaded(2e-3)), RS_OK) << set.error.message;
  for (int input : {RS_BY_Z, RS_BY_ROLL, -1, 19, RS_OF_RIGHT}) EXPECT_EQ(answer(input), RS_CASE) << input;
  EXPECT_EQ(answer(RS_BY_RAIL_YAW + RS_OF_RIGHT), RS_OK) << set.error.message;
  out.size = 8;
  EXPECT_EQ(answer(RS_BY_Y), RS_CASE);
}

}  // namespace
}  // namespace railstrata
