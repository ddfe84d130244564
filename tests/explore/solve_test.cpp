// What the explorer's page asks, answered by this build: the numbers of the half-space engine, faults with remedies.
#include "explore/solve.hpp"

#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "ask/answer.hpp"
#include "explore/calls.h"
#include "explore/page.hpp"
#include "io/summary_json.hpp"
#include "reader/case_file.hpp"
#include "result/stress_sections.hpp"

namespace railstrata {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kCase = R"(
[geometry]
rail_profile = "arc:R=300 mm"
wheel_profile = "flat"
wheel_radius = "0.5 m"

[[layer]]
thickness = "2 mm"
young_ratio = 2.0
yield_strength = "900 MPa"

[material.rail]
yield_strength = "480 MPa"

[drive]
traction_coefficient = 0.2
friction_coefficient = 0.4
)";
constexpr double kCell = 0.8e-3;

Json request(std::vector<std::string> overrides, std::vector<std::string> want) {
  return {{"case", kCase}, {"set", overrides}, {"cell", kCell}, {"want", want}};
}

Answer solved(const std::vector<std::string>& overrides) {
  const LoadedCase loaded = parse_case(kCase, "case.toml", overrides);
  BemOptions options;
  options.cell = kCell;
  return ask(loaded.spec, place(loaded.spec, loaded.folder()), {}, {.bem = options});
}

/// What of a summary depends on the machine.
Json timeless(Json summary) {
  summary.erase("run");
  return summary;
}

TEST(Explorer, SaysTheNumbersOfTheProgram) {
  const std::vector<std::string> overrides{
      "layer.0.thickness=1.5 mm",    "drive.traction_coefficient=0.1",        "layer.0.bond_shear=50 MPa",
      "layer.0.bond_tension=50 MPa", "material.rail.yield_strength=2000 MPa", "layer.0.yield_strength=2000 MPa"};
  Explorer explorer;
  const Json head = Json::parse(explorer.answer(request(overrides, {"stress", "shakedown"}).dump()).head);
  ASSERT_TRUE(head.at("ok")) << head.dump(2);
  EXPECT_EQ(timeless(head.at("summary")), timeless(summary_json(solved(overrides).summary)));
  EXPECT_EQ(head.at("summary").at("shakedown").at("answer").at("lasts"), "no") << "the interface shears";
  EXPECT_TRUE(head.at("strengths"));
}

TEST(Explorer, TellsItsDoubtsInUnitsForPeople) {
  Explorer explorer;
  const std::vector<std::string> overrides{"vehicle.wheel_load=120 kN", "geometry.rail_profile=arc:R=80 mm"};
  Json asked = request(overrides, {"stress"});
  asked["case"] = "[geometry]\nwheel_profile = \"flat\"\nwheel_radius = \"0.5 m\"\n";  // without a strength
  const Json head = Json::parse(explorer.answer(asked.dump()).head);
  ASSERT_TRUE(head.at("ok")) << head.dump(2);
  ASSERT_FALSE(head.at("summary").at("warnings").empty());
  ASSERT_GE(head.at("doubts").size(), head.at("summary").at("warnings").size());
  bool stress = false;
  for (const auto& doubt : head.at("doubts")) {
    const std::string words = doubt.get<std::string>();
    EXPECT_EQ(words.find("[Pa]"), std::string::npos) << words;
    stress = stress || words.find(" MPa, above 500 MPa") != std::string::npos;
  }
  EXPECT_TRUE(stress) << head.at("doubts").dump(2);
}

TEST(Explorer, ComputesInStagesWhatItComputesAtOnce) {
  Explorer at_once, staged;
  const Json all = Json::parse(at_once.answer(request({}, {"patch", "stress", "section", "shakedown"}).dump()).head);
  for (const std::vector<std::string>& want :
       {std::vector<std::string>{}, {"patch"}, {"patch", "section"}, {"patch", "section", "stress"}})
    ASSERT_TRUE(Json::parse(staged.answer(request({}, want).dump()).head).at("ok"));
  Json last = Json::parse(staged.answer(request({}, {"patch", "stress", "section", "shakedown"}).dump()).head);
  for (const char* key : {"patch", "section", "cross"}) EXPECT_EQ(last.at(key), all.at(key));
  EXPECT_EQ(timeless(last.at("summary")), timeless(all.at("summary")));
}

TEST(Explorer, HandsOutThePatchAndTheSection) {
  Explorer explorer;
  const ExplorerAnswer answer = explorer.answer(request({}, {"patch", "section"}).dump());
  const Json head = Json::parse(answer.head);
  const Answer expected = solved({});
  const ContactField& field = expected.result.field;
  const Json& patch = head.at("patch");
  EXPECT_EQ(patch.at("stations"), field.stations);
  const auto number = [&](const Json& slice, int k) {
    return answer.numbers.at(slice.at("first").get<std::size_t>() + static_cast<std::size_t>(k));
  };
  ASSERT_EQ(patch.at("p").at("count"), field.size());
  for (int k = 0; k < field.size(); ++k) {
    ASSERT_EQ(number(patch.at("p"), k), static_cast<float>(field.p[k]));
    ASSERT_EQ(number(patch.at("q_x"), k), static_cast<float>(field.q_x[k]));
    ASSERT_EQ(number(patch.at("state"), k), static_cast<float>(field.state[k]));
  }
  const Json& section = head.at("section");
  EXPECT_EQ(section.at("von_mises").at("count").get<int>(),
            section.at("along").at("count").get<int>() * section.at("depth").at("count").get<int>());
}

TEST(Explorer, TellsFaultsWithTheirPlacesAndRemedies) {
  Explorer explorer;
  const auto fault = [&](const std::vector<std::string>& overrides) {
    const Json head = Json::parse(explorer.answer(request(overrides, {}).dump()).head);
    EXPECT_FALSE(head.at("ok"));
    return head.at("faults").at(0);
  };
  const Json too_much = fault({"drive.traction_coefficient=0.5"});
  EXPECT_NE(too_much.at("message").get<std::string>().find("drive.friction_coefficient"), std::string::npos)
      << too_much;
  EXPECT_NE(too_much.at("remedy").get<std::string>().find("friction"), std::string::npos) << too_much;
  EXPECT_NE(too_much.at("where").get<std::string>(), "");
  EXPECT_NE(fault({"layer.0.thickness=-1 mm"}).at("remedy").get<std::string>(), "");
  EXPECT_NE(fault({"transient.kind=shift"}).at("message").get<std::string>(), "");
  EXPECT_TRUE(Json::parse(explorer.answer(request({}, {}).dump()).head).at("ok")) << "a fault leaves nothing behind";
}

TEST(Explorer, AnswersWhatIsNoRequest) {
  Explorer explorer;
  for (const std::string text : {"", "{", "[]", "{\"case\": 3}", "{\"case\": \"\", \"cell\": 1}", "{\"set\": []}"}) {
    const Json head = Json::parse(explorer.answer(text).head);
    EXPECT_FALSE(head.at("ok")) << text;
    EXPECT_FALSE(head.at("faults").empty()) << text;
  }
}

TEST(Explorer, IsThereInC) {
  const Json head = Json::parse(rs_explore(request({}, {"patch"}).dump().c_str()));
  ASSERT_TRUE(head.at("ok"));
  const Json& p = head.at("patch").at("p");
  EXPECT_LE(p.at("first").get<int>() + p.at("count").get<int>(), rs_explore_count());
  float most = 0;
  for (int k = 0; k < p.at("count").get<int>(); ++k)
    most = std::max(most, rs_explore_numbers()[p.at("first").get<int>() + k]);
  EXPECT_GT(most, 1e8F);
  EXPECT_FALSE(Json::parse(rs_explore(nullptr)).at("ok"));
}

TEST(Explorer, FindsValuesByKeyAndDerivedOnesFromWhatTheyGive) {
  Json asked = request({"vehicle.wheel_load=70 kN"}, {});
  asked["values"] = {"layer.0.thickness",
                     "layer.0.young_ratio",
                     "vehicle.wheel_load",
                     "material.rail.yield_strength",
                     "material.wheel.yield_strength",
                     "layer.1.thickness",
                     "layer.x.thickness",
                     "drive.nothing",
                     "nothing"};
  Explorer explorer;
  const Json values = Json::parse(explorer.answer(asked.dump()).head).at("values");
  EXPECT_DOUBLE_EQ(values.at("layer.0.thickness"), 2e-3);
  EXPECT_DOUBLE_EQ(values.at("layer.0.young_ratio"), 2.0);
  EXPECT_NEAR(values.at("vehicle.wheel_load").get<double>(), 70e3, 1e-6);
  EXPECT_DOUBLE_EQ(values.at("material.rail.yield_strength"), 480e6);
  for (const char* none :
       {"material.wheel.yield_strength", "layer.1.thickness", "layer.x.thickness", "drive.nothing", "nothing"})
    EXPECT_TRUE(values.at(none).is_null()) << none;
}

TEST(ExplorerPage, IsOneFileThatNamesNoFolderOfThisMachine) {
  const LoadedCase loaded = parse_case(kCase, "/home/somebody/case.toml");
  const std::string page = explorer_page(loaded, "/home/somebody/case.toml", kCell);
  EXPECT_EQ(page.find("somebody/case"), std::string::npos);
  EXPECT_EQ(page.find("http://"), page.find("http://", page.find("id=\"licences\"")))
      << "an address in the page itself";
  EXPECT_NE(page.find("default-src 'none'"), std::string::npos);
  EXPECT_EQ(page.find("'unsafe-eval'"), std::string::npos);
}

TEST(ExplorerPage, RefusesAHistoryInTime) {
  LoadedCase loaded = parse_case(kCase, "case.toml");
  loaded.spec.transient.kind = TransientKind::rolling;
  EXPECT_THROW(static_cast<void>(explorer_page(loaded, "case.toml", kCell)), CaseError);
}

}  // namespace
}  // namespace railstrata
