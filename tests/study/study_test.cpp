#include "study/published_table.hpp"
#include "study/study_report.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "core/faults.hpp"
#include "tests/places.hpp"

namespace railstrata {
namespace {

using Numbers = std::vector<std::pair<std::string, double>>;
using Values = std::vector<std::pair<std::string, std::string>>;

CaseRow entry(const std::string& group, const std::string& name, Engine engine, Numbers numbers, Values values = {}) {
  return {group, name, engine, "done", "", "", std::move(values), std::move(numbers)};
}

const std::vector<AnswerColumn> kColumns{
    {"paper's mesh", Engine::fem, "paper_"}, {"converged", Engine::fem, ""}, {"half-space", Engine::bem, ""}};

PublishedNumber about(double value, double within) {
  PublishedNumber n;
  n.section = "4";
  n.quantity = "pressure";
  n.unit = "MPa";
  n.column = "p";
  n.given = "layers/h 1";
  n.value = value;
  n.within = within;
  return n;
}

/// The answers of the three columns and the difference, then the reason.
std::vector<nlohmann::ordered_json> row(const PublishedNumber& n, const std::vector<CaseRow>& entries) {
  return published_table({"S", kColumns, {n}, {}}, entries).rows.at(0);
}
std::string reason(const PublishedNumber& n, const std::vector<CaseRow>& entries) {
  return row(n, entries).back().get<std::string>();
}

std::vector<CaseRow> answers(double paper_mesh, double converged, double half_space) {
  std::vector<CaseRow> out;
  if (!std::isnan(paper_mesh))
    out.push_back(entry("paper_layers", "h 1", Engine::fem, {{"p", paper_mesh}, {"other", 500}}));
  if (!std::isnan(converged)) out.push_back(entry("layers", "h 1", Engine::fem, {{"p", converged}, {"other", 500}}));
  if (!std::isnan(half_space)) out.push_back(entry("layers", "h 1", Engine::bem, {{"p", half_space}, {"other", 500}}));
  return out;
}

TEST(PublishedTable, TheReasonFollowsFromTheRuns) {
  const PublishedNumber n = about(1000, 20);
  EXPECT_EQ(reason(n, answers(1010, 1005, 990)), "agrees");
  EXPECT_EQ(reason(n, answers(1090, 1005, 990)), "agrees when converged; on the paper's mesh ours gives 1090");
  EXPECT_EQ(reason(n, answers(1010, 1090, 1085)),
            "mesh artefact: our run on the paper's mesh agrees, the converged answer is 1090");
  EXPECT_EQ(reason(n, answers(1200, 1090, 1085)), "not explained");
  EXPECT_EQ(reason(n, answers(NAN, NAN, 1005)), "agrees (half-spaces alone: no finite element result yet)");
  EXPECT_EQ(reason(n, answers(1090, NAN, 1085)), "not explained (no converged finite element result yet)");
  EXPECT_EQ(reason(n, {}), "the study has no such case");
}

TEST(PublishedTable, AnotherDefinitionIsNamedOnlyWhereItAgrees) {
  PublishedNumber n = about(510, 20);
  n.other = "other";
  n.other_is = "the largest anywhere";
  EXPECT_EQ(reason(n, answers(1010, 1005, 990)), "other definition: the largest anywhere gives 500");
  n.value = 560;
  EXPECT_EQ(reason(n, answers(1010, 1005, 990)), "not explained");
}

TEST(PublishedTable, AChangeIsTakenWithinEachColumnAndAGroupWithoutTwinStandsForItself) {
  PublishedNumber n = about(10, 1);
  n.unit = "%";
  n.against = "base/f 1";
  std::vector<CaseRow> all = answers(1200, 1100, 1090);
  all.push_back(entry("base", "f 1", Engine::fem, {{"p", 1000}}));
  all.push_back(entry("base", "f 1", Engine::bem, {{"p", 1000}}));
  const auto without = row(n, all);
  EXPECT_NEAR(without[5].get<double>(), 20, 1e-9);
  EXPECT_NEAR(without[6].get<double>(), 10, 1e-9);
  EXPECT_NEAR(without[7].get<double>(), 9, 1e-9);
  EXPECT_EQ(without[8], "+0.0 points");
  all.push_back(entry("paper_base", "f 1", Engine::fem, {{"p", 1100}}));
  EXPECT_NEAR(row(n, all)[5].get<double>(), 100.0 / 11, 1e-9);
}

TEST(PublishedTable, EnginesAreHeldAgainstEachOtherAndBoundsAreBounds) {
  PublishedNumber n = about(2, 0);
  n.unit = "%";
  n.engines = true;
  n.bound = "at most";
  const auto r = row(n, answers(1030, 1010, 1000));
  EXPECT_NEAR(r[5].get<double>(), 3, 1e-9);
  EXPECT_NEAR(r[6].get<double>(), 1, 1e-9);
  EXPECT_EQ(r[7], nullptr);
  EXPECT_EQ(r.back(), "agrees when converged; on the paper's mesh ours gives 3");
}

TEST(PublishedTable, WhatIsNotDoneHasNoNumber) {
  std::vector<CaseRow> all = answers(NAN, 1005, NAN);
  all[0].state = "failed";
  EXPECT_EQ(reason(about(1000, 20), all), "no result yet");
}

std::string claim(PublishedClaim c, const std::vector<CaseRow>& entries) {
  c.section = "6";
  c.text = "…";
  c.column = "p";
  c.unit = "MPa";
  return claims_table({"S", {{"half-space", Engine::bem, ""}}, {}, {c}}, entries).rows.at(0).at(2).get<std::string>();
}

std::vector<CaseRow> grid(const std::vector<double>& thin, const std::vector<double>& thick) {
  std::vector<CaseRow> out{entry("base", "case", Engine::bem, {{"p", 100}}, {{"E", "1"}})};
  const char* moduli[] = {"2", "10", "4"};  // by their numbers, not by their letters or their order
  for (int k = 0; k < 3; ++k) {
    out.push_back(entry("layers", "", Engine::bem, {{"p", thin[k]}}, {{"h", "0.5 mm"}, {"E", moduli[k]}}));
    out.push_back(entry("layers", "", Engine::bem, {{"p", thick[k]}}, {{"h", "10 mm"}, {"E", moduli[k]}}));
  }
  return out;
}

PublishedClaim along_modulus(const std::string& kind) {
  PublishedClaim c;
  c.kind = kind;
  c.along = "E";
  c.each = "h";
  c.groups = {"base", "layers"};
  return c;
}

TEST(ClaimsTable, ACaseWithoutTheKeyStandsInEveryLine) {
  EXPECT_EQ(claim(along_modulus("rises"), grid({110, 130, 120}, {150, 400, 200})),
            "confirmed: 0.5 mm: 100, 110, 120, 130; 10 mm: 100, 150, 200, 400 MPa");
}

TEST(ClaimsTable, WhatHoldsInPartIsToldInParts) {
  EXPECT_EQ(claim(along_modulus("rises"), grid({110, 130, 120}, {150, 190, 200})),
            "in part: not 10 mm: 100, 150, 200, 190 MPa; confirmed 0.5 mm: 100, 110, 120, 130 MPa");
  EXPECT_EQ(claim(along_modulus("falls"), grid({110, 130, 120}, {150, 190, 200})),
            "not confirmed: 0.5 mm: 100, 110, 120, 130; 10 mm: 100, 150, 200, 190 MPa");
}

TEST(ClaimsTable, FallsThenRises) {
  PublishedClaim c = along_modulus("falls_then_rises");
  c.where = {{"h", {"10 mm"}}};
  EXPECT_EQ(claim(c, grid({0, 0, 0}, {60, 150, 80})), "confirmed: 10 mm: 100, 60, 80, 150 MPa");
  EXPECT_EQ(claim(c, grid({0, 0, 0}, {110, 150, 120})), "not confirmed: 10 mm: 100, 110, 120, 150 MPa");
}

TEST(ClaimsTable, LimitsAndMissingResults) {
  PublishedClaim c;
  c.kind = "below";
  c.given = "base/case";
  c.limit = 120;
  EXPECT_EQ(claim(c, grid({0, 0, 0}, {0, 0, 0})), "confirmed: 100 MPa (below 120 MPa)");
  c.kind = "above";
  EXPECT_EQ(claim(c, grid({0, 0, 0}, {0, 0, 0})), "not confirmed: 100 MPa (above 120 MPa)");
  EXPECT_EQ(claim(c, {}), "no result yet");
  EXPECT_EQ(claim(along_modulus("rises"), {}), "no result yet");
}

TEST(Published, ThePapersFileIsReadAndItsCasesAreInTheStudy) {
  const std::filesystem::path folder = source_dir() / "cases/paper";
  const Published p = load_published(source_dir() / "data/paper/published.toml");
  const LoadedStudy study = load_study(folder / "study.toml");
  EXPECT_EQ(p.columns.size(), 3u);
  EXPECT_GT(p.numbers.size(), 25u);
  for (const PublishedNumber& n : p.numbers)
    for (const std::string& given : {n.given, n.against}) {
      const std::string group = given.substr(0, given.find('/'));
      EXPECT_TRUE(given.empty() || std::any_of(study.spec.groups.begin(), study.spec.groups.end(),
                                               [&](const StudyGroup& g) { return g.name == group; }))
          << given;
    }
  for (const PublishedClaim& c : p.claims)
    for (const std::string& g : c.groups)
      EXPECT_TRUE(std::any_of(study.spec.groups.begin(), study.spec.groups.end(), [&](const StudyGroup& known) {
        return known.name == g;
      })) << g;
}

TEST(Published, MistakesAreToldWithTheirPlace) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "published_test.toml";
  std::ofstream(file) << "[[number]]\nsection = \"1\"\nquantity = \"a\"\nvalue = \"x\"\ncolumn = \"p\"\ngiven = "
                         "\"a/b\"\nbond = \"at most\"\nwithin = 1\n";
  try {
    load_published(file);
    FAIL();
  } catch (const CaseError& e) {
    ASSERT_EQ(e.diagnostics.size(), 2u);
    EXPECT_EQ(e.diagnostics[0].where, file.string() + ":4:9");
    EXPECT_EQ(e.diagnostics[1].where, file.string() + ":7:8");
  }
}

}  // namespace
}  // namespace railstrata
