#include "many/case_row.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/text.hpp"
#include "many/case_page.hpp"
#include "tests/places.hpp"

namespace railstrata {
namespace {

/// Two cases of different keys and numbers, one without a result.
std::vector<CaseRow> rows() {
  CaseRow one, other;
  one.state = "done";
  one.values = {{"geometry.yaw", "1 mrad"}};
  one.numbers = {{"p_max_MPa", 900.5}, {"creepage_x", NAN}};
  one.remarks = {2, "ok", "edge; film", "", ""};
  other.state = "failed";
  other.fault = "said \"no\"";
  other.values = {{"drive.speed", "10 m/s, 20 m/s"}};
  return {one, other};
}

}  // namespace

TEST(CaseTable, HasTheKeysAndNumbersOfAllRowsAndIsEmptyWhereARowHasNone) {
  const CaseTable table{joined(value_columns(rows()), number_columns(rows()), remark_columns()), rows()};
  const TemporaryFolder folder;
  write_cases(folder.path() / "table.csv", {"origin"}, table);
  EXPECT_EQ(file_text(folder.path() / "table.csv"),
            "# origin\n"
            "geometry.yaw,drive.speed,p_max_MPa,creepage_x,fault,patches,checks,warnings\n"
            "1 mrad,,900.5,,,2,ok,edge; film\n"
            ",\"10 m/s, 20 m/s\",,,\"said \"\"no\"\"\",0,,\n");
  const nlohmann::ordered_json json = json_of(table);
  EXPECT_EQ(json[0]["p_max_MPa"], 900.5);
  EXPECT_TRUE(json[0]["creepage_x"].is_null() && json[0]["fault"].is_null());
  EXPECT_EQ(json[1]["fault"], "said \"no\"");
}

TEST(CaseTable, SaysWhetherItLastsAndWhatDecidesWhereAnyRowHasAnAnswer) {
  EXPECT_TRUE(answer_columns(rows()).empty());
  std::vector<CaseRow> two = rows();
  two[1].remarks =
      remarks_of(nlohmann::ordered_json::parse(R"({"shakedown": {"answer": {"lasts": "no", "zone": "rail: layer"}}})"));
  const std::vector<CaseColumn> columns = answer_columns(two);
  ASSERT_EQ(columns.size(), 2u);
  EXPECT_EQ(columns[0].cell(two[0]), "");
  EXPECT_EQ(columns[0].cell(two[1]), "no");
  EXPECT_EQ(columns[1].cell(two[1]), "rail: layer");
}

TEST(CaseTable, ATrendHasALineForEachNameInTheOrderOfItsValuesAndALevelForWhatLacksTheKey) {
  std::vector<CaseRow> cases(4);
  for (std::size_t k = 0; k < 3; ++k) {
    cases[k].values = {{"layer.0.thickness", std::vector{"3 mm", "1 mm", "2 mm"}[k]}};
    cases[k].numbers = {{"p_max_MPa", 30.0 - 10.0 * static_cast<double>(k)}};
  }
  cases[3].numbers = {{"p_max_MPa", 5}};
  ReportChart chart;
  add_trend(chart, "layer.0.thickness", "p_max_MPa",
            {{&cases[0], "layer"}, {&cases[1], "layer"}, {&cases[2], "layer"}, {&cases[3], "none"}});
  ASSERT_EQ(chart.series.size(), 2u);
  EXPECT_EQ(chart.series[0].x, (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(chart.series[0].y, (std::vector<double>{20, 10, 30}));
  EXPECT_EQ(chart.series[1].x, (std::vector<double>{1, 3}));
  EXPECT_EQ(chart.series[1].y, (std::vector<double>{5, 5}));
}

}  // namespace railstrata
