#include <gtest/gtest.h>

#include "core/faults.hpp"
#include "reader/case_file.hpp"

namespace railstrata {
namespace {

const std::string kYields = "[material.rail]\nyield_strength = \"500 MPa\"\n[run]\nplasticity = true\n";

TEST(PlasticityCase, IsAskedForAndNoDefault) {
  EXPECT_TRUE(parse_case(kYields, "a.toml").spec.run.plasticity);
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

}  // namespace
}  // namespace railstrata
