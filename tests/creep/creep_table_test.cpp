#include "creep/table_error.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>

#include "core/faults.hpp"
#include "core/parallel.hpp"
#include "halfspace/creep_theories.hpp"

namespace railstrata {
namespace {

LoadedCase ball() {
  return parse_case(
      "[geometry]\nrail_profile = \"flat\"\nwheel_profile = \"arc:R=430 mm\"\nrail_shape = \"block\"\n"
      "wheel_shape = \"disc\"\ncant = 0\n[drive]\nfriction_coefficient = 0.3\n",
      "ball.toml", {});
}

CreepTableOptions coarse() {
  CreepTableOptions out;
  out.bem.cell = 1e-3;
  return out;
}

std::size_t number(const ForceTable& table, const std::string& name) {
  for (std::size_t k = 0; k < table.numbers.size(); ++k)
    if (table.numbers[k].name == name) return k;
  ADD_FAILURE() << name;
  return 0;
}

std::vector<NumberAxis> axes_of(const std::vector<std::string>& texts) { return parse_number_axes("--axis", texts); }

std::string refusal(const std::string& axis) {
  try {
    axes_of({axis});
  } catch (const CaseError& e) {
    return e.what();
  }
  return "";
}

}  // namespace

TEST(CreepTable, ReadsAxesInThreeForms) {
  const std::vector<NumberAxis> axes =
      axes_of({"load=50 kN, 0.1 MN", "lateral_shift=-2 mm:2 mm:5", "creepage_x=+-0.01:5", "layer.0.thickness=1,2 mm"});
  ASSERT_EQ(axes.size(), 4u);
  EXPECT_EQ(axes[0].at, (std::vector<double>{50e3, 100e3}));
  EXPECT_EQ(axes[0].unit, "N");
  EXPECT_EQ(axes[1].key, "geometry.lateral_shift");
  EXPECT_EQ(axes[1].at.size(), 5u);
  EXPECT_EQ(axes[1].at[4], 2e-3);
  EXPECT_EQ(axes[2].at.size(), 5u);
  EXPECT_EQ(axes[2].at[2], 0);
  EXPECT_EQ(axes[2].at[0], -0.01);
  EXPECT_NEAR(axes[2].at[3], 0.01 * std::pow(10, -1.25), 1e-12);
  EXPECT_EQ(axes[3].at, (std::vector<double>{1e-3, 2e-3}));
  EXPECT_EQ(axes_of({"drive.creepage=0,0.1"})[0].word, "creepage_x");
}

TEST(CreepTable, SaysWhatIsWrongWithAnAxis) {
  EXPECT_NE(refusal("creepage=0,1").find("key creepage"), std::string::npos);
  EXPECT_NE(refusal("load").find("KEY=VALUES"), std::string::npos);
  EXPECT_NE(refusal("load=50,100").find("50"), std::string::npos) << "a unit is missing";
  EXPECT_NE(refusal("load=100 kN,50 kN").find("ascending order"), std::string::npos);
  EXPECT_NE(refusal("load=100 kN").find("at least two values"), std::string::npos);
  EXPECT_NE(refusal("creepage_x=+-0.01:4").find("give an odd number"), std::string::npos);
  EXPECT_NE(refusal("creepage_x=0:50:3").find("out of range"), std::string::npos);
  EXPECT_NE(refusal("case.title=1,2").find("is no number"), std::string::npos);
  EXPECT_NE(refusal("creepage_x=0:0.1:2000").find("give 2 to 1000"), std::string::npos);
  EXPECT_NE(refusal("load=5 t,10 t").find("\"49.05 kN\""), std::string::npos);
  EXPECT_NE(refusal("lateral_shift=0,,1 mm").find("a value is missing"), std::string::npos);
  EXPECT_NE(refusal("Load=1 kN,2 kN").find("did you mean load?"), std::string::npos);
  EXPECT_THROW(axes_of({"spin=0:1:3", "drive.spin=0:1:3"}), CaseError);
  EXPECT_THROW(axes_of({}), CaseError);
}

TEST(CreepTable, TakesUnitsWithOrWithoutABlankAndSlopesAsTangents) {
  EXPECT_EQ(axes_of({"layer.0.thickness=100,200µm"})[0].at, (std::vector<double>{1e-4, 2e-4}));
  EXPECT_EQ(axes_of({"layer.0.thickness=100um,0.2mm"})[0].at, (std::vector<double>{1e-4, 2e-4}));
  EXPECT_EQ(axes_of({"friction=10,30 %"})[0].at, (std::vector<double>{0.1, 0.3}));
  EXPECT_EQ(axes_of({"geometry.cant=0.025,1/20"})[0].at, (std::vector<double>{0.025, 0.05}));
  const NumberAxis yaw = axes_of({"yaw=-1:1 deg:3"})[0];
  EXPECT_EQ(yaw.at[2], std::tan(std::numbers::pi / 180));
  EXPECT_EQ(yaw.unit, "") << "a tangent, not an angle";
}

TEST(CreepTable, NamesTheAxisWhoseValueTheCaseRefuses) {
  try {
    CreepTable table(ball(), axes_of({"creepage_x=0,1e-3", "layer.0.thickness=1 mm,2 mm"}));
    FAIL() << "a layer without a modulus";
  } catch (const CaseError& e) {
    EXPECT_EQ(e.diagnostics.front().where, "--axis layer.0.thickness, 1 mm");
  }
}

TEST(CreepTable, IsOfTheCaseWithItsOverrides) {
  const auto force = [](const LoadedCase& base) {
    CreepTable table(base, axes_of({"creepage_x=0,0.1"}));
    table.solve(coarse());
    return table.table().numbers[number(table.table(), "force_x")].values[1];
  };
  EXPECT_NEAR(force(with_overrides(ball(), {"drive.friction_coefficient=0.6"})) / force(ball()), 2, 1e-3)
      << "full sliding";
}

TEST(CreepTable, RefusesTwoAxesOfWhichOneGivesTheOther) {
  for (const auto& [one, other] : {std::pair{"creepage_x=0,1e-3", "drive.traction_coefficient=0.1,0.2"},
                                   std::pair{"drive.lateral_force=0,1 kN", "creepage_y=0,1e-3"}}) {
    try {
      CreepTable(ball(), axes_of({one, other}));
      FAIL() << one << " and " << other;
    } catch (const CaseError& e) {
      EXPECT_NE(std::string(e.what()).find("a case has one of them"), std::string::npos) << e.what();
    }
  }
}

TEST(CreepTable, CountsItsPointsBeforeItMakesThem) {
  std::vector<std::string> axes;
  for (const char* axis : {"creepage_x=0:0.01", "creepage_y=0:0.01", "spin=0:0.1 1/m", "load=10:100 kN",
                           "friction=0.1:0.3", "lateral_shift=0:1 mm", "yaw=0:0.01", "drive.speed=1:10 m/s"})
    axes.push_back(std::string(axis) + ":256");  // 256^8 = 2^64
  EXPECT_THROW(CreepTable(ball(), axes_of(axes)), CaseError);
}

TEST(CreepTable, LeavesTheTractionOfTheCaseWhereACreepageIsGiven) {
  LoadedCase driven = ball();
  driven.source_text += "traction_coefficient = 0.2\n";  // more than the smaller friction
  CreepTable table(driven, axes_of({"creepage_x=-1e-3,1e-3", "friction=0.1,0.3", "mesh.element_size=1,2 mm"}));
  table.solve(coarse());
  EXPECT_EQ(table.missing(), 0u);
  EXPECT_EQ(table.idle_axes(), (std::vector<std::string>{"mesh.element_size"}));
}

TEST(CreepTable, HasTheSolutionsOfItsPoints) {
  CreepTable table(ball(), axes_of({"creepage_x=+-0.01:7", "load=60 kN,90 kN"}));
  table.solve(coarse());
  EXPECT_EQ(table.points(), 14u);
  EXPECT_EQ(table.missing(), 0u);
  const ForceTable& t = table.table();
  const std::size_t force = number(t, "force_x"), bound = number(t, "bound"), normal = number(t, "normal_force");
  for (std::size_t i = 0; i < 7; ++i)
    for (std::size_t j = 0; j < 2; ++j) {
      const auto direct = table.direct({t.axes[0].at[i], t.axes[1].at[j]}, coarse().bem);
      ASSERT_TRUE(direct);
      EXPECT_NEAR(t.numbers[force].values[2 * i + j], (*direct)[force], 1e-4 * 90e3);
      EXPECT_NEAR(t.numbers[normal].values[2 * i + j], t.axes[1].at[j], 1);
      EXPECT_LE(t.numbers[bound].values[2 * i + j], 1 + 1e-4);
    }
  EXPECT_GT(t.numbers[force].values[0], 0) << "a driving wheel has creepage < 0 and is pushed forward";
}

TEST(CreepTable, RollsWhateverRunRollingSays) {
  LoadedCase still = ball();
  still.source_text += "\n[run]\nrolling = false\n";
  const auto axes = [] { return axes_of({"creepage_x=+-0.01:3"}); };
  CreepTable rolling(ball(), axes()), table(still, axes());
  rolling.solve(coarse());
  table.solve(coarse());
  EXPECT_GT(table.table().numbers[number(table.table(), "force_x")].values[0], 0);
  for (std::size_t n = 0; n < table.table().numbers.size(); ++n)
    EXPECT_EQ(table.table().numbers[n].values, rolling.table().numbers[n].values);
}

TEST(CreepTable, HasTheSameBitsForAnyThreadsAndAfterAStop) {
  const std::vector<NumberAxis> axes = axes_of({"creepage_x=+-0.01:5", "spin=0,0.4 1/m", "load=60 kN,90 kN"});
  std::vector<std::vector<double>> forces;
  for (const int threads : {1, 2}) {
    const int before = max_threads();
    set_threads(threads);
    CreepTable table(ball(), axes);
    table.solve(coarse());
    set_threads(before);
    forces.push_back(table.table().numbers[number(table.table(), "force_x")].values);
  }
  EXPECT_EQ(forces[0], forces[1]);
  Control control;
  CreepTable begun(ball(), axes);
  CreepTableOptions how = coarse();
  how.control = &control;
  how.solved = [&](std::size_t done) { control.stop = done >= 5; };
  begun.solve(how);
  EXPECT_GT(begun.missing(), 0u);
  CreepTable resumed(ball(), axes);
  resumed.take(begun.table());
  resumed.solve(coarse());
  EXPECT_EQ(resumed.missing(), 0u);
  EXPECT_EQ(resumed.table().numbers[number(resumed.table(), "force_x")].values, forces[0]);
  CreepTable other(ball(), axes_of({"creepage_x=+-0.02:5"}));
  EXPECT_THROW(other.take(begun.table()), CaseError);
}

TEST(CreepTable, SaysWhichPointsHaveNoAnswer) {
  const LoadedCase whole = parse_case("", "base.toml", {});
  CreepTable table(whole, axes_of({"lateral_shift=0 mm,30 mm", "creepage_x=0,0.001"}));
  table.solve(coarse());
  EXPECT_EQ(table.missing(), 2u) << "the wheel has left the rail";
  ASSERT_FALSE(table.faults().empty());
  EXPECT_NE(table.faults()[0].find("lateral_shift = 0.03 m"), std::string::npos) << table.faults()[0];
}

namespace {

const std::vector<std::string> kCreepageEnds = {"creepage_x=-0.01,0.01", "creepage_y=-0.01,0.01", "spin=-0.5,0.5 1/m"};

CreepTable scaled_ball(const ScaledCounts& counts, std::vector<std::string> more = {}) {
  more.insert(more.begin(), kCreepageEnds.begin(), kCreepageEnds.end());
  return {ball(), axes_of(more), counts};
}

std::string refusal_of_scaled(const LoadedCase& base, const std::vector<std::string>& axes) {
  try {
    CreepTable(base, axes_of(axes), ScaledCounts{});
  } catch (const CaseError& e) {
    return e.what();
  }
  return "";
}

}  // namespace

TEST(ScaledCreepTable, HasKalkersStiffnessesAndTheSameForAnyLoad) {
  CreepTable table = scaled_ball({4, 5, 4}, {"load=60 kN,120 kN"});
  table.solve(coarse());
  ASSERT_EQ(table.missing(), 0u);
  const MaterialSpec steel = ball().spec.rail_material;
  const double poisson = steel.poisson, shear = steel.young / (2 * (1 + poisson));
  const CreepCoefficients kalker = kalker_coefficients(1, poisson);
  const std::size_t area = number(table.table(), "patch_area");
  for (std::size_t load = 0; load < 2; ++load) {
    const auto& stiffness = table.table().scaling->stiffness;
    const double n = table.table().axes[3].at[load], c2 = table.table().numbers[area].values[load] / std::numbers::pi,
                 tolerance = 0.05;  // 12 to 15 cells across the patch, 1 % from slip at a hundredth of the unit
    EXPECT_NEAR(stiffness[0].values[load] * std::pow(n, 2.0 / 3) / (shear * c2 * kalker.c11), 1, tolerance);
    EXPECT_NEAR(stiffness[1].values[load] * std::pow(n, 2.0 / 3) / (shear * c2 * kalker.c22), 1, tolerance);
    EXPECT_NEAR(stiffness[2].values[load] * n / (shear * std::pow(c2, 1.5) * kalker.c23), 1, tolerance);
  }
}

TEST(ScaledCreepTable, IsNearDirectSolutionsBetweenItsPointsAndNearerWithMore) {
  double before = 1;
  for (const ScaledCounts counts : {ScaledCounts{6, 7, 6}, ScaledCounts{12, 13, 12}}) {
    CreepTable table = scaled_ball(counts);
    table.solve(coarse());
    const TableError error = interpolation_error(table, 40, coarse());
    EXPECT_EQ(error.places, 40);
    EXPECT_LE(error.creep_force.half, error.creep_force.most);
    EXPECT_LE(error.creep_force.most, error.creep_force.largest);
    EXPECT_GT(error.creep_force.half, 0);
    EXPECT_LT(error.creep_force.most, 0.4 * before) << "cubic: an eighth and less but for the edge of full sliding";
    before = error.creep_force.most;
  }
  EXPECT_LT(before, 0.01);
}

// 10,080 points, shifts dense where the patch moves across the profiles.
TEST(SlowScaledCreepTable, OfAEuropeanPairOverItsShiftIsNearDirectSolutions) {
  const LoadedCase european = parse_case(
      "[geometry]\nwheel_profile = \"S1002\"\nrail_profile = \"UIC60\"\ncant = \"1:40\"\nwheel_radius = \"460 mm\"\n"
      "[drive]\nfriction_coefficient = 0.35\ntraction_coefficient = 0.0\n",
      "european.toml", {});
  CreepTable table(european,
                   axes_of({"creepage_x=-0.02,0.02", "creepage_y=-0.02,0.02", "spin=-0.5,0.5 1/m",
                            "lateral_shift=-4,-2.3,-1.5,-1,-0.6,-0.2,0.2,0.6,1,1.4,1.8,2.2,2.6,3,3.5,4 mm"}),
                   ScaledCounts{10, 7, 9});
  table.solve(coarse());
  EXPECT_EQ(table.missing(), 0u);
  const TableError error = interpolation_error(table, 2500, coarse());
  EXPECT_LT(error.creep_force.half, 0.0005);
  EXPECT_LT(error.creep_force.most, 0.004);
  EXPECT_LT(error.creep_force.largest, 0.01);
}

TEST(ScaledCreepTable, IsRefusedWithTheReasonWhereNothingScalesIt) {
  LoadedCase pressed = ball(), smooth = ball();
  pressed.source_text += "[vehicle]\napproach = \"60 um\"\n";
  smooth.source_text = std::string(smooth.source_text).replace(smooth.source_text.find("0.3"), 3, "0.0");
  std::vector<std::string> two = kCreepageEnds;
  two.erase(two.begin() + 1);
  EXPECT_NE(refusal_of_scaled(pressed, kCreepageEnds).find("scaled by the load, which is a result"), std::string::npos);
  EXPECT_NE(refusal_of_scaled(smooth, kCreepageEnds).find("needs drive.friction_coefficient"), std::string::npos);
  EXPECT_NE(refusal_of_scaled(ball(), two).find("needs an axis of drive.lateral_creepage"), std::string::npos);
}

TEST(ScaledCreepTable, GoesOnWithTheSameEndsAlone) {
  CreepTable begun = scaled_ball({4, 5, 4}), same = scaled_ball({4, 5, 4});
  begun.solve(coarse());
  same.take(begun.table());
  CreepTable other(ball(), axes_of({"creepage_x=-0.02,0.02", kCreepageEnds[1], kCreepageEnds[2]}),
                   ScaledCounts{4, 5, 4});
  EXPECT_THROW(other.take(begun.table()), CaseError);
}

TEST(CreepTable, ErrorOfInterpolationFallsWithTheSquareOfItsCells) {
  double before = 0;
  for (const int n : {5, 9}) {
    CreepTable table(ball(), axes_of({"creepage_x=-0.002:-0.0002:" + std::to_string(n), "load=60 kN,60.1 kN"}));
    table.solve(coarse());
    const TableError error = interpolation_error(table, 40, coarse());
    EXPECT_EQ(error.places, 40);
    const double force = error.numbers[number(table.table(), "force_x")].mean;
    EXPECT_GT(force, 0);
    if (before > 0) {
      EXPECT_LT(force, 0.45 * before);
    }
    before = force;
  }
}

}  // namespace railstrata
