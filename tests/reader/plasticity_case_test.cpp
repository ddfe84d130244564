#include <gtest/gtest.h>

#include "core/faults.hpp"
#include "reader/case_file.hpp"
#include "rules/clashes.hpp"

namespace railstrata {
namespace {

const std::string kYields = "[material.rail]\nyield_strength = \"500 MPa\"\n[run]\nplasticity = true\n";

TEST(PlasticityCase, KeysAreReadInSiUnits) {
  const RunSpec run = parse_case(kYields + "plastic_depth = \"12 mm\"\nplastic_width = \"9 mm\"\n", "a.toml").spec.run;
  EXPECT_TRUE(run.plasticity);
  EXPECT_EQ(run.plastic_depth, 12e-3);
  EXPECT_EQ(run.plastic_width, 9e-3);
  EXPECT_FALSE(parse_case("", "a.toml").spec.run.plasticity);
}

TEST(PlasticityCase, WhatDoesNotYieldRightlyIsRefusedWithARemedy) {
  const auto refused = [](const std::string& text, const std::string& key, const std::string& remedy) {
    try {
      parse_case(text, "a.toml");
      ADD_FAILURE() << text;
    } catch (const CaseError& e) {
      for (const std::string& word : {key, std::string("run.plasticity = true"), remedy})
        EXPECT_NE(std::string(e.what()).find(word), std::string::npos) << e.what();
    }
  };
  refused(kYields + "[mesh]\nelement = \"one_point\"\n", "mesh.element", "\"full\"");
}

TEST(PlasticityCase, ABoxWithoutPlasticityIsSaidToBeIdle) {
  const CaseSpec spec = parse_case("[run]\nplastic_depth = \"12 mm\"\n", "a.toml").spec;
  EXPECT_EQ(idle_settings(spec).size(), 1);
}

}  // namespace
}  // namespace railstrata
