#include "traffic/traffic_page.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

namespace railstrata {
namespace {

constexpr double kNot = std::numeric_limits<double>::infinity();

LifeRow row_of(const char* mechanism, double mgt) {
  return {.body = "rail",
          .zone = "clad",
          .place = "at the surface",
          .mechanism = mechanism,
          .wheels = {mgt, mgt, mgt},
          .mgt = {mgt, mgt, mgt},
          .depth = 0.15e-3,
          .y = -0.01e-3,
          .followed = 50};
}

RangeRun run_of(const std::string& input, double crack, double worn) {
  RangeRun out{input, input.empty() ? "" : "1"};
  out.result.lives = {row_of("ductility exhausted", crack), row_of(kWornThrough, worn)};
  out.result.history = {{.layer_left = 2e-3}, {.kilograms = 5e10, .removed = 1e-3, .layer_left = 1e-3}};
  out.result.wheels = out.result.tonnes = 1;
  out.result.reached = 5e10;
  return out;
}

std::vector<ReportAnswer> answers_of(std::vector<RangeRun> runs) {
  const CaseSpec spec;
  const std::vector<CollectiveRow> rows;
  const RailDamage unworn;
  std::vector<NamedInput> inputs;
  if (runs.size() > 1) inputs.push_back({"a", "life.a"});
  const TrafficRange range = range_of(std::move(runs), inputs);
  return traffic_answers({spec, rows, unworn, range, 5e10, 1e-3});
}

TEST(TrafficPage, TheVerdictIsTheFirstCrackItsPlaceAndTheLayer) {
  const std::vector<ReportAnswer> out = answers_of({run_of("", 20, 40), run_of("a", 10, 40), run_of("a", 30, 60)});
  EXPECT_EQ(out[0].title, "First crack");
  EXPECT_EQ(out[0].text,
            "after 20 MGT (10 to 30) at y = 0.0 mm, 0.15 mm deep (clad, at the surface), by ductility exhausted");
  EXPECT_EQ(out[1].text, "worn through after 40 MGT (40 to 60)");
  EXPECT_EQ(out[2].text, "a decides (100 % of the range): 1 to 1 gives 10 MGT to 30 MGT");
}

TEST(TrafficPage, WithoutACrackItIsGreenOnlyWhereNoEndOfTheRangeHasOne) {
  const std::vector<ReportAnswer> sure =
      answers_of({run_of("", kNot, kNot), run_of("a", kNot, kNot), run_of("a", kNot, kNot)});
  EXPECT_EQ(sure[0].tone, "good");
  EXPECT_EQ(sure[0].text, "within the 50 MGT that were followed");
  EXPECT_EQ(sure[1].text, "1.00 mm of 2.00 mm left after 50 MGT");
  EXPECT_EQ(sure[2].text, "no input changes this answer");
  const std::vector<ReportAnswer> out =
      answers_of({run_of("", kNot, kNot), run_of("a", 30, kNot), run_of("a", kNot, kNot)});
  EXPECT_EQ(out[0].tone, "open");
  EXPECT_EQ(out[0].text, "within the 50 MGT that were followed; at the lower end of its range after 30 MGT");
}

TEST(TrafficPage, OneRunNamesTheFlagAndALifeThatIsNotKnownItsKey) {
  std::vector<RangeRun> runs{run_of("", kNot, kNot)};
  LifeRow lacking = row_of("fatigue", std::numeric_limits<double>::quiet_NaN());
  lacking.rests_on = "layer.0.fatigue_limit";
  runs[0].result.lives.push_back(lacking);
  const std::vector<ReportAnswer> out = answers_of(runs);
  EXPECT_EQ(out[0].tone, "open") << "fatigue may end it";
  EXPECT_NE(out[2].text.find("--range"), std::string::npos);
  EXPECT_EQ(out.back().text, "fatigue of clad (give layer.0.fatigue_limit)");
}

}  // namespace
}  // namespace railstrata
