#include <gtest/gtest.h>

#include "core/faults.hpp"
#include "reader/case_file.hpp"
#include "rules/clashes.hpp"

namespace railstrata {
namespace {

TEST(DeviceCase, TheDeviceIsReadAndWrittenBack) {
  EXPECT_EQ(parse_case("", "a.toml").spec.run.device, ComputeDevice::cpu);
  const LoadedCase loaded = parse_case("[run]\ndevice = \"gpu\"\n", "a.toml");
  EXPECT_EQ(loaded.spec.run.device, ComputeDevice::gpu);
  EXPECT_EQ(parse_case(loaded.resolved_toml, "a.toml").spec.run.device, ComputeDevice::gpu);
}

TEST(DeviceCase, WhatADeviceDoesNotTakeIsRefusedWithARemedy) {
  const auto refused = [](const std::string& text, const std::string& what) {
    try {
      parse_case(text, "a.toml");
      ADD_FAILURE() << text;
    } catch (const CaseError& e) {
      const std::string said = e.what();
      for (const std::string& word :
           {std::string("run.device = \"gpu\""), what, std::string("give run.device = \"cpu\"")})
        EXPECT_NE(said.find(word), std::string::npos) << said;
    }
  };
  refused("[run]\ndevice = \"gpu\"\nplasticity = true\n[material.rail]\nyield_strength = \"500 MPa\"\n",
          "run.plasticity = true");
  refused("[run]\ndevice = \"gpu\"\n[friction]\nlateral_table = [[\"0 mm\", 0.2], [\"9 mm\", 0.4]]\n",
          "friction.lateral_table");
}

TEST(DeviceCase, ItIsIdleWhereNothingRolls) {
  const CaseSpec spec = parse_case("[run]\ndevice = \"gpu\"\nrolling = false\n", "a.toml").spec;
  EXPECT_EQ(idle_settings(spec).size(), 1);
}

}  // namespace
}  // namespace railstrata
