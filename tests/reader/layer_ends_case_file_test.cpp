// Layers with ends and [[stretch]]: read, refused with place and remedy, written out again.
#include <gtest/gtest.h>

#include "reader/case_file.hpp"
#include "rules/irregularity_rules.hpp"
#include "rules/support.hpp"

namespace railstrata {
namespace {

std::string refusal(const std::string& text) {
  try {
    parse_case(text, "a.toml");
  } catch (const CaseError& e) {
    return e.what();
  }
  return "taken";
}

const std::string kClad = "[[layer]]\nname = \"clad\"\nthickness = \"3 mm\"\nyoung = \"300 GPa\"\n";
const std::string kStretch = "[[stretch]]\nalong = [[\"180 mm\", 1.0, 1.0], [\"200 mm\", 0.98, 0.75]]\n";

TEST(LayerEndsCaseFile, EndsAndStretchesAreReadAndWrittenOutAgain) {
  const LoadedCase loaded = parse_case(
      kClad + "from = \"150 mm\"\nto = \"260 mm\"\ntaper_length = \"10 mm\"\n" + kStretch + "depth = \"20 mm\"\n",
      "a.toml");
  const LayerSpec& layer = loaded.spec.layers.at(0);
  EXPECT_EQ(layer.from, 0.15);
  EXPECT_EQ(layer.to, 0.26);
  EXPECT_EQ(layer.taper_length, 0.01);
  const StretchSpec& stretch = loaded.spec.stretches.at(0);
  ASSERT_EQ(stretch.along.size(), 2u);
  EXPECT_EQ(stretch.along[1].x, 0.2);
  EXPECT_EQ(stretch.along[1].strength, 0.75);
  EXPECT_EQ(stretch.depth, 0.02);
  EXPECT_EQ(parse_case(loaded.resolved_toml, "b.toml").resolved_toml, loaded.resolved_toml);
  const std::string endless = parse_case(kClad, "a.toml").resolved_toml;
  for (const char* key : {"from", "taper_length", "stretch"}) EXPECT_EQ(endless.find(key), std::string::npos) << key;
}

TEST(LayerEndsCaseFile, FaultsNameTheKeyAndTheRemedy) {
  const std::pair<std::string, std::vector<const char*>> all[] = {
      {kClad + "from = \"20 mm\"\nto = \"10 mm\"\n", {"a.toml:6", "layer.0.to", "beyond from = 20 mm", "exchange"}},
      {kClad + "taper_length = \"10 mm\"\n", {"a.toml:5", "needs from or to"}},
      {kClad + "from = \"20 mm\"\nto = \"30 mm\"\ntaper_length = \"6 mm\"\n", {"longer than the layer", "shorter"}},
      {kClad + "on = \"wheel\"\nfrom = \"20 mm\"\n", {"layer.0.from on a wheel needs to", "round"}},
      {kClad +
           "from = \"20 mm\"\n[[layer]]\nname = \"b\"\nthickness = \"3 mm\"\nyoung = \"300 GPa\"\nwidth = \"20 mm\"\n",
       {"layer.1.width", "one width"}},
      {"[[stretch]]\non = \"rail\"\n", {"stretch.0.along", "places and factors"}},
      {"[[stretch]]\nalong = [[\"20 mm\", 1.0, 1.0], [\"10 mm\", 1.0, 1.0]]\n", {"place must increase", "sort"}},
  };
  for (const auto& [text, words] : all) {
    const std::string said = refusal(text);
    for (const char* word : words) EXPECT_NE(said.find(word), std::string::npos) << said << "\n  lacks: " << word;
  }
}

TEST(LayerEndsCaseFile, EnginesSayWhatTheyDoNotTake) {
  const auto beyond = [](const std::string& text) {
    std::vector<std::string> keys;
    for (const Diagnostic& r : refused_by(uses::kFiniteElements, parse_case(text, "a.toml").spec))
      keys.push_back(r.where);
    return keys;
  };
  using Keys = std::vector<std::string>;
  const std::string ending = kClad + "from = \"150 mm\"\n", at_points = "[run]\nwindow = \"0 mm\"\n";
  EXPECT_EQ(beyond(at_points + ending), Keys{});
  EXPECT_EQ(beyond(at_points + kStretch), Keys{});
  EXPECT_EQ(beyond(ending), Keys{"run.window"});
  EXPECT_EQ(beyond(kStretch), Keys{"run.window"});
  EXPECT_EQ(beyond(at_points +
                   "plasticity = true\n[material.rail]\nhardening = \"R260\"\n"
                   "initial_stress = [\"-100 MPa\", \"0 MPa\"]\n" +
                   ending),
            Keys{"material.rail.initial_stress"});
  for (const std::string& text : {ending, kStretch}) {
    const CaseSpec spec = parse_case(text, "a.toml").spec;
    EXPECT_THROW(require_support(uses::kHalfSpaces, spec), CaseError);
    EXPECT_THROW(require_support(uses::kRolledPasses, spec), CaseError);
  }
}

const std::string kUnbonded = "unbonded = [[\"180 mm\", \"192 mm\"], [\"200 mm\", \"210 mm\"]]\n";

TEST(LayerEndsCaseFile, UnbondedStretchesAreReadAndWrittenOutAgain) {
  const LoadedCase loaded = parse_case(kClad + kUnbonded + "unbonded_friction = 0.2\n", "a.toml");
  const LayerSpec& layer = loaded.spec.layers.at(0);
  ASSERT_EQ(layer.unbonded.size(), 2u);
  EXPECT_EQ(layer.unbonded[0].to, 0.192);
  EXPECT_EQ(layer.unbonded[1].from, 0.2);
  EXPECT_EQ(layer.unbonded_friction, 0.2);
  EXPECT_EQ(parse_case(loaded.resolved_toml, "b.toml").resolved_toml, loaded.resolved_toml);
  EXPECT_EQ(parse_case(kClad + "unbonded = []\n", "a.toml").resolved_toml, parse_case(kClad, "a.toml").resolved_toml);
}

TEST(LayerEndsCaseFile, UnbondedStretchesLieInOrderWhereTheLayerIs) {
  const std::pair<std::string, std::vector<const char*>> all[] = {
      {"unbonded = [[\"192 mm\", \"180 mm\"]]\n", {"a.toml:5", "layer.0.unbonded", "must increase", "one after"}},
      {"unbonded = [[\"180 mm\", \"192 mm\"], [\"190 mm\", \"195 mm\"]]\n", {"must increase", "join"}},
      {"unbonded = [[\"180 mm\"]]\n", {"a from and a to"}},
      {"unbonded = [[180, 192]]\n", {"unit"}},
      {"from = \"170 mm\"\nto = \"195 mm\"\ntaper_length = \"5 mm\"\nunbonded = [[\"180 mm\", \"192 mm\"]]\n",
       {"a.toml:8", "reaches from 180 mm to 192 mm", "tapers", "taper_length"}},
      {"on = \"wheel\"\n" + kUnbonded, {"a.toml:6", "layers of the rail", "take it out"}},
      {kUnbonded + "unbonded_friction = -1\n", {"layer.0.unbonded_friction", "between 0 and 2"}},
  };
  for (const auto& [text, words] : all) {
    const std::string said = refusal(kClad + text);
    for (const char* word : words) EXPECT_NE(said.find(word), std::string::npos) << said << "\n  lacks: " << word;
  }
}

TEST(InterfaceCaseFile, StiffnessesAreReadWrittenOutAgainAndRefusedByElements) {
  const std::string springs =
      "interface_normal_stiffness = \"20000 MPa/mm\"\ninterface_shear_stiffness = \"0 MPa/mm\"\n";
  const LoadedCase loaded = parse_case(kClad + springs, "a.toml");
  EXPECT_EQ(loaded.spec.layers.at(0).interface_normal_stiffness, 2e13);
  EXPECT_EQ(loaded.spec.layers.at(0).interface_shear_stiffness, 0);
  EXPECT_EQ(parse_case(loaded.resolved_toml, "b.toml").resolved_toml, loaded.resolved_toml);
  EXPECT_FALSE(parse_case(kClad, "a.toml").spec.layers.at(0).interface_shear_stiffness);
  EXPECT_THROW(require_support(uses::kFiniteElements, loaded.spec), CaseError);
  EXPECT_NO_THROW(require_support(uses::kHalfSpaces, loaded.spec));
  EXPECT_NE(refusal(kClad + "interface_shear_stiffness = \"1 MPa/mm\"\n").find("must be 0 or at least 10 MPa/mm"),
            std::string::npos);
  EXPECT_NE(refusal(kClad + "interface_normal_stiffness = \"0 MPa/mm\"\n").find("between 10 MPa/mm"),
            std::string::npos);
}

TEST(LayerEndsCaseFile, EnginesSayWhereALayerMustHold) {
  const auto beyond = [](const std::string& run) {
    std::vector<std::string> keys;
    const CaseSpec spec = parse_case(run + kClad + kUnbonded, "a.toml").spec;
    for (const Diagnostic& r : refused_by(uses::kFiniteElements, spec)) keys.push_back(r.where);
    return keys;
  };
  using Keys = std::vector<std::string>;
  EXPECT_EQ(beyond("[run]\nwindow = \"0 mm\"\n"), Keys{});
  EXPECT_EQ(beyond(""), Keys{"run.window"});
  EXPECT_EQ(beyond("[run]\nwindow = \"0 mm\"\ndevice = \"gpu\"\n"), Keys{"run.device"});
  EXPECT_EQ(beyond("[run]\nrolling = false\n"), Keys{"run.rolling"});
  const CaseSpec spec = parse_case(kClad + kUnbonded, "a.toml").spec;
  try {
    require_support(uses::kHalfSpaces, spec);
    FAIL() << "taken";
  } catch (const CaseError& e) {
    const std::string said = e.what();
    for (const char* word : {"layer.0.unbonded", "half-spaces", "take it out", "railstrata run"})
      EXPECT_NE(said.find(word), std::string::npos) << said;
  }
  EXPECT_THROW(require_support(uses::kRolledPasses, spec), CaseError);
}

}  // namespace
}  // namespace railstrata
