// Many handles in one call: the bits of one after the other, errors of each, mistakes of the call.
#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "tests/capi/wheelset_handle.hpp"

namespace railstrata {
namespace {

constexpr int kMany = 5;

/// Copies of a contact, with a state of its own each.
struct Contacts {
  explicit Contacts(const std::vector<const char*>& overrides = {}) : first(overrides) {
    for (int k = 0; k < kMany; ++k) {
      handles.push_back(rs_contact_copy(first.handle, nullptr));
      states.push_back(state_of(RS_LOAD | RS_CREEPAGE_X));
      states.back().load = 70e3 + 3e3 * k;
      states.back().creepage_x = -1e-3;
      forces.push_back(first.forces);
    }
  }
  ~Contacts() {
    for (rs_contact* handle : handles) rs_contact_free(handle);
  }
  Contacts(const Contacts&) = delete;
  Contacts& operator=(const Contacts&) = delete;
  int solve(int threads) {
    return rs_solve_many(kMany, handles.data(), states.data(), forces.data(), errors.data(), threads);
  }
  Handle first;
  std::vector<rs_contact*> handles;
  std::vector<rs_state> states;
  std::vector<rs_forces> forces;
  std::array<rs_error, kMany> errors{};
};

struct CMany : OfBothPairs {};
INSTANTIATE_TEST_SUITE_P(Pairs, CMany, testing::ValuesIn(kBothPairs), OfBothPairs::name);

TEST_P(CMany, ContactsHaveTheBitsOfOneAfterTheOtherForAnyNumberOfThreads) {
  for (const int threads : {1, 2, 3, 0}) {
    Contacts many(GetParam()), alone(GetParam());
    for (int step = 0; step < 2; ++step) {
      ASSERT_EQ(many.solve(threads), RS_OK);
      for (std::size_t k = 0; k < kMany; ++k) {
        ASSERT_EQ(rs_solve(alone.handles[k], &alone.states[k], &alone.forces[k], nullptr), RS_OK);
        EXPECT_EQ(std::memcmp(&many.forces[k], &alone.forces[k], sizeof(rs_forces)), 0) << threads << " " << k;
        many.states[k].load += 1e3;
        alone.states[k].load += 1e3;
      }
    }
    EXPECT_NE(many.forces[0].p_max, many.forces[1].p_max);
  }
}

TEST_P(CMany, AnErrorOfOneLeavesTheAnswersOfTheOthers) {
  Contacts many(GetParam());
  many.states[2].creepage_x = 1e9;
  EXPECT_EQ(many.solve(2), RS_CASE);
  for (std::size_t k = 0; k < kMany; ++k) {
    EXPECT_EQ(many.errors[k].code, k == 2 ? RS_CASE : RS_OK) << k;
    EXPECT_EQ(many.forces[k].force_z > 0, k != 2) << k;
  }
  EXPECT_NE(std::string(many.errors[2].message).find("creepage_x"), std::string::npos) << many.errors[2].message;
  EXPECT_EQ(rs_solve_many(kMany, many.handles.data(), many.states.data(), many.forces.data(), nullptr, 2), RS_CASE);
}

TEST_P(CMany, MistakesOfTheCallSolveNothing) {
  Contacts many(GetParam());
  const auto refused = [&](const std::string& word, int threads = 1) {
    EXPECT_EQ(many.solve(threads), RS_CASE) << word;
    for (const rs_error& error : many.errors)
      EXPECT_NE(std::string(error.message).find(word), std::string::npos) << error.message;
    EXPECT_EQ(many.forces[0].force_z, 0);
  };
  std::swap(many.handles[1], many.handles[4]);
  rs_contact* const kept = many.handles[3];
  many.handles[3] = many.handles[1];
  refused("handles 1 and 3 are the same");
  many.handles[3] = kept;
  refused("-1 threads", -1);
  many.forces[4].size -= 8;
  refused("element 4");
  EXPECT_EQ(rs_solve_many(-1, nullptr, nullptr, nullptr, nullptr, 0), RS_CASE);
  EXPECT_EQ(rs_solve_many(1, nullptr, nullptr, nullptr, nullptr, 0), RS_CASE);
  EXPECT_EQ(rs_solve_many(0, nullptr, nullptr, nullptr, nullptr, 0), RS_OK);
}

TEST_P(CMany, WheelsetsHaveTheBitsOfOneAfterTheOther) {
  const std::string text = case_of(GetParam());
  Set set(text), other(text);
  rs_wheelset* const copy = rs_wheelset_copy(set.handle, nullptr);
  rs_wheelset* const handles[] = {set.handle, copy};
  const rs_wheelset_state states[] = {loaded(1e-3), loaded(-2e-3)};
  rs_wheelset_forces forces[] = {set.forces, set.forces};
  ASSERT_EQ(rs_wheelset_solve_many(2, handles, states, forces, nullptr, 2), RS_OK);
  for (int k : {0, 1}) {
    rs_wheelset_forget(other.handle);
    ASSERT_EQ(other.solve(states[k]), RS_OK) << other.error.message;
    EXPECT_EQ(std::memcmp(&forces[k], &other.forces, sizeof(rs_wheelset_forces)), 0) << k;
  }
  rs_wheelset_free(copy);
}

}  // namespace
}  // namespace railstrata
