#pragma once
// A wheelset of the C interface that frees itself.
#include <string>
#include <vector>

#include "tests/capi/contact_handle.hpp"

namespace railstrata {

inline constexpr const char* kEuropeanCase =
    "[geometry]\nwheel_profile = \"S1002\"\nrail_profile = \"UIC60\"\ncant = \"1:40\"\nwheel_radius = \"460 mm\"\n"
    "[drive]\nfriction_coefficient = 0.35\n";

/// The other pair without a layer.
inline constexpr const char* kChineseCase =
    "[geometry]\nwheel_profile = \"LMA\"\nrail_profile = \"CN60\"\ncant = \"1:40\"\n"
    "[drive]\nfriction_coefficient = 0.35\n";
/// The same under a clad whose interface has springs; MPa/mm, of opening and of slip.
inline std::string clad_on_springs(const std::string& normal, const std::string& shear) {
  return std::string(kChineseCase) +
         "[[layer]]\nthickness = \"3 mm\"\nyoung_ratio = 2\ninterface_normal_stiffness = \"" + normal +
         " MPa/mm\"\ninterface_shear_stiffness = \"" + shear + " MPa/mm\"\n";
}
/// The wheelset of a pair: none is the quick case.
inline std::string case_of(const std::vector<const char*>& pair) { return pair.empty() ? "" : kEuropeanCase; }

struct Set {
  explicit Set(const std::string& text = {}) {
    handle = text.empty() ? rs_wheelset_new(kQuick.c_str(), nullptr, 0, nullptr, 0, &error)
                          : rs_wheelset_from_text(text.c_str(), nullptr, 0, nullptr, 0, &error);
    forces.size = sizeof(rs_wheelset_forces);
    for (int side : {RS_LEFT, RS_RIGHT})
      if (handle) rs_set_cell(rs_wheelset_contact(handle, side), 1e-3, nullptr);
  }
  ~Set() { rs_wheelset_free(handle); }
  Set(const Set&) = delete;
  Set& operator=(const Set&) = delete;
  int solve(const rs_wheelset_state& state) { return rs_wheelset_solve(handle, &state, &forces, &error); }
  rs_error error{};
  rs_wheelset* handle = nullptr;
  rs_wheelset_forces forces{};
};

inline rs_wheelset_state loaded(double y = 0, double yaw = 0) {
  rs_wheelset_state out{};
  out.size = sizeof(rs_wheelset_state);
  out.given = RS_WHEELSET_LOAD;
  out.load = 160e3;
  out.speed = 20;
  out.y = y;
  out.yaw = yaw;
  return out;
}

}  // namespace railstrata
