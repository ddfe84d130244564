// Derivatives of the C interface against differences of new solutions.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "capi/railstrata.h"
#include "tests/capi/contact_handle.hpp"

namespace railstrata {
namespace {

/// An input, the step of its differences and what is a usual change of it, m, N, 1.
struct Input {
  unsigned bit;
  double rs_state::*member;
  double step, usual;
};
constexpr Input kInputs[] = {{RS_LOAD, &rs_state::load, 1, 10e3},
                             {RS_LATERAL_SHIFT, &rs_state::lateral_shift, 1e-7, 1e-3},
                             {RS_YAW, &rs_state::yaw, 1e-7, 1e-2},
                             {RS_CREEPAGE_X, &rs_state::creepage_x, 1e-8, 1e-3},
                             {RS_CREEPAGE_Y, &rs_state::creepage_y, 1e-8, 1e-3},
                             {RS_SPIN, &rs_state::spin, 1e-6, 0.1}};
/// An output and a hundredth of what it changes with usual changes of inputs: a derivative nearer to zero than that
/// counts as this.
struct Output {
  double rs_derivatives::*slope;
  double rs_forces::*value;
  double least;
};
constexpr Output kOutputs[] = {{&rs_derivatives::force_x, &rs_forces::force_x, 100},
                               {&rs_derivatives::force_y, &rs_forces::force_y, 100},
                               {&rs_derivatives::force_z, &rs_forces::force_z, 100},
                               {&rs_derivatives::spin_moment, &rs_forces::spin_moment, 0.5},
                               {&rs_derivatives::normal_force, &rs_forces::normal_force, 100},
                               {&rs_derivatives::lateral_force, &rs_forces::lateral_force, 100},
                               {&rs_derivatives::approach, &rs_forces::approach, 1e-6}};

rs_forces solved(Handle& contact, const rs_state& state) {
  rs_forget(contact.handle);
  EXPECT_EQ(contact.solve(state), RS_OK) << contact.error.message;
  return contact.forces;
}

/// Deviations of derivatives by rs_jacobian from central differences of new solutions.
struct Deviations {
  int compared = 0, at_jumps = 0;
  double largest = 0;
};

/// By each output: how far a derivative lies outside of the differences to both sides. It jumps where a cell comes into
/// contact or begins to slip, and lies between them there.
std::vector<double> wrong_by(Handle& contact, const rs_state& state, const rs_forces& here, const Input& in,
                             const rs_derivatives& slope, double step) {
  rs_state up = state, down = state;
  up.*in.member += step;
  down.*in.member -= step;
  const rs_forces more = solved(contact, up), less = solved(contact, down);
  std::vector<double> out;
  for (const Output& o : kOutputs) {
    const double above = (more.*o.value - here.*o.value) / step, below = (here.*o.value - less.*o.value) / step,
                 nearest = std::clamp(slope.*o.slope, std::min(above, below), std::max(above, below));
    out.push_back(std::abs(slope.*o.slope - nearest) / std::max(std::abs(nearest), o.least / in.usual));
  }
  return out;
}

/// Two jumps on both sides are told apart by smaller steps, above the round-off; beside a jump the error of a
/// difference falls with its step.
void compare(Handle& contact, const rs_state& state, Deviations& out) {
  constexpr double kClose = 1e-4;
  const rs_forces here = solved(contact, state);
  std::vector<unsigned> bits;
  for (const Input& in : kInputs) bits.push_back(in.bit);
  std::vector<rs_derivatives> slopes(bits.size());
  for (rs_derivatives& s : slopes) s.size = sizeof(rs_derivatives);
  const int count = static_cast<int>(bits.size());
  ASSERT_EQ(rs_jacobian(contact.handle, bits.data(), count, slopes.data(), &contact.error), RS_OK)
      << contact.error.message;
  for (std::size_t k = 0; k < bits.size(); ++k) {
    const std::vector<double> wrong = wrong_by(contact, state, here, kInputs[k], slopes[k], kInputs[k].step);
    out.compared += static_cast<int>(wrong.size());
    double largest = *std::max_element(wrong.begin(), wrong.end());
    if (largest > kClose) ++out.at_jumps;
    for (const double share : {0.3, 0.1, 0.03}) {
      if (!(largest > kClose)) break;
      const std::vector<double> nearer = wrong_by(contact, state, here, kInputs[k], slopes[k], share * kInputs[k].step);
      largest = std::min(largest, *std::max_element(nearer.begin(), nearer.end()));
    }
    out.largest = std::max(out.largest, largest);
  }
}

rs_state random_state(std::mt19937& random) {
  const auto within = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
  };
  rs_state out{};
  out.size = sizeof(out);
  out.given = RS_LOAD | RS_LATERAL_SHIFT | RS_YAW | RS_CREEPAGE_X | RS_CREEPAGE_Y | RS_SPIN;
  out.load = within(40e3, 120e3);
  out.lateral_shift = within(-3e-3, 3e-3);
  out.yaw = within(-5e-3, 5e-3);
  out.creepage_x = within(-2e-3, 2e-3);
  out.creepage_y = within(-2e-3, 2e-3);
  out.spin = within(-0.3, 0.3);
  return out;
}

/// Random states of a contact.
Deviations deviations(const std::vector<const char*>& overrides, int states) {
  Handle contact(overrides);
  EXPECT_NE(contact.handle, nullptr) << contact.error.message;
  rs_set_tolerance(contact.handle, 1e-12, nullptr);
  std::mt19937 random(1);
  Deviations out;
  for (int k = 0; k < states; ++k) compare(contact, random_state(random), out);
  testing::Test::RecordProperty("largest", std::to_string(out.largest));
  return out;
}

const std::vector<const char*> kUniform{"layer.0.young_ratio=1"}, kStiffLayer{};
const std::vector<const char*> kGivingInterface{"layer.0.interface_normal_stiffness=20000 MPa/mm",
                                                "layer.0.interface_shear_stiffness=5000 MPa/mm"};
const std::vector<const char*> kSections{"bem.bodies=sections"};
const std::vector<const char*> kCases[] = {kUniform, kStiffLayer, kGivingInterface, kEuropean, kSections};

TEST(CDerivatives, AreTheSlopesOfNewSolutions) {
  for (const auto& overrides : kCases) {
    const Deviations found = deviations(overrides, 2);
    EXPECT_LT(found.largest, 1e-4);
    EXPECT_LT(found.at_jumps, 0.05 * found.compared);
  }
}

TEST(SlowCDerivatives, AreTheSlopesOfNewSolutions) {
  for (const auto& overrides : kCases) {
    const Deviations found = deviations(overrides, 25);
    EXPECT_LT(found.largest, 1e-4);
    EXPECT_LT(found.at_jumps, 0.05 * found.compared);
  }
}

}  // namespace
}  // namespace railstrata
