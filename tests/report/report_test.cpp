#include "report/report.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "io/provenance.hpp"
#include "report/assets.hpp"
#include "report/checks.hpp"
#include "report/page.hpp"
#include "report/payload.hpp"

namespace railstrata {
namespace {

using Json = nlohmann::ordered_json;

/// A run of 3 x 4 points with a peak of 900 MPa at x = 1, y = 0 mm.
ReportRun sample(const std::string& engine) {
  ReportRun run;
  run.name = "sample";
  run.result.engine = engine;
  run.result.title = "a sample";
  const auto most = [](double value, double depth) {
    return Json{{"von_mises_max", {{"value_Pa", value}, {"x_m", 0}, {"y_m", 0}, {"depth_m", depth}}},
                {"sigma1_max", nullptr}};
  };
  run.result.summary = {
      {"title", "a sample"},
      {"position_m", 0.3},
      {"contact", {{"p_max_Pa", 900e6}, {"q_max_Pa", 300e6}, {"patch_length_m", 12e-3}}},
      {"stress",
       {{"rail",
         {{"subsurface", most(500e6, 3e-3)}, {"interface", nullptr}, {"layer", nullptr}, {"matrix", nullptr}}}}},
      {"checks", {{{"name", "energy_closure"}, {"ok", true}, {"value", 1e-4}, {"limit", 1e-2}}}}};
  run.options = {{"geometry", "cant", "0.025"},
                 {"mesh", "element_size", "1 mm"},
                 {"layer.0", "thickness", "2 mm"},
                 {"drive", "friction_coefficient", "0.5"}};
  ContactField& f = run.result.field;
  f.resize(3, 4);
  for (int s = 0; s < 4; ++s)
    for (int c = 0; c < 3; ++c) {
      const int i = s * 3 + c;
      f.x[i] = 1e-3 * (s - 1);
      f.y[i] = 1e-3 * (c - 1);
      f.p[i] = s == 2 && c == 1 ? 900e6 : s == 3 ? 0 : 100e6;
      f.q_x[i] = -0.3 * f.p[i];
      f.state[i] = f.p[i] > 0 ? ContactState::stick : ContactState::separated;
    }
  return run;
}

ReportCheck find(const std::vector<ReportCheck>& checks, const std::string& name, std::size_t runs) {
  const auto found = std::find_if(checks.begin(), checks.end(),
                                  [&](const ReportCheck& c) { return c.name == name && c.runs.size() == runs; });
  if (found == checks.end()) throw std::runtime_error("no check " + name);
  return *found;
}

bool has(const std::vector<ReportCheck>& checks, const std::string& name) {
  return std::any_of(checks.begin(), checks.end(), [&](const ReportCheck& c) { return c.name == name; });
}

// [RFC 4648, section 10]
TEST(Base64, MeetsItsTestVectors) {
  const std::pair<const char*, const char*> vectors[] = {{"", ""},
                                                         {"f", "Zg=="},
                                                         {"fo", "Zm8="},
                                                         {"foo", "Zm9v"},
                                                         {"foob", "Zm9vYg=="},
                                                         {"fooba", "Zm9vYmE="},
                                                         {"foobar", "Zm9vYmFy"}};
  for (const auto& [bytes, text] : vectors) EXPECT_EQ(base64_of(bytes), text);
}

TEST(ReportChecks, HoldFiniteElementsAgainstHalfSpacesOfTheSameCase) {
  ReportRun fem = sample("fem"), bem = sample("bem");
  fem.result.summary["contact"]["p_max_Pa"] = 900e6 * 1.039;
  fem.result.summary["contact"]["q_max_Pa"] = 300e6 * 1.071;
  fem.result.summary["contact"]["patch_length_m"] = 12e-3 * 0.941;
  fem.result.summary["stress"]["rail"]["subsurface"]["von_mises_max"]["value_Pa"] = 500e6 * 0.921;
  bem.options[1].value = "0.5 mm";  // how it is computed does not make it another case
  const auto checks = report_checks({fem, bem});
  EXPECT_TRUE(find(checks, "p_max", 2).ok);
  EXPECT_NEAR(find(checks, "p_max", 2).value, 0.039, 1e-12);
  EXPECT_FALSE(find(checks, "q_max", 2).ok);
  EXPECT_TRUE(find(checks, "patch_length", 2).ok);
  EXPECT_TRUE(find(checks, "von_mises_below_surface", 2).ok);
  EXPECT_TRUE(find(checks, "von_mises_below_surface", 2).judged);
  EXPECT_EQ(
      std::count_if(checks.begin(), checks.end(), [](const ReportCheck& c) { return c.name == "energy_closure"; }), 2)
      << "each run's own";
  EXPECT_FALSE(has(checks, "cases_differ"));
}

TEST(ReportChecks, CompareTheLargestShearOnCellsAsLargeAsTheElements) {
  ReportRun fem = sample("fem");
  const ReportRun bem = sample("bem");
  fem.result.summary["contact"]["q_max_point_Pa"] = 240e6;
  fem.result.summary["contact"]["q_max_Pa"] = 270e6;
  fem.shear_on_elements = 250e6;
  const ReportCheck shear = find(report_checks({fem, bem}), "q_max", 2);
  EXPECT_TRUE(shear.ok);
  EXPECT_NEAR(shear.value, 0.04, 1e-12);
  EXPECT_DOUBLE_EQ(shear.limit, 0.07);
  EXPECT_NE(shear.note.find("(1 mm): 250 MPa; half-spaces give 300 MPa at the front of slip, from which the "
                            "elements differ by 10.0 %"),
            std::string::npos)
      << shear.note;
  fem.shear_on_elements = 260e6;
  EXPECT_FALSE(find(report_checks({fem, bem}), "q_max", 2).ok) << "the limit is that of any two runs";
}

TEST(ReportChecks, AnEditedCaseFailsAndAnotherVersionIsSaid) {
  ReportRun run = sample("bem");
  run.doubts = {{"case_edited", "changed", true}, {"other_version", "older", false}};
  const auto checks = report_checks({run});
  EXPECT_TRUE(find(checks, "case_edited", 1).judged);
  EXPECT_FALSE(find(checks, "case_edited", 1).ok);
  EXPECT_FALSE(find(checks, "other_version", 1).judged);
}

TEST(ReportChecks, CompareProfileFilesByTheirContent) {
  ReportRun fem = sample("fem"), bem = sample("bem");
  fem.options.push_back({"geometry", "wheel_profile", "inputs/w.csv"});
  bem.options.push_back({"geometry", "wheel_profile", "/elsewhere/w.csv"});
  fem.profile_sha256["wheel_profile"] = bem.profile_sha256["wheel_profile"] = "12";
  EXPECT_FALSE(has(report_checks({fem, bem}), "cases_differ"));
  bem.options.back().value = "inputs/w.csv";
  bem.profile_sha256["wheel_profile"] = "34";
  EXPECT_EQ(find(report_checks({fem, bem}), "cases_differ", 2).note,
            "geometry.wheel_profile: inputs/w.csv, a different file of this name");
}

TEST(ReportVerdict, SaysWhatFailsAndByHowMuch) {
  Report report;
  EXPECT_EQ(verdict_of(report).text, "nothing was checked");
  EXPECT_FALSE(verdict_of(report).ok);
  report.checks = {{"p_max", {0, 1}, true, true, 0.01, 0.04, ""}, {"yield", {0}, false, true, 2, 1, ""}};
  EXPECT_TRUE(verdict_of(report).ok);
  EXPECT_EQ(verdict_of(report).text, "all 1 checks hold");
  report.checks.push_back({"q_max", {0, 1}, true, false, 0.0952, 0.07, ""});
  EXPECT_FALSE(verdict_of(report).ok);
  EXPECT_EQ(verdict_of(report).text, "1 of 2 checks fails: Largest shear 9.52 %, limit 7 %");
}

TEST(ReportPayload, LeavesOutTheMachineAndItsFolders) {
  Report report;
  report.runs.push_back(sample("bem"));
  ReportRun& run = report.runs[0];
  run.result.folder = "/home/name/results/one";
  run.provenance = {{"cpu", "a processor"},
                    {"host", "a name"},
                    {"command_line", {"/usr/bin/railstrata", "bem", "/home/name/case.toml", "--out=one"}},
                    {"inputs", {{{"file", "/home/name/w.csv"}, {"sha256", "12"}}}}};
  run.geometry = {{"rail_profile", "CN60"}, {"wheel_profile", "/home/name/w.csv"}};
  run.options.push_back({"geometry", "wheel_profile", "/home/name/w.csv"});
  const Json shown = report_payload(report)["runs"][0];
  EXPECT_EQ(shown.dump().find("/home"), std::string::npos);
  EXPECT_EQ(shown["folder"], "one");
  EXPECT_EQ(shown["provenance"], (Json{{"command_line", {"railstrata", "bem", "case.toml", "--out=one"}},
                                       {"inputs", {{{"file", "w.csv"}, {"sha256", "12"}}}}}));
  EXPECT_EQ(shown["geometry"]["wheel_profile"], "w.csv");
  EXPECT_EQ(shown["geometry"]["rail_profile"], "CN60");
}

TEST(ReportChecks, CompareTheLargestStressBelowTheSurface) {
  ReportRun fem = sample("fem"), bem = sample("bem");
  const auto set = [](ReportRun& run, double value) {
    run.result.summary["stress"]["rail"]["subsurface"]["von_mises_max"]["value_Pa"] = value;
  };
  set(fem, 700e6);
  set(bem, 600e6);
  EXPECT_NEAR(find(report_checks({fem, bem}), "von_mises_below_surface", 2).value, 700.0 / 600 - 1, 1e-12);
}

TEST(ReportChecks, DoNotJudgeAStressWithinOneElementOfTheSurface) {
  const ReportRun fem = sample("fem");
  ReportRun bem = sample("bem");
  bem.result.summary["stress"]["rail"]["subsurface"]["von_mises_max"] = {{"value_Pa", 900e6}, {"depth_m", 0.5e-3}};
  const ReportCheck stress = find(report_checks({fem, bem}), "von_mises_below_surface", 2);
  EXPECT_FALSE(stress.judged);
  EXPECT_NE(stress.note.find("0.50 mm deep, within an element of 1.00 mm"), std::string::npos) << stress.note;
}

TEST(ReportChecks, TakeTheWordsOfAWarningFromTheTableIfItKnowsTheName) {
  ReportRun run = sample("fem");
  run.result.summary["warnings"] = {
      {{"name", "von_mises_above_common_rail_yield"}, {"value", 931e6}, {"limit", 500e6}, {"text", "in Pa"}},
      {{"name", "of_another_version"}, {"value", 2}, {"limit", 1}, {"text", "its own words"}}};
  const auto checks = report_checks({run});
  EXPECT_EQ(find(checks, "von_mises_above_common_rail_yield", 1).note, "");
  EXPECT_EQ(find(checks, "of_another_version", 1).note, "its own words");
  EXPECT_FALSE(find(checks, "of_another_version", 1).judged);
  const Json words = report_payload(Report{})["words"];
  const auto yield = std::find_if(words["checks"].begin(), words["checks"].end(),
                                  [](const Json& row) { return row["key"] == "von_mises_above_common_rail_yield"; });
  ASSERT_NE(yield, words["checks"].end());
  EXPECT_EQ((*yield)["name"], "Von Mises stress above common rail yield");
  EXPECT_EQ((*yield)["unit"]["shown"], "MPa");
}

TEST(ReportChecks, OfDifferentCasesTellWhatDiffersAndJudgeNothing) {
  ReportRun fem = sample("fem"), bem = sample("bem");
  bem.options[2].value = "3 mm";
  const auto checks = report_checks({fem, bem});
  EXPECT_FALSE(has(checks, "p_max"));
  const ReportCheck differ = find(checks, "cases_differ", 2);
  EXPECT_FALSE(differ.judged);
  EXPECT_EQ(differ.note, "layer.0.thickness: 2 mm, 3 mm");
  bem.options.erase(bem.options.begin() + 2);
  EXPECT_EQ(find(report_checks({fem, bem}), "cases_differ", 2).note, "layer.0.thickness: 2 mm, none");
  EXPECT_EQ(find(report_checks({bem, fem}), "cases_differ", 2).note, "layer.0.thickness: none, 2 mm");
}

TEST(ReportPayload, PacksAMapToSixteenBitsOfItsRange) {
  Report report;
  report.runs.push_back(sample("bem"));
  const Json patch = report_payload(report)["runs"][0]["patch"];
  EXPECT_EQ(patch["x"], Json::array({-1.0, 0.0, 1.0, 2.0}));
  EXPECT_EQ(patch["y"], Json::array({-1.0, 0.0, 1.0}));
  EXPECT_EQ(patch["state"], "111111111000");
  EXPECT_EQ(patch["p"]["low"], 0.0);
  EXPECT_EQ(patch["p"]["high"], 900.0);
  std::string bytes;
  for (int i = 0; i < 12; ++i) {
    const int k = i == 7 ? 65534 : i < 9 ? 7282 : 0;  // 100 of 900 MPa: 7281.6 of 65534
    bytes += static_cast<char>(k & 0xFF);
    bytes += static_cast<char>(k >> 8);
  }
  EXPECT_EQ(patch["p"]["u16"], base64_of(bytes));
}

TEST(ReportPayload, HasAMapForEveryPatch) {
  Report report;
  report.runs.push_back(sample("bem"));
  EXPECT_EQ(report_payload(report)["runs"][0]["further_patches"], Json::array());
  report.runs[0].result.further.push_back(report.runs[0].result.field);
  const Json run = report_payload(report)["runs"][0];
  ASSERT_EQ(run["further_patches"].size(), 1U);
  EXPECT_EQ(run["further_patches"][0], run["patch"]);
}

TEST(ReportPayload, CarriesTablesAndChartsOfAStudy) {
  Report report;
  report.tables.push_back({"trend", "Trend", "a note", {"h", "p_max"}, {{"1 mm", 1100.0}, {"2 mm", nullptr}}});
  report.charts.push_back({"fig", "Figure", "", "h [mm]", "p [MPa]", {{"4 E0", {1, 2}, {1100, 1200}, true}}});
  const Json all = report_payload(report);
  EXPECT_EQ(all["tables"][0]["rows"][1][1], nullptr);
  EXPECT_EQ(all["charts"][0]["series"][0]["y"][1], 1200.0);
}

TEST(ReportPage, RunsOnlyItsOwnScriptAndHoldsNoTagsOfOthers) {
  Report report;
  report.title = "<script>alert(1)</script> & more";
  report.runs.push_back(sample("fem"));
  report.runs[0].name = "</script><img src=x onerror=alert(1)>";
  const std::string page = report_page(report);
  EXPECT_NE(page.find("<title>&lt;script>alert(1)&lt;/script> &amp; more</title>"), std::string::npos);
  EXPECT_EQ(page.find("<img"), std::string::npos);
  EXPECT_NE(page.find("default-src 'none'; script-src 'sha256-"), std::string::npos);
  const auto count = [&](const std::string& text) {
    int n = 0;
    for (auto at = page.find(text); at != std::string::npos; at = page.find(text, at + 1)) ++n;
    return n;
  };
  EXPECT_EQ(count("</script>"), 2) << "the data and the page's own";
  EXPECT_EQ(count("</style>"), 1);
  EXPECT_EQ(count("unsafe"), 0);
  EXPECT_LT(page.size(), 5e5);
  const auto data = page.find("id=\"data\">") + 10;
  EXPECT_EQ(Json::parse(page.substr(data, page.find("</script>", data) - data))["runs"][0]["name"],
            report.runs[0].name);
}

TEST(ReportAssets, StandInTheProgramWhole) {
  EXPECT_GT(report_script().size(), 5e4);
  EXPECT_LT(report_script().size(), 2e5) << "without a library for charts";
  EXPECT_NE(report_style().find("@media print"), std::string_view::npos);
  EXPECT_TRUE(view_script().starts_with("#!/usr/bin/env python3\n"));
  EXPECT_TRUE(view_script().ends_with("main()\n"));
}

}  // namespace
}  // namespace railstrata
