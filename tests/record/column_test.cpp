#include "record/column.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "record/json.hpp"
#include "record/vtk.hpp"

namespace railstrata {
namespace {

struct Point {
  double depth = 0;
  int zone = 0;
  Sym3 stress;
};

Columns<Point> columns() {
  Columns<Point> out{{"depth", unit::kMillimetres, &Point::depth, 1}, {"zone", unit::kCount, &Point::zone}};
  append(out, tensor_columns<Point>("sigma", unit::kMPa, &Point::stress));
  return out;
}

const Point kPoint{1.26e-3, 2, {1e6, 2e6, 3e6, 4e6, 5e6, 6e6}};

TEST(Column, IsSaidOnceForTablesAndForNumbersInSi) {
  EXPECT_EQ(names_of(columns()),
            (std::vector<std::string>{"depth_mm", "zone", "sigma_xx_MPa", "sigma_yy_MPa", "sigma_zz_MPa",
                                      "sigma_xy_MPa", "sigma_yz_MPa", "sigma_xz_MPa"}));
  EXPECT_EQ(table_row(columns(), kPoint), (std::vector<double>{1.3, 2, 1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(json_record(kPoint, select(columns(), {"zone", "depth"})).dump(), R"({"zone":2,"depth_m":0.00126})");
  const Point none{std::numeric_limits<double>::quiet_NaN(), 0, {}};
  EXPECT_EQ(json_record(none, select(columns(), {"depth"})).dump(), R"({"depth_m":null})");
}

TEST(Column, OfAPartIsAColumnOfTheWhole) {
  struct Whole {
    Point point;
  };
  const Columns<Whole> lifted = of_part<Whole>(columns(), &Whole::point);
  EXPECT_EQ(table_row(lifted, Whole{kPoint}), table_row(columns(), kPoint));
}

TEST(Column, GivesArraysForVtkWithOneComponentOrSix) {
  std::vector<VtkField> fields{
      vtk_field<float>("stress", std::vector{kPoint}, tensor_columns<Point>("sigma", unit::kMPa, &Point::stress))};
  add_vtk_fields<float>(fields, std::vector{kPoint}, select(columns(), {"zone"}));
  EXPECT_EQ(fields[0].name, "stress_MPa");
  EXPECT_EQ(std::get<std::vector<float>>(fields[0].values), (std::vector<float>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(std::get<std::vector<std::int32_t>>(fields[1].values), std::vector<std::int32_t>{2});
}

}  // namespace
}  // namespace railstrata
