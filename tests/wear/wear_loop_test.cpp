#include "wear/wear_loop.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "core/faults.hpp"
#include "jobs/state_table.hpp"
#include "reader/case_file.hpp"
#include "tests/places.hpp"
#include "wear/wear_loop_page.hpp"

namespace railstrata {
namespace {

constexpr double kCell = 0.5e-3;

CaseSpec arcs(const std::string& loads) {
  return parse_case(
             "[geometry]\nrail_profile = \"arc:R=300 mm\"\nwheel_profile = \"arc:R=-600 mm\"\ncant = 0\n"
             "[drive]\ntraction_coefficient = 0.2\nspin = \"0 1/m\"\n" +
                 loads,
             "a.toml")
      .spec;
}

WearStepOptions coarse(double max_wear) {
  WearStepOptions options;
  options.collective.bem.cell = kCell;
  options.collective.wanted = kContactAlone;
  options.max_wear = max_wear;
  return options;
}

/// A rail worn in steps until so many passages are over.
struct Worn {
  WornRail rail;
  double wanted_area = 0;
};
Worn worn(const CaseSpec& spec, double passages, int steps) {
  const TemporaryFolder folder;
  const Placement original = place(spec, {});
  Worn out{unworn(original, kCell), 0};
  WearStepOptions options = coarse(1e-3);
  for (int k = 0; k < steps; ++k) {
    options.passages_left = passages / steps;
    WearStep step = wear_step(spec, {}, original, out.rail, options);
    out.wanted_area += step.wanted_area;
    out.rail = step.rail;
    out.rail.file = folder.path() / ("step" + std::to_string(k) + ".csv");
    write_profile_table(out.rail.file, {}, out.rail.points);
  }
  return out;
}

/// m, by which the worn profile lies below the unworn one.
double deepest(const WornRail& rail, const CaseSpec& spec) {
  const Placement original = place(spec, {});
  double out = 0;
  for (const Vec2 p : rail.points)
    if (std::abs(p.y) < 0.02) out = std::max(out, original.rail.height(p.y) - p.z);
  return out;
}

constexpr double kPassages = 2e5;

}  // namespace

TEST(WearLoop, TheLayerThinsWhereItWearsAndTheStepEndsWhereItIsThrough) {
  const CaseSpec spec = arcs(
      "[material.rail]\nhardness = \"280 HV\"\n[[layer]]\nthickness = \"0.05 mm\"\nyoung_ratio = 1.5\n"
      "hardness = \"280 HV\"\n[[load]]\npassages = 1000\n");
  const Placement original = place(spec, {});
  const TemporaryFolder folder;
  WornRail rail = unworn(original, kCell);
  const WearStep first = wear_step(spec, {}, original, rail, coarse(0.02e-3));
  EXPECT_NEAR(first.deepest, 0.02e-3, 1e-12);
  EXPECT_NEAR(first.layer_left, 0.03e-3, 1e-9);
  EXPECT_EQ(first.rows[0].spec.layers[0].thickness, 0.05e-3) << "a new rail";
  EXPECT_NEAR(first.tonnes, 2 * first.passages * first.rows[0].summary.contact.F_z / (1e3 * kGravity),
              1e-9 * first.tonnes);
  rail = first.rail;
  rail.file = folder.path() / "worn.csv";
  write_profile_table(rail.file, {}, rail.points);
  const WearStep last = wear_step(spec, {}, original, rail, coarse(0.5e-3));
  EXPECT_NEAR(last.rows[0].spec.layers[0].thickness, 0.03e-3, 1e-6) << "the wheel touches where most is worn off";
  EXPECT_EQ(last.layer_left, 0) << "through";
  EXPECT_NEAR(last.deepest, 0.03e-3, 1e-6) << "no further, though half a millimetre was allowed";
  EXPECT_NEAR(depth_below(unworn(original, kCell).points, last.rail.points[last.rail.points.size() / 2]), 0.05e-3,
              1e-6);
}

TEST(WearLoop, TheAreaOffTheProfileIsThatOfTheStreamlines) {
  const CaseSpec spec = arcs("[[load]]\npassages = 3\nlateral_shift = \"2 mm\"\n[[load]]\nwheel_load = \"60 kN\"\n");
  const Worn result = worn(spec, kPassages, 2);
  EXPECT_NEAR(result.rail.area / result.wanted_area, 1, 0.01);
  EXPECT_NEAR(result.rail.passages, kPassages, 1e-6 * kPassages);
  EXPECT_GT(deepest(result.rail, spec), 20e-6);
}

TEST(WearLoop, SymmetricLoadsWearSymmetrically) {
  const CaseSpec spec = arcs("[[load]]\nlateral_shift = \"3 mm\"\n[[load]]\nlateral_shift = \"-3 mm\"\n");
  const WornRail rail = worn(spec, kPassages, 2).rail;
  const double depth = deepest(rail, spec);
  ASSERT_GT(depth, 20e-6);
  const std::size_t n = rail.points.size();
  for (std::size_t i = 0; i < n; ++i) {
    EXPECT_NEAR(rail.points[i].z, rail.points[n - 1 - i].z, 0.01 * depth) << rail.points[i].y;
    EXPECT_NEAR(rail.points[i].y, -rail.points[n - 1 - i].y, 0.01 * depth);
  }
}

TEST(WearLoop, HalvingTheStepChangesTheProfileLittle) {
  const CaseSpec spec = arcs("[[load]]\n[[load]]\nlateral_shift = \"2 mm\"\n");
  constexpr double kFew = 2e4;  // some 5 µm a step
  const WornRail coarse_steps = worn(spec, kFew, 2).rail, fine_steps = worn(spec, kFew, 4).rail;
  const double depth = deepest(fine_steps, spec);
  ASSERT_GT(depth, 5e-6);
  EXPECT_NEAR(coarse_steps.area / fine_steps.area, 1, 0.02);
  const Profile fine = Profile::from_points(ProfileKind::rail, "fine", fine_steps.points);
  for (const Vec2 p : coarse_steps.points) {
    if (std::abs(p.y) > 0.02) continue;
    EXPECT_NEAR(p.z, fine.height(p.y), 0.1 * depth) << p.y;
  }
}

TEST(WearLoopPage, TheDepthIsTheDistanceToTheWornProfile) {
  std::vector<Vec2> unworn, worn;
  for (int i = 0; i <= 400; ++i) {
    const double angle = 0.002 * (i - 200), worn_off = std::abs(i - 200) < 50 ? 20e-6 : 0;
    const Vec2 outward{std::sin(angle), std::cos(angle)};
    unworn.push_back(0.3 * outward);
    worn.push_back((0.3 - worn_off) * outward);
  }
  const std::vector<double> depth = worn_depth(unworn, worn);
  EXPECT_NEAR(depth[200], 20e-6, 0.2e-6) << "chords of 0.6 mm lie 0.15 µm below the arc";
  EXPECT_NEAR(depth[170], 20e-6, 0.2e-6);
  EXPECT_NEAR(depth[20], 0, 1e-12);
}

TEST(WearLoopPage, ContactsAreReadBackAndThePageNamesTheLoads) {
  const TemporaryFolder folder;
  const std::filesystem::path out = folder.path();
  const std::vector<WearLoad> loads{
      {1, 0, 1, 1, 1200, 13}, {1, 0, 2, -2, 800, 2}, {2, 4e3, 1, 4.787483858534468, 1350.0862428485952, 12}};
  write_rows(out / "loads.csv", {}, wear_load_columns(), loads);
  const std::vector<WearLoad> back = read_rows(out / "loads.csv", wear_load_columns());
  ASSERT_EQ(back.size(), 3u);
  EXPECT_EQ(back[1].load, 2);
  EXPECT_EQ(back[1].y, -2);
  EXPECT_EQ(back[2].y, loads[2].y) << "to the bit: a loop that goes on writes them again";
  EXPECT_EQ(back[2].pressure, loads[2].pressure);
  const WornRail rail = unworn(place(arcs("[[load]]\n"), {}), kCell);
  std::vector<Vec2> worn = rail.points;
  for (Vec2& p : worn)
    if (std::abs(p.y) < 5e-3) p.z -= 30e-6;
  write_wear_loop_page(out / "report.html",
                       {"arcs", {"freight", "coach"}, rail.points, {{2, 8e3, 3e-7, worn, {}}}, back});
  std::ifstream in(out / "report.html");
  const std::string page{std::istreambuf_iterator<char>(in), {}};
  for (const char* words : {"arcs: wear loop", "freight", "coach", "after 8000 passages", "Where each load touches"})
    EXPECT_NE(page.find(words), std::string::npos) << words;
}

TEST(WearLoop, NothingWearsWhereNothingRolled) {
  RailDamage damage;
  damage.cell = kCell;
  damage.passages = {0, 0, 1, 1, 1, 1, 1, 0, 1, 0};
  damage.usfd = {0, 0, 0, 0, 5e-6, 0, 0, 0, 1e-6, 0};
  const std::vector<double> depth = smoothed_wear(damage, WearLaw::usfd);
  EXPECT_EQ(depth[1], 0);
  EXPECT_EQ(depth[7], 0);
  EXPECT_DOUBLE_EQ(depth[8], 1e-6) << "a cell alone has nobody to exchange with";
  EXPECT_NEAR(depth[2] + depth[3] + depth[4] + depth[5] + depth[6], 5e-6, 1e-18);
  EXPECT_LT(depth[4], 3e-6);
  EXPECT_NEAR(depth[3], depth[5], 1e-18);
}

TEST(WearLoop, APeakSpreadsToAMillimetreWithAnyCells) {
  for (const double cell : {0.1e-3, 0.25e-3, 1e-3}) {
    RailDamage damage;
    damage.cell = cell;
    damage.passages.assign(301, 1);
    damage.usfd.assign(301, 0);
    damage.usfd[150] = 1;
    const std::vector<double> depth = smoothed_wear(damage, WearLaw::usfd);
    double variance = 0;
    for (int i = 0; i < 301; ++i) variance += depth[static_cast<std::size_t>(i)] * std::pow((i - 150) * cell, 2);
    EXPECT_NEAR(variance, 1e-6, 1e-12) << cell;
  }
}

TEST(WearLoop, TheRailStaysInItsPlaceAndTheGaugeWidens) {
  const CaseSpec spec = parse_case("[[load]]\n", "a.toml").spec;
  const Placement original = place(spec, {});
  WornRail rail = unworn(original, kCell);
  const TemporaryFolder folder;
  rail.file = folder.path() / "rail.csv";
  for (Vec2& p : rail.points)
    if (p.y < 0) p.y += 0.1e-3;  // the gauge face gives way by 0.1 mm
  const CaseSpec worn = on_worn_rail(spec, original, rail);
  EXPECT_NEAR(worn.geometry.gauge - spec.geometry.gauge, 0.2e-3, 2e-6);
}

TEST(WearLoop, SaysWhatItCannotDo) {
  const CaseSpec spec = arcs("[[load]]\n[[load]]\nname = \"beside\"\nlateral_shift = \"50 mm\"\n");
  const Placement original = place(spec, {});
  try {
    wear_step(spec, {}, original, unworn(original, kCell), coarse(1e-5));
    FAIL();
  } catch (const CaseError& e) {
    EXPECT_NE(std::string(e.what()).find("step 1: beside cannot be solved"), std::string::npos) << e.what();
  }
  CaseSpec hard = arcs("[[load]]\n[collective]\nwear_law = \"archard\"\n");
  EXPECT_THROW(wear_step(hard, {}, original, unworn(original, kCell), coarse(1e-5)), CaseError);
  Placement no_face = original;
  no_face.wheel = place(parse_case("", "a.toml").spec, {}).wheel;
  EXPECT_THROW(wear_step(spec, {}, no_face, unworn(no_face, kCell), coarse(1e-5)), CaseError);
}

}  // namespace railstrata
