#pragma once
// A contact of the C interface that frees itself.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "capi/railstrata.h"
#include "tests/places.hpp"

namespace railstrata {

inline const std::string kQuick = source_dir() / "cases/quick/case.toml";

/// A European pair in place of LMA on CN60.
inline const std::vector<const char*> kEuropean{"geometry.wheel_profile=\"S1002\"", "geometry.rail_profile=\"UIC60\""};
/// The case's own pair and that one.
inline const std::vector<std::vector<const char*>> kBothPairs{{}, kEuropean};

/// A test of both.
struct OfBothPairs : testing::TestWithParam<std::vector<const char*>> {
  static std::string name(const testing::TestParamInfo<std::vector<const char*>>& pair) {
    return pair.param.empty() ? "LMA_CN60" : "S1002_UIC60";
  }
};

struct Handle {
  explicit Handle(const std::vector<const char*>& overrides = {})
      : handle(rs_contact_new(kQuick.c_str(), overrides.data(), static_cast<int>(overrides.size()), &error)) {
    rs_set_cell(handle, 0.5e-3, nullptr);
    forces.size = sizeof(rs_forces);
  }
  ~Handle() { rs_contact_free(handle); }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  int solve(const rs_state& state) { return rs_solve(handle, &state, &forces, &error); }
  rs_error error{};
  rs_contact* handle;
  rs_forces forces{};
};

inline rs_state state_of(unsigned given) {
  rs_state out{};
  out.size = sizeof(rs_state);
  out.given = given;
  return out;
}

}  // namespace railstrata
