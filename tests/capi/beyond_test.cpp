// Trial steps beyond what half-spaces bear: marked, continuous, an error where the mark has no place.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "tests/capi/wheelset_handle.hpp"

namespace railstrata {
namespace {

rs_state pressed(double approach) {
  rs_state out = state_of(RS_APPROACH | RS_CREEPAGE_X);
  out.approach = approach;
  out.creepage_x = -1e-3;
  return out;
}

struct Coarse : Handle {
  explicit Coarse(const std::vector<const char*>& overrides) : Handle(overrides) { rs_set_cell(handle, 1e-3, nullptr); }
};

struct Beyond : OfBothPairs {};
INSTANTIATE_TEST_SUITE_P(Pairs, Beyond, testing::ValuesIn(kBothPairs), OfBothPairs::name);

TEST_P(Beyond, AnApproachThatFlattensThePatchIsContinuedAndMarked) {
  Coarse contact(GetParam());
  ASSERT_EQ(contact.solve(pressed(1e-3)), RS_OK) << contact.error.message;
  EXPECT_EQ(contact.forces.beyond, 0);
  double before = contact.forces.force_z;
  for (const double approach : {3e-3, 4e-3, 6e-3}) {
    ASSERT_EQ(contact.solve(pressed(approach)), RS_OK) << contact.error.message;
    EXPECT_EQ(contact.forces.beyond, 1);
    EXPECT_EQ(contact.forces.checks_hold, 0);
    EXPECT_EQ(contact.forces.approach, approach);
    EXPECT_NE(std::string(rs_remarks(contact.handle)).find("beyond what half-spaces bear"), std::string::npos);
    EXPECT_GT(contact.forces.force_z, before);
    before = contact.forces.force_z;
  }
  Coarse other(GetParam());
  double force[3];
  for (int k = 0; k < 3; ++k) {
    ASSERT_EQ(other.solve(pressed((3 + k) * 1e-3)), RS_OK);
    force[k] = other.forces.force_z;
  }
  EXPECT_NEAR(force[2] - force[1], force[1] - force[0], 1e-3 * (force[1] - force[0])) << "along a line";
}

TEST_P(Beyond, WhereItBeginsTheForceJumpsByLittle) {
  Coarse contact(GetParam());
  double low = 1e-3, high = 3e-3, borne = 0;
  while (high - low > 1e-6) {
    const double middle = 0.5 * (low + high);
    rs_forget(contact.handle);
    ASSERT_EQ(contact.solve(pressed(middle)), RS_OK) << contact.error.message;
    (contact.forces.beyond ? high : low) = middle;
    if (!contact.forces.beyond) borne = contact.forces.force_z;
  }
  ASSERT_EQ(contact.solve(pressed(high)), RS_OK) << contact.error.message;
  ASSERT_EQ(contact.forces.beyond, 1);
  EXPECT_NEAR(contact.forces.force_z, borne, 0.02 * borne);
}

TEST_P(Beyond, LeavesNoTraceInTheSolutionsThatFollow) {
  Coarse contact(GetParam()), other(GetParam());
  ASSERT_EQ(contact.solve(pressed(0.1e-3)), RS_OK);
  ASSERT_EQ(other.solve(pressed(0.1e-3)), RS_OK);
  ASSERT_EQ(contact.solve(pressed(5e-3)), RS_OK);
  ASSERT_EQ(contact.forces.beyond, 1);
  ASSERT_EQ(contact.solve(pressed(0.11e-3)), RS_OK);
  ASSERT_EQ(other.solve(pressed(0.11e-3)), RS_OK);
  EXPECT_EQ(contact.forces.beyond, 0);
  EXPECT_EQ(contact.forces.force_x, other.forces.force_x);
}

TEST_P(Beyond, IsAnErrorWhereTheStructHasNoPlaceForTheMarkOrALoadIsGiven) {
  Coarse contact(GetParam());
  contact.forces.size = offsetof(rs_forces, beyond);
  EXPECT_EQ(contact.solve(pressed(5e-3)), RS_NO_ANSWER);
  contact.forces.size = sizeof(rs_forces);
  rs_state loaded_state = state_of(RS_LOAD);
  loaded_state.load = 1e9;
  EXPECT_EQ(contact.solve(loaded_state), RS_NO_ANSWER);
  Set set(case_of(GetParam()));
  ASSERT_EQ(set.solve(loaded()), RS_OK) << set.error.message;
  rs_wheelset_state state = loaded();
  state.given = RS_WHEELSET_Z | RS_WHEELSET_ROLL;
  state.z = set.forces.z - 5e-3;
  set.forces.size = offsetof(rs_wheelset_forces, beyond);
  EXPECT_EQ(set.solve(state), RS_NO_ANSWER);
}

TEST_P(Beyond, AWheelsetThatIsPressedTooFarIsMarkedWheelByWheel) {
  Set set(case_of(GetParam()));
  ASSERT_EQ(set.solve(loaded(1e-3)), RS_OK) << set.error.message;
  rs_wheelset_state state = loaded(1e-3);
  state.given = RS_WHEELSET_Z | RS_WHEELSET_ROLL;
  state.z = set.forces.z - 3e-3;
  ASSERT_EQ(set.solve(state), RS_OK) << set.error.message;
  EXPECT_EQ(set.forces.beyond, 2);
  const rs_wheel& left = set.forces.wheel[RS_LEFT];
  EXPECT_EQ(left.beyond, 1);
  EXPECT_EQ(left.checks_hold, 0);
  EXPECT_NEAR(left.moment[0] / left.force[2], left.point[1] - state.y, 0.02) << "an arm to the contact";
  EXPECT_NE(std::string(rs_wheelset_remarks(set.handle)).find("right wheel: check half_spaces"), std::string::npos);
  state.roll = 4e-3;
  ASSERT_EQ(set.solve(state), RS_OK) << set.error.message;
  EXPECT_EQ(set.forces.beyond, 1);
  EXPECT_EQ(set.forces.wheel[RS_LEFT].beyond + set.forces.wheel[RS_RIGHT].beyond, 1);
}

}  // namespace
}  // namespace railstrata
