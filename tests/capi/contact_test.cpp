// The C interface: the same numbers as the C++ one, states, errors, fields.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include "ask/library.hpp"
#include "capi/railstrata.h"
#include "tests/capi/contact_handle.hpp"

namespace railstrata {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
struct CPairs : OfBothPairs {};
INSTANTIATE_TEST_SUITE_P(Pairs, CPairs, testing::ValuesIn(kBothPairs), OfBothPairs::name);

TEST_P(CPairs, HaveTheNumbersOfTheCppInterface) {
  Handle contact(GetParam());
  ASSERT_NE(contact.handle, nullptr) << contact.error.message;
  ASSERT_EQ(rs_solve(contact.handle, nullptr, &contact.forces, &contact.error), RS_OK) << contact.error.message;
  HalfSpaceSettings settings;
  settings.cell = 0.5e-3;
  const CaseResult result = solve_by_half_spaces(load_case(kQuick, {GetParam().begin(), GetParam().end()}), settings);
  const ContactSummary& c = result.summary.contact;
  EXPECT_EQ(contact.forces.p_max, c.patch.p_max);
  EXPECT_EQ(contact.forces.force_x, c.F_x);
  EXPECT_EQ(contact.forces.creepage_x, c.creepage_x);
  EXPECT_EQ(contact.forces.checks_hold, 1) << rs_remarks(contact.handle);
  int nx = 0, ny = 0;
  ASSERT_EQ(rs_points(contact.handle, 0, &nx, &ny, nullptr), RS_OK);
  std::vector<double> p(static_cast<std::size_t>(nx * ny));
  ASSERT_EQ(rs_field(contact.handle, 0, RS_PRESSURE, p.data(), p.size(), nullptr), RS_OK);
  EXPECT_EQ(p, result.patch.p);
}

TEST_P(CPairs, HaveInAStateTheNumbersOfItsCase) {
  std::vector<const char*> changes{
      "geometry.lateral_shift=0.5 mm", "drive.creepage=-0.0008", "drive.spin=0.1 1/m",
      "drive.lateral_creepage=0.0005", "drive.speed=20 m/s",     "drive.friction_coefficient=0.4",
      "vehicle.wheel_load=70 kN"};
  changes.insert(changes.end(), GetParam().begin(), GetParam().end());
  Handle contact(GetParam()), other(changes);
  ASSERT_NE(other.handle, nullptr) << other.error.message;
  rs_state state =
      state_of(RS_LATERAL_SHIFT | RS_CREEPAGE_X | RS_CREEPAGE_Y | RS_SPIN | RS_SPEED | RS_FRICTION | RS_LOAD);
  state.lateral_shift = 0.5e-3;
  state.creepage_x = -0.0008;
  state.creepage_y = 0.0005;
  state.spin = 0.1;
  state.speed = 20;
  state.friction = 0.4;
  state.load = 70e3;
  ASSERT_EQ(contact.solve(state), RS_OK) << contact.error.message;
  ASSERT_EQ(rs_solve(other.handle, nullptr, &other.forces, nullptr), RS_OK);
  EXPECT_NEAR(contact.forces.force_x, other.forces.force_x, 1e-9 * std::abs(other.forces.force_x));
  EXPECT_NEAR(contact.forces.force_y, other.forces.force_y, 1e-9 * std::abs(other.forces.force_x));
  EXPECT_NEAR(contact.forces.p_max, other.forces.p_max, 1e-9 * other.forces.p_max);
  EXPECT_NEAR(contact.forces.dissipation, other.forces.dissipation, 1e-9 * other.forces.dissipation);
}

TEST_P(CPairs, GivenForcesComeOutAndTheNextStateKnowsNothingOfThem) {
  Handle contact(GetParam());
  rs_state pulled = state_of(RS_FORCE_X | RS_FORCE_Y);
  pulled.force_x = 12e3;
  pulled.force_y = -4e3;
  ASSERT_EQ(contact.solve(pulled), RS_OK) << contact.error.message;
  EXPECT_NEAR(contact.forces.force_x, 12e3, 1);
  EXPECT_NEAR(contact.forces.lateral_force, -4e3, 1);
  const double creepage = contact.forces.creepage_x;
  rs_state rolled = state_of(RS_CREEPAGE_X | RS_CREEPAGE_Y);
  rolled.creepage_x = creepage;
  rolled.creepage_y = contact.forces.creepage_y;
  ASSERT_EQ(contact.solve(rolled), RS_OK) << contact.error.message;
  EXPECT_NEAR(contact.forces.force_x, 12e3, 12);
  EXPECT_NEAR(contact.forces.creepage_x, creepage, 1e-12);
}

TEST_P(CPairs, AnApproachGivesTheLoadThatGaveIt) {
  Handle contact(GetParam());
  rs_state loaded = state_of(RS_LOAD | RS_CREEPAGE_X);
  loaded.load = 80e3;
  ASSERT_EQ(contact.solve(loaded), RS_OK) << contact.error.message;
  rs_state pressed = state_of(RS_APPROACH | RS_CREEPAGE_X);
  pressed.approach = contact.forces.approach;
  ASSERT_EQ(contact.solve(pressed), RS_OK) << contact.error.message;
  EXPECT_NEAR(contact.forces.force_z, 80e3, 80e3 * 1e-4);
}

TEST_P(CPairs, HaveStressesInEquilibriumWithThePressureAtTheSurface) {
  Handle contact(GetParam());
  ASSERT_EQ(rs_solve(contact.handle, nullptr, &contact.forces, nullptr), RS_OK);
  double pressure = 0, below = 0, s[12];
  for (double y = -6e-3; y <= 6e-3; y += 0.5e-3) {
    const double xyz[] = {0, y, 0, 0, y, 1e-3};
    ASSERT_EQ(rs_stress(contact.handle, RS_RAIL, xyz, 2, s, &contact.error), RS_OK) << contact.error.message;
    pressure = std::max(pressure, -s[2]);
    below = std::max(below, -s[8]);
  }
  EXPECT_NEAR(pressure, contact.forces.p_max, 0.1 * contact.forces.p_max);
  EXPECT_LT(below, pressure);
  const double far[] = {100, 0, 1e-3};
  EXPECT_EQ(rs_stress(contact.handle, RS_RAIL, far, 1, s, &contact.error), RS_CASE);
  EXPECT_NE(std::string(contact.error.message).find("too far away"), std::string::npos) << contact.error.message;
}

TEST_P(CPairs, RefuseADriveOfACaseAtRest) {
  std::vector<const char*> at_rest = GetParam();
  at_rest.push_back("run.rolling=false");
  Handle contact(at_rest);
  rs_state state = state_of(RS_CREEPAGE_X);
  state.creepage_x = 1e-3;
  EXPECT_EQ(contact.solve(state), RS_CASE);
  EXPECT_NE(std::string(contact.error.message).find("run.rolling"), std::string::npos) << contact.error.message;
  rs_state pressed = state_of(RS_LOAD);
  pressed.load = 80e3;
  EXPECT_EQ(contact.solve(pressed), RS_OK) << contact.error.message;
}

/// The pair of the case and the European one; how near solutions that start from others are to new ones.
struct Pair {
  std::vector<const char*> overrides;
  double near;
};
const Pair kPairs[] = {{{}, 2e-5}, {kEuropean, 1e-4}};

TEST(CInterface, SolutionsThatStartFromTheOneBeforeAgreeWithNewOnes) {
  for (const Pair& pair : kPairs) {
    Handle warm(pair.overrides);
    rs_state state = state_of(RS_LATERAL_SHIFT | RS_CREEPAGE_X);
    for (const double shift : {-1e-3, -0.9e-3, -0.8e-3, 2e-3, 2.1e-3}) {
      state.lateral_shift = shift;
      state.creepage_x = -1e-3 + 0.1 * shift;
      ASSERT_EQ(warm.solve(state), RS_OK) << warm.error.message;
      Handle cold(pair.overrides);
      ASSERT_EQ(cold.solve(state), RS_OK);
      for (const auto member : {&rs_forces::force_x, &rs_forces::p_max, &rs_forces::normal_force})
        EXPECT_NEAR(warm.forces.*member, cold.forces.*member, pair.near * std::abs(cold.forces.*member)) << shift;
      rs_forget(warm.handle);
      ASSERT_EQ(warm.solve(state), RS_OK);
      EXPECT_EQ(warm.forces.force_x, cold.forces.force_x) << shift;
    }
  }
}

void expect_same_after_a_jump(const Pair& pair) {
  Handle warm(pair.overrides), again(pair.overrides);
  const auto steps = [](double from, double step, int count) {
    std::vector<double> out;
    for (int k = 0; k < count; ++k) out.push_back(from + k * step);
    return out;
  };
  std::vector<double> shifts = steps(-1e-3, 0.02e-3, 5);  // along a line, on, back, and far away
  for (const auto& more : {steps(-0.93e-3, -0.01e-3, 3), steps(2.5e-3, 0.04e-3, 3), steps(-2e-3, 0.1e-3, 3)})
    shifts.insert(shifts.end(), more.begin(), more.end());
  for (const double shift : shifts) {
    rs_state state = state_of(RS_LATERAL_SHIFT | RS_CREEPAGE_X | RS_LOAD);
    state.lateral_shift = shift;
    state.creepage_x = -1e-3 + 0.05 * shift;
    state.load = 85e3 + 1e6 * shift;
    ASSERT_EQ(warm.solve(state), RS_OK) << warm.error.message;
    ASSERT_EQ(again.solve(state), RS_OK) << again.error.message;
    Handle cold(pair.overrides);
    ASSERT_EQ(cold.solve(state), RS_OK) << cold.error.message;
    for (const auto member : {&rs_forces::force_x, &rs_forces::p_max, &rs_forces::q_max, &rs_forces::approach,
                              &rs_forces::normal_force, &rs_forces::dissipation}) {
      EXPECT_EQ(warm.forces.*member, again.forces.*member) << "the same sequence, the same bits";
      EXPECT_NEAR(warm.forces.*member, cold.forces.*member, pair.near * std::abs(cold.forces.*member)) << shift;
    }
    EXPECT_NEAR(warm.forces.force_y, cold.forces.force_y, pair.near * std::abs(cold.forces.force_x)) << shift;
    EXPECT_EQ(warm.forces.cells, cold.forces.cells) << shift;
  }
}

TEST(CInterface, SolutionsAlongALineAndAfterAJumpAgreeWithNewOnes) {
  for (const auto& pair : kPairs) expect_same_after_a_jump(pair);
}

TEST(CInterface, FaultsHaveACodeAndAText) {
  rs_error error{};
  EXPECT_EQ(rs_contact_new("/no/such/case.toml", nullptr, 0, &error), nullptr);
  EXPECT_NE(error.code, RS_OK);
  EXPECT_NE(std::strlen(error.message), 0u);
  EXPECT_EQ(rs_contact_new(nullptr, nullptr, 0, nullptr), nullptr);
  const char* wrong[] = {"drive.no_such=1"};
  EXPECT_EQ(rs_contact_new(kQuick.c_str(), wrong, 1, &error), nullptr);
  EXPECT_EQ(error.code, RS_CASE);
  const char* missing[] = {"drive.speed=10 m/s", nullptr};
  EXPECT_EQ(rs_contact_new(kQuick.c_str(), missing, 2, &error), nullptr);
  EXPECT_EQ(error.code, RS_CASE);
  EXPECT_NE(std::string(error.message).find("override 1 is NULL"), std::string::npos) << error.message;
  EXPECT_EQ(rs_contact_from_text("[mesh]\nelement_size = 1\n", nullptr, 0, &error), nullptr);
  EXPECT_EQ(error.code, RS_CASE);

  Handle contact;
  int nx = 0;
  EXPECT_EQ(rs_points(contact.handle, 0, &nx, nullptr, nullptr), RS_CASE);  // nothing is solved yet
  EXPECT_EQ(rs_set_cell(contact.handle, kNaN, nullptr), RS_CASE);
  EXPECT_EQ(rs_solve(nullptr, nullptr, &contact.forces, nullptr), RS_CASE);
  EXPECT_EQ(rs_solve(contact.handle, nullptr, nullptr, nullptr), RS_CASE);
}

TEST_P(CPairs, RefuseStatesThatCannotBeAndKeepNoSolution) {
  Handle contact(GetParam());
  ASSERT_EQ(rs_solve(contact.handle, nullptr, &contact.forces, nullptr), RS_OK);
  const auto refused = [&](rs_state state, const std::string& word, int wanted = RS_CASE) {
    const int code = contact.solve(state);
    EXPECT_EQ(code, wanted) << word;
    EXPECT_NE(std::string(contact.error.message).find(word), std::string::npos) << contact.error.message;
  };
  rs_state state = state_of(RS_FRICTION);
  state.friction = -0.1;
  refused(state, "friction");
  state = state_of(RS_LOAD);
  state.load = kNaN;
  refused(state, "load");
  refused(state_of(RS_LOAD | RS_APPROACH), "both");
  refused(state_of(RS_CREEPAGE_X | RS_FORCE_X), "both");
  refused(state_of(1u << 20), "bits");
  state = state_of(0);
  state.size = 8;
  refused(state, "size");
  state = state_of(RS_FORCE_X);
  state.force_x = 1e9;
  refused(state, "friction", RS_NO_ANSWER);
  state = state_of(RS_LOAD);
  state.load = 1e11;
  refused(state, "flattens", RS_NO_ANSWER);
  int nx = 0;
  EXPECT_EQ(rs_points(contact.handle, 0, &nx, nullptr, nullptr), RS_CASE);
}

TEST(CInterface, NumbersOfTheCaseAreThereByTheirKeys) {
  Handle contact({"material.rail.young=200 GPa", "layer.0.thickness=1.5 mm", "drive.speed=72 km/h"});
  double number = 0;
  const auto asked = [&](const char* key) {
    EXPECT_EQ(rs_contact_number(contact.handle, key, &number, &contact.error), RS_OK) << contact.error.message;
    return number;
  };
  EXPECT_EQ(asked("material.rail.young"), 200e9);
  EXPECT_EQ(asked("layer.0.thickness"), 1.5e-3);
  EXPECT_EQ(asked("drive.speed"), 20);
  EXPECT_EQ(asked("geometry.wheel_radius"), 0.43);
  EXPECT_EQ(asked("run.rolling"), 1);
  EXPECT_TRUE(std::isnan(asked("drive.spin"))) << "the geometry's";
  const auto refused = [&](const char* key, const std::string& word) {
    EXPECT_EQ(rs_contact_number(contact.handle, key, &number, &contact.error), RS_CASE) << key;
    EXPECT_NE(std::string(contact.error.message).find(word), std::string::npos) << contact.error.message;
  };
  refused("material.rail.yung", "did you mean material.rail.young");
  refused("geometry.rail_profile", "not a single number");
  refused("layer.7.thickness", "the case has");
  refused("layer.thickness", "no key");
  refused("vehicle.wheel_load", "ask for sprung_mass");
  refused("", "no key");
  EXPECT_EQ(rs_contact_number(contact.handle, nullptr, &number, nullptr), RS_CASE);
}

TEST_P(CPairs, RefuseSizesOfNoVersion) {
  Handle contact(GetParam());
  rs_state state = state_of(0);
  for (const std::size_t size : {std::size_t{0}, std::size_t{104}, sizeof(rs_state) + 8}) {
    state.size = size;
    EXPECT_EQ(contact.solve(state), RS_CASE) << size;
    EXPECT_NE(std::string(contact.error.message).find("sizeof(rs_state)"), std::string::npos) << contact.error.message;
  }
  ASSERT_EQ(contact.solve(state_of(0)), RS_OK) << contact.error.message;
  rs_derivatives slopes[2]{};
  slopes[0].size = sizeof(rs_derivatives);
  const unsigned inputs[] = {RS_LOAD, RS_YAW};
  EXPECT_EQ(rs_jacobian(contact.handle, inputs, 2, slopes, &contact.error), RS_CASE);
  EXPECT_NE(std::string(contact.error.message).find("element 1"), std::string::npos) << contact.error.message;
}

TEST_P(CPairs, WithALiftedWheelHaveNoForces) {
  Handle contact(GetParam());
  rs_state state = state_of(RS_APPROACH | RS_CREEPAGE_X);
  state.creepage_x = 1e-3;
  for (const double approach : {1e-5, 0.0, -1e-6}) {
    state.approach = approach;
    ASSERT_EQ(contact.solve(state), RS_OK) << contact.error.message;
    EXPECT_EQ(contact.forces.force_z > 0, approach > 0);
    EXPECT_EQ(contact.forces.approach, approach);
    EXPECT_EQ(contact.forces.creepage_x, 1e-3);
  }
  EXPECT_EQ(contact.forces.cells, 0);
  EXPECT_EQ(contact.forces.patches, 0);
  EXPECT_EQ(contact.forces.force_x, 0);
  int nx = 0;
  EXPECT_EQ(rs_points(contact.handle, 0, &nx, nullptr, &contact.error), RS_CASE);
  EXPECT_NE(std::string(contact.error.message).find("lifted"), std::string::npos) << contact.error.message;
  rs_state unloaded = state_of(RS_LOAD);
  EXPECT_EQ(contact.solve(unloaded), RS_OK) << contact.error.message;
  EXPECT_EQ(contact.forces.cells, 0);
  const unsigned input = RS_LOAD;
  rs_derivatives slope{};
  slope.size = sizeof(slope);
  EXPECT_EQ(rs_jacobian(contact.handle, &input, 1, &slope, &contact.error), RS_OK) << contact.error.message;
  EXPECT_EQ(slope.force_x, 0);
  state.friction = -1;
  state.given |= RS_FRICTION;
  EXPECT_EQ(contact.solve(state), RS_CASE);  // a mistake is one of a lifted wheel too
}

/// A contact under two loads, the second from the solution of the first; its longitudinal forces.
std::vector<double> two_loads(double load) {
  Handle contact(kBothPairs[static_cast<std::size_t>(load / 2e3) % 2]);
  std::vector<double> out;
  for (const double share : {1.0, 1.05}) {
    rs_state state = state_of(RS_LOAD);
    state.load = share * load;
    EXPECT_EQ(contact.solve(state), RS_OK) << contact.error.message;
    out.push_back(contact.forces.force_x);
    out.push_back(contact.forces.p_max);
  }
  return out;
}

TEST_P(CPairs, MarkAWheelThatHasClimbedTheRail) {
  Handle h(GetParam());
  rs_state state = state_of(RS_LOAD | RS_LATERAL_SHIFT);
  state.load = 80e3;
  const double climbed = GetParam().empty() ? 28e-3 : 24e-3;  // LMA's crest reaches the rail later
  for (const double shift : {2e-3, climbed}) {
    state.lateral_shift = shift;
    ASSERT_EQ(h.solve(state), RS_OK) << h.error.message;
    const bool named = std::string(rs_remarks(h.handle)).find("contact_on_flange_crest") != std::string::npos;
    EXPECT_EQ(named, shift == climbed);
    EXPECT_EQ(h.forces.checks_hold, named ? 0 : 1);
  }
}

TEST(CInterface, EightContactsOnFourThreadsHaveTheBitsOfOne) {
  std::vector<std::vector<double>> alone(8), together(8);
  for (std::size_t k = 0; k < alone.size(); ++k) alone[k] = two_loads(70e3 + 2e3 * static_cast<double>(k));
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < 4; ++t)
    threads.emplace_back([&together, t] {
      for (std::size_t k = t; k < together.size(); k += 4) together[k] = two_loads(70e3 + 2e3 * static_cast<double>(k));
    });
  for (std::thread& t : threads) t.join();
  EXPECT_EQ(together, alone);
  EXPECT_NE(alone[0], alone[1]);
}

// The line through the descents of the first two ends below zero: a plane where the wheel is lifted must not stay.
TEST(CContact, AStateFarFromThoseBeforeHasTheForcesOfANewContact) {
  Handle contact(kEuropean), other(kEuropean);
  rs_state state = state_of(RS_LOAD | RS_LATERAL_SHIFT | RS_YAW | RS_CREEPAGE_X | RS_CREEPAGE_Y | RS_FRICTION);
  const double states[][6] = {{98.8e3, 1.2e-3, -0.954e-3, 0.511e-3, 0.728e-3, 0.255},
                              {52.7e3, 0.48e-3, -1.796e-3, -0.271e-3, 0.573e-3, 0.266},
                              {96e3, -3.154e-3, -2.463e-3, -0.028e-3, -0.737e-3, 0.377}};
  for (Handle* one : {&contact, &other}) rs_set_cell(one->handle, 1e-3, nullptr);
  for (const auto& [load, shift, yaw, creepage_x, creepage_y, friction] : states) {
    state.load = load;
    state.lateral_shift = shift;
    state.yaw = yaw;
    state.creepage_x = creepage_x;
    state.creepage_y = creepage_y;
    state.friction = friction;
    rs_forget(other.handle);
    ASSERT_EQ(contact.solve(state), RS_OK) << contact.error.message;
    ASSERT_EQ(other.solve(state), RS_OK) << other.error.message;
    EXPECT_NEAR(contact.forces.force_x, other.forces.force_x, 2e-5 * load);
    EXPECT_NEAR(contact.forces.contact_angle, other.forces.contact_angle, 1e-6);
  }
}

}  // namespace
}  // namespace railstrata
