#include "many/sweep.hpp"

#include <gtest/gtest.h>

#include "core/faults.hpp"

namespace railstrata {
namespace {

LoadedCase base() { return parse_case("[case]\ntitle = \"base\"\n", "base.toml"); }

SweepOptions coarse() {
  SweepOptions options;
  options.bem.cell = 1e-3;
  return options;
}

}  // namespace

TEST(Sweep, SolvesTheCasesThatTakeTheirValuesAndNamesTheFaultOfTheOthers) {
  std::vector<SweepCase> cases =
      plan_sweep(base(), {{"drive.friction_coefficient", {"0.3", "7", "0.1"}}});  // at most 2; more than F_T / G
  ASSERT_EQ(cases.size(), 3u);
  int ended = 0;
  SweepOptions options = coarse();
  options.ended = [&] { ++ended; };
  run_sweep(cases, options);
  EXPECT_EQ(ended, 3);
  EXPECT_EQ(cases[0].fault, "");
  EXPECT_TRUE(cases[0].summary.contains("contact"));
  EXPECT_FALSE(cases[1].loaded);
  EXPECT_NE(cases[1].fault, "");
  EXPECT_FALSE(cases[2].loaded);
  EXPECT_NE(cases[2].fault, "");
  EXPECT_TRUE(cases[1].summary.is_null() && cases[2].summary.is_null());
}

TEST(Sweep, SaysOfItsColumnsWhatTheyAreOfAndOfItsCasesWhatIsWrong) {
  const std::string said = patches_remark(result_columns(true));
  EXPECT_NE(said.find("F_x_kN, F_y_kN, F_z_kN of all patches together"), std::string::npos) << said;
  EXPECT_NE(said.find("stresses below that one"), std::string::npos) << said;
  EXPECT_EQ(patches_remark(result_columns(false)).find("stresses"), std::string::npos);
  const auto summary = nlohmann::ordered_json::parse(R"({"patches": [{}, {}],
      "checks": [{"name": "a", "ok": false}, {"name": "b", "ok": true}, {"name": "c", "ok": false}],
      "warnings": [{"name": "w"}]})");
  const ResultRemarks two = remarks_of(summary), none = remarks_of(nullptr),
                      plain = remarks_of(nlohmann::ordered_json::parse(R"({"checks": [{"name": "a", "ok": true}]})"));
  EXPECT_EQ(two.patches, 2);
  EXPECT_EQ(two.checks, "a; c");
  EXPECT_EQ(two.warnings, "w");
  EXPECT_EQ(none.patches, 0);
  EXPECT_EQ(none.checks + none.warnings, "");
  EXPECT_EQ(plain.patches, 1);
  EXPECT_EQ(plain.checks, "ok");
}

TEST(Sweep, IsRefusedIfNoCaseTakesItsValues) {
  EXPECT_THROW(plan_sweep(base(), {{"drive.no_such_key", {"1", "2"}}}), CaseError);
}

TEST(Sweep, KeepsTheOverridesOfItsBase) {
  const LoadedCase dry = with_overrides(base(), {"drive.friction_coefficient=0.6"});
  EXPECT_EQ(plan_sweep(dry, {{"drive.traction_coefficient", {"0.1"}}})[0].loaded->spec.drive.friction_coefficient, 0.6);
}

TEST(Sweep, OverAnInterfaceGoesFromSmoothToBonded) {
  const std::string clad = "[[layer]]\nthickness = \"3 mm\"\nyoung_ratio = 2\n";
  std::vector<SweepCase> cases =
      plan_sweep(parse_case(clad, "clad.toml"),
                 {{"layer.0.interface_shear_stiffness", {"0 MPa/mm", "1000 MPa/mm", "5e4 MPa/mm", "1e10 MPa/mm"}}});
  run_sweep(cases, coarse());
  double last = 0;
  for (const SweepCase& swept : cases) {
    EXPECT_GT(swept.summary.at("contact").at("p_max_Pa").get<double>(), last) << swept.fault;
    last = swept.summary.at("contact").at("p_max_Pa").get<double>();
  }
  std::vector<SweepCase> bonded = plan_sweep(parse_case(clad, "clad.toml"), {{"layer.0.young_ratio", {"2"}}});
  run_sweep(bonded, coarse());
  EXPECT_NEAR(bonded.at(0).summary.at("contact").at("p_max_Pa").get<double>() / last, 1, 1e-5);
}

TEST(Sweep, LeavesOutWhatHasNotBegunWhenItIsStopped) {
  std::vector<SweepCase> cases = plan_sweep(base(), {{"drive.traction_coefficient", {"0.1", "0.2"}}});
  Control control;
  control.stop = true;
  SweepOptions options = coarse();
  options.control = &control;
  run_sweep(cases, options);
  EXPECT_FALSE(cases[0].done || cases[1].done);
}

TEST(Sweep, ThrowsWhatGoesWrongWhereACaseEnds) {
  std::vector<SweepCase> cases = plan_sweep(base(), {{"drive.traction_coefficient", {"0.1"}}});
  SweepOptions options = coarse();
  options.ended = [] { throw EnvironmentError("the disk is full"); };
  EXPECT_THROW(run_sweep(cases, options), EnvironmentError);
  EXPECT_TRUE(cases[0].done);
}

}  // namespace railstrata
